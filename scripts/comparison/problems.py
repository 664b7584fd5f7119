"""Problem files from a seed: bars, L's, stars, rings and limbs of fibres or winches, with targets in reach and out of it."""

import numpy as np

from body import Body, NoEquilibrium

SHAPES = ["bar", "L", "star", "ring", "limb"]
# Figures of the shared kind of problem, SI units.
FEWEST, MOST = 100, 5000
PIN_K = 20000.0
TENDON_K, TENDON_EPSILON = 5000.0, 0.001
# How far the targets are, in body lengths.
NEAR, FAR = 0.08, 0.45


def outline(name, rng):
    """inside(points) and the box of a shape, m."""
    size = rng.uniform(0.2, 0.3)
    if name == "bar":
        height = size * rng.uniform(0.2, 0.4)
        return (lambda p: (p >= 0).all(axis=1) & (p[:, 0] <= size) & (p[:, 1] <= height)), (0, 0, size, height)
    if name == "L":
        width = size * rng.uniform(0.28, 0.42)
        return (lambda p: (p >= 0).all(axis=1) & (p <= size).all(axis=1) & (p.min(axis=1) <= width)), (0, 0, size, size)
    radius, phase = size / 2, rng.uniform(0, 2 * np.pi)
    box = (-radius, -radius, radius, radius)
    if name == "star":
        arms, depth = rng.integers(3, 7), rng.uniform(0.3, 0.5)

        def star(p):
            r, angle = np.hypot(*p.T), np.arctan2(p[:, 1], p[:, 0])
            return r <= radius * (1 - depth * (0.5 + 0.5 * np.cos(arms * angle + phase)))

        return star, box
    if name == "ring":
        hole = radius * rng.uniform(0.35, 0.55)
        return (lambda p: (np.hypot(*p.T) <= radius) & (np.hypot(*p.T) >= hole)), box
    # A limb: a thick curve whose direction wanders, thinner towards its end.
    turn, width = rng.uniform(-2.5, 2.5), size * rng.uniform(0.09, 0.14)
    along = np.linspace(0, 1, 200)
    angle = np.pi / 2 + turn * (along - 0.5) + rng.uniform(-0.5, 0.5) * np.sin(2 * np.pi * along)
    line = np.cumsum(np.stack([np.cos(angle), np.sin(angle)], axis=1), axis=0) / 200 * size * 1.1
    thick = width * (1 - 0.5 * along)

    def limb(p):
        return ((np.hypot(*(p[:, None] - line).transpose(2, 0, 1)) - thick).min(axis=1)) <= 0

    low, high = line.min(axis=0) - width, line.max(axis=0) + width
    return limb, (*low, *high)


def mesh(inside, box, spacing, rng):
    """A triangular grid clipped to the shape and jittered: nodes and counter-clockwise triangles."""
    height = spacing * np.sqrt(3) / 2
    rows, columns = int((box[3] - box[1]) / height) + 2, int((box[2] - box[0]) / spacing) + 3
    i, j = np.meshgrid(np.arange(columns), np.arange(rows))
    points = np.stack([box[0] + (i + 0.5 * (j % 2) - 0.5) * spacing, box[1] + j * height], axis=2).reshape(-1, 2)
    points = points + 1e-9 * spacing
    triangles = []
    for row in range(rows - 1):
        for column in range(columns - 1):
            a, b = row * columns + column, row * columns + column + 1
            c, d = a + columns, b + columns
            triangles += [[a, b, c], [b, d, c]] if row % 2 == 0 else [[a, b, d], [a, d, c]]
    triangles = np.array(triangles)
    triangles = triangles[inside(points[triangles].reshape(-1, 2)).reshape(-1, 3).all(axis=1)]
    triangles = connected(triangles)
    used, triangles = np.unique(triangles, return_inverse=True)
    triangles = triangles.reshape(-1, 3)
    return points[used] + rng.uniform(-0.14, 0.14, (len(used), 2)) * spacing, triangles


def connected(triangles):
    """The largest piece that hangs together by edges."""
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    owner = {}
    links = []
    for t, triangle in enumerate(triangles.tolist()):
        for k in range(3):
            edge = tuple(sorted((triangle[k], triangle[k - 1])))
            if edge in owner:
                links.append((owner[edge], t))
            owner[edge] = t
    links = np.array(links).reshape(-1, 2)
    n = len(triangles)
    _, label = connected_components(coo_matrix((np.ones(len(links)), links.T), shape=(n, n)), directed=False)
    return triangles[label == np.bincount(label).argmax()]


def edges_of(triangles):
    pairs = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    return np.unique(pairs, axis=0)


def meshed(name, count, rng):
    """A mesh of the shape with about `count` edges."""
    inside, box = outline(name, rng)
    sample = rng.uniform(box[:2], box[2:], (4000, 2))
    area = inside(sample).mean() * (box[2] - box[0]) * (box[3] - box[1])
    spacing = np.sqrt(area * 2 / np.sqrt(3) * 3 / count)
    for _ in range(4):
        nodes, triangles = mesh(inside, box, spacing, rng)
        found = len(edges_of(triangles))
        if abs(found / count - 1) < 0.03:
            break
        spacing *= (found / count) ** 0.5
    return nodes, triangles


def base(nodes):
    """The nodes at the low end of the longer side, which are pinned."""
    axis = 0 if np.ptp(nodes[:, 0]) > 1.2 * np.ptp(nodes[:, 1]) else 1
    order = np.argsort(nodes[:, axis], kind="stable")
    reach = nodes[order[0], axis] + 0.07 * np.ptp(nodes[:, axis])
    return [int(n) for n in order if nodes[n, axis] <= reach or n in order[:3]]


def spread(nodes, taken, count, rng):
    """Nodes far from those taken and from each other, each among the farthest fifth."""
    chosen, distance = [], np.hypot(*(nodes[:, None] - nodes[taken]).transpose(2, 0, 1)).min(axis=1)
    for _ in range(count):
        order = np.argsort(-distance, kind="stable")
        chosen.append(int(rng.choice(order[: max(1, len(nodes) // 5)])) if len(chosen) else int(rng.choice(order[: max(1, len(nodes) // 20)])))
        distance = np.minimum(distance, np.hypot(*(nodes - nodes[chosen[-1]]).T))
        distance[chosen] = -1.0
    return chosen


def fibres_of(nodes, triangles, mu, rng):
    edges = edges_of(triangles)
    length = np.hypot(*(nodes[edges[:, 1]] - nodes[edges[:, 0]]).T)
    k = mu * 10 ** rng.uniform(-0.5, 0.7)
    epsilon = length.mean() * rng.uniform(0.01, 0.05)
    return [{"routing": e.tolist(), "K": k, "epsilon": epsilon, "alpha0": a, "winch": i} for i, (e, a) in enumerate(zip(edges, length.tolist()))]


def tendons(nodes, triangles, pinned, winches, rng):
    """Winches of one to three tendons, each along a short path through the mesh from near the pins outward."""
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import dijkstra

    edges = edges_of(triangles)
    length = np.hypot(*(nodes[edges[:, 1]] - nodes[edges[:, 0]]).T)
    elements = []
    for winch in range(winches):
        weight = length * rng.uniform(0.5, 2.0, len(length))
        graph = coo_matrix((weight, edges.T), shape=(len(nodes),) * 2)
        start = int(rng.choice(pinned)) if rng.random() < 0.7 else int(rng.integers(len(nodes)))
        for end in spread(nodes, [start], int(rng.choice([1, 1, 2, 3])), rng):
            _, before = dijkstra(graph, directed=False, indices=start, return_predecessors=True)
            path = [end]
            while path[-1] != start:
                path.append(int(before[path[-1]]))
            stride = max(1, round(len(path) / rng.integers(4, 9)))
            routing = [start] + path[::-1][stride:-1:stride] + [end]
            alpha0 = np.hypot(*np.diff(nodes[routing], axis=0).T).sum()
            elements.append({"routing": routing, "K": TENDON_K, "epsilon": TENDON_EPSILON, "alpha0": float(alpha0), "winch": winch})
    return elements


def goals(problem, nodes, chosen, rng):
    """Where the targets go: far in random directions, or where a random winding within the bounds sends them."""
    length = np.ptp(nodes, axis=0).max()
    if rng.random() < 0.5:
        body = Body(problem)
        ik = problem["soft_ik"]
        waves = rng.normal(size=(2, 2)) * 6 / length
        middle = nodes[[e["routing"][len(e["routing"]) // 2] for e in problem["elements"]]]
        part = np.clip(0.5 + 0.5 * np.sin(middle @ waves[0] + rng.uniform(0, 6)) * np.sin(middle @ waves[1] + rng.uniform(0, 6)), 0, 1)
        upper = dict(zip(ik["winch_ids"], ik["beta_upper"]))
        first = {}
        alpha = np.array([upper.get(e["winch"], 0.0) * first.setdefault(e["winch"], part[i]) for i, e in enumerate(problem["elements"])])
        x = nodes.ravel()
        try:
            for step in range(1, 9):
                x, _ = body.equilibrium(alpha * step / 8, x)
            return x.reshape(-1, 2)[chosen].tolist(), True
        except NoEquilibrium:
            pass
    angle, distance = rng.uniform(0, 2 * np.pi, len(chosen)), rng.uniform(NEAR, FAR, len(chosen)) * length
    return (nodes[chosen] + np.stack([np.cos(angle), np.sin(angle)], axis=1) * distance[:, None]).tolist(), False


def at_work(seed, number, fibres):
    """A statics problem: a shape all of whose fibres contract by a smooth field of up to 15 %."""
    rng = np.random.default_rng([seed, number, fibres])
    shape = SHAPES[number % len(SHAPES)]
    nodes, triangles = meshed(shape, fibres, rng)
    mu = rng.uniform(200, 800)
    elements = fibres_of(nodes, triangles, mu, rng)
    middle = nodes[[e["routing"] for e in elements]].mean(axis=1) / np.ptp(nodes, axis=0).max()
    part = 0.5 + 0.5 * np.sin(middle @ rng.normal(size=2) * 6 + rng.uniform(0, 6))
    return {
        "format": "plushwright-problem/1",
        "name": f"{shape} of {len(elements)} fibres at work",
        "mesh": {"nodes": nodes.tolist(), "triangles": triangles.tolist()},
        "material": {"mu": mu, "kappa": mu * rng.uniform(0.5, 4)},
        "elements": elements,
        "pins": [{"node": n, "target": nodes[n].tolist(), "K": PIN_K} for n in base(nodes)],
        "contractions": [0.15 * p * e["alpha0"] for p, e in zip(part.tolist(), elements)],
    }


def generate(seed, number):
    """Problem `number` of the seed: three in five have fibres (100 to 5000), two in five winches (1 to 12)."""
    rng = np.random.default_rng([seed, number])
    shape = SHAPES[number % len(SHAPES)]
    wound = number % 5 in (1, 3) if (number // 5) % 2 == 0 else number % 5 in (0, 2)
    count = round(10 ** rng.uniform(np.log10(FEWEST), np.log10(MOST)))
    if number % 20 == 19:
        count = MOST
    nodes, triangles = meshed(shape, count, rng)
    mu = rng.uniform(200, 800)
    pinned = base(nodes)
    problem = {"format": "plushwright-problem/1", "name": "", "units": "SI"}
    problem["mesh"] = {"nodes": nodes.tolist(), "triangles": triangles.tolist()}
    problem["material"] = {"mu": mu, "kappa": mu * rng.uniform(0.5, 4)}
    problem["pins"] = [{"node": n, "target": nodes[n].tolist(), "K": PIN_K} for n in pinned]
    fraction = rng.uniform(0.2, 0.5)
    fixed = {}
    if wound:
        winches = 1 + (number * 7 + int(rng.integers(3))) % 12
        problem["elements"] = tendons(nodes, triangles, pinned, winches, rng)
        ids = list(range(winches))
        if winches > 2 and rng.random() < 0.25:
            fixed = {str(ids.pop()): 0.1 * problem["elements"][-1]["alpha0"]}
    else:
        problem["elements"] = fibres_of(nodes, triangles, mu, rng)
        ids = list(range(len(problem["elements"])))
    shortest = {}
    for e in problem["elements"]:
        shortest[e["winch"]] = min(shortest.get(e["winch"], np.inf), e["alpha0"])
    lower = 0.0 if rng.random() < 0.6 else None
    problem["soft_ik"] = {"winch_ids": ids, "beta_upper": [fraction * shortest[w] for w in ids], "beta_lower": [lower] * len(ids), "fixed_winches": fixed}
    problem["contractions"] = [0.0] * len(problem["elements"])
    chosen = spread(nodes, pinned, int(rng.integers(1, 7)), rng)
    where, reachable = goals(problem, nodes, chosen, rng)
    targets = [{"node": n, "xy": xy, "weight": 1.0} for n, xy in zip(chosen, where)]
    at_rest = 0.5 * sum((t["xy"][0] - nodes[t["node"], 0]) ** 2 + (t["xy"][1] - nodes[t["node"], 1]) ** 2 for t in targets)
    weight = len(targets) / len(nodes) * 10 ** rng.uniform(-3, -1) if rng.random() < 0.5 else 0.0
    regulariser = at_rest * 10 ** rng.uniform(-6, -2)
    problem["objective"] = {"targets": targets, "default_weight": weight, "regulariser": regulariser}
    kind = f"{len(ids)} winches" if wound else f"{len(ids)} fibres"
    problem["name"] = f"seed {seed}, {number}: {shape} of {kind}, {len(targets)} targets{', reachable' if reachable else ''}"
    return problem
