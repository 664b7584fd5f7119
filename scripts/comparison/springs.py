"""Contractile elements and pins, as examples/problem-format.md defines them: energy, gradient and the entries of the Hessian.

Positions are flat arrays [x0, y0, x1, y1, ...] in m. All loops over elements are numpy's.
"""

import numpy as np

# Width of a point, in rest lengths of its element: where the ends of a segment meet, its length is smooth.
POINT = 1e-9


class Springs:
    def __init__(self, problem):
        self.size = 2 * len(problem["mesh"]["nodes"])
        pins = problem.get("pins") or []
        self.pin_nodes = np.array([p["node"] for p in pins], int)
        self.pin_targets = np.array([p["target"] for p in pins], float).reshape(-1, 2)
        self.pin_k = np.array([p["K"] for p in pins], float)
        elements = problem.get("elements") or []
        self.count = len(elements)
        self.k, self.epsilon, self.alpha0 = (np.array([e[name] for e in elements], float) for name in ("K", "epsilon", "alpha0"))
        self.winch = np.array([e["winch"] for e in elements], int)
        self._flatten([e["routing"] for e in elements])

    def _flatten(self, routings):
        """Segments of all elements; entries, the distinct nodes of each element; all pairs of entries of the same element."""
        owner, ends, place, entries = [], [], [], []
        for e, nodes in enumerate(routings):
            where = {}
            for node in nodes:
                if node not in where:
                    where[node] = len(entries)
                    entries.append((e, node))
            for a, b in zip(nodes, nodes[1:]):
                owner.append(e)
                ends.append((a, b))
                place.append((where[a], where[b]))
        self.owner = np.array(owner, int)
        self.ends, self.place, entries = (np.array(v, int).reshape(-1, 2) for v in (ends, place, entries))
        self.entry_owner = np.repeat(entries[:, 0], 2)
        self.entry_dof = (2 * entries[:, 1:] + [0, 1]).ravel()
        sizes = np.bincount(self.entry_owner, minlength=self.count)
        first, each = np.cumsum(sizes) - sizes, sizes[self.entry_owner]
        self.pair_i = np.repeat(np.arange(len(each)), each)
        self.pair_j = np.arange(len(self.pair_i)) - np.repeat(np.cumsum(each) - each, each)
        self.pair_j += first[self.entry_owner[self.pair_i]]

    def segments(self, x):
        """Lengths of the elements; lengths and directions (unit vectors, but for points that meet) of their segments."""
        points = x.reshape(-1, 2)
        d = points[self.ends[:, 1]] - points[self.ends[:, 0]]
        length = np.sqrt((d**2).sum(axis=1) + (POINT * self.alpha0[self.owner]) ** 2)
        return np.bincount(self.owner, length, self.count), length, d / length[:, None]

    def laws(self, gamma):
        """U, U' and U'' of the elements."""
        k, eps = self.k, self.epsilon
        into = np.clip(gamma + eps, 0.0, 2.0 * eps)
        taut = gamma >= eps
        energy = np.where(taut, k * gamma**2 + k * eps**2 / 3.0, k / (6.0 * eps) * into**3)
        tension = np.where(taut, 2.0 * k * gamma, k / (2.0 * eps) * into**2)
        return energy, tension, np.where(taut, 2.0 * k, k / eps * into)

    def energy(self, x, alpha):
        offset = x.reshape(-1, 2)[self.pin_nodes] - self.pin_targets
        stored = self.laws(self.segments(x)[0] - self.alpha0 + alpha)[0].sum()
        return stored + 0.5 * self.pin_k @ (offset**2).sum(axis=1)

    def gradient(self, x, alpha):
        length, _, direction = self.segments(x)
        out = self.pull(self.laws(length - self.alpha0 + alpha)[1], direction)
        for d in (0, 1):
            out[2 * self.pin_nodes + d] += self.pin_k * (x[2 * self.pin_nodes + d] - self.pin_targets[:, d])
        return out

    def length_gradient(self, direction):
        """dl/dx, one number for each entry (element, node, axis)."""
        flat = np.zeros((len(self.entry_dof) // 2, 2))
        for d in (0, 1):
            flat[:, d] = np.bincount(self.place[:, 1], direction[:, d], len(flat))
            flat[:, d] -= np.bincount(self.place[:, 0], direction[:, d], len(flat))
        return flat.ravel()

    def pull(self, weights, direction):
        """sum over the elements of weight dl/dx."""
        values = self.length_gradient(direction) * weights[self.entry_owner]
        return np.bincount(self.entry_dof, values, self.size)

    def places(self):
        """Rows and columns of the numbers that `entries` returns."""
        dofs = (2 * self.ends[:, :, None] + [0, 1]).reshape(-1, 4)
        pins = (2 * self.pin_nodes[:, None] + [0, 1]).ravel()
        rows = [np.repeat(dofs, 4, axis=1).ravel(), self.entry_dof[self.pair_i], pins]
        columns = [np.tile(dofs, 4).ravel(), self.entry_dof[self.pair_j], pins]
        return np.concatenate(rows), np.concatenate(columns)

    def entries(self, x, alpha):
        """The second derivatives: tension times the curvature of each segment, U'' dl dl^T of each element, pins."""
        length, segment, direction = self.segments(x)
        _, tension, stiffness = self.laws(length - self.alpha0 + alpha)
        curved = (np.eye(2) - direction[:, :, None] * direction[:, None, :]) * (tension[self.owner] / segment)[:, None, None]
        blocks = np.array([[1, -1], [-1, 1]])[None, :, None, :, None] * curved[:, None, :, None, :]
        g = self.length_gradient(direction)
        outer = stiffness[self.entry_owner[self.pair_i]] * g[self.pair_i] * g[self.pair_j]
        return np.concatenate([blocks.ravel(), outer, np.repeat(self.pin_k, 2)])
