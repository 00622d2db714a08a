"""The colour of noise: found from a process whose law is known, taken out exactly."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy import linalg, signal

from identification.diagnosis.columns.whitening import Colour, alike, at_rate, colour, mixed, recoloured, stretches
from tests.matrices import process

Array = NDArray[np.float64]

#: A process e[t] = 1.2 e[t-1] - 0.5 e[t-2] + 3 w[t], with poles of modulus 0.71.
LAW, DEVIATION = np.array([1.0, -1.2, 0.5]), 3.0


def drawn(count: int, seed: int) -> Array:
    return process(LAW, DEVIATION, count, seed)


def covariances(count: int) -> Array:
    """Of the process for lags 0 to count - 1, from its impulse response."""
    impulse = np.zeros(3000)
    impulse[0] = 1.0
    h = signal.lfilter([DEVIATION], LAW, impulse)
    return np.array([float(h[: len(h) - lag] @ h[lag:]) for lag in range(count)])


def with_gaps(count: int) -> NDArray[np.bool_]:
    """Rows that are kept: every 40 rows 13 are missing."""
    return np.arange(count) % 40 < 27


def test_a_known_process_is_found_across_gaps() -> None:
    e, kept = drawn(40_000, 1), with_gaps(40_000)
    found = colour(stretches(e, kept), order=2)
    # The standard deviation of a coefficient is below 1/sqrt(rows) = 0.006.
    assert found.filters[-1] == pytest.approx(LAW, abs=0.03)
    assert found.deviations[-1] == pytest.approx(DEVIATION, rel=0.02)
    assert found.deviations[0] ** 2 == pytest.approx(covariances(1)[0], rel=0.05)


def test_a_higher_order_than_needed_changes_little() -> None:
    found = colour([drawn(40_000, 2)], order=10)
    assert found.filters[-1][:3] == pytest.approx(LAW, abs=0.03)
    assert np.abs(found.filters[-1][3:]).max() < 0.03


def test_the_rows_are_white_and_of_deviation_one() -> None:
    e, kept = drawn(40_000, 3), with_gaps(40_000)
    white = colour(stretches(e, kept)).white(e[None], kept)[0]
    assert len(white) == kept.sum()
    assert white.std() == pytest.approx(1.0, rel=0.02)
    # Within stretches, which are 27 rows long.
    for lag in (1, 2, 3, 5):
        pairs = white.reshape(-1, 27)
        assert abs(np.mean(pairs[:, lag:] * pairs[:, :-lag])) < 0.03
    # The first rows of a stretch are as large as the others.
    assert white.reshape(-1, 27)[:, 0].std() == pytest.approx(1.0, rel=0.08)


def test_a_short_stretch_is_whitened_as_its_covariance_says() -> None:
    order, count = 4, 9
    # Levinson's prediction errors of each order from exact covariances; x' C^-1 x is the sum of the white squares.
    c = covariances(count)
    filters, deviations = [np.ones(1)], [float(np.sqrt(c[0]))]
    for m in range(1, order + 1):
        a = np.concatenate([[1.0], -linalg.solve_toeplitz(c[:m], c[1 : m + 1])])
        filters.append(a)
        deviations.append(float(np.sqrt(c[: m + 1] @ a)))
    known = Colour(tuple(filters), tuple(deviations))
    # The process is of order 2, so that the prediction from the last four rows is the one from all.
    root = linalg.cholesky(linalg.toeplitz(c), lower=True)
    x = np.random.default_rng(4).normal(size=(3, count))
    expected = linalg.solve_triangular(root, x.T, lower=True).T
    assert known.white(x, np.ones(count, dtype=bool)) == pytest.approx(expected, rel=1e-9, abs=1e-9)


def test_stretches_are_apart() -> None:
    """What is left out is not read, and each stretch starts as a run does."""
    e, kept = drawn(600, 5), with_gaps(600)
    known = colour([drawn(5000, 6)])
    spoiled = np.where(kept, e, np.nan)
    white = known.white(spoiled[None], kept)[0]
    parts = [known.white(part[None], np.ones(len(part), dtype=bool))[0] for part in stretches(e, kept)]
    assert white == pytest.approx(np.concatenate(parts), rel=1e-12)


def test_the_spectrum_holds_the_power() -> None:
    known = colour([drawn(20_000, 7)], order=2)
    rate = 50.0
    frequency = np.linspace(0, rate / 2, 4001)
    power = np.trapezoid(known.spectrum(frequency, rate), frequency)
    assert power == pytest.approx(known.deviations[0] ** 2, rel=1e-12)
    # And lies where the process has it: against Welch's estimate.
    at, measured = signal.welch(drawn(400_000, 8), rate, nperseg=256)
    inside = slice(4, -4)
    ratio = known.spectrum(at[inside], rate) / measured[inside]
    assert np.median(ratio) == pytest.approx(1.0, abs=0.05)
    assert ratio.max() < 1.4
    assert ratio.min() > 0.7


def test_what_was_taken_away_at_a_frequency_is_given_back_there() -> None:
    whole = colour([drawn(100_000, 9)])
    half = recoloured(whole, np.full(65, 0.5))
    assert half.deviations == pytest.approx(np.array(whole.deviations) * np.sqrt(2), rel=1e-12)
    for one, other in zip(half.filters, whole.filters, strict=True):
        assert one == pytest.approx(other, abs=1e-12)
    # Slow parts twice as large, quick ones as they are.
    free = np.linspace(0.5, 1.0, 65)
    slow = recoloured(whole, free)
    rate = 50.0
    at = np.linspace(0.0, rate / 2, 65)
    assert slow.spectrum(at, rate) * free == pytest.approx(whole.spectrum(at, rate), rel=0.03)


def test_rows_at_another_rate_have_the_same_power_at_the_same_frequency() -> None:
    known = colour([drawn(40_000, 5)], order=2)
    slower = at_rate(known, 50.0, 40.0)
    f = np.linspace(0.5, 18.0, 30)
    assert slower.spectrum(f, 40.0) == pytest.approx(known.spectrum(f, 50.0), rel=0.25)
    frequency = np.linspace(0.0, 20.0, 2000)
    power = float(np.trapezoid(known.spectrum(frequency, 50.0), frequency))
    assert slower.deviations[0] ** 2 == pytest.approx(power, rel=1e-7)
    assert at_rate(known, 50.0, 50.0) is known


def test_a_mixed_colour_is_between_both() -> None:
    one, other = colour([drawn(40_000, 5)]), colour([np.random.default_rng(6).normal(size=40_000)])
    frequency = np.linspace(0.01, 0.49, 20)
    a, b, both = (x.spectrum(frequency, 1.0) for x in (one, other, mixed([(one, 300.0), (other, 100.0)])))
    assert both == pytest.approx(a**0.75 * b**0.25, rel=0.05)


def test_runs_are_alike_whose_rows_are() -> None:
    assert alike([(50.0, 20), (75.0, 1), (50.0002, 20), (50.0, 2)]) == [[0, 2], [1], [3]]
