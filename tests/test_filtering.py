"""Filters of the identification against plain statements of what they are."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy import signal

from identification.filtering import Stage, decimated, derivative, flat_derivative, kept_indices, smoothed, stages

Array = NDArray[np.float64]


def forward_and_backward(b: Array, a: Array, x: Array, pad: int) -> Array:
    """MATLAB's filtfilt, written out: odd reflection, steady state of the first sample, there and back."""
    padded = np.concatenate([2 * x[0] - x[pad:0:-1], x, 2 * x[-1] - x[-2 : -pad - 2 : -1]])
    steady = signal.lfilter_zi(b, a)
    there, _ = signal.lfilter(b, a, padded, zi=steady * padded[0])
    back, _ = signal.lfilter(b, a, there[::-1], zi=steady * there[-1])
    return back[::-1][pad:-pad]


def noise(count: int, seed: int = 1) -> Array:
    return np.random.default_rng(seed).normal(size=count).cumsum()


@pytest.mark.parametrize("count", [24792, 1000, 1001, 1009])
@pytest.mark.parametrize("r", [10, 5, 2])
def test_decimation_is_that_of_matlab(count: int, r: int) -> None:
    x = noise(count)
    b, a = signal.cheby1(8, 0.05, 0.8 / r)
    kept = -(-count // r)
    start = r - (r * kept - count)
    expected = forward_and_backward(b, a, x, 24)[start - 1 :: r]
    assert len(expected) == kept
    assert np.allclose(Stage(r)(x), expected, rtol=0, atol=1e-6 * np.abs(x).max())


def test_butterworth_forward_and_backward_with_three_samples_an_order() -> None:
    x = noise(2000)
    b, a = signal.butter(4, 100 / 500)
    assert np.allclose(smoothed(x, 4, 100.0, 1000.0), forward_and_backward(b, a, x, 12), atol=1e-9 * np.abs(x).max())


def test_central_differences_are_exact_on_parabolas_inside() -> None:
    t = np.linspace(0, 1, 101)
    x = np.stack([3 * t**2 - t, 5 * t])
    found = derivative(x, 0.01)
    assert np.allclose(found[:, 1:-1], np.stack([6 * t - 1, 5 + 0 * t])[:, 1:-1])
    assert found[0, 0] == pytest.approx((x[0, 1] - x[0, 0]) / 0.01)
    assert found[0, -1] == pytest.approx((x[0, -1] - x[0, -2]) / 0.01)


def test_flat_differences_keep_a_fifth_of_the_sampling_rate() -> None:
    t = np.arange(400) / 100
    for part, least in ((0.1, 0.9999), (0.2, 0.993)):
        omega = 2 * np.pi * part * 100
        x, xd = np.sin(omega * t), omega * np.cos(omega * t)
        flat, plain = (rate(x, 0.01)[4:-4] @ xd[4:-4] / (xd[4:-4] @ xd[4:-4]) for rate in (flat_derivative, derivative))
        assert plain < least < flat <= 1
    x = np.stack([t**2, 5 * t])
    assert flat_derivative(x, 0.01)[:, 1:-1] == pytest.approx(np.stack([2 * t, 5 + 0 * t])[:, 1:-1])
    assert flat_derivative(x[:, :8], 0.01) == pytest.approx(derivative(x[:, :8], 0.01))


@pytest.mark.parametrize("factor", [1, 2, 7, 10, 13, 20, 26, 100, 1000])
def test_stages_multiply_to_the_factor(factor: int) -> None:
    assert np.prod([stage.factor for stage in stages(factor)], dtype=int) == factor
    assert all(stage.factor <= 13 for stage in stages(factor))
    count = 30 * factor + 7
    assert len(kept_indices(count, factor)) == decimated(noise(count), factor).shape[-1]


def test_a_factor_without_stages_is_refused() -> None:
    with pytest.raises(ValueError, match="17 has no divisor up to 13"):
        stages(34)


def test_the_kept_samples_keep_their_times() -> None:
    gain = 10 ** (-0.05 / 20 * 2 * 2)  # 0.05 dB at rest, forward and backward, in two stages
    x = 3 + np.arange(50000) / 1000
    assert np.allclose(decimated(x, 100)[190:-190], gain * x[kept_indices(50000, 100)][190:-190], rtol=1e-8)


@pytest.mark.parametrize("r", [2, 10, 13])
def test_an_end_is_forgotten_after_the_margin(r: int) -> None:
    stage = Stage(r)
    x = noise(6 * stage.margin)
    whole, part = stage.filtered(x), stage.filtered(x[stage.margin :])
    assert np.abs(whole[2 * stage.margin :] - part[stage.margin :]).max() < 1e-11 * np.abs(x).max()


def test_the_filters_pass_what_is_slow_and_stop_what_is_fast() -> None:
    t = np.arange(20000) / 1000
    slow, fast = np.sin(2 * np.pi * 5 * t), np.sin(2 * np.pi * 200 * t)
    inner = slice(500, -500)
    assert np.abs(smoothed(slow + fast, 4, 50.0, 1000.0) - slow)[inner].max() < 2e-3
    assert np.abs(decimated(fast, 10))[50:-50].max() < 1e-5
