"""A run as the diagnosis looks at it: decimated less than an identification does, without rows near standstill or the
beginning.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import ceil, floor

import numpy as np
from numpy.typing import NDArray
from scipy import signal
from scipy.ndimage import maximum_filter1d

from generator.errors import InputError
from identification.arrays import Array
from identification.dataset import Run
from identification.diagnosis.runs.periods import repeating
from identification.diagnosis.runs.stated_elasticity import stated
from identification.filtering import flat_derivative
from identification.observation import Jump, Regressors, followed
from identification.recipes import Recipe, possible_factor
from identification.run_filters import fast_enough, filters_of
from identification.sampling import Sampled, sampled
from identification.standstill import stands_throughout

#: Rows a second that are looked at; the motion's filter passes up to as many hertz.
RATE = 50.0
#: Speed below which a joint stands, in parts of its own rms.
_SLOW = 0.04
#: Such a part below which a joint crawls: presliding and stiction, which no law of friction tells to the end.
_CRAWLING = 0.12
#: Time [s] in which a joint may remember what was before the record, and the part of a run that may be left out for it:
#: of shorter runs every row is wanted.
_MEMORY, _FORGOTTEN = 1.0, 0.05
#: Time [s] in which the swings of an elastic drive train fade, of which the log does not tell how they began, and the
#: largest part of a run.
_SWINGING, _FADING = 1.5, 0.2
#: Time before and after standing still [s] in which friction is not yet what it will be.
_SETTLING = 0.03
#: Times as long as what a reversal costs of the rows, between two reversals, from which they are not of a swing.
_APART = 1.5
#: Shortest run, or part of one, that anything can be told from [s].
SHORTEST = 1.0
#: Periods that rows hold from which they are compared: a run of two loses some rows at its ends.
_TWICE = 1.8
#: Factors of decimation that are tried for one that divides the period, in parts of the wanted one.
_NEAR = 0.35


@dataclass(frozen=True)
class Prepared:
    """A run of n joints and N decimated rows: times ``t`` [s], torques ``tau`` (n x N), ``kept`` rows (n x N).

    ``unsettled`` rows (n x N) are close to standstill, or to the beginning, before which nobody knows what was.
    ``period`` is that of the motion in rows, or of the fewest periods that are a whole number of rows, 0 where the rows
    hold no two of these; ``repeats`` is that in samples, 0 where it does not repeat; ``stretch`` are the samples of the
    run that do, and ``repeating`` how many rows hold them. Joint j's speed is below ``slow[j]`` [rad/s, m/s] in the
    rows that are left out, of ``sampled`` too; all rows of a joint that is held are.
    """

    sampled: Sampled
    t: Array
    tau: Array
    kept: NDArray[np.bool_]
    unsettled: NDArray[np.bool_]
    period: int
    slow: Array
    repeats: int
    stretch: slice
    repeating: int

    @property
    def times(self) -> float:
        """How often the run has a row of each phase of the motion, in the mean; 0 where periods are not compared."""
        return self.repeating / self.period if self.period else 0.0

    @property
    def rate(self) -> float:
        """Rows a second."""
        return self.sampled.filters.rate / self.sampled.filters.factor

    @property
    def factor(self) -> int:
        """Samples a row."""
        return self.sampled.filters.factor

    @property
    def unlike(self) -> str:
        """Why no periods of the run are compared; empty where they are."""
        if self.period:
            return ""
        if not self.repeats and self.sampled.run.is_part:
            return "shows no two periods in a part of it"
        if not self.repeats:
            return "does not repeat, or not after a whole number of samples"
        factor = self.sampled.filters.factor
        if self.repeats % factor:
            would = f"after a multiple of {factor}, such as {ceil(self.repeats / factor) * factor}, they would be"
            return f"repeats after {self.repeats} samples: periods are not compared; {would}"
        return f"repeats after {self.repeats} samples, too late for its rows to hold two: periods are not compared"

    def without_standstill(self, jumps: Sequence[Jump]) -> Prepared:
        """The same without rows in which a speed nearly stands whose sign a joint's torque follows."""
        rate = self.sampled.run.rate
        apart = _apart(rate, self.sampled.filters.factor)
        standing = _unsettled(_at_rest(self.sampled.motion.qd, jumps, apart), rate)
        sampled = replace(self.sampled, left_out=self.sampled.left_out | standing)
        kept = self.kept & (windowed(standing.astype(float), sampled.filters.factor) == 0)
        return replace(self, sampled=sampled, kept=kept)

    def decimated(self, x: Array) -> Array:
        """Signals at the recorded rate (... x M) as rows (... x N): means under a Hann window two rows wide.

        The window ends: what happens while a joint stands does not ring into the rows that are kept.
        """
        return windowed(x, self.sampled.filters.factor)


def joined(runs: Sequence[Prepared], signals: Sequence[Array], k: int) -> Array:
    """Rows of coordinate k that count (N), one run after the other; ``signals`` are n x rows, one a run."""
    return np.concatenate([rows[k, run.kept[k]] for run, rows in zip(runs, signals, strict=True)])


def _at_rest(qd: Array, jumps: Sequence[Jump], apart: float) -> NDArray[np.bool_]:
    """Samples (n x N) in which a joint's torque follows the sign of a speed that is slow beside its own rms, or that
    turns, with other reversals ``apart``.
    """
    result = np.zeros(qd.shape, dtype=bool)
    for joint, speed in followed(jumps, qd):
        result[joint] |= _standing(speed, _SLOW * float(np.sqrt(np.mean(np.square(speed)))), apart)
    return result


def _apart(rate: float, factor: int) -> float:
    """Samples between two reversals, at least, of which enough rows are left if none counts near a reversal."""
    return _APART * 2 * (round(_SETTLING * rate) + 1 + factor)


def _standing(speed: Array, slow: float, apart: float) -> NDArray[np.bool_]:
    """Samples (N) in which a speed is ``slow``, or on both sides of a reversal, which may pass between two; not of one
    of a swing, with others less than so many samples ``apart``.
    """
    result = np.abs(speed) < slow
    turned = np.flatnonzero(np.diff(np.sign(speed)))
    before, after = np.diff(turned, prepend=-np.inf), np.diff(turned, append=np.inf)
    alone = turned[np.minimum(before, after) > apart]
    result[alone] = result[alone + 1] = True
    return np.asarray(result)


def _unsettled(standing: NDArray[np.bool_], rate: float) -> NDArray[np.bool_]:
    """With the samples before and after in which friction is not yet what it will be."""
    return np.stack([maximum_filter1d(row, 2 * round(_SETTLING * rate) + 1) for row in standing])


def _decimation(wanted: float, period: int, count: int) -> tuple[int, int]:
    """The factor of decimation nearest to the ``wanted`` one that divides the ``period`` in samples, else the fewest
    periods that ``count`` samples hold twice; and what it divides, 0 where there is nothing.
    """
    usual = possible_factor(wanted) if wanted > 1 else 1
    near = range(ceil(wanted * (1 - _NEAR)), floor(wanted * (1 + _NEAR)) + 1)
    possible = sorted({usual, *(r for r in near if r > 0 and possible_factor(r) == r)}, key=lambda r: abs(r - wanted))
    for compared in range(period, floor(count / _TWICE) + 1, period) if period else ():
        for factor in possible:
            if compared % factor == 0:
                return factor, compared
    return usual, 0


def windowed(x: Array, factor: int, apart: int = 0) -> Array:
    """Every ``factor``-th sample of ``x``, from number ``factor`` to as far from the end, under a Hann window; every
    one of so many ``apart`` where that is not 0.
    """
    step = apart or factor
    count = (x.shape[-1] - 1 - 2 * factor) // step + 1
    before = -2 * factor % step
    if before:
        x = np.concatenate([np.zeros((*x.shape[:-1], before)), x], axis=-1)
    first = (2 * factor + before) // step
    result = signal.upfirdn(window(factor), x, 1, step, axis=-1)
    return np.asarray(result[..., first : first + count])


def window(factor: int) -> Array:
    """Weights (2 factor + 1) of a row's samples."""
    weights = signal.windows.hann(2 * factor + 3)[1:-1]
    return np.asarray(weights / weights.sum())


def prepared(run: Run, recipe: Recipe, regressors: Regressors) -> Prepared:
    """The run by the diagnosis' filters, which replace those of ``recipe``.

    Raises InputError for a run that is too short, has too few samples, is sampled too slowly, or with a payload of
    which something is sought.
    """
    fast_enough(run, recipe)
    if run.payload is not None and run.payload.sought:
        problem = f"{', '.join(run.payload.sought)} of payload {run.payload.name} are sought"
        raise InputError(
            run.place, problem, "all ten in the sidecar, or none: a payload that is not known is looked for"
        )
    if run.duration < SHORTEST:
        raise InputError(
            run.place, f"a run of {run.duration:.3g} s", f"{SHORTEST:g} s at least, better several periods"
        )
    kinds = [joint.sigma for joint in regressors.model.robot.moving]
    period, stretch = repeating(run.q, run.period, kinds)
    factor, compared = _decimation(run.rate / RATE, period, stretch.stop - stretch.start)
    changed = recipe.changed(cutoff=min(RATE, 0.4 * run.rate), factor=factor, order=4, standstill=0.0)
    filtering = replace(changed, dropped_first=None, dropped_last=None)
    filters_of(run, filtering)
    one = sampled(run, filtering, regressors, flat_derivative)
    speed = one.motion.qd
    usual = np.maximum(np.sqrt(np.mean(speed**2, axis=-1)), 1e-9)
    slow = _SLOW * usual
    apart = _apart(run.rate, factor)
    left_out = np.stack([_standing(x, limit, apart) for x, limit in zip(speed, slow, strict=True)])
    left_out |= stands_throughout(one.motion.q)[:, None]
    left_out |= _at_rest(speed, regressors.signs, apart)
    # Whole samples: the period of written times is a little short of what it is.
    if round(_FORGOTTEN * run.samples) >= round(_MEMORY * run.rate):
        left_out[:, one.times < run.start + _MEMORY] = True
    inner = np.arange(run.samples)[one.filters.inner(run.samples)]
    left_out[:, (inner < stretch.start) | (inner >= stretch.stop)] = True
    if swinging := stated(regressors.model.robot):
        fading = run.start + min(_SWINGING, _FADING * run.duration)
        left_out[[each.k for each in swinging]] |= one.times < fading
    if run.unusable is not None:
        left_out |= run.unusable[:, one.filters.inner(run.samples)]
    left_out = _unsettled(left_out, run.rate)
    tau = windowed(one.tau, factor)
    kept = windowed(left_out.astype(float), factor) == 0
    t = one.times[factor : factor * (tau.shape[-1] + 1) : factor]
    crawling = windowed((np.abs(speed) < _CRAWLING * usual[:, None]).astype(float), factor) > 0
    unsettled = crawling | (t < run.start + _MEMORY)
    at = inner[factor : factor * (tau.shape[-1] + 1) : factor]
    within = int(((at >= stretch.start) & (at < stretch.stop)).sum())
    rows = compared // factor if within >= _TWICE * (compared // factor) else 0
    return Prepared(replace(one, left_out=left_out), t, tau, kept, unsettled, rows, slow, period, stretch, within)
