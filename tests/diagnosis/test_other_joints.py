"""A residual that follows how another joint moves is told so; one that its own motion orders is not."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from identification.diagnosis.command import Request
from identification.diagnosis.diagnosis import UNEXPLAINED
from tests.diagnosis.diagnosed_arm import answered
from tests.recorded import TRUTH, Array, as_recorded, fourier, two_links

#: Of the motion, which repeats [s], and of a run; rms of the noise [N m].
PERIOD, SECONDS, NOISE = 10.0, 40.0, 0.3


def dragged(q: Array, qd: Array) -> Array:
    """What joint 2 feels of how fast joint 1 turns, whichever way it turns itself [N m]."""
    return np.asarray(4.0 * np.tanh(qd[0] / 0.3))


def bump(q: Array, qd: Array) -> Array:
    """What joint 2 feels at one place of its own range [N m]."""
    return np.asarray(4.0 * np.exp(-(((q[1] - np.median(q[1])) / 0.05) ** 2)))


@pytest.mark.parametrize(("hidden", "told"), [(dragged, True), (bump, False)])
def test_only_what_follows_another_joint_is_told_so(
    hidden: Callable[[Array, Array], Array], told: bool, tmp_path: Path
) -> None:
    regressors, draw, sources = two_links(tmp_path), np.random.default_rng(11), []
    for seed in (1, 2, 3):
        t, motion = fourier(regressors.model.robot, SECONDS, 250.0, seed, 1 / PERIOD)
        tau = regressors.torques(TRUTH, motion)
        tau[1] += hidden(motion.q, motion.qd)
        tau += NOISE * draw.normal(size=tau.shape)
        sources.append(str(as_recorded(regressors, t, motion.q, tau).save(tmp_path / f"{seed}.csv")))
    request = Request(sources[:2], test=sources[2:])
    found, _ = answered(tmp_path / "two_links.yaml", request, tmp_path / "out")
    assert (found.verdict, found.after.joint) == (UNEXPLAINED, 2)
    notes = [note for note in found.notes if "of what is left of joint 2 follows the speed of joint 1" in note]
    assert len(notes) == told
