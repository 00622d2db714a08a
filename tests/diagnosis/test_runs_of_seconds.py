"""Runs of a few seconds: what is missing is not taken for noise, and a joint may stand still all along."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from generator.robot.readers import read
from identification.diagnosis.command import Request
from identification.diagnosis.diagnosis import NAMED, NOTHING, Diagnosis
from identification.diagnosis.mending.mended import Mended
from identification.observation import Regressors
from tests.diagnosis.diagnosed_arm import answered
from tests.recorded import TRUTH, TWO_LINKS, as_recorded, fourier

#: Stiffness of a spring that the file does not know [N m/rad], step of the encoders [rad], noise in parts of a torque.
SPRING, STEP, NOISE = 20.0, 2e-5, 0.01
RATE = 250.0
#: Both axes upright: no weight looks like a spring.
UPRIGHT = TWO_LINKS.replace("[0 m/s2, 0 m/s2, -9.81 m/s2]", "[0 m/s2, -9.81 m/s2, 0 m/s2]")


def diagnosis(
    folder: Path, text: str, seconds: float, spring: float, still: bool = False, runs: int = 1
) -> tuple[Diagnosis, Mended]:
    path = folder / "two_links.yaml"
    path.write_text(text.replace("  coupling: {convention: direct, N21: 5}\n", ""))
    robot, draw = read(path), np.random.default_rng(2)
    regressors, sources = Regressors(robot), []
    for number in range(1, runs + 1):
        t, motion = fourier(robot, seconds, RATE, number, slowest=max(0.25, 1 / seconds))
        if still:
            still_there = [
                np.stack([row[0], np.full_like(row[1], held)])
                for row, held in zip((motion.q, motion.qd, motion.qdd), (0.4, 0.0, 0.0), strict=True)
            ]
            motion = replace(motion, q=still_there[0], qd=still_there[1], qdd=still_there[2])
        tau = regressors.torques(TRUTH, motion)
        tau[0] += spring * motion.q[0]
        tau += NOISE * np.sqrt(np.mean(tau**2, axis=1, keepdims=True)) * draw.normal(size=tau.shape)
        q = STEP * np.round(motion.q / STEP)
        sources.append(str(as_recorded(regressors, t, q, tau).save(folder / f"{number}.csv")))
    found, new = answered(path, Request(sources), folder / "out")
    assert new is not None
    return found, new


@pytest.mark.parametrize("seconds", [2.5, pytest.param(3.0, marks=pytest.mark.long)])
def test_what_is_missing_has_its_own_value(seconds: float, tmp_path: Path) -> None:
    """Rows are too few for all that may act to be taken out of the noise, which would hold a part of the spring."""
    found, new = diagnosis(tmp_path, UPRIGHT, seconds, SPRING)
    assert found.verdict == NAMED
    (one,) = found.findings
    assert one.joints == (1,)
    assert {"joint_spring", "cable_spring"} & {one.hypothesis.effect, *(other.effect for other in one.alternatives)}
    stiffness = next(iter(one.parameters.values()))
    assert abs(stiffness.value - SPRING) < 3 * stiffness.std
    assert new.tried[1].after.relative_to_mean < 1.5


def test_a_joint_may_stand_still_all_along(tmp_path: Path) -> None:
    """What shows only together with what carries it serves their torques; what makes none is no part of the set."""
    found, new = diagnosis(tmp_path, TWO_LINKS, 8.0, 0.0, still=True, runs=2)
    assert found.verdict == NOTHING
    (together,) = [
        note for note in new.notes if note.endswith("serve the torques of such motion together, and no other")
    ]
    (out,) = [note for note in new.notes if note.endswith("which the set leaves out: zero where it plays")]
    assert "MX2" in together
    assert "Fv2" in out
    told = new.fit.parameter_set.values
    assert told["MX2"].relative_std == 1e5
    assert "Fv2" not in told
    assert all(one.after.relative_to_mean < 1.5 * one.relative_floor for one in new.tried.values() if one.floor)
