"""Short runs that do not repeat: what follows the motion by no law of the library is told from noise all the same."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from scipy.signal import lfilter

from identification.diagnosis.command import Request
from identification.diagnosis.diagnosis import NOTHING, UNEXPLAINED, Diagnosis
from tests.diagnosis.diagnosed_arm import answered
from tests.recorded import TRUTH, as_recorded, fourier, two_links

#: Seconds of a run: too few rows for all maps of the motion. Frequency [Hz] of its slowest sine.
SECONDS, SLOWEST = 6.0, 0.11
#: Of the noise [N m].
NOISE = 0.3


def diagnosis(folder: Path, drag: float) -> Diagnosis:
    """What joint 2 drags grows with the speed of joint 1, by ``drag`` [N m s/rad]."""
    regressors, draw, sources = two_links(folder), np.random.default_rng(11), []
    for seed in (1, 2, 3):
        t, motion = fourier(regressors.model.robot, SECONDS, 250.0, seed, SLOWEST)
        tau = regressors.torques(TRUTH, motion)
        tau[1] += drag * np.sign(motion.qd[1]) * np.abs(motion.qd[0])
        tau += lfilter([1], [1, -0.5], NOISE * draw.normal(size=tau.shape))
        sources.append(str(as_recorded(regressors, t, motion.q, tau).save(folder / f"{seed}.csv")))
    request = Request(sources[:2], test=sources[2:])
    return answered(folder / "two_links.yaml", request, folder / "out")[0]


def test_drag_by_another_joint_is_unexplained_and_told(tmp_path: Path) -> None:
    found = diagnosis(tmp_path, 5.0)
    assert found.verdict == UNEXPLAINED
    assert found.after.joint == 2
    assert not any(one.status == "firm" for one in found.findings)
    assert "what is left on joint 2 follows the speed of joint 1" in found.notes


def test_noise_follows_nothing(tmp_path: Path) -> None:
    found = diagnosis(tmp_path, 0.0)
    assert (found.verdict, found.findings) == (NOTHING, ())
