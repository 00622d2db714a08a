"""On which joints the diagnosis looks for balancers."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from generator.robot.readers import read
from identification.diagnosis.candidates import library
from identification.diagnosis.evidence import BALANCERS
from identification.observation import Regressors
from tests.diagnosed import known, played
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
    assert not {one.effect for one in library.hypotheses([scene])} & set(BALANCERS)
    # Joint 2 has its balancer, and the wrist carries next to nothing.
    heavy, _, _ = played(known(ROBOTS[HEAVY], tmp_path), Effect("offset", 1, 0.0), WAY)
    found = {(one.effect, one.joint) for one in library.hypotheses([heavy])}
    assert {joint for effect, joint in found if effect == "spring_balancer"} == {3}
