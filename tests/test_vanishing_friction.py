"""Simulated dry friction that is none where the motion begins: at rest, or at one position."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from generator.derivation import derive
from generator.robot.readers import read
from tests.simulated import maker
from tests.subject import Subject

WHEEL = """\
name: wheel
gravity: [0 m/s2, 0 m/s2, -9.81 m/s2]
joints:
  - {j: 1, sigma: 0, alpha: 0, d: 0, theta: q1, r: 0}
effects:
  - {effect: EFFECT, joint: 1}
"""


def wheel(folder: Path, effect: str, values: dict[str, float]) -> Subject:
    path = folder / "wheel.yaml"
    path.write_text(WHEEL.replace("EFFECT", effect))
    return Subject(derive(read(path)), {"ZZ1": 1.0} | values)


def advanced(of: Subject, folder: Path, q: float, tau: float, duration: float) -> tuple[float, float]:
    simulated = maker(folder)(of, "rigid")
    start = simulated.start(np.array([q]), np.zeros(1))
    end = simulated.advance(start, simulated.integration("RK4", 4000, None), duration, np.array([tau]))
    return float(end.q[0]), float(end.qd[0])


def test_friction_that_grows_from_rest_brakes_from_the_start(tmp_path: Path) -> None:
    """qdd = 5 - 2 qd^2 from rest: qd = sqrt(2.5) tanh(sqrt(10) t)."""
    (tmp_path / "s").mkdir()
    of = wheel(tmp_path, "power_friction", {"Fp1": 2.0})
    for duration in (0.1, 1.0):
        _, qd = advanced(of, tmp_path / "s", 0.0, 5.0, duration)
        assert qd == pytest.approx(np.sqrt(2.5) * np.tanh(np.sqrt(10.0) * duration), rel=1e-6)


def test_friction_of_the_position_brakes_from_where_it_is_none(tmp_path: Path) -> None:
    """qd^2 / 2 = 3 q - 2 (1 - cos q): the work of friction 2 sin q along the way."""
    (tmp_path / "s").mkdir()
    of = wheel(tmp_path, "position_friction", {"Fqs1": 2.0, "Fqc1": 0.0})
    q, qd = advanced(of, tmp_path / "s", 0.0, 3.0, 0.8)
    assert 0.3 < q < np.pi
    assert qd**2 / 2 == pytest.approx(3 * q - 2 * (1 - np.cos(q)), rel=1e-5)


def test_friction_stays_where_the_probe_finds_no_numbers(tmp_path: Path) -> None:
    """A gas balancer whose chamber would be too short 0.7 rad further on: qdd = 1 - 0.5 |load| on the other joint."""
    (tmp_path / "s").mkdir()
    path = tmp_path / "pair.yaml"
    path.write_text(PAIR)
    of = Subject(derive(read(path)), {"ZZ1R": 2.0, "ZZ1": 1.0, "ZZ2": 1.0, "Fl1": 0.5, "F02": 100.0})
    simulated = maker(tmp_path / "s")(of, "rigid")
    start = simulated.start(np.array([0.0, -0.3]), np.zeros(2))
    assert next(iter(start.contact)) != FREE


FREE = 0
PAIR = """\
name: pair
gravity: [0 m/s2, 0 m/s2, -9.81 m/s2]
joints:
  - {j: 1, sigma: 0, alpha: 0, d: 0, theta: q1, r: 0}
  - {j: 2, sigma: 0, alpha: pi/2, d: 0, theta: q2, r: 0}
effects:
  - {effect: load_friction, joint: 1, values: {rotor: 0.1 kg m2}}
  - {effect: gas_balancer, joint: 2, values: {d21: 0.9669 m, d22: 0.2062 m, phi: -90 deg, l0: 0.05 m, exponent: 1.3}}
"""
