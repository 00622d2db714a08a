"""Whether a motion repeats itself, and after how many samples."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from identification.arrays import Array

#: What a repetition may differ by, mean square over the motion's variance; and what must lie between two of them.
_SAME, _OTHER = 1e-5, 0.05
#: Spread of a joint [rad, m] below which it stands; and in parts of the largest, below which it is held and trembles.
_STANDING, _HELD = 1e-9, 1e-3
#: Shortest period [s]; time [s] after the beginning in which a drive may still catch up with the motion, as a part of
#: the record at most.
_SHORTEST, _STARTING, _PART = 0.5, 1.0, 0.1


def period_of(q: Array, period: float) -> int:
    """Samples after which positions q (n x N), sampled every ``period`` [s], repeat; 0 where they do not.

    At least two whole periods must be there; the beginning need not repeat. A joint that hardly moves beside the others
    does not count: the steps of its encoder do not repeat.
    """
    beginning = int(min(_STARTING / period, _PART * q.shape[-1]))
    return _period(q, period) or _period(q[:, beginning:], period)


def _period(q: Array, period: float) -> int:
    moved = q - q.mean(axis=-1, keepdims=True)
    spread = moved.std(axis=-1)
    moving = spread > max(_STANDING, _HELD * spread.max())
    x = moved[moving] / spread[moving, None]
    if not x.size:
        return 0
    lags, difference = _differences(x)
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


def _differences(x: Array) -> tuple[NDArray[np.int64], Array]:
    """Lags up to half of the samples, and the mean of |x(t + lag) - x(t)|^2 / 2 over rows and times."""
    count = x.shape[-1]
    lags = np.arange(count // 2 + 1)
    spectrum = np.fft.rfft(x, 2 * count, axis=-1)
    product = np.fft.irfft(np.abs(spectrum) ** 2, axis=-1)[..., : len(lags)].sum(axis=0)
    square = np.concatenate([[0.0], np.cumsum((x**2).sum(axis=0))])
    head, tail = square[count - lags], square[count] - square[lags]
    return lags, np.maximum((head + tail) / 2 - product, 0.0) / ((count - lags) * len(x))
