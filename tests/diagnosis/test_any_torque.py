"""Names are firm only where the law is known, not the torque alone."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.signal import lfilter

from generator.robot.readers import read
from identification.diagnosis.diagnosis import Diagnosis
from identification.diagnosis.noise import noise_floor
from identification.diagnosis.verdict.alternatives import OTHER_TORQUE
from identification.diagnosis.verdict.finding import TENTATIVE
from identification.observation import Regressors
from tests.diagnosis.diagnosed_arm import ARM, NOISE, STAYS, TRUTH, diagnosis_of, recorded, rewritten, torque
from tests.recorded import Array, Recorded, fourier


def test_a_soft_contact_is_firmly_no_balancer_and_no_spring(tmp_path: Path) -> None:
    def contact(q: Array, qd: Array) -> Array:
        return np.asarray(20.0 * np.maximum(q - 0.2, 0.0))

    regressors, sources = recorded(tmp_path, [contact] * 3)
    found = diagnosis_of(sources, regressors)
    (one,) = found.findings
    assert (one.hypothesis.effect, one.status) == ("gas_balancer", TENTATIVE)
    assert OTHER_TORQUE in [other.effect for other in one.alternatives]
    assert one.doubts


@pytest.mark.parametrize(("stiffness", "hardening"), [pytest.param(20.0, 2.0, marks=pytest.mark.long), (0.5, 5.0)])
def test_a_spring_that_is_mostly_its_hardening_may_be_any_torque(
    tmp_path: Path, stiffness: float, hardening: float
) -> None:
    def spring(q: Array, qd: Array) -> Array:
        return np.asarray(stiffness * (q - 0.3) + hardening * (q - 0.3) ** 3)

    lying = ARM.replace("[0 m/s2, 0 m/s2, -9.81 m/s2]", "[0 m/s2, 9.81 m/s2, 0 m/s2]")
    truth = {name: value for name, value in TRUTH.items() if not name.startswith("M")}
    regressors, sources = recorded(tmp_path, [spring] * 3, lying, truth)
    (one,) = diagnosis_of(sources, regressors).findings
    mostly = hardening > stiffness
    assert one.hypothesis.effect == "cable_spring"
    assert bool(one.doubts) == mostly
    assert (OTHER_TORQUE in [other.effect for other in one.alternatives]) == mostly


def loaded(folder: Path, share: float, rotor: float) -> Diagnosis:
    """Friction by the load past a rotor of which the file, which has no rotors, knows nothing."""
    path = folder / "arm.yaml"
    path.write_text(ARM)
    robot = read(path)
    regressors, draw, sources = Regressors(robot), np.random.default_rng(1), []
    dry = {name: 0.0 if name in ("Fv1", "Fc1", "Off1") else value for name, value in TRUTH.items()}
    for seed in (1, 2, 3):
        t, motion = fourier(robot, 40.0, 100.0, seed)
        carried = regressors.torques(dry, motion)[0] - rotor * motion.qdd[0]
        tau = regressors.torques(TRUTH, motion)[0] + share * np.sign(motion.qd[0]) * np.abs(carried)
        tau += lfilter([1], [1, -STAYS], NOISE * draw.normal(size=len(t)))
        sources.append(str(Recorded({"t": t, "q1": motion.q[0], "tau1": tau}).save(folder / f"{seed}.csv")))
    return diagnosis_of(sources, regressors)


def test_load_friction_past_a_rotor_of_which_the_file_knows_nothing(tmp_path: Path) -> None:
    (one,) = loaded(tmp_path, 0.1, 4.0).findings
    assert one.hypothesis.effect == "load_friction"
    assert abs((one.parameters["Fl1"].value or 0.0) - 0.1) < 4 * (one.parameters["Fl1"].std or 0.0)
    assert abs(one.shape["rotor"] - 4.0) < 4 * one.shape_std["rotor"]
    assert (one.parameters["Fl1"].std or 0.0) < 0.01
    assert one.shape_std["rotor"] < 0.8


def test_much_that_counts_as_noise_is_told(tmp_path: Path) -> None:
    regressors, sources = recorded(tmp_path, [torque("")] * 2)
    assert noise_floor.notes(diagnosis_of(sources, regressors).search.bank) == []
    for source in sources:
        rewritten(source, lambda t, q, tau: (t, q, tau + 25.0 * np.sin(2 * np.pi * 1.337 * t + 1.0)))
    (note,) = noise_floor.notes(diagnosis_of(sources, regressors).search.bank)
    assert "of the torques' spread counts as noise" in note
    assert "% on joint 1" in note
