"""Rows of the observation matrix: a run differentiated, its regressor and torques decimated alike (report eq. 40).

The matrix of a long run is never held whole at the recorded rate: it is computed and decimated part by part, each part
with so much of its neighbours that the filter has forgotten where the part ends.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from generator.effects.library import undefined
from generator.errors import InputError
from identification.arrays import Array
from identification.dataset import Run
from identification.filtering import Stage, decimated, derivative, kept_indices, kept_rows, smoothed, stages
from identification.observation import Motion, Regressors, standing
from identification.recipes import Filters, Recipe

#: Samples of a part at the recorded rate.
_PART = 1 << 15
#: Decimated rows at either end of which noise is larger than that of the others.
_ENDS = 2
#: Range [rad, m] within which a joint that never moves faster than the threshold has no motion. Less than that of one
#: that stands: there rows are left out, here what little moves is made zero.
_UNMOVED = 1e-3


@dataclass(frozen=True)
class Rows:
    """Consecutive rows of one joint: regressor columns W (rows x columns), torques Y (rows), times [s] (rows)."""

    joint: int
    names: tuple[str, ...]
    W: Array
    Y: Array
    t: Array

    def errors(self, values: Mapping[str, float]) -> Array:
        """What parameters by name [SI] leave of the torques (rows) [N m, N]: Y - W chi."""
        return np.asarray(self.Y - self.W @ np.array([values[name] for name in self.names]))


#: Why a joint that is ``Sampled.spoiled`` has no rows.
SPOILED = "each would hold a sample that was lost or cut off"


@dataclass(frozen=True)
class Sampled:
    """A run ready to be observed: its filtered motion, without the ends; ``still`` are joints without motion.

    Of samples (n x N) near standstill, ``slow``, and of all that are ``left_out``, no row is made.
    ``head`` are the speeds (n x h) [rad/s, m/s] before it, since the run began: states inside effects remember them.
    """

    run: Run
    filters: Filters
    motion: Motion
    tau: Array
    slow: NDArray[np.bool_]
    left_out: NDArray[np.bool_]
    still: tuple[int, ...]
    head: Array

    @property
    def times(self) -> Array:
        """Times of the samples [s] (N)."""
        numbers: Array = np.arange(self.filters.first, self.filters.first + self.motion.samples, dtype=float)
        return self.run.start + self.run.period * numbers

    def spoiled(self, k: int) -> bool:
        """Whether joint k, fast enough for rows, has none because of samples that were lost or cut off."""
        rows, fast = (kept_rows(out[k], self.filters.factor).any() for out in (self.left_out, self.slow))
        return bool(fast and not rows)


def sampled(
    run: Run, recipe: Recipe, regressors: Regressors, rate: Callable[[Array, float], Array] = derivative
) -> Sampled:
    """The motion of a run by the recipe's filters (report eq. 46), its speeds by ``rate`` of positions and period.

    Raises InputError where the run is too short, for a filter whose order is too high to be computed, and where the
    model has no real torque along the motion.
    """
    filters = recipe.at(run.rate)
    with np.errstate(all="ignore"):
        q = smoothed(run.q, filters.order, filters.cutoff, run.rate)
    if not np.isfinite(q).all():
        problem = f"a filter of order {filters.order} at {filters.cutoff:g} Hz cannot be computed"
        raise InputError(run.place, problem, "a lower order")
    qd = rate(q, run.period)
    qdd = rate(qd, run.period)
    inner = filters.inner(run.samples)
    limits = recipe.standstills(regressors.model.robot)
    still = tuple(k for k in range(len(q)) if np.ptp(run.q[k]) < _UNMOVED and np.abs(qd[k, inner]).max() <= limits[k])
    for k in still:
        q[k], qd[k], qdd[k] = run.q[k].mean(), 0.0, 0.0
    motion = regressors.completed(Motion(q, qd, qdd, warmth=run.warmth), run.period).part(inner.start, inner.stop)
    slow = standing(regressors.signs, motion.qd, limits)
    left_out = slow if run.unusable is None else slow | run.unusable[:, inner]
    result = Sampled(run, filters, motion, run.tau[:, inner], slow, left_out, still, qd[:, : inner.start])
    _check_defined(result, regressors)
    return result


def _check_defined(one: Sampled, regressors: Regressors) -> None:
    """Raises InputError, with the effect and the time, where the model has no real torque along the motion."""
    with np.errstate(all="ignore"):
        torques = regressors.torques({}, one.motion)
    numbers = np.isfinite(torques).all(axis=0)
    if not numbers.all():
        first = int(np.argmin(numbers))
        what = _without_value(one.motion.part(first, first + 1), regressors)
        problem = f"{what} has no real value at {one.times[first]:g} s"
        raise InputError(one.run.place, problem, "a model that is defined along the run's motion")


def _without_value(motion: Motion, regressors: Regressors) -> str:
    """The effect that has no value along a motion."""
    with np.errstate(all="ignore"):
        base = regressors.base(motion)
    names = {
        name
        for own, columns in zip(regressors.structure, base, strict=True)
        for name, column in zip(own, columns, strict=True)
        if not np.isfinite(column).all()
    }
    first = undefined(regressors.model.effects, names)
    return "the robot's model" if first is None else f"{first.effect.title} on joint {first.joint.number}"


def rows_of(one: Sampled, regressors: Regressors) -> Iterator[Rows]:
    """All rows of a run, joint by joint, in parts; rows whose decimation window holds a left-out sample are not there,
    nor those next to an end: the filter leaves the sample there, about which the run is continued, all its noise.

    The columns of a joint are those of the base parameters that it depends on, then those of the run's payload.
    """
    names = [list(row) for row in regressors.structure]
    if one.run.payload is not None:
        for row in names:
            row += one.run.payload.names().values()
    times = one.times
    factor = one.filters.factor
    keep = np.array([kept_rows(one.left_out[k], factor) for k in range(len(names))])
    if factor > 1:
        keep[:, :_ENDS] = keep[:, -_ENDS:] = False
    indices = kept_indices(one.motion.samples, factor)
    for part in _decimated_parts(one, regressors):
        for k, (W, Y) in enumerate(part.columns):
            inside = keep[k][part.start : part.start + len(Y)]
            t = times[indices[part.start : part.start + len(Y)]]
            yield Rows(k, tuple(names[k]), W[:, inside].T, Y[inside], t[inside])


@dataclass(frozen=True)
class _Part:
    """Decimated columns of all joints from row ``start``: (columns x rows, rows) a joint."""

    start: int
    columns: list[tuple[Array, Array]]


def _decimated_parts(one: Sampled, regressors: Regressors) -> Iterator[_Part]:
    steps = stages(one.filters.factor)
    if not steps:
        for start in range(0, one.motion.samples, _PART):
            yield _Part(start, _columns(one, regressors, start, min(start + _PART, one.motion.samples)))
        return
    first = [*_first_stage(one, regressors, steps[0])]
    if len(steps) == 1:
        yield from first
        return
    rest = one.filters.factor // steps[0].factor
    joined = [
        tuple(np.concatenate([part.columns[k][i] for part in first], axis=-1) for i in (0, 1))
        for k in range(len(first[0].columns))
    ]
    yield _Part(0, [(decimated(W, rest), decimated(Y, rest)) for W, Y in joined])


def _first_stage(one: Sampled, regressors: Regressors, stage: Stage) -> Iterator[_Part]:
    """The run after the first stage, in parts that begin with a sample that is kept."""
    count, r = one.motion.samples, stage.factor
    length, margin = max(_PART // r, 1) * r, -(-stage.margin // r) * r
    for start in range(stage.first(count), count, length):
        end = min(start + length, count)
        left, right = max(start - margin, 0), min(end + margin, count)
        kept = slice(start - left, end - left, r)
        columns = _columns(one, regressors, left, right)
        # Copies, so that what is not kept can be freed.
        filtered = [(stage.filtered(W)[:, kept].copy(), stage.filtered(Y)[kept].copy()) for W, Y in columns]
        yield _Part((start - stage.first(count)) // r, filtered)


def _columns(one: Sampled, regressors: Regressors, start: int, end: int) -> list[tuple[Array, Array]]:
    motion = one.motion.part(start, end)
    base = _loaded(one, regressors).base(motion)
    if one.run.payload is not None:
        base = [np.concatenate(pair) for pair in zip(base, regressors.payload(motion), strict=True)]
    return [(W, one.tau[k, start:end]) for k, W in enumerate(base)]


def _loaded(one: Sampled, regressors: Regressors) -> Regressors:
    """With the load of the run's payload: of the values that the regressors have, or else of those that are known."""
    payload = one.run.payload
    if payload is None or not regressors.reads_load:
        return regressors
    return regressors.carrying(
        [regressors.values.get(name, payload.known.get(stem, 0.0)) for stem, name in payload.names().items()]
    )
