"""soft_ik by scipy's L-BFGS-B on the activations of the winches: statics and adjoint of body.py."""

import time

import numpy as np
from scipy.optimize import minimize

from body import Body, NoEquilibrium

# Ends of L-BFGS-B in the scaled problem (activations in rest lengths, O in its value at rest).
OPTIONS = {"maxiter": 5000, "maxfun": 10000, "maxcor": 20, "ftol": 1e-11, "gtol": 1e-8}
# What an activation without equilibrium is said to cost, in O at rest: the line search then goes back.
UNSETTLED = 1e3


class OutOfTime(Exception):
    pass


class Inverse:
    """O(beta) = 1/2 sum q |x - x'|^2 + lambda/2 sum (alpha_c / alpha0)^2 and its exact gradient."""

    def __init__(self, problem):
        self.body = Body(problem)
        self.springs = self.body.springs
        body, springs, objective, ik = self.body, self.springs, problem["objective"], problem["soft_ik"]
        self.q = np.full(len(body.rest), float(objective.get("default_weight", 0.0)))
        self.goal = body.rest.copy()
        for target in objective["targets"]:
            self.q[target["node"]] = target.get("weight", 1.0)
            self.goal[target["node"]] = target["xy"]
        self.regulariser = objective.get("regulariser", 0.0)
        fixed = {int(w): v for w, v in (ik.get("fixed_winches") or {}).items()}
        ids = ik.get("winch_ids") or sorted(set(springs.winch.tolist()) - set(fixed))
        column = {w: j for j, w in enumerate(ids)}
        self.column = np.array([column.get(w, -1) for w in springs.winch.tolist()])
        self.held = np.array([fixed.get(w, 0.0) for w in springs.winch.tolist()])
        bound = lambda name, none: np.array([none if v is None else v for v in (ik.get(name) or [None] * len(ids))], float)
        self.lower, self.upper = bound("beta_lower", -np.inf), bound("beta_upper", np.inf)
        self.scale = np.full(len(ids), np.inf)
        np.minimum.at(self.scale, self.column[self.column >= 0], springs.alpha0[self.column >= 0])
        self.x = body.rest.ravel()
        self.last = None

    def alpha(self, beta):
        return np.where(self.column >= 0, beta[self.column], self.held)

    def by_winch(self, values):
        free = self.column >= 0
        return np.bincount(self.column[free], values[free], len(self.scale))

    def predicted(self, alpha):
        """Where the factor of the last equilibrium sends the body, if that lowers the energy."""
        if self.last is None:
            return self.x
        factor, before, direction, stiffness = self.last
        step = factor.solve(-self.springs.pull(stiffness * (alpha - before), direction))
        energy = self.body.energy(self.x, alpha)
        moved = self.body.advance(self.x, alpha, step, energy, 0.0)
        return self.x if moved is None else moved[0]

    def value(self, beta):
        """O and dO/dbeta in equilibrium, which is sought from the last one."""
        springs, alpha = self.springs, self.alpha(beta)
        self.x, factor = self.body.equilibrium(alpha, self.predicted(alpha))
        offset = self.x.reshape(-1, 2) - self.goal
        strain = alpha / springs.alpha0
        value = 0.5 * self.q @ (offset**2).sum(axis=1) + 0.5 * self.regulariser * strain @ strain
        length, _, direction = springs.segments(self.x)
        stiffness = springs.laws(length - springs.alpha0 + alpha)[2]
        self.last = (factor, alpha, direction, stiffness)
        adjoint = factor.solve((self.q[:, None] * offset).ravel())
        along = np.bincount(springs.entry_owner, springs.length_gradient(direction) * adjoint[springs.entry_dof], springs.count)
        return value, self.by_winch(self.regulariser * strain / springs.alpha0 - stiffness * along)

    def at_rest(self):
        """O of the rest shape without contraction: the unit of the scaled problem."""
        return 0.5 * self.q @ ((self.body.rest - self.goal) ** 2).sum(axis=1)

    def taut(self):
        """Every winch wound until its first element leaves the zone in which it goes slack, at rest."""
        springs = self.springs
        tight = springs.alpha0 - springs.segments(self.body.rest.ravel())[0] + springs.epsilon
        beta = np.full(len(self.scale), -np.inf)
        free = self.column >= 0
        np.maximum.at(beta, self.column[free], tight[free])
        return np.clip(beta, self.lower, self.upper)

    def zero(self):
        return np.clip(np.zeros(len(self.scale)), self.lower, self.upper)

    def projected_gradient(self, beta, gradient):
        """Largest component of dO/dbeta that a bound does not hold, m; and with activations in rest lengths, m^2."""
        reach = 1e-9 * self.scale
        held = ((beta <= self.lower + reach) & (gradient > 0)) | ((beta >= self.upper - reach) & (gradient < 0))
        free = np.where(held, 0.0, np.abs(gradient))
        return free.max(), (free * self.scale).max()


def descend(problem, name, limit):
    """One run of L-BFGS-B from `zero` or `taut`: its best O, the CPU time it took, and when it first was within 0.1 % of that."""
    began = time.process_time()
    inverse = Inverse(problem)
    unit = inverse.at_rest()
    start = getattr(inverse, name)()
    course, best = [], [np.inf, start]

    def evaluate(u):
        if time.process_time() - began > limit:
            raise OutOfTime
        beta, kept = u * inverse.scale, (inverse.x, inverse.last)
        try:
            value, gradient = inverse.value(beta)
        except NoEquilibrium:
            inverse.x, inverse.last = kept
            return UNSETTLED, np.zeros_like(u)
        course.append((time.process_time() - began, value))
        if value < best[0]:
            best[:] = value, beta
        return value / unit, gradient * inverse.scale / unit

    bounds = list(zip(inverse.lower / inverse.scale, inverse.upper / inverse.scale))
    ended = "out of time"
    try:
        ended = minimize(evaluate, start / inverse.scale, jac=True, method="L-BFGS-B", bounds=bounds, options=OPTIONS).message
    except OutOfTime:
        pass
    seconds = time.process_time() - began
    within = next((t for t, value in course if value <= 1.001 * best[0]), seconds)
    return {"start": name, "objective": best[0], "seconds": seconds, "seconds_to_0.1%": within, "evaluations": len(course), "ended": str(ended)}
