"""What the open loop is given: a run cut into segments, each with its torques, positions and a first state."""

from __future__ import annotations

from dataclasses import dataclass
from hashlib import sha256

import numpy as np

from generator.errors import InputError
from generator.robot.description import Robot
from generator.words import plural
from identification.arrays import Array
from identification.dataset import Run
from identification.filtering import derivative, smoothed
from identification.observation import Motion
from identification.recipes import Filters, Recipe

#: Fewest positions by which a segment is judged, and the time between two of them [s].
_FEWEST, _STEP = 20, 4e-3
#: Weights of the fourth difference, and the sum of their squares.
_FOURTH, _POWER = (1.0, -4.0, 6.0, -4.0, 1.0), 70.0


@dataclass(frozen=True)
class Experiment:
    """A run of n joints in S segments of L samples, ``period`` [s] apart, joint side.

    ``began`` (S) are the times [s] at which segments begin. ``tau`` (S x L x n) [N m, N] is held from each sample to
    the next. ``q`` (S x K x n) [rad, m] are the measured positions at each ``stride``-th sample, ``start`` (S x 2n) is
    a first guess of the first states [q; qd], ``noise`` (n) the rms of the positions' noise. ``recorded`` are the
    torques (N x n) of the samples of ``motion``, the filtered motion, ``slow`` (n) [rad/s, m/s] the speeds below which
    a joint counts as standing still.
    """

    run: Run
    filters: Filters
    period: float
    stride: int
    began: Array
    tau: Array
    q: Array
    start: Array
    noise: Array
    motion: Motion
    recorded: Array
    slow: Array

    @property
    def step(self) -> float:
        """Time between two positions that are compared [s]."""
        return self.stride * self.period

    @property
    def digest(self) -> str:
        """Hash of what drives the simulation and of what it is compared with."""
        return sha256(b"".join(x.tobytes() for x in (self.tau, self.q, self.start))).hexdigest()

    @property
    def times(self) -> Array:
        """Times (S x K) [s] of the positions that are compared."""
        return np.asarray(self.began[:, None] + self.step * np.arange(self.q.shape[1]))


def experiment(run: Run, robot: Robot, recipe: Recipe, segment: float | None, filtered: bool = False) -> Experiment:
    """The run in segments of ``segment`` [s], or in one where it is None; what is left over at the end is not used.

    Torques and positions are as measured: what a filter makes of the jump that dry friction asks of a torque, the
    simulated friction answers at another instant. ``filtered`` torques pass the recipe's Butterworth filter forward and
    backward as in report section 6.2, where noise is large beside the friction. First states are those of the filtered
    motion, so that the filter's ends are left out; and so are segments in which a torque is cut off.

    Raises InputError for a run with a payload, which the direct model does not have, and for one that is too short.
    """
    if run.payload is not None:
        raise InputError(run.place, f"the run carries payload {run.payload.name}", "a run without payload")
    filters = recipe.at(run.rate)
    stride = max(1, round(_STEP / run.period))
    count, length = _cut(run, filters, stride, segment)
    smooth = smoothed(run.q, filters.order, filters.cutoff, run.rate)
    speed = derivative(smooth, run.period)
    torque = smoothed(run.tau, filters.order, filters.cutoff, run.rate) if filtered else run.tau
    inner = filters.inner(run.samples)
    motion = Motion(*(x[:, inner] for x in (smooth, speed, derivative(speed, run.period))))
    parts = [_segments(x[:, inner], count, length) for x in (_held(torque), run.q, smooth, speed)]
    cut = np.zeros(run.q.shape) if run.unusable is None else run.unusable.astype(float)
    used = _segments(cut[:, inner], count, length).max(axis=(1, 2)) == 0
    if not used.any():
        raise InputError(
            run.place,
            "every segment holds a sample that was lost or cut off",
            "a run below the limits, or shorter segments",
        )
    tau, q, q_smooth, qd = (np.ascontiguousarray(part[used]) for part in parts)
    return Experiment(
        run=run,
        filters=filters,
        period=run.period,
        stride=stride,
        began=run.start + run.period * np.asarray(filters.first + length * np.flatnonzero(used), dtype=np.float64),
        tau=tau,
        q=q[:, ::stride].copy(),
        start=np.concatenate([q_smooth[:, 0], qd[:, 0]], axis=-1),
        noise=_white(run.q),
        motion=motion,
        recorded=np.ascontiguousarray(run.tau[:, inner].T),
        slow=recipe.standstills(robot),
    )


def _cut(run: Run, filters: Filters, stride: int, segment: float | None) -> tuple[int, int]:
    """Number of the segments, and samples of each; raises InputError where there are too few."""
    inner = filters.inner(run.samples)
    samples, fewest = inner.stop - inner.start, _FEWEST * stride
    length = samples if segment is None else round(segment / run.period)
    if length < fewest:
        least = fewest * run.period
        if segment is not None and segment < least:
            raise InputError(run.place, f"segments of {segment:g} s", f"at least {least:g} s")
        length = samples
    count = samples // length if length > 0 else 0
    if samples < fewest or not count:
        wanted = filters.first + filters.last + max(length, fewest)
        raise InputError(run.place, plural(run.samples, "row"), f"at least {wanted} for the filters and one segment")
    return count, length


def _held(tau: Array) -> Array:
    """Torques (n x N) as they are held from each sample to the next: what acts in the mean between the two."""
    result = tau.copy()
    result[:, :-1] = (tau[:, :-1] + tau[:, 1:]) / 2
    return result


def _segments(x: Array, count: int, length: int) -> Array:
    """(n x N) as (count x length x n)."""
    return x[:, : count * length].reshape(len(x), count, length).transpose(1, 2, 0)


def _white(q: Array) -> Array:
    """Rms of the white noise on positions (n x N), from their fourth differences, in which motion does not show."""
    fourth = np.apply_along_axis(np.convolve, -1, q, _FOURTH, "valid")
    result: Array = np.sqrt((fourth**2).mean(axis=-1) / _POWER)
    return result
