"""Candidates about drives beside what the runs hold and the robot's file says of them."""

from __future__ import annotations

from dataclasses import replace

import pytest
import sympy

from identification.diagnosis.candidates import current_limit, gear_ratio
from identification.diagnosis.hypothesis import Hypothesis
from identification.diagnosis.scene import Scene
from tests.diagnosed import known, played, with_robot
from tests.plant.effect import Effect
from tests.plant.robots import ROBOTS
from tests.plant.trajectories.fourier import fourier

JOINT = 2


@pytest.fixture(scope="module")
def scene(tmp_path_factory: pytest.TempPathFactory) -> Scene:
    """A run in which the motor of a joint clips its current."""
    arm = known(ROBOTS["kr500_like"], tmp_path_factory.mktemp("robot"))
    found, _, _ = played(arm, Effect("current_saturation", JOINT), fourier(1, period=10.0, periods=1, before=2.0))
    return found


def test_a_ratio_is_offered_where_the_file_has_a_say_in_it(scene: Scene) -> None:
    """What was recorded on the joint side stays what it is."""
    of_joints = replace(scene, sampled=replace(scene.sampled, run=replace(scene.sampled.run, by_motors=False)))
    assert len(gear_ratio.hypotheses([scene])) == 6
    assert gear_ratio.hypotheses([of_joints]) == []
    assert gear_ratio.hypotheses([scene, of_joints]) == []


def test_a_limit_is_one_of_the_recorded_current(scene: Scene) -> None:
    """Where the file states a gain, torques are no longer what was recorded."""

    def limit(one: Scene) -> Hypothesis:
        (found,) = [each for each in current_limit.hypotheses([one]) if each.joint == JOINT]
        return found

    gains = tuple(sympy.Rational(9, 10) if j == JOINT else sympy.Integer(1) for j in range(1, 7))
    signals = replace(scene.robot.signals, torque_gain=gains)
    stated = with_robot(scene, replace(scene.robot, signals=signals))
    plain, gained = limit(scene).shapes[0], limit(stated).shapes[0]
    assert (gained.low, gained.high) == pytest.approx((plain.low / 0.9, plain.high / 0.9))
    columns = limit(stated).columns(stated, {"current_limit": gained.low})
    assert columns == pytest.approx(limit(scene).columns(scene, {"current_limit": plain.low}))
