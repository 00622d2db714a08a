"""The physically consistent standard parameters nearest to an estimate of base parameters, such as a printed table."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import cvxpy
import numpy as np

from generator.robot.parameters import INERTIAL_STEMS
from generator.symbolic.model import Model
from generator.symbolic.pseudo_inertia import Matrix
from identification.consistency import divergence, grouped, possible, relative_to

#: The package's own types leave out most of its functions.
cp: Any = cvxpy

#: With bodies to keep to: the gap that is asked for, and one that will do where rounding errors allow no more. The
#: divergence is so flat that the solver's own 1e-8 would leave parameters open in their fourth digit.
_GAP, _ENOUGH = 1e-12, 1e-9
_ACCURACY = dict.fromkeys(("tol_gap_abs", "tol_gap_rel", "tol_feas"), _GAP) | dict.fromkeys(
    ("reduced_tol_gap_abs", "reduced_tol_gap_rel", "reduced_tol_feas"), _ENOUGH
)


@dataclass(frozen=True)
class BaseValues:
    """Base parameters by name: value and standard deviation, in the parameter's unit, the latter positive."""

    values: Mapping[str, float]
    std: Mapping[str, float]

    def shifts(self, base: Mapping[str, float]) -> dict[str, float]:
        """How far ``base`` lies above each value, in its standard deviations."""
        return {name: (base[name] - value) / self.std[name] for name, value in self.values.items()}

    def distance(self, base: Mapping[str, float]) -> float:
        """Root of the sum of the squared shifts."""
        return float(np.linalg.norm(list(self.shifts(base).values())))


@dataclass(frozen=True)
class Knowledge:
    """What is known beside the estimate.

    ``bodies`` are positive definite pseudo-inertias (4 x 4), one for every body by its number: what to keep to where
    the estimate says nothing. A unit of divergence from one costs ``weight`` squared standard deviations. ``given`` are
    base or standard parameters with exact values.
    """

    bodies: Mapping[int, Matrix]
    weight: float
    given: Mapping[str, float] = field(default_factory=dict)


def nearest(model: Model, estimate: BaseValues, knowledge: Knowledge) -> dict[str, float]:
    """The standard parameters by name [SI] that minimise squared distance plus weighted divergence.

    A weight of 0 gives the smallest distance there is, by bodies that are one choice of many. The parameter of an
    effect is zero where no estimated and no given value involves it.

    Raises ValueError where no physically consistent parameters have the given values.
    """
    s = {parameter.name: cp.Variable(name=parameter.name) for parameter in model.standard_parameters}
    base = grouped(model, s)
    shifts = [(base[name] - value) / estimate.std[name] for name, value in estimate.values.items()]
    relative = [
        relative_to(body, [s[f"{stem}{number}"] for stem in INERTIAL_STEMS])
        for number, body in knowledge.bodies.items()
    ]
    cost = cp.sum_squares(cp.hstack(shifts))
    if knowledge.weight > 0:
        cost += knowledge.weight * divergence(relative)
    constraints = possible(model, s, relative)
    constraints += [(s | base)[name] == value for name, value in knowledge.given.items()]
    constraints += [s[name] == 0 for name in _silent(model, estimate, knowledge)]
    problem = cp.Problem(cp.Minimize(cost), constraints)
    problem.solve(solver=cp.CLARABEL, **(_ACCURACY if knowledge.weight > 0 else {}))
    if problem.status not in (cp.OPTIMAL, cp.OPTIMAL_INACCURATE):
        raise ValueError(f"no physically consistent parameters with {dict(knowledge.given)}: {problem.status}")
    return {name: float(variable.value) for name, variable in s.items()}


def _silent(model: Model, estimate: BaseValues, knowledge: Knowledge) -> list[str]:
    """Effects' parameters that nothing known involves."""
    groupings = model.grouping.numeric()
    known = {*estimate.values, *knowledge.given}
    involved = known.union(*(groupings[name] for name in known if name in groupings))
    of_bodies = {f"{stem}{number}" for number in knowledge.bodies for stem in INERTIAL_STEMS}
    return [p.name for p in model.standard_parameters if p.name not in involved | of_bodies]
