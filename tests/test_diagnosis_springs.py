"""Springs that pull a link back: by their stiffness, where they rest, and how they harden."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.signal import lfilter

from generator.robot.readers import read
from identification.diagnosis.diagnosis import NAMED, diagnose
from identification.diagnosis.roles import Roles
from identification.observation import Regressors
from tests.diagnosed_arm import ARM, NOISE, STAYS, ready
from tests.recorded import Recorded, fourier

#: Without weight or offset, of which a cable could be a part.
BARE = ARM.replace("-9.81 m/s2", "0 m/s2").replace("  - {effect: offset, joint: 1}\n", "")
TRUTH, STIFFNESS = {"ZZ1": 9.0, "Fv1": 14.0, "Fc1": 9.0}, 12.0


@pytest.mark.parametrize("hardening", [0.0, 12.0, 40.0])
@pytest.mark.parametrize("neutral", [-0.2, 0.0, 0.1, 0.17, 0.28])
def test_a_spring_is_told_by_rest_and_hardening(neutral: float, hardening: float, tmp_path: Path) -> None:
    (tmp_path / "arm.yaml").write_text(BARE)
    robot = read(tmp_path / "arm.yaml")
    regressors, draw = Regressors(robot), np.random.default_rng(1)
    sources = []
    for seed in (1, 2):
        t, motion = fourier(robot, 40.0, 100.0, seed)
        way = motion.q[0] - neutral
        tau = regressors.torques(TRUTH, motion)[0] + STIFFNESS * way + hardening * way**3
        tau += lfilter([1], [1, -STAYS], NOISE * draw.normal(size=len(t)))
        sources.append(str(Recorded({"t": t, "q1": motion.q[0], "tau1": tau}).save(tmp_path / f"{seed}.csv")))
    runs = [ready(source, regressors) for source in sources]
    found = diagnose(regressors, runs, Roles((sources[0],), (sources[1],), (), tuple(sources)))
    assert found.verdict == NAMED
    (one,) = found.findings
    told = {name: (value.value, value.std) for name, value in one.parameters.items()}
    if not neutral and not hardening:
        assert one.hypothesis.effect == "joint_spring"
        assert told["ks1"][0] == pytest.approx(STIFFNESS, abs=4 * told["ks1"][1])
        return
    assert one.hypothesis.effect == "cable_spring"
    assert one.shape["neutral"] == pytest.approx(neutral, abs=0.01)
    for name, true in (("kc1", STIFFNESS), ("kch1", hardening)):
        assert told[name][0] == pytest.approx(true, abs=4 * told[name][1])
