"""Filters of the identification: zero-phase Butterworth, central differences, and MATLAB's decimation (report eq. 46).

Arrays have samples along the last axis. Every filter runs forward and backward, which doubles its order and cancels its
phase; ends are continued by odd reflection about the end sample, three samples an order.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray
from scipy import signal

from identification.arrays import Array

#: Order, ripple [dB] and corner (of the new Nyquist frequency) of the Chebyshev filter before decimation.
_ORDER, _RIPPLE, _CORNER = 8, 0.05, 0.8
#: Largest factor of one stage; MATLAB's manual asks for several beyond it.
_LARGEST = 13
#: Weights of a first derivative by the differences of samples 1, 2, 3 and 4 before and after: exact to degree 8.
_FLAT = (4 / 5, -1 / 5, 4 / 105, -1 / 280)
#: What an interior end may leave of a transient.
_FORGOTTEN = 1e-14


def padding(order: int) -> int:
    """Samples by which the ends are continued."""
    return 3 * order


def zero_phase(sections: Array, x: Array, pad: int) -> Array:
    """``x`` through second-order sections, forward and backward, its ends continued by ``pad`` samples.

    MATLAB's filtfilt; sections keep the digits that one transfer function of order 8 would lose.
    """
    result: Array = signal.sosfiltfilt(sections, x, axis=-1, padtype="odd", padlen=pad)
    return result


def smoothed(x: Array, order: int, cutoff: float, rate: float) -> Array:
    """``x`` after a Butterworth filter of ``order`` at ``cutoff`` [Hz], forward and backward; ``rate`` in Hz."""
    return zero_phase(signal.butter(order, cutoff / (rate / 2), output="sos"), x, padding(order))


def derivative(x: Array, period: float) -> Array:
    """Central differences (.. x N) over two ``period`` [s] (report eq. 46), one-sided at the two ends."""
    result = np.empty_like(x)
    result[..., 1:-1] = (x[..., 2:] - x[..., :-2]) / 2
    result[..., 0], result[..., -1] = x[..., 1] - x[..., 0], x[..., -1] - x[..., -2]
    result /= period
    return result


def flat_derivative(x: Array, period: float) -> Array:
    """Central differences over nine samples (.. x N), as ``derivative`` at the four of each end.

    They pass 0.99 of a fifth of the sampling rate, where ``derivative`` passes 0.76: an acceleration that lacks what
    its torque has looks like an elastic drive train.
    """
    result = derivative(x, period)
    count = x.shape[-1]
    reach = len(_FLAT)
    if count > 2 * reach:
        inner = sum(
            weight * (x[..., reach + n : count - reach + n] - x[..., reach - n : count - reach - n])
            for n, weight in enumerate(_FLAT, 1)
        )
        result[..., reach:-reach] = inner / period
    return result


@dataclass(frozen=True)
class Stage:
    """Decimation by one factor r as MATLAB does it: Chebyshev I of order 8, 0.05 dB, at 0.8/r of the Nyquist frequency.

    Of nd samples nout = ceil(nd/r) are kept, the first of them number r - (r nout - nd), counted from 1.
    """

    factor: int

    def first(self, count: int) -> int:
        """Index, from 0, of the first of ``count`` samples that is kept."""
        return (count - 1) % self.factor

    def kept(self, count: int) -> int:
        """How many of ``count`` samples are kept."""
        return -(-count // self.factor)

    @property
    def margin(self) -> int:
        """Samples after which the filter has forgotten an end."""
        _, poles, _ = signal.cheby1(_ORDER, _RIPPLE, _CORNER / self.factor, output="zpk")
        return int(np.ceil(np.log(_FORGOTTEN) / np.log(np.abs(poles).max())))

    @property
    def fewest(self) -> int:
        """Samples that it needs at least."""
        return padding(_ORDER) + 1

    def filtered(self, x: Array) -> Array:
        """``x`` after the filter, all samples."""
        return zero_phase(_chebyshev(self.factor), x, padding(_ORDER))

    def __call__(self, x: Array) -> Array:
        """The kept samples of ``x``."""
        return self.filtered(x)[..., self.first(x.shape[-1]) :: self.factor]


@cache
def _chebyshev(factor: int) -> Array:
    result: Array = signal.cheby1(_ORDER, _RIPPLE, _CORNER / factor, output="sos")
    return result


def stages(factor: int) -> tuple[Stage, ...]:
    """The stages whose factors multiply to ``factor``, the largest first; none for 1.

    Raises ValueError where a prime of ``factor`` is too large for a stage.
    """
    result = []
    while factor > 1:
        largest = max((r for r in range(2, min(factor, _LARGEST) + 1) if factor % r == 0), default=0)
        if not largest:
            raise ValueError(f"{factor} has no divisor up to {_LARGEST}")
        result.append(Stage(largest))
        factor //= largest
    return tuple(result)


def decimated(x: Array, factor: int) -> Array:
    """``x`` (.. x N) decimated by all stages of ``factor`` (.. x K)."""
    for stage in stages(factor):
        x = stage(x)
    return x


def kept_indices(count: int, factor: int) -> NDArray[np.int64]:
    """Indices (K), from 0, of those of ``count`` samples that decimation by all stages of ``factor`` keeps."""
    indices = np.arange(count)
    for stage in stages(factor):
        indices = indices[stage.first(len(indices)) :: stage.factor]
    return indices


def kept_rows(left_out: NDArray[np.bool_], factor: int, reach: int = 0) -> NDArray[np.bool_]:
    """Which of the samples that decimation keeps (K) have none of ``left_out`` (N) in their window: ``factor`` samples
    to either side, ``reach`` if that is more.
    """
    indices = kept_indices(len(left_out), factor)
    if not left_out.any():
        return np.ones(len(indices), dtype=bool)
    total = np.concatenate([[0], np.cumsum(left_out)])
    reach = max(factor if factor > 1 else 0, reach)
    lower, upper = np.maximum(indices - reach, 0), np.minimum(indices + reach + 1, len(left_out))
    result: NDArray[np.bool_] = total[upper] == total[lower]
    return result
