"""How a link swings when a log begins, of a simulated robot that integrates its drive train apart."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from identification.diagnosis.runs.first_swing import FirstSwings
from identification.diagnosis.runs.link_side import LinkSide, Train, link_side
from identification.diagnosis.runs.scene import Scene
from tests.diagnosis.diagnosed import CLEAN, known
from tests.diagnosis.soft_arm import COMPLIANCE, NAME, ROTOR
from tests.plant.effect import Effect
from tests.plant.robots import ROBOTS
from tests.plant.run import Run
from tests.plant.simulate import make_run
from tests.plant.trajectories.fourier import fourier
from tests.recorded import Array

#: Time [s] in which the first swing hardly dies out.
_FIRST = 2.0


@pytest.fixture(scope="module")
def run() -> Run:
    way = fourier(2, period=10.0, periods=1, before=2.0)
    effect = Effect("joint_flexibility", 1).sized(COMPLIANCE)
    return make_run(ROBOTS[NAME], way, [effect], sensors=replace(CLEAN, noise=0.01))


def link(run: Run, folder: Path, begins: float) -> LinkSide:
    """Past the first drive train, in a log that ``begins`` so many seconds after the robot does."""
    scene = known(ROBOTS[NAME], folder).scene(run)
    first = round(begins * run.rate)
    sampled = scene.sampled
    motion = sampled.motion.part(first, sampled.motion.samples)
    cut = replace(sampled, motion=motion, tau=sampled.tau[:, first:], left_out=sampled.left_out[:, first:])
    return link_side(Scene(cut, scene.regressors, scene.values), 0, ROTOR)


def left(side: LinkSide, torque: Array) -> Array:
    """The rms of what a torque leaves of the log, while the first swing lasts and after it."""
    e, first = (side.scene.tau - side.scene.model_torque - torque)[0], round(_FIRST / side.scene.period)
    return np.array([np.std(e[:first]), np.std(e[first:])])


@pytest.mark.parametrize(("begins", "swings"), [(0.0, False), (5.0, True)])
def test_a_log_that_begins_as_the_link_swings(begins: float, swings: bool, run: Run, tmp_path: Path) -> None:
    side = link(run, tmp_path, begins)
    k = 1 / COMPLIANCE
    train = Train(k, 0.02 * np.sqrt(ROTOR / float(np.mean(side.inertia))))
    hanging, told = side.torque_per(side.deflection(train)), FirstSwings().torque(side, train)
    if not swings:
        np.testing.assert_array_equal(told, hanging)
        return
    assert left(side, hanging)[0] > 2 * left(side, hanging)[1]
    np.testing.assert_allclose(left(side, told)[0], left(side, told)[1], rtol=0.3)
