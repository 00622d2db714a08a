"""Shape values of effects: which numbers a robot file may give."""

from __future__ import annotations

import re
from contextlib import nullcontext
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import pytest

from generator.derivation import derive
from generator.effects.library import effects_of, library
from generator.errors import InputError
from generator.robot.description import PRISMATIC
from generator.robot.readers import read
from tests.commands import PENDULUM
from tests.reviewed import files


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


#: The second joint slides.
SCREW = """\
name: screw
gravity: [0 m/s2, 0 m/s2, -9.81 m/s2]
joints:
  - {j: 1, sigma: 0, alpha: pi/2, d: 0, theta: q1, r: 0}
  - {j: 2, sigma: 1, alpha: pi/2, d: 0, theta: 0, r: q2}
  - {j: 3, sigma: 0, alpha: pi/2, d: 0.3 m, theta: q3, r: 0}
effects: [{effect: coupled_rotor, joint: JOINT, values: {other: OTHER, ratio: RATIO}}]
"""


@pytest.mark.parametrize(
    ("joint", "other", "ratio", "told"),
    [
        (1, 2, "314 rad/m", 314),
        (1, 2, "0.314 rad/mm", 314),
        (1, 2, "314", 314),
        (2, 1, "3 mm/rad", Fraction(3, 1000)),
        (2, 1, "3 rad/m", "ratio is given in rad/m, expected a number without a unit or in m/rad"),
        (1, 2, "3 rad", "ratio is given in rad, expected a number without a unit or in rad/m"),
        (1, 3, "3 rad/m", "ratio is given in rad/m, expected a number without a unit"),
    ],
)
def test_a_ratio_between_a_slide_and_a_revolute_joint_may_state_its_unit(
    joint: int, other: int, ratio: str, told: Fraction | str, tmp_path: Path
) -> None:
    path = tmp_path / "screw.yaml"
    path.write_text(SCREW.replace("JOINT", str(joint)).replace("OTHER", str(other)).replace("RATIO", ratio))
    if isinstance(told, str):
        with pytest.raises(InputError, match=re.escape(told) + "$"):
            effects_of(read(path))
    else:
        (instance,) = effects_of(read(path))
        assert instance.site.values["ratio"] == told


@pytest.mark.parametrize(
    ("joint", "other", "ratio", "shown"),
    [(1, 2, "314", "314 rad/m"), (2, 1, "3 mm/rad", "0.003 m/rad"), (1, 3, "-7/4", "-1.75")],
)
def test_the_review_tells_the_unit_of_a_ratio_between_a_slide_and_a_revolute_joint(
    joint: int, other: int, ratio: str, shown: str, tmp_path: Path
) -> None:
    path = tmp_path / "screw.yaml"
    path.write_text(SCREW.replace("JOINT", str(joint)).replace("OTHER", str(other)).replace("RATIO", ratio))
    told = files(derive(read(path), (), check=False))
    assert f"| coupled_rotor | {joint} | other = {other}, ratio = {shown} |" in told["groupings.md"]
    assert f"<td>{shown}</td>" in told["review.html"].replace("\u2212", "-").replace("\u00a0", " ")


def test_the_kinds_of_joint_that_an_effect_needs_are_its_own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "screw.yaml"
    use = "effect: cycloid_ripple, joint: 2, values: {order: 3}"
    path.write_text(re.sub("effect: coupled_rotor.*}}", f"{use}}}", SCREW))
    with pytest.raises(InputError, match=r"cycloid_ripple cannot sit on joint 2, expected a revolute joint$"):
        effects_of(read(path))
    of_slides = replace(library()["cycloid_ripple"], kinds=(PRISMATIC,))
    monkeypatch.setattr("generator.effects.library.library", lambda: {of_slides.id: of_slides})
    path.write_text(path.read_text().replace("joint: 2", "joint: 1"))
    with pytest.raises(InputError, match=r"cycloid_ripple cannot sit on joint 1, expected a prismatic joint$"):
        effects_of(read(path))
