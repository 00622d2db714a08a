"""Noise without its colour: an autoregressive model of a joint's residual, and rows in which it is white.

Without this everything looks significant. Rows are in stretches, which end where rows are left out; the first rows of a
stretch are predicted from the few before them, so that nothing is lost and gaps do no harm (Levinson; Burg 1975).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import solve_toeplitz
from scipy.signal import lfilter

from identification.arrays import Array
from identification.neighbours import in_a_row

#: Order of the autoregressive model.
ORDER = 10
#: Points of a spectrum that is as fine as any colour.
_FREQUENCIES = 4097
#: Part by which rates of rows may differ that are one.
_SAME = 1e-3


@dataclass(frozen=True)
class Colour:
    """Prediction errors by order m = 0 .. p: ``filters[m]`` (m + 1, the first is 1), ``deviations[m]`` [N m, N]."""

    filters: tuple[Array, ...]
    deviations: tuple[float, ...]

    def white(self, rows: Array, stretch: NDArray[np.bool_]) -> Array:
        """Consecutive ``rows`` (k x N), of which ``stretch`` (N) tells the ones that are kept, white (k x kept)."""
        if not rows.size:
            return rows[:, stretch]
        place = _places(stretch)
        order = len(self.filters) - 1
        result = lfilter(self.filters[order] / self.deviations[order], 1.0, rows)
        for m in range(order):
            at = np.flatnonzero(place == m)
            lags = rows[:, at[:, None] - np.arange(m + 1)]
            result[:, at] = lags @ (self.filters[m] / self.deviations[m])
        return np.asarray(result[:, stretch])

    def spectrum(self, frequency: Array, rate: float) -> Array:
        """One-sided power density [unit^2/Hz] of the noise at frequencies [Hz] for rows at ``rate`` [Hz]."""
        a = self.filters[-1]
        z = np.exp(-2j * np.pi * np.outer(frequency, np.arange(len(a))) / rate)
        return np.asarray(2 * self.deviations[-1] ** 2 / rate / np.abs(z @ a) ** 2)


def colour(stretches: Sequence[Array], order: int = ORDER) -> Colour:
    """The colour of a residual in stretches, by Burg's recursion over all of them together."""
    parts = [e for e in stretches if len(e)]
    count = sum(map(len, parts))
    power = sum(float(e @ e) for e in parts) / max(count, 1)
    power = max(power, 1e-300)
    a = np.ones(1)
    filters, deviations = [a], [np.sqrt(power)]
    forward, backward = parts, parts
    for _ in range(min(order, max((len(e) for e in parts), default=1) - 1)):
        pairs = [(f[1:], b[:-1]) for f, b in zip(forward, backward, strict=True) if len(f) > 1]
        above = sum(float(f @ b) for f, b in pairs)
        below = sum(float(f @ f) + float(b @ b) for f, b in pairs)
        k = -2 * above / below if below > 0 else 0.0
        a = np.append(a, 0.0) + k * np.append(a, 0.0)[::-1]
        power *= max(1 - k * k, 1e-12)
        filters.append(a)
        deviations.append(np.sqrt(power))
        forward, backward = [f + k * b for f, b in pairs], [b + k * f for f, b in pairs]
    return Colour(tuple(filters), tuple(float(x) for x in deviations))


def recoloured(one: Colour, free: Array) -> Colour:
    """The colour of which a part ``free`` of the power is left, at frequencies evenly from none to half the rate."""
    spectrum = one.spectrum(np.linspace(0.0, 0.5, _FREQUENCIES), 1.0) / 2
    given = np.interp(np.linspace(0.0, 1.0, _FREQUENCIES), np.linspace(0.0, 1.0, len(free)), free)
    return _of_power(spectrum / given, len(one.filters) - 1)


def alike(kinds: Sequence[tuple[float, int]]) -> list[list[int]]:
    """Numbers of runs whose noise can have one colour: with the same rate of rows [Hz], means of as many samples."""
    groups: list[list[int]] = []
    for r, kind in enumerate(kinds):
        known = next((one for one in groups if np.allclose(kinds[one[0]], kind, rtol=_SAME)), None)
        if known is None:
            groups.append([r])
        else:
            known.append(r)
    return groups


def at_rate(one: Colour, own: float, rate: float) -> Colour:
    """The colour in rows at another ``rate`` [Hz] than its ``own``: even where its rows show no frequencies."""
    if np.isclose(own, rate, rtol=_SAME):
        return one
    frequency = np.linspace(0.0, rate / 2, _FREQUENCIES)
    return _of_power(one.spectrum(np.minimum(frequency, own / 2), own) * rate / 2, len(one.filters) - 1)


def mixed(colours: Sequence[tuple[Colour, float]]) -> Colour:
    """The colour between several colours, each with its weight: the logarithm of its power is the mean of theirs."""
    spectra = [one.spectrum(np.linspace(0.0, 0.5, _FREQUENCIES), 1.0) / 2 for one, _ in colours]
    weights = np.array([weight for _, weight in colours])
    order = max(len(one.filters) - 1 for one, _ in colours)
    return _of_power(np.exp(weights @ np.log(spectra) / max(weights.sum(), 1e-300)), order)


def _of_power(power: Array, order: int) -> Colour:
    """The colour of rows with a power at frequencies evenly from none to half the rate (Levinson's recursion)."""
    r = np.fft.irfft(power)
    filters, deviations = [np.ones(1)], [float(np.sqrt(r[0]))]
    for m in range(1, order + 1):
        a = np.concatenate([[1.0], solve_toeplitz(r[:m], -r[1 : m + 1])])
        filters.append(a)
        deviations.append(float(np.sqrt(np.maximum(a @ r[: m + 1], 0.0))))
    return Colour(tuple(filters), tuple(deviations))


def stretches(rows: Array, stretch: NDArray[np.bool_]) -> list[Array]:
    """The kept stretches of a signal (N)."""
    return [rows[one] for one in in_a_row(stretch)]


def _places(stretch: NDArray[np.bool_]) -> NDArray[np.int64]:
    """Of each row, how many kept rows stand right before it; -1 where it is not kept."""
    numbers = np.arange(len(stretch))
    last = np.maximum.accumulate(np.where(stretch, -1, numbers))
    return np.where(stretch, numbers - last - 1, -1)
