"""By how much coloured residuals make estimates less certain."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import signal

from identification.colour import inflation


@pytest.mark.parametrize("a", [0.0, 0.8, 0.98])
def test_noise_of_first_order_counts_by_its_spectrum_at_zero(a: float) -> None:
    """Of e_k = a e_k-1 + w_k the mean's variance is (1 + a)/(1 - a) times that of white noise."""
    noise = np.random.default_rng(4).normal(size=(40, 20_000))
    found = [inflation(e) for e in signal.lfilter([1.0], [1.0, -a], noise, axis=-1)]
    assert np.mean(found) == pytest.approx((1 + a) / (1 - a), rel=0.1)
