"""What is searched: the criterion with its constraint, and how."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from generator.errors import InputError
from identification.arrays import Array
from identification.output_error.criterion import Criterion, Point
from identification.output_error.experiment import Experiment
from identification.output_error.positivity import Positivity
from identification.recipes import JOINT, Recipe

#: Poses at which M(q) is looked at, of each run; least eigenvalue allowed in parts of the start's, and of the mean one.
_POSES, _MARGIN, _LEAST = 200, 0.1, 1e-4


@dataclass(frozen=True)
class Settings:
    """How parameters are sought.

    ``segment`` [s] is the time after which the simulation begins anew at a state of its own, None for one simulation a
    run. ``method`` is a module of ``methods``. A search ends after ``iterations`` or ``seconds`` where they are given;
    what polishes its result has no such end.
    ``margin`` [kg m2, kg] is the least eigenvalue of M(q) that is allowed, a tenth of the start's where it is None.
    ``fixed`` are values [SI] of parameters that are not sought; ``spread`` is that of further starts about the first,
    in its standard deviations, ``seed`` that of their draws. Torques are as measured, or ``filtered`` by the recipe as
    in the report.
    """

    recipe: Recipe = field(default_factory=Recipe)
    segment: float | None = 1.0
    method: str = "gauss-newton"
    iterations: int | None = None
    seconds: float | None = None
    margin: float | None = None
    fixed: Mapping[str, float] = field(default_factory=dict)
    spread: float = 2.0
    seed: int = 0
    filtered: bool = False


@dataclass(frozen=True)
class Search:
    """A criterion, its constraint, and ``std`` (b), by how much parameters are expected to change."""

    criterion: Criterion
    positivity: Positivity
    std: Array
    settings: Settings

    @property
    def weighted(self) -> bool:
        """Whether joints are weighted by their errors."""
        return self.settings.recipe.weights == JOINT


@dataclass(frozen=True)
class Minimum:
    """Where a search ended: the point, the criterion with the weights it ended with, what it took, and whether it had
    ``settled``, rather than come to its last iteration or second.
    """

    point: Point
    criterion: Criterion
    simulations: int
    iterations: int
    settled: bool

    @property
    def rms(self) -> Array:
        """Root mean squares of the position errors (n) [rad, m]; infinite where the simulation diverges."""
        errors = self.criterion.errors(self.point)
        found = replace(self.criterion, scale=np.ones(len(self.criterion.scale))).weighted(errors).scale
        return np.where(np.isfinite(found), found, np.inf)


def search_of(
    module: Any,
    experiments: Sequence[Experiment],
    start: Mapping[str, float],
    std: Mapping[str, float],
    settings: Settings,
) -> tuple[Search, Array]:
    """The search for all base parameters that are not fixed, and its start (b), moved to where M(q) is positive.

    ``start`` are values [SI] by name, ``std`` what they are expected to be wrong by; where that is 0 or not finite, a
    hundredth of the value.

    Raises InputError for fixed parameters with which M(q) cannot be positive, or that are all.
    """
    known = {name: value for name, value in start.items() if name in module.PARAMETERS}
    fixed = {**{name: value for name, value in known.items() if name not in module.BASE_PARAMETERS}, **settings.fixed}
    sought = tuple(name for name in module.BASE_PARAMETERS if name not in fixed)
    place = experiments[0].run.place
    if not sought:
        raise InputError(place, "all parameters are fixed", "one to be sought")
    chi = np.array([known.get(name, 0.0) for name in sought])
    size = np.array([std.get(name, 0.0) for name in sought])
    usable = np.isfinite(size) & (size > 0)
    size = np.where(usable, size, np.maximum(np.abs(chi) / 100, 1e-6))
    q = np.concatenate([one.motion.q.T[:: max(1, one.motion.samples // _POSES)] for one in experiments])
    criterion = Criterion(module, tuple(experiments), sought, fixed, np.ones(q.shape[1]))
    positivity = Positivity(module, np.ascontiguousarray(q), sought, fixed, 0.0)
    eigenvalues = positivity.eigenvalues(chi)
    margin = max(_MARGIN * float(eigenvalues.min()), _LEAST * float(np.abs(eigenvalues).mean()))
    positivity = replace(positivity, margin=margin if settings.margin is None else settings.margin)
    search = Search(criterion, positivity, size, settings)
    feasible = search.positivity.nearest(chi, size)
    if feasible is None:
        raise InputError(place, "M(q) is not positive definite for any parameters near the start", "other fixed values")
    return search, feasible


def starts(search: Search, first: Array, count: int) -> dict[str, Array]:
    """The first start, then random ones about it, each moved to where M(q) is positive."""
    draw = np.random.default_rng(search.settings.seed)
    result = {"start_001": first}
    while len(result) < count:
        drawn = first + search.settings.spread * search.std * draw.normal(size=len(first))
        feasible = search.positivity.nearest(drawn, search.std)
        if feasible is not None:
            result[f"start_{len(result) + 1:03d}"] = feasible
    return result
