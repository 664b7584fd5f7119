"""A soft body with contractile elements, as examples/problem-format.md defines it: energy, gradient, Hessian, equilibrium.

Written against the formulas of that page alone, with numpy and scipy's SuperLU, so that its figures are independent of plushwright's.
Positions are flat arrays [x0, y0, x1, y1, ...] in m, energies in J.
"""

import numpy as np
from scipy.sparse import csc_matrix
from scipy.sparse.linalg import splu

# Equilibrium: largest component of dE/dx, as a part of mu times the body length (the same measure at every size).
RESIDUAL = 1e-10
# Newton steps before statics gives up, and halvings of one step.
STEPS, HALVINGS = 200, 40
# Part of the way to the first triangle that would turn over which a step may go.
CAP = 0.9
# Smallest eigenvalue that a projected block keeps, in mu.
FLOOR = 1e-6


class NoEquilibrium(Exception):
    pass


class Body:
    def __init__(self, problem):
        self.rest = np.array(problem["mesh"]["nodes"], float)
        self.length = np.ptp(self.rest, axis=0).max()
        self.mu, self.kappa = problem["material"]["mu"], problem["material"]["kappa"]
        self.triangles = np.array(problem["mesh"]["triangles"])
        corners = self.rest[self.triangles]
        edges = np.stack([corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]], axis=2)
        self.area = 0.5 * np.linalg.det(edges)
        # F = sum_k x_k (x) shape_k: the gradients of the three shape functions.
        inverse = np.linalg.inv(edges)
        self.shape = np.concatenate([-inverse.sum(axis=1, keepdims=True), inverse], axis=1)
        pins = problem.get("pins") or []
        self.pin_nodes = np.array([p["node"] for p in pins], int)
        self.pin_targets = np.array([p["target"] for p in pins], float).reshape(-1, 2)
        self.pin_k = np.array([p["K"] for p in pins], float)
        self._elements(problem.get("elements") or [])
        self._pattern()

    def _elements(self, elements):
        """Segments of all elements, and the distinct nodes of each element, flattened."""
        self.count = len(elements)
        self.k, self.epsilon, self.alpha0 = (np.array([e[name] for e in elements], float) for name in ("K", "epsilon", "alpha0"))
        self.winch = np.array([e["winch"] for e in elements], int)
        owner, start, end, place, entries = [], [], [], [], []
        for e, element in enumerate(elements):
            nodes = element["routing"]
            where = {}
            for node in nodes:
                if node not in where:
                    where[node] = len(entries)
                    entries.append((e, node))
            for a, b in zip(nodes, nodes[1:]):
                owner.append(e)
                start.append(a)
                end.append(b)
                place.append((where[a], where[b]))
        self.owner, self.start, self.end = (np.array(v, int) for v in (owner, start, end))
        self.place = np.array(place, int).reshape(-1, 2)
        self.entry = np.array(entries, int).reshape(-1, 2)

    def _pattern(self):
        """Where each block entry goes in the compressed matrix: triangles, segments, elements' outer products, pins."""
        dofs = lambda nodes: np.stack([2 * nodes, 2 * nodes + 1], axis=-1).reshape(len(nodes), -1)
        rows, columns = [], []
        for nodes in (self.triangles, np.stack([self.start, self.end], axis=1)):
            d = dofs(nodes)
            rows.append(np.repeat(d, d.shape[1], axis=1).ravel())
            columns.append(np.tile(d, d.shape[1]).ravel())
        # All pairs of gradient entries of the same element.
        owner = np.repeat(self.entry[:, 0], 2)
        dof = (2 * self.entry[:, 1:] + [0, 1]).ravel()
        sizes = np.bincount(owner, minlength=self.count)
        first = np.concatenate([[0], np.cumsum(sizes)[:-1]]).astype(int) if self.count else np.zeros(0, int)
        self.pair_i = np.repeat(np.arange(len(owner)), sizes[owner]) if self.count else np.zeros(0, int)
        within = np.arange(len(self.pair_i)) - np.repeat(np.cumsum(sizes[owner]) - sizes[owner], sizes[owner])
        self.pair_j = first[owner[self.pair_i]] + within
        self.pair_owner = owner[self.pair_i]
        self.entry_owner, self.entry_dof = owner, dof
        pins = (2 * self.pin_nodes[:, None] + [0, 1]).ravel()
        rows = np.concatenate(rows + [dof[self.pair_i], pins])
        columns = np.concatenate(columns + [dof[self.pair_j], pins])
        n = self.rest.size
        keys, self.slot = np.unique(columns * n + rows, return_inverse=True)
        self.indices = (keys % n).astype(np.int32)
        self.indptr = np.searchsorted(keys, np.arange(n + 1) * n).astype(np.int32)

    def stretch(self, x):
        """Deformation gradients F and their determinants."""
        f = np.einsum("tki,tkj->tij", x.reshape(-1, 2)[self.triangles], self.shape)
        return f, f[:, 0, 0] * f[:, 1, 1] - f[:, 0, 1] * f[:, 1, 0]

    def segments(self, x):
        """Lengths of the elements; lengths and directions of their segments."""
        points = x.reshape(-1, 2)
        d = points[self.end] - points[self.start]
        length = np.hypot(d[:, 0], d[:, 1])
        return np.bincount(self.owner, length, self.count), length, d / length[:, None]

    def forces(self, gamma):
        """U, U' and U'' of the elements."""
        k, eps = self.k, self.epsilon
        into = np.clip(gamma + eps, 0.0, 2.0 * eps)
        taut = gamma >= eps
        energy = np.where(taut, k * gamma**2 + k * eps**2 / 3.0, k / (6.0 * eps) * into**3)
        tension = np.where(taut, 2.0 * k * gamma, k / (2.0 * eps) * into**2)
        return energy, tension, np.where(taut, 2.0 * k, k / eps * into)

    def energy(self, x, alpha):
        f, j = self.stretch(x)
        if not j.min() > 0.0:
            return np.inf
        log = np.log(j)
        psi = 0.5 * self.mu * ((f * f).sum(axis=(1, 2)) - 2.0) - self.mu * log + 0.5 * self.kappa * log**2
        offset = x.reshape(-1, 2)[self.pin_nodes] - self.pin_targets
        length = self.segments(x)[0]
        contractile = self.forces(length - self.alpha0 + alpha)[0].sum() if self.count else 0.0
        return self.area @ psi + contractile + 0.5 * self.pin_k @ (offset**2).sum(axis=1)

    def gradient(self, x, alpha):
        f, j = self.stretch(x)
        cofactor = np.stack([f[:, 1, 1], -f[:, 1, 0], -f[:, 0, 1], f[:, 0, 0]], axis=1).reshape(-1, 2, 2)
        stress = self.mu * f + ((self.kappa * np.log(j) - self.mu) / j)[:, None, None] * cofactor
        nodal = np.einsum("tij,tkj,t->tki", stress, self.shape, self.area)
        out = np.zeros_like(x)
        for d in (0, 1):
            out[d::2] += np.bincount(self.triangles.ravel(), nodal[:, :, d].ravel(), len(out) // 2)
            out[2 * self.pin_nodes + d] += self.pin_k * (x[2 * self.pin_nodes + d] - self.pin_targets[:, d])
        if self.count:
            length, _, direction = self.segments(x)
            tension = self.forces(length - self.alpha0 + alpha)[1]
            out += self.pull(tension, direction)
        return out

    def length_gradient(self, direction):
        """dl/dx, one number for each entry (element, node, axis)."""
        flat = np.zeros((len(self.entry), 2))
        for d in (0, 1):
            flat[:, d] = np.bincount(self.place[:, 1], direction[:, d], len(flat))
            flat[:, d] -= np.bincount(self.place[:, 0], direction[:, d], len(flat))
        return flat.ravel()

    def pull(self, weights, direction):
        """sum over the elements of weight dl/dx."""
        values = self.length_gradient(direction) * weights[self.entry_owner]
        return np.bincount(self.entry_dof, values, self.rest.size)

    def hessian(self, x, alpha, projected=False):
        f, j = self.stretch(x)
        a, b, c, d = f[:, 0, 0], f[:, 0, 1], f[:, 1, 0], f[:, 1, 1]
        cof = np.stack([d, -c, -b, a], axis=1)  # in the order F00, F01, F10, F11
        pressure = self.kappa * np.log(j) - self.mu
        flip = np.array([[0, 0, 0, 1], [0, 0, -1, 0], [0, -1, 0, 0], [1, 0, 0, 0.0]])
        block = self.mu * np.eye(4) + ((self.kappa - pressure) / j**2)[:, None, None] * cof[:, :, None] * cof[:, None, :]
        block = block + (pressure / j)[:, None, None] * flip
        if projected:
            values, vectors = np.linalg.eigh(block)
            block = np.einsum("tij,tj,tkj->tik", vectors, np.maximum(values, FLOOR * self.mu), vectors)
        block = block.reshape(-1, 2, 2, 2, 2) * self.area[:, None, None, None, None]
        parts = [np.einsum("tiajb,tka,tlb->tkilj", block, self.shape, self.shape, optimize=True).ravel()]
        if self.count:
            length, segment, direction = self.segments(x)
            _, tension, stiffness = self.forces(length - self.alpha0 + alpha)
            curved = (np.eye(2) - direction[:, :, None] * direction[:, None, :]) * (tension[self.owner] / segment)[:, None, None]
            parts.append((np.array([[1, -1], [-1, 1]])[None, :, None, :, None] * curved[:, None, :, None, :]).ravel())
            g = self.length_gradient(direction)
            parts.append(stiffness[self.pair_owner] * g[self.pair_i] * g[self.pair_j])
        parts.append(np.repeat(self.pin_k, 2))
        data = np.bincount(self.slot, np.concatenate(parts), len(self.indices))
        return csc_matrix((data, self.indices, self.indptr), shape=(x.size, x.size))

    def farthest(self, x, step):
        """The part of the step after which the first triangle is flat."""
        f, j = self.stretch(x)
        g, quadratic = self.stretch(step)
        linear = f[:, 0, 0] * g[:, 1, 1] + f[:, 1, 1] * g[:, 0, 0] - f[:, 0, 1] * g[:, 1, 0] - f[:, 1, 0] * g[:, 0, 1]
        # The smallest positive root of j + linear t + quadratic t^2 is 2 j over the largest denominator.
        root = linear**2 - 4.0 * quadratic * j
        rate = np.where(root >= 0.0, (np.sqrt(np.maximum(root, 0.0)) - linear) / (2.0 * j), 0.0)
        return 1.0 / max(rate.max(), 1e-300)

    def advance(self, x, alpha, step, energy, slope):
        """x after as much of the step as lowers the energy, with that energy; None where no part of it does."""
        t = min(1.0, CAP * self.farthest(x, step))
        for _ in range(HALVINGS):
            tried = x + t * step
            new = self.energy(tried, alpha)
            if new <= energy + 1e-4 * t * slope + 1e-14 * abs(energy):
                return tried, new
            t *= 0.5
        return None

    def equilibrium(self, alpha, x):
        """x in equilibrium with contractions alpha by Newton's method with a line search, and the factor of the Hessian there."""
        goal = RESIDUAL * self.mu * self.length
        energy = self.energy(x, alpha)
        for _ in range(STEPS):
            g = self.gradient(x, alpha)
            factor = factorise(self.hessian(x, alpha))
            if np.abs(g).max() <= goal:
                return x, factor
            step = -factor.solve(g)
            moved = self.advance(x, alpha, step, energy, g @ step) if g @ step < 0.0 else None
            if moved is None:
                step = -factorise(self.hessian(x, alpha, projected=True)).solve(g)
                moved = self.advance(x, alpha, step, energy, g @ step)
            if moved is None:
                if np.abs(g).max() <= 1e3 * goal:  # as far as rounding lets the energy tell
                    return x, factor
                break
            x, energy = moved
        raise NoEquilibrium


def factorise(matrix):
    """SuperLU as it is quickest for a symmetric matrix."""
    return splu(matrix, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
