"""Noise of recorded currents is not taken for an effect."""

from __future__ import annotations

from pathlib import Path

import pytest

from identification.diagnosis.candidates import current_limit
from tests.diagnosed import known, played
from tests.plant.effect import Effect
from tests.plant.measurement import Sensors
from tests.plant.robots import ROBOTS
from tests.plant.trajectories.fourier import fourier


@pytest.mark.parametrize("clipped", [True, False])
def test_what_noise_exceeds_a_limit_by_is_not_missing(clipped: bool, tmp_path: Path) -> None:
    """A column of the recorded current shares its noise with the torque that it is to explain."""
    robot = known(ROBOTS["small_wrist"], tmp_path)
    effect = Effect("current_saturation", 1, 0.7) if clipped else Effect("offset", 1, 0.0)
    scene, _, _ = played(robot, effect, fourier(1, period=10.0, periods=1, before=2.0), Sensors(noise=0.05))
    (hypothesis,) = (one for one in current_limit.hypotheses([scene]) if one.joint == 1)
    limit = robot.robot.chain[0].peak * 0.3 if clipped else hypothesis.shapes[0].high
    assert bool(hypothesis.columns(scene, {"current_limit": limit}).any()) == clipped
