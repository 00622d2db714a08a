"""M(q) positive definite along a trajectory (report section 3.3 and fig. 33), as a constraint on the parameters.

v^T M(q) v is linear in the base parameters for each direction v, so the parameters with M(q) >= margin form a convex
set, and an eigenvector of too small an eigenvalue gives a half-space that holds it: a cutting plane.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from scipy.linalg import solve_triangular
from scipy.optimize import nnls

from identification.arrays import Array
from identification.output_error.variations import mass_matrix

#: Rounds of cutting planes of a step, and part of the margin by which they may fall short.
_ROUNDS, _SHORT = 50, 1e-6
#: Part of the strongest direction below which one is rounding.
_ROUNDING = 1e-13
#: Residual of the least distances' dual problem, below which there are no such parameters.
_EMPTY = 1e-10


@dataclass(frozen=True)
class Positivity:
    """Eigenvalues of M(q) stay above ``margin`` [kg m2, kg] at poses ``q`` (N x n).

    ``module`` is the robot's compiled module, ``sought`` are the parameters that vary, ``fixed`` the values of others.
    """

    module: Any
    q: Array
    sought: tuple[str, ...]
    fixed: Mapping[str, float]
    margin: float

    def eigenvalues(self, chi: Array) -> Array:
        """Of M(q) with parameters ``chi`` (b) [SI] at all poses (N x n), rising."""
        return np.asarray(np.linalg.eigvalsh(self._inertia(chi)), dtype=float)

    def holds(self, chi: Array) -> bool:
        """Whether all are above the margin."""
        return bool(self.eigenvalues(chi)[:, 0].min() >= (1 - _SHORT) * self.margin)

    def cut(self, chi: Array) -> tuple[Array, float] | None:
        """a (b) and r: parameters with M >= margin at the worst pose have a^T chi >= r; None where all of them hold."""
        values, vectors = np.linalg.eigh(self._inertia(chi))
        worst = int(values[:, 0].argmin())
        if values[worst, 0] >= (1 - _SHORT) * self.margin:
            return None
        v = vectors[worst, :, 0]
        normal = v @ self._columns(self.q[worst], v)
        at = [self.module.BASE_PARAMETERS.index(name) for name in self.sought]
        others = sum(
            float(normal[k]) * self.fixed.get(name, 0.0)
            for k, name in enumerate(self.module.BASE_PARAMETERS)
            if name not in self.sought
        )
        return normal[at], self.margin - others

    def nearest(self, chi: Array, std: Array) -> Array | None:
        """Parameters within the constraint, nearest to ``chi`` in units of ``std`` (b each); None if none are."""
        step = np.zeros_like(chi)
        rows: list[Array] = []
        bounds: list[float] = []
        for _ in range(_ROUNDS):
            cut = self.cut(chi + step)
            if cut is None:
                return chi + step
            normal, bound = cut
            if not normal.any():
                return None
            rows.append(normal * std)
            bounds.append(bound - float(normal @ chi))
            step = std * _nearest(np.eye(len(chi)), np.zeros(len(chi)), np.array(rows), np.array(bounds))
            if not np.isfinite(step).all():
                return None
        return None

    def _columns(self, q: Array, v: Array) -> Array:
        """M(q) v per unit of each base parameter (n x all)."""
        still = np.zeros((1, len(q)))
        model = self.module.Robot()
        pose = np.ascontiguousarray(q[None])
        moved = model.observation_matrix(pose, still, np.ascontiguousarray(v[None]))
        result: Array = moved - model.observation_matrix(pose, still, still)
        return result

    def _inertia(self, chi: Array) -> Array:
        values = {**self.fixed, **dict(zip(self.sought, chi.tolist(), strict=True))}
        known = {name: value for name, value in values.items() if name in self.module.PARAMETERS}
        return mass_matrix(self.module.Robot({**self._nothing, **known}), self.q)

    @cached_property
    def _nothing(self) -> dict[str, float]:
        return dict.fromkeys(self.module.BASE_PARAMETERS, 0.0)


def constrained(H: Array, g: Array, size: Array, positivity: Positivity, chi: Array) -> Array:
    """The step d (b) of the parameters that minimises d^T H d / 2 - g^T d in d size, with M positive at chi + d.

    ``H`` (b x b) and ``g`` (b) are in units of 1/``size`` (b). Half-spaces are added until all eigenvalues hold;
    ``chi`` must fulfil the constraint.
    """
    # What the runs hardly show may be a little less than nothing by rounding, which has no Cholesky factor.
    powers, directions = np.linalg.eigh(H)
    kept = np.maximum(powers, _ROUNDING * powers[-1])
    R = np.asarray(np.linalg.qr(np.sqrt(kept)[:, None] * directions.T, mode="r"))
    best = solve_triangular(R, solve_triangular(R, g, trans="T"))
    step: Array = best / size
    rows: list[Array] = []
    bounds: list[float] = []
    for _ in range(_ROUNDS):
        cut = positivity.cut(chi + step)
        if cut is None:
            return step
        normal, bound = cut
        rows.append(normal / size)
        bounds.append(bound - float(normal @ chi))
        step = _nearest(R, best, np.array(rows), np.array(bounds)) / size
    return _inside(positivity, chi, step)


def _nearest(R: Array, best: Array, A: Array, bounds: Array) -> Array:
    """The x nearest to ``best`` in |R (x - best)| with A x >= bounds; not finite where there is none.

    Least distance programming by non-negative least squares (Lawson and Hanson, Solving Least Squares Problems, 1974,
    chapter 23).
    """
    turned = solve_triangular(R, A.T, trans="T").T
    short = bounds - A @ best
    scale = np.linalg.norm(turned, axis=1)
    turned, short = turned / scale[:, None], short / scale
    unit = np.abs(short).max()
    E = np.vstack([turned.T, short / unit])
    f = np.zeros(len(E))
    f[-1] = 1.0
    u, _ = nnls(E, f)
    r = E @ u - f
    if -r[-1] <= _EMPTY:
        return np.full_like(best, np.nan)
    y = -unit * r[:-1] / r[-1]
    result: Array = best + solve_triangular(R, y)
    return result


def _inside(positivity: Positivity, chi: Array, step: Array) -> Array:
    """The step, shortened until the constraint holds: chi fulfils it and the set is convex."""
    for _ in range(60):
        if positivity.holds(chi + step):
            return step
        step = step / 2
    return np.zeros_like(step)
