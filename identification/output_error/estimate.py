"""Parameters by output error, from a start: as one call, and what is told of a minimum."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from generator.errors import InputError
from identification.arrays import Array
from identification.dataset import Run
from identification.least_squares import standard_deviation
from identification.output_error.criterion import Criterion, Point
from identification.output_error.experiment import Experiment, experiment
from identification.output_error.methods import methods
from identification.output_error.search import Minimum, Search, Settings, search_of
from identification.output_error.uncertainty import covariance, noise_density
from identification.rank import nonzero, not_identifiable
from identification.residuals import Residual, Residuals
from identification.simulation.machine import Machine

#: Singular values of the sensitivities below this part of the largest are zero; change of positions in units of their
#: errors that is not seen.
_RANK, _UNSEEN = 1e-6, 1e-2
#: Steps by which first states of held-out runs are found, and by how much an eigenvalue may be above the margin at most
#: for the constraint to count as active, in parts of the margin.
_SETTLING, _ACTIVE = 6, 1e-2


@dataclass(frozen=True)
class Estimate:
    """What was found.

    ``values`` [SI] are those of all parameters by name, ``names`` (b) those that were sought, in the order of
    ``covariance`` (b x b); ``hidden`` are those of them that no position shows alone, their variance is infinite.
    ``train`` and ``test`` (None if there is none) are the positions' errors [rad, m], on held-out runs with first
    states of their own; ``errors`` and ``test_errors`` are measured less simulated positions (S x K x n), run by run.
    ``poses`` (N x n) [rad, m] are those at which M(q) was looked at, ``eigenvalues`` (N x n) its own there, rising
    [kg m2, kg], ``margin`` the least that is allowed. ``condition`` is that of the sensitivities with columns of
    unit length, ``segments`` the number of simulations of one run through the data, ``settled`` whether the search
    came to its end, rather than to its last iteration or second.
    """

    names: tuple[str, ...]
    values: Mapping[str, float]
    covariance: Array
    hidden: tuple[str, ...]
    train: Residuals
    test: Residuals | None
    errors: tuple[Array, ...]
    test_errors: tuple[Array, ...]
    poses: Array
    eigenvalues: Array
    margin: float
    condition: float
    segments: int
    simulations: int
    iterations: int
    settled: bool

    @property
    def limited(self) -> bool:
        """Whether the constraint on M(q) holds the estimate where it is."""
        return bool(self.eigenvalues.min() <= (1 + _ACTIVE) * self.margin)

    def std(self, name: str) -> float:
        """Standard deviation of a parameter [SI]; infinite if it is hidden, zero if it was fixed."""
        return standard_deviation(name, self.names, self.hidden, self.covariance)


def estimate(
    machine: Machine,
    runs: Sequence[Run],
    start: Mapping[str, float],
    std: Mapping[str, float] | None = None,
    settings: Settings | None = None,
) -> Estimate:
    """Base parameters of a robot with which its simulated positions follow those of the runs (report eq. 62).

    ``start`` are values [SI] by name, such as those of the inverse model; ``std`` their standard deviations, which set
    the scale of a search that begins at random or needs a first step. Friction is that of sign(qd), and the simulation
    begins anew in each segment, at a state that is sought as well.

    Raises InputError for runs that are too short or carry a payload, and where M(q) cannot be positive definite.
    """
    settings = settings or Settings()
    experiments = [experiment(run, machine.robot, settings.recipe, settings.segment, settings.filtered) for run in runs]
    search, first = search_of(machine.module, experiments, start, std or {}, settings)
    return evaluated(search, methods()[settings.method].minimise(search, first))


def evaluated(search: Search, minimum: Minimum, tests: Sequence[Experiment] = ()) -> Estimate:
    """A minimum with its uncertainty and errors, on the experiments of the search and on ``tests``."""
    criterion, point = minimum.criterion, minimum.point
    errors = criterion.errors(point)
    at = criterion.linearised(point) if np.isfinite(criterion.sum(errors)) else None
    normal = None if at is None else criterion.normal(at)
    if at is None or normal is None or not normal.finite:
        place = criterion.experiments[0].run.place
        raise InputError(place, "the simulation diverges", "shorter segments, or a start nearer to the robot")
    reduced = normal.reduced()
    size = np.sqrt(np.diag(reduced.H))
    # Parameters of which a change as large as they are, or as is expected, could not be told from the errors.
    shown = np.sqrt(np.diag(criterion.weighted(errors).normal(at).reduced().H))
    silent = shown * np.maximum(np.abs(point.chi), search.std) < _UNSEEN
    size = np.where(silent, np.inf, size)
    power, directions = np.linalg.eigh(reduced.H / np.outer(size, size))
    seen = nonzero(power, _RANK**2)
    inverse = (directions[:, seen] / power[seen]) @ directions[:, seen].T / np.outer(size, size)
    hidden = silent | not_identifiable(directions[:, ~seen].T)
    density = noise_density(criterion)
    others = replace(criterion, experiments=tuple(tests))
    tried = others.errors(_settled(others, point.chi)) if tests else ()
    return Estimate(
        names=criterion.sought,
        values=criterion.values(point.chi),
        covariance=covariance(criterion, at, reduced, inverse, density),
        hidden=tuple(np.array(criterion.sought)[hidden].tolist()),
        train=_residuals(criterion, errors),
        test=_residuals(others, tried) if tests else None,
        errors=errors,
        test_errors=tried,
        poses=search.positivity.q,
        eigenvalues=search.positivity.eigenvalues(point.chi),
        margin=search.positivity.margin,
        condition=float(np.sqrt(power[-1] / power[0])) if seen.all() else float("inf"),
        segments=sum(len(one.tau) for one in criterion.experiments),
        simulations=minimum.simulations,
        iterations=minimum.iterations,
        settled=minimum.settled,
    )


def _settled(criterion: Criterion, chi: Array) -> Point:
    """First states that fit the positions best with the parameters as they are."""
    point = criterion.begin(chi)
    least = criterion.value(point)
    for _ in range(_SETTLING if np.isfinite(least) else 0):
        steps = criterion.normal(criterion.linearised(point)).reduced().own
        trial = Point(chi, tuple(old + new for old, new in zip(point.states, steps, strict=True)))
        value = criterion.value(trial)
        if not value < least:
            break
        point, least = trial, value
    return point


def _residuals(criterion: Criterion, errors: Sequence[Array]) -> Residuals:
    """Norms of position errors, infinite where the simulation diverges, of positions, and of positions about their mean
    in each run.
    """
    result = {}
    for k in range(len(criterion.scale)):
        q = [one.q[:, :, k] for one in criterion.experiments]
        result[k] = Residual(
            sum(one.size for one in q),
            float(np.nan_to_num(np.linalg.norm(np.concatenate([e[:, :, k].ravel() for e in errors])), nan=np.inf)),
            float(np.linalg.norm(np.concatenate([one.ravel() for one in q]))),
            float(np.linalg.norm(np.concatenate([one.ravel() - one.mean() for one in q]))),
        )
    return Residuals(result)
