"""Shape values of effects: which numbers a robot file may give."""

from __future__ import annotations

import re
from contextlib import nullcontext
from pathlib import Path

import pytest

from generator.derivation import derive
from generator.effects.library import effects_of
from generator.errors import InputError
from generator.robot.readers import read
from tests.commands import PENDULUM


@pytest.mark.parametrize(
    ("effect", "value", "told"),
    [
        ("dahl_friction", "xs: 1e-300 rad", "xs is 1e-300, expected a size from 1e-12 to 1e+12"),
        ("coupled_rotor", "other: 2, ratio: 1e-13", "ratio is 1e-13, expected a size from 1e-12 to 1e+12"),
        ("cable_spring", "neutral: 1e13 rad", "neutral is 1e+13, expected at most 1e+12 either way"),
        ("cable_spring", "neutral: 1e-17 rad", ""),
    ],
)
def test_shape_values_have_sizes_for_single_precision(effect: str, value: str, told: str, tmp_path: Path) -> None:
    path = tmp_path / "two.yaml"
    rows = "".join(f"  - {{j: {j}, sigma: 0, alpha: 0, d: 0, theta: q{j}, r: 0}}\n" for j in (1, 2))
    use = f"effects: [{{effect: {effect}, joint: 1, values: {{{value}}}}}]\n"
    path.write_text(f"name: two\ngravity: [0 m/s2, 0 m/s2, 0 m/s2]\njoints:\n{rows}{use}")
    with pytest.raises(InputError, match=re.escape(told)) if told else nullcontext():
        effects_of(read(path))


@pytest.mark.parametrize(
    ("effect", "value", "names"),
    [
        ("cycloid_ripple", "order: 1e-4", "Ryc1 and Rys1 and Ry2c1 and Ry2s1"),
        ("spring_balancer", "d21: 0.5 m, d22: 1.5e-9 m, phi: 20 deg", "K01"),
    ],
)
def test_values_that_leave_torques_nearly_alike_are_refused(
    effect: str, value: str, names: str, tmp_path: Path
) -> None:
    """Waves so long that their harmonics are straight lines too; a crank so short that its rod hardly turns."""
    path = tmp_path / "pendulum.yaml"
    use = f"  - {{effect: {effect}, joint: 1, values: {{{value}}}}}\n"
    path.write_text(PENDULUM.replace("parameters:", f"{use}parameters:"))
    told = f"{path}:9:14: the torque of {names} is hardly another than other parameters make, "
    told += f"expected values of {effect} with which it is, or the effect left out"
    with pytest.raises(InputError, match=re.escape(told)):
        derive(read(path), ())
