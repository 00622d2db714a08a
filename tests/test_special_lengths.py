"""Symbolic lengths whose nominal value hides a part of the groupings are refused, others may have any value later."""

from __future__ import annotations

from pathlib import Path

import pytest

from generator.errors import InputError
from generator.robot.description import Robot
from generator.robot.readers import read
from generator.symbolic.model import Model
from tests.core_quantities import CORE, check_core
from tests.subject import subject

ARM = """\
name: arm
gravity: [0 m/s2, 0 m/s2, -9.81 m/s2]
geometry:
  a: {nominal: A, symbolic: SYMBOLIC}
  b: {nominal: B, symbolic: SYMBOLIC}
joints:
  - {j: 1, sigma: 0, alpha: 0, d: 0, theta: q1, r: 0}
  - {j: 2, sigma: 0, alpha: ALPHA, d: 0, theta: q2, r: 0}
  - {j: 3, sigma: 0, alpha: pi/2, d: D, theta: q3, r: R}
  - {j: 4, sigma: 0, alpha: pi/2, d: 0, theta: q4, r: 0}
"""

#: What vanishes at the nominal values: a length, the difference of two squares, the difference of two, an angle's sine.
SPECIAL = {
    "zero": {"A": "0.2 m", "B": "0 m"},
    "equal": {"A": "0.4 m", "B": "0.4 m"},
    "difference": {"A": "0.4 m", "B": "0.4 m", "D": "a - b", "R": "0"},
    "angle": {"A": "0.4 m", "B": "0 rad", "ALPHA": "b", "R": "0"},
}


def arm(folder: Path, symbolic: bool, values: dict[str, str]) -> Robot:
    text = ARM
    for name, value in ({"ALPHA": "pi/2", "D": "a", "R": "b", "SYMBOLIC": str(symbolic).lower()} | values).items():
        text = text.replace(f" {name}", f" {value}")
    path = folder / "arm.yaml"
    path.write_text(text)
    return read(path)


@pytest.mark.parametrize("name", SPECIAL)
def test_a_special_nominal_value_is_refused_at_its_length(name: str, tmp_path: Path) -> None:
    robot = arm(tmp_path, symbolic=True, values=SPECIAL[name])
    expected = r"arm.yaml:[45]:3: the groupings at the nominal value of [ab] are not those of other values"
    with pytest.raises(InputError, match=expected):
        _ = Model(robot).grouping


@pytest.mark.parametrize("name", SPECIAL)
def test_a_number_may_be_special(name: str, tmp_path: Path) -> None:
    check_core(subject(arm(tmp_path, symbolic=False, values=SPECIAL[name]), 1, CORE), 1)


#: Named angles that are numbers, and what quarter turns among them are.
NAMED = [("90 deg", "pi/2"), ("-180 deg", "pi"), ("0 deg", "0"), ("-1.81 rad", "")]


@pytest.mark.parametrize(("angle", "exact"), NAMED)
def test_a_named_angle_that_is_a_number_is_one_in_the_code(angle: str, exact: str, tmp_path: Path) -> None:
    """Its name stands in the groupings where it is no quarter turn, and no sine of it is left to the code."""
    lengths = {"A": "0.4 m", "D": "a", "R": "0"}
    named = arm(tmp_path, symbolic=False, values={**lengths, "B": angle, "ALPHA": "b"})
    plain = arm(tmp_path, symbolic=False, values={**lengths, "B": "0 m", "ALPHA": exact or "-1810 mrad"})
    made, other = subject(named, 1, CORE), subject(plain, 1, CORE)
    check_core(made, 1)
    functions = (made.model.functions, other.model.functions)
    assert {name: one.count for name, one in functions[0].items()} == {
        name: one.count for name, one in functions[1].items()
    }
    terms = [str(part) for base in made.model.grouping.base for part, _ in base.terms]
    assert any("b" in one for one in terms) is (not exact)


def test_other_values_hold_away_from_the_nominal_ones(tmp_path: Path) -> None:
    check_core(subject(arm(tmp_path, symbolic=True, values={"A": "0.4 m", "B": "0.3 m"}), 1, CORE), 1)


def test_a_general_value_is_made_special_by_no_step(tmp_path: Path) -> None:
    """Each symbolic length, the seventh too, is held against another value of it, which must not be a special one."""
    lengths = "".join(f"  l{k}: {{nominal: 0.1 m, symbolic: true}}\n" for k in range(1, 7))
    fixed = "".join(f"  - {{j: {k}, sigma: 2, alpha: 0, d: l{k}, theta: 0, r: 0}}\n" for k in range(1, 7))
    path = tmp_path / "arm.yaml"
    path.write_text(
        f"name: arm\ngravity: [0 m/s2, 0 m/s2, -9.81 m/s2]\ngeometry:\n{lengths}"
        f"  l7: {{nominal: -1 m, symbolic: true}}\njoints:\n{fixed}"
        "  - {j: 7, sigma: 0, alpha: pi/2, d: 0, theta: q7, r: 0}\n"
        "  - {j: 8, sigma: 0, alpha: pi/2, d: l7, theta: q8, r: 0}\n"
    )
    assert Model(read(path)).grouping.base
