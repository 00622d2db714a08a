"""Runs that do not repeat: noise is not known apart from the model, and what is small beside it is not firm."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from identification.diagnosis.command import Request
from identification.diagnosis.verdict.finding import FIRM, TENTATIVE, Finding
from tests.diagnosis.diagnosed_arm import answered
from tests.recorded import TRUTH, as_recorded, fourier, two_links

#: Frequency [Hz] of the slowest sine, and the noise [N m].
SLOWEST, NOISE = 0.11, 0.3


def found(folder: Path, seconds: float, delay: float) -> Finding:
    """The one finding in runs whose torques of joint 2 are recorded late by ``delay`` [s]."""
    regressors, draw, sources = two_links(folder), np.random.default_rng(23), []
    for seed in (1, 2):
        t, motion = fourier(regressors.model.robot, seconds, 250.0, seed, SLOWEST)
        tau = regressors.torques(TRUTH, motion)
        tau[1] = np.interp(t - delay, t, tau[1])
        tau += NOISE * draw.normal(size=tau.shape)
        sources.append(str(as_recorded(regressors, t, motion.q, tau).save(folder / f"{seed}.csv")))
    (one,) = answered(folder / "two_links.yaml", Request(sources), folder / "out")[0].findings
    return one


@pytest.mark.parametrize(
    ("seconds", "delay", "status"),
    [
        (6.0, 0.02, TENTATIVE),
        pytest.param(20.0, 0.012, TENTATIVE, marks=pytest.mark.long),
        pytest.param(20.0, 0.015, FIRM, marks=pytest.mark.long),
    ],
)
def test_what_is_small_beside_the_noise_is_not_firm(seconds: float, delay: float, status: str, tmp_path: Path) -> None:
    """In the shorter ones 0.91 times it is, in the longer ones 0.45, but not 0.56."""
    one = found(tmp_path, seconds, delay)
    assert (one.hypothesis.effect, one.joints) == ("torque_delay", (2,))
    assert one.status == status
