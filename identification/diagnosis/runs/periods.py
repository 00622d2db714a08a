"""Whether a motion repeats itself, and after how many samples."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.signal import argrelmin

from identification.arrays import Array

#: What a repetition may differ by, mean square over the motion's variance; and what must lie between two of them.
_SAME, _OTHER = 1e-5, 0.05
#: Spread of a joint [rad, m] below which it stands; and in parts of the largest of its kind, below which it is held and
#: trembles.
_STANDING, _HELD = 1e-9, 1e-3
#: Shortest period [s]; time [s] after the beginning in which a drive may still catch up with the motion, as a part of
#: the record at most.
_SHORTEST, _STARTING, _PART = 0.5, 1.0, 0.1
#: Part of a record that the motion that repeats takes at least, beside ways to where it begins and from where it ends;
#: periods that it holds; and lags that are tried.
_MOST, _TWICE, _TRIED = 0.6, 1.95, 8
#: Part of a lag by which what does not repeat may draw it away, and steps of that which are tried at once.
_NEAR, _STEPS = 0.03, 8
#: Square of a repetition's difference, over the motion's variance, from which a sample is no repetition.
_OTHER_NOW = 1e-3


def period_of(q: Array, period: float, kinds: Sequence[int] = ()) -> int:
    """Samples after which positions q (n x N), sampled every ``period`` [s], repeat; 0 where they do not. See
    ``repeating``.
    """
    return repeating(q, period, kinds)[0]


def repeating(q: Array, period: float, kinds: Sequence[int] = ()) -> tuple[int, slice]:
    """Samples after which positions q (n x N), sampled every ``period`` [s], repeat, 0 where they do not; and those
    that do: all but a way to where the motion begins, and from where it ends.

    At least two whole periods must be there; the first second need not repeat. A joint that hardly moves beside
    others of its kind does not count: the steps of its encoder do not repeat. ``kinds`` (n) are those of the joints,
    without which all are of one.
    """
    count = q.shape[-1]
    beginning = int(min(_STARTING / period, _PART * count))
    x = _moved(q, kinds)
    rest = _moved(q[:, beginning:], kinds)
    if found := _period(x, period, count // 2) or _period(rest, period, (count - beginning) // 2):
        return found, slice(0, count)
    for near in _lags_that_stand_out(x, period):
        lag = _of_most(x, near)
        stretch = _stretch(x, lag)
        length = stretch.stop - stretch.start
        if length > max(_MOST * count, _TWICE * lag) and (
            found := _period(_moved(q[:, stretch], kinds), period, int(length / _TWICE))
        ):
            return found, stretch
    return 0, slice(0, count)


def _lags_that_stand_out(x: Array, period: float) -> list[int]:
    """Those after which positions differ less than after lags about them, the least differing first."""
    if not x.size:
        return []
    lags, difference = _differences(x, int(x.shape[-1] / _TWICE))
    least = argrelmin(difference, order=max(int(_SHORTEST / period / 2), 1))[0]
    least = least[lags[least] >= _SHORTEST / period]
    return [int(lags[i]) for i in least[np.argsort(difference[least])][:_TRIED]]


def _of_most(x: Array, near: int) -> int:
    """The lag ``near`` one after which most positions differ least: what does not repeat draws the mean away."""
    best, width = near, max(int(_NEAR * near), 1)
    while width:
        step = max(width // _STEPS, 1)
        tried = np.arange(max(best - width, 1), min(best + width, x.shape[-1] - 1) + 1, step)
        best = int(tried[np.argmin([np.median(_apart(x, int(lag))) for lag in tried])])
        width = step if step > 1 else 0
    return best


def _apart(x: Array, lag: int) -> Array:
    """|x(t + lag) - x(t)|^2 / 2 over rows, by time."""
    return np.asarray(np.mean((x[:, lag:] - x[:, :-lag]) ** 2, axis=0) / 2)


def _stretch(x: Array, lag: int) -> slice:
    """The longest stretch of positions that all repeat after a ``lag``, to its end."""
    ends = np.flatnonzero(np.diff(np.concatenate([[False], _apart(x, lag) < _OTHER_NOW, [False]])))
    if not ends.size:
        return slice(0, 0)
    starts, stops = ends[::2], ends[1::2]
    longest = int(np.argmax(stops - starts))
    return slice(int(starts[longest]), int(stops[longest]) + lag)


def _moved(q: Array, kinds: Sequence[int]) -> Array:
    """Positions of the joints that move, about their mean, in units of their spread."""
    moved = q - q.mean(axis=-1, keepdims=True)
    spread = moved.std(axis=-1)
    alike = np.equal.outer(kinds, kinds) if len(kinds) else np.ones((len(q), len(q)), dtype=bool)
    moving = spread > np.maximum(_STANDING, _HELD * np.max(alike * spread, axis=1))
    return np.asarray(moved[moving] / spread[moving, None])


def _period(x: Array, period: float, most: int) -> int:
    """Samples after which all positions x, ``_moved``, repeat, up to so many at ``most``; 0 where they do not."""
    if not x.size:
        return 0
    lags, difference = _differences(x, most)
    first = np.flatnonzero(difference > _OTHER)
    if not first.size:
        return 0
    start = max(int(first[0]), int(_SHORTEST / period))
    below = np.flatnonzero((difference < _SAME) & (lags >= start))
    if not below.size:
        return 0
    # The best lag of the first stretch of lags that will do.
    end = below[0] + np.flatnonzero(np.diff(np.append(below, below[-1] + 2)) > 1)[0] + 1
    return int(lags[below[0] + np.argmin(difference[below[0] : end])])


def _differences(x: Array, most: int) -> tuple[NDArray[np.int64], Array]:
    """Lags up to ``most``, and the mean of |x(t + lag) - x(t)|^2 / 2 over rows and times."""
    count = x.shape[-1]
    lags = np.arange(most + 1)
    spectrum = np.fft.rfft(x, 2 * count, axis=-1)
    product = np.fft.irfft(np.abs(spectrum) ** 2, axis=-1)[..., : len(lags)].sum(axis=0)
    square = np.concatenate([[0.0], np.cumsum((x**2).sum(axis=0))])
    head, tail = square[count - lags], square[count] - square[lags]
    return lags, np.maximum((head + tail) / 2 - product, 0.0) / ((count - lags) * len(x))
