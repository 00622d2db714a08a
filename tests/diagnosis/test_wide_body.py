"""A body that reaches far from the flange: how its mass is spread shows more than its weight, and tells it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from generator.robot.readers import read
from identification.observation import Regressors
from tests.bodies import ten_parameters
from tests.diagnosis.diagnosed_arm import diagnosis_of
from tests.recorded import as_recorded, fourier

#: Two axes that cross, the first one level: of a welding positioner.
POSITIONER = """\
name: positioner
gravity: [0 m/s2, -9.81 m/s2, 0 m/s2]
joints:
  - {j: 1, sigma: 0, alpha: 0, d: 0, theta: q1, r: 0}
  - {j: 2, sigma: 0, alpha: -pi/2, d: 0, theta: q2, r: 0.25 m}
  - {j: 3, sigma: 2, alpha: 0, d: 0, theta: 0, r: 0, tool: true}
effects:
  - {effect: viscous_friction, joints: all}
  - {effect: coulomb_friction, joints: all}
"""
#: Base parameters [SI], and the standard deviation of what is known of them [%].
TRUTH = {"ZZ1R": 50.0, "MX1": 1.0, "MY1R": 30.0, "Fv1": 90.0, "Fc1": 40.0, "XX2R": -1.0, "XY2": -0.15} | {
    "XZ2": -0.7,
    "YZ2": -0.4,
    "ZZ2": 17.0,
    "MX2": 7.5,
    "MY2": 4.1,
    "Fv2": 40.0,
    "Fc2": 20.0,
}
STD = 3
#: Of the body [kg, m], in the frame of the flange.
MASS, CENTRE = 14.0, np.array([0.32, -0.2, 0.3])


def unit(name: str) -> str:
    return {"M": "kg m", "F": "N m s/rad" if name[1] == "v" else "N m"}.get(name[0], "kg m2")


def test_it_is_told_by_how_its_mass_is_spread(tmp_path: Path) -> None:
    (path := tmp_path / "true.yaml").write_text(POSITIONER)
    regressors, draw, sources = Regressors(read(path)), np.random.default_rng(3), []
    assert TRUTH.keys() == set(regressors.names)
    body = ten_parameters(MASS, CENTRE, 0.1 * np.eye(3))
    for seed in range(1, 4):
        t, motion = fourier(regressors.model.robot, 15.0, 200.0, seed)
        tau = regressors.torques(TRUTH, motion) + np.stack([body @ rows for rows in regressors.payload(motion)])
        tau += np.array([[1.0], [0.5]]) * draw.normal(size=tau.shape)
        sources.append(str(as_recorded(regressors, t, motion.q, tau).save(tmp_path / f"{seed}.csv")))
    known = {name: value * (1 + STD / 100 * draw.normal()) for name, value in TRUTH.items()}
    values = [f"\n      {name}: {{value: {x:g}, unit: {unit(name)}, relative_std: {STD}}}" for name, x in known.items()]
    path.write_text(f"{POSITIONER}parameters:\n  known:\n    values:{''.join(values)}\n")
    found = diagnosis_of(sources, Regressors(read(path)), "known")
    (one,) = found.findings
    assert one.hypothesis.effect == "payload"
    for name, true in {"MX": body[6], "MY": body[7], "XY": body[1], "XZ": body[2], "YZ": body[4]}.items():
        assert one.parameters[name].value == pytest.approx(true, abs=3 * one.parameters[name].std)
        assert one.parameters[name].std < 0.2 * abs(true)
