"""A soft body with contractile elements, as examples/problem-format.md defines it, and its equilibrium.

Written against the formulas of that page alone, with numpy and scipy's SuperLU, so that its figures are independent of plushwright's.
Positions are flat arrays [x0, y0, x1, y1, ...] in m, energies in J.
"""

import numpy as np
from scipy.sparse import csc_matrix
from scipy.sparse.linalg import splu

from springs import Springs

# Equilibrium: largest component of dE/dx, as a part of mu times the body length (the same measure at every size).
RESIDUAL = 1e-10
# A decrease by this part of the energy drowns in its rounding.
BLUNT = 1e-12
# Where rounding no longer lets a state get better, a residual of this many times that will do.
ROUNDED = 1e3
# Newton steps before statics gives up, and halvings of one step.
STEPS, HALVINGS = 200, 40
# Part of the way to the first triangle that would turn over which a step may go.
CAP = 0.9
# Smallest eigenvalue that a projected block keeps, in mu.
FLOOR = 1e-6


class NoEquilibrium(RuntimeError):
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
        self.springs = Springs(problem)
        self._pattern()

    def _pattern(self):
        """Where each number goes in the compressed matrix: triangles, then springs."""
        dofs = (2 * self.triangles[:, :, None] + [0, 1]).reshape(-1, 6)
        rows, columns = self.springs.places()
        rows = np.concatenate([np.repeat(dofs, 6, axis=1).ravel(), rows])
        columns = np.concatenate([np.tile(dofs, 6).ravel(), columns])
        n = self.rest.size
        keys, self.slot = np.unique(columns * n + rows, return_inverse=True)
        self.indices = (keys % n).astype(np.int32)
        self.indptr = np.searchsorted(keys, np.arange(n + 1) * n).astype(np.int32)

    def stretch(self, x):
        """Deformation gradients F and their determinants."""
        f = np.einsum("tki,tkj->tij", x.reshape(-1, 2)[self.triangles], self.shape)
        return f, f[:, 0, 0] * f[:, 1, 1] - f[:, 0, 1] * f[:, 1, 0]

    def energy(self, x, alpha):
        f, j = self.stretch(x)
        if not j.min() > 0.0:
            return np.inf
        log = np.log(j)
        psi = 0.5 * self.mu * ((f * f).sum(axis=(1, 2)) - 2.0) - self.mu * log + 0.5 * self.kappa * log**2
        return self.area @ psi + self.springs.energy(x, alpha)

    def gradient(self, x, alpha):
        f, j = self.stretch(x)
        cofactor = np.stack([f[:, 1, 1], -f[:, 1, 0], -f[:, 0, 1], f[:, 0, 0]], axis=1).reshape(-1, 2, 2)
        stress = self.mu * f + ((self.kappa * np.log(j) - self.mu) / j)[:, None, None] * cofactor
        nodal = np.einsum("tij,tkj,t->tki", stress, self.shape, self.area)
        out = self.springs.gradient(x, alpha)
        for d in (0, 1):
            out[d::2] += np.bincount(self.triangles.ravel(), nodal[:, :, d].ravel(), len(self.rest))
        return out

    def hessian(self, x, alpha, projected=False):
        """The exact second derivatives; with the body's blocks made positive where asked."""
        f, j = self.stretch(x)
        cof = np.stack([f[:, 1, 1], -f[:, 1, 0], -f[:, 0, 1], f[:, 0, 0]], axis=1)
        c = self.kappa * np.log(j) - self.mu
        flip = np.array([[0, 0, 0, 1], [0, 0, -1, 0], [0, -1, 0, 0], [1, 0, 0, 0.0]])
        block = self.mu * np.eye(4) + ((self.kappa - c) / j**2)[:, None, None] * cof[:, :, None] * cof[:, None, :]
        block += (c / j)[:, None, None] * flip
        if projected:
            values, vectors = np.linalg.eigh(block)
            block = np.einsum("tij,tj,tkj->tik", vectors, np.maximum(values, FLOOR * self.mu), vectors)
        block = (block * self.area[:, None, None]).reshape(-1, 2, 2, 2, 2)
        block = np.einsum("tiajb,tka,tlb->tkilj", block, self.shape, self.shape, optimize=True)
        numbers = np.concatenate([block.ravel(), self.springs.entries(x, alpha)])
        data = np.bincount(self.slot, numbers, len(self.indices))
        return csc_matrix((data, self.indices, self.indptr), shape=(x.size, x.size))

    def farthest(self, x, step):
        """The part of the step after which the first triangle is flat."""
        f, j = self.stretch(x)
        g, quadratic = self.stretch(step)
        linear = f[:, 0, 0] * g[:, 1, 1] + f[:, 1, 1] * g[:, 0, 0] - f[:, 0, 1] * g[:, 1, 0] - f[:, 1, 0] * g[:, 0, 1]
        # One over the smallest positive root of j + linear t + quadratic t^2.
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
            try:
                factor = factorise(self.hessian(x, alpha))
                step = -factor.solve(g)
            except RuntimeError:  # exactly singular
                factor, step = None, np.zeros_like(x)
            if factor and np.abs(g).max() <= goal:
                return x, factor
            if factor and abs(g @ step) <= BLUNT * abs(energy) and self.farthest(x, step) > 1.0:
                # Energies no longer tell states apart; forces still do.
                tried = x + step
                if np.abs(self.gradient(tried, alpha)).max() < np.abs(g).max():
                    x, energy = tried, self.energy(tried, alpha)
                    continue
                if np.abs(g).max() <= ROUNDED * goal:
                    return x, factor
            moved = self.advance(x, alpha, step, energy, g @ step) if g @ step < 0.0 else None
            if moved is None:
                try:
                    step = -factorise(self.hessian(x, alpha, projected=True)).solve(g)
                except RuntimeError:
                    break
                moved = self.advance(x, alpha, step, energy, g @ step)
            if moved is None:
                if factor and np.abs(g).max() <= ROUNDED * goal:
                    return x, factor
                break
            x, energy = moved
        raise NoEquilibrium


def factorise(matrix):
    """SuperLU as it is quickest for a symmetric matrix."""
    return splu(matrix, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
