"""On which joints the diagnosis looks for balancers."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from generator.effects.library import effects_of
from generator.effects.library import library as effects
from generator.errors import InputError
from generator.robot.readers import read
from identification.diagnosis.candidates import library
from identification.diagnosis.columns.bank import Variant
from identification.diagnosis.columns.effect_columns import EffectColumns
from identification.diagnosis.search.likely import balances, likely
from identification.observation import Regressors
from tests.diagnosis.diagnosed import known, played
from tests.plant.effect import Effect
from tests.plant.robot_file import robot_file
from tests.plant.robots import ROBOTS
from tests.plant.trajectories.fourier import fourier

HEAVY, SCARA = "kr500_like", "scara_like"
WAY = fourier(1, period=10.0, periods=1, before=2.0)


def test_a_balancer_is_looked_for_where_bodies_weigh(tmp_path: Path) -> None:
    """A spring pulls on an upright axis of a SCARA, but there is nothing to balance."""
    path = tmp_path / "scara_like.yaml"
    path.write_text(robot_file(ROBOTS[SCARA]).replace("effects:\n", "effects:\n  - {effect: joint_spring, joint: 1}\n"))
    regressors = Regressors(read(path))
    own = known(ROBOTS[SCARA], tmp_path)
    of_spring = replace(own, regressors=regressors, values={**own.values, "ks1": 40.0})
    scene, _, _ = played(of_spring, Effect("offset", 1, 0.0), WAY)
    assert np.ptp(scene.load[0]) > 10
    assert not any(balances(one.effect) for one in library.hypotheses([scene]))
    # Joint 2 has its balancer, and the wrist carries next to nothing.
    heavy, _, _ = played(known(ROBOTS[HEAVY], tmp_path), Effect("offset", 1, 0.0), WAY)
    found = {(one.effect, one.joint) for one in library.hypotheses([heavy])}
    assert {joint for effect, joint in found if effect == "spring_balancer"} == {3}


@pytest.mark.parametrize(("lean", "usual"), [(0.0, {2}), (0.1, {2}), (0.6, {1, 2})])
def test_a_balancer_is_usual_on_the_shoulder(lean: float, usual: set[int], tmp_path: Path) -> None:
    """However the base leans: the first axis carries weight too then."""
    robot = replace(ROBOTS[HEAVY], own=(), base=(lean, 0.0, 0.0))
    scene, _, _ = played(known(robot, tmp_path), Effect("offset", 1, 0.0), WAY)
    found = [one for one in library.hypotheses([scene]) if balances(one.effect)]
    assert {2, 3} <= {one.joint for one in found}
    assert {one.joint for one in found if one.usual} == usual


def test_the_weight_on_a_slide_says_nothing_of_shoulders(tmp_path: Path) -> None:
    """A lift that leans, and carries a light arm: newtons are no part of newton metres."""
    path = tmp_path / "lift.yaml"
    axes = ((1, 1, "pi/6", "0", "q1"), (2, 0, "pi/2", "q2", "0"), (3, 0, "0", "q3", "0"), (4, 0, "pi/2", "q4", "0"))
    joints = "".join(f"  - {{j: {j}, sigma: {s}, alpha: {a}, d: 0, theta: {t}, r: {r}}}\n" for j, s, a, t, r in axes)
    path.write_text(f"name: lift\ngravity: [0 m/s2, 0 m/s2, -9.81 m/s2]\njoints:\n{joints}", encoding="utf-8")
    swing = np.array([200.0, 50.0, 20.0, 1.0])
    slides, turning = sorted(library._alike(read(path)), key=len)
    assert library._shoulders(swing, turning) == {1}
    assert library._shoulders(swing, slides) == {0}
    assert library._shoulders(0 * swing, turning) == set()
    scenes: Any = [SimpleNamespace(tau=np.array([[0.0, 300.0], [0.0, 80.0], [0.0, 30.0], [0.0, 5.0]]))]
    assert library._weighty(scenes, swing, turning) == {1, 2}


def test_a_balancer_has_room_over_the_limits_of_the_joint(tmp_path: Path) -> None:
    """Along the run it may have: the robot file refuses one that the joint's limits do not allow."""
    arm = known(ROBOTS[HEAVY], tmp_path)
    scene, _, _ = played(arm, Effect("offset", 1, 0.0), WAY)
    joint = arm.regressors.model.robot.moving[2]
    shape = {"d21": 1.0, "d22": 0.4, "phi": 1.5, "exponent": 1.0}
    columns = EffectColumns(effects()["gas_balancer"], joint, 2, arm.regressors.model.robot)
    lengths = np.linspace(0.05, 1.5, 40).tolist()
    finite = [bool(np.all(np.isfinite(columns(scene, {**shape, "l0": length})))) for length in lengths]
    assert not finite[0]
    assert finite[-1]
    first = lengths[finite.index(True)]
    text = robot_file(ROBOTS[HEAVY]).replace(
        "effects:\n",
        "effects:\n  - {effect: gas_balancer, joint: 3, values: {d21: 1.0 m, d22: 0.4 m, phi: 1.5 rad, exponent: 1, "
        f"l0: {first} m}}}}\n",
    )
    path = tmp_path / "balanced.yaml"
    path.write_text(text, encoding="utf-8")
    assert effects_of(read(path))
    # The file allows any room; what is looked for is not squeezed to a tenth.
    path.write_text(text.replace(f"l0: {first} m", f"l0: {0.94 * first} m"), encoding="utf-8")
    assert effects_of(read(path))
    path.write_text(text.replace(f"l0: {first} m", f"l0: {0.85 * first} m"), encoding="utf-8")
    with pytest.raises(InputError, match="l0 is too small"):
        effects_of(read(path))


def test_a_spring_may_pass_its_dead_centre_closely(tmp_path: Path) -> None:
    """As near as the file may have it: pivots need no room beside each other."""
    arm = known(ROBOTS[HEAVY], tmp_path)
    scene, _, _ = played(arm, Effect("offset", 1, 0.0), WAY)
    q = scene.motion.q[2]
    shape = {"d21": 1.0, "d22": 0.93, "phi": np.pi - float(q[len(q) // 3])}
    columns = EffectColumns(
        effects()["spring_balancer"], arm.regressors.model.robot.moving[2], 2, arm.regressors.model.robot
    )
    assert np.isfinite(columns(scene, shape)).all()


def test_a_spring_without_stiffness_is_not_thought_of_first(tmp_path: Path) -> None:
    scene, _, _ = played(known(ROBOTS["small_wrist"], tmp_path), Effect("offset", 1, 0.0), WAY)
    (spring,) = (
        one for one in library.hypotheses([scene]) if (one.effect, one.joint, one.usual) == ("spring_balancer", 2, True)
    )
    assert [one.name for one in spring.coefficients] == ["Kr2", "K02"]
    whole = Variant(spring, {}, (10, 11), (1,), (0, 1))
    assert likely(whole, [])
    assert not likely(whole.only([1]), [])
    assert not likely(whole, [whole])
