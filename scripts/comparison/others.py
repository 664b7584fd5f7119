"""Statics of a problem file by other people's finite elements: `others.py felupe|skfem PROBLEM.json ANSWER.json`.

The body and its Newton loop are the library's (felupe's newtonraphson; scikit-fem has none, so one is written as its examples do).
Elements and pins, which neither library has, come from springs.py. Both get the quickest direct solver that scipy offers.
"""

import json
import sys
import time

import numpy as np
from scipy.sparse import coo_matrix, csr_matrix

from body import RESIDUAL, factorise
from springs import Springs

# Newton without a line search needs small enough steps of the contraction: it is begun with one, then twice as many, until it ends.
MOST_STEPS = 64
MOST_ITERATIONS = 25


def solver(matrix, right):
    """What scipy.sparse.linalg.spsolve does, told that the matrix is symmetric."""
    return factorise(matrix.tocsc()).solve(np.asarray(right).ravel())


def stiffness(springs, x, alpha):
    """The springs' part of the Hessian."""
    rows, columns = springs.places()
    return csr_matrix(coo_matrix((springs.entries(x, alpha), (rows, columns)), shape=(springs.size,) * 2))


def felupe(problem, springs, goal):
    """Returns a function that takes u at one contraction to u at the next."""
    import felupe as fem

    rest = np.array(problem["mesh"]["nodes"])
    mesh = fem.Mesh(rest, np.array(problem["mesh"]["triangles"]), "triangle")
    field = fem.FieldContainer([fem.Field(fem.RegionTriangle(mesh), dim=2)])
    solid = fem.SolidBody(fem.NeoHookeCompressible(mu=problem["material"]["mu"], lmbda=problem["material"]["kappa"]), field)

    class Item:
        """Elements and pins beside felupe's own items."""

        def __init__(self):
            self.field, self.alpha = field, None
            self.results = fem.mechanics._helpers.Results()
            self.assemble = fem.mechanics._helpers.Assemble(vector=self.vector, matrix=self.matrix)

        def positions(self, field):
            self.field = field if field is not None else self.field
            return rest.ravel() + self.field[0].values.ravel()

        def vector(self, field=None, **_):
            return csr_matrix(springs.gradient(self.positions(field), self.alpha).reshape(-1, 1))

        def matrix(self, field=None, **_):
            return stiffness(springs, self.positions(field), self.alpha)

    item, every = Item(), np.arange(rest.size)

    def advance(u, alpha):
        item.alpha = alpha
        field[0].values[:] = u.reshape(-1, 2)
        # felupe divides the sum of all forces by 1e-3 N where no displacement is prescribed.
        tolerance = goal * np.sqrt(rest.size) / 1e-3
        loads = {"dof0": np.zeros(0, int), "dof1": every, "ext0": np.zeros(0)}
        result = fem.newtonraphson(items=[solid, item], x0=field, **loads, solver=solver, tol=tolerance, maxiter=MOST_ITERATIONS, verbose=0)
        return result.x[0].values.ravel().copy(), result.iterations

    return advance


def skfem(problem, springs, goal):
    """The same with scikit-fem's forms."""
    from skfem import Basis, BilinearForm, ElementTriP1, ElementVector, LinearForm, MeshTri
    from skfem.helpers import ddot, grad, identity, inv, mul, trace, transpose, det

    mu, kappa = problem["material"]["mu"], problem["material"]["kappa"]
    rest = np.array(problem["mesh"]["nodes"])
    mesh = MeshTri(np.ascontiguousarray(rest.T), np.ascontiguousarray(np.array(problem["mesh"]["triangles"]).T))
    basis = Basis(mesh, ElementVector(ElementTriP1()), intorder=1)
    if not (basis.nodal_dofs == 2 * np.arange(len(rest)) + [[0], [1]]).all():
        raise SystemExit("scikit-fem orders its degrees of freedom in another way")

    @LinearForm
    def force(v, w):
        f = grad(w["u"]) + identity(grad(w["u"]))
        inverse = transpose(inv(f))
        return ddot(mu * (f - inverse) + kappa * np.log(det(f)) * inverse, grad(v))

    @BilinearForm
    def tangent(u, v, w):
        f = grad(w["u"]) + identity(grad(w["u"]))
        change = mul(inv(f), grad(u))
        turned = mul(transpose(inv(f)), mul(transpose(grad(u)), transpose(inv(f))))
        log = np.log(det(f))
        return ddot(mu * grad(u) + (mu - kappa * log) * turned + kappa * trace(change) * transpose(inv(f)), grad(v))

    def advance(u, alpha):
        for iteration in range(MOST_ITERATIONS):
            x, at = rest.ravel() + u, basis.interpolate(u)
            g = force.assemble(basis, u=at) + springs.gradient(x, alpha)
            if np.abs(g).max() <= goal:
                return u, iteration
            u = u - solver(tangent.assemble(basis, u=at) + stiffness(springs, x, alpha), g)
        raise ValueError("too many iterations")

    return advance


def main():
    name, question, answer = sys.argv[1:]
    with open(question) as file:
        problem = json.load(file)
    springs = Springs(problem)
    alpha = np.array(problem["contractions"])
    rest = np.array(problem["mesh"]["nodes"])
    goal = RESIDUAL * problem["material"]["mu"] * np.ptp(rest, axis=0).max()
    advance = {"felupe": felupe, "skfem": skfem}[name](problem, springs, goal)
    steps = 1
    while steps <= MOST_STEPS:
        began, u, iterations = time.perf_counter(), np.zeros(rest.size), 0
        try:
            with np.errstate(invalid="raise", divide="raise"):
                for step in range(1, steps + 1):
                    u, count = advance(u, alpha * step / steps)
                    iterations += count
            break
        except (ValueError, FloatingPointError, RuntimeError):
            steps *= 2
    else:
        raise SystemExit("Newton's method does not end")
    out = {"milliseconds": 1e3 * (time.perf_counter() - began), "steps": steps, "iterations": iterations, "x": (rest.ravel() + u).tolist()}
    with open(answer, "w") as file:
        json.dump(out, file)


if __name__ == "__main__":
    main()
