"""Robots as a calibration leaves them: no angle is a right one, and every length is something."""

from __future__ import annotations

import time
from collections.abc import Iterator

import pytest
import sympy
from sympy import Integer, Rational, pi

from generator.derivation import derive
from generator.errors import InputError
from generator.robot.description import PRISMATIC, REVOLUTE, Length, Robot
from tests.chains import joint, robot
from tests.core_quantities import CORE, check_core
from tests.regressor_rank import check_grouping
from tests.subject import subject


def degrees(text: str) -> sympy.Expr:
    return Rational(text) * pi / 180


def millimetres(text: str) -> sympy.Expr:
    return Rational(text) / 1000


def stanford() -> Robot:
    """The six joints of a Stanford arm with some hundredths of a degree and tenths of a millimetre."""
    return robot(
        "calibrated",
        [
            joint(1, REVOLUTE),
            joint(2, REVOLUTE, degrees("-90.02"), millimetres("1"), Integer(0), millimetres("152.4")),
            joint(3, PRISMATIC, degrees("90.01"), millimetres("0.2"), degrees("0.03")),
            joint(4, REVOLUTE, degrees("0.01"), millimetres("0.3")),
            joint(5, REVOLUTE, degrees("-89.99"), millimetres("0.1"), Integer(0), millimetres("0.2")),
            joint(6, REVOLUTE, degrees("90.04"), millimetres("0.3"), Integer(0), millimetres("0.2")),
        ],
    )


def test_groupings_are_found_in_seconds_and_are_right() -> None:
    """Written in the half tangents of six angles they take minutes."""
    start = time.process_time()
    arm = subject(stanford(), 1, CORE)
    assert time.process_time() - start < 20
    check_grouping(arm)
    check_core(arm, 1)


def coefficients(of: Robot) -> Iterator[tuple[sympy.Expr, float]]:
    """Of all groupings: as they are written, and the number at the robot's lengths."""
    grouping = subject(of, 1, ()).model.grouping
    for base in grouping.base:
        for coefficient, name in base.terms:
            yield coefficient, grouping.numbers[base.name][name]


def test_angles_are_written_as_such_where_they_are_few() -> None:
    one = robot("one", [joint(1, REVOLUTE, pi / 3), joint(2, REVOLUTE, degrees("20"), Rational(1, 2))])
    assert any(written.has(sympy.tan(pi / 18)) for written, _ in coefficients(one))


def test_a_length_may_have_any_name() -> None:
    """Even one that half tangents once had."""
    length = Length("tan_half_0", Rational(1, 2))
    d = sympy.Symbol(length.name, real=True)
    one = robot("one", [joint(1, REVOLUTE, pi / 3), joint(2, REVOLUTE, degrees("20"), d)], lengths=[length])
    found = list(coefficients(one))
    assert any(written.has(d) for written, _ in found)
    for written, number in found:
        assert float(written.subs(d, length.value)) == pytest.approx(number, rel=1e-12)


def test_lengths_may_be_parts_of_pi() -> None:
    one = robot("one", [joint(1, REVOLUTE), joint(2, REVOLUTE, pi / 2, pi / 3)])
    check_grouping(subject(one, 1, ()))


def test_numbers_beyond_all_robots_are_refused() -> None:
    one = robot("one", [joint(1, REVOLUTE), joint(2, REVOLUTE, Integer(0), Integer(10) ** 200)])
    with pytest.raises(InputError, match="too large or too small to compute with"):
        derive(one)


def test_named_angles_stay_named_beside_many_others() -> None:
    """A user may change them, and the generated code with them."""
    tilt = sympy.Symbol("tilt", real=True)
    one = robot(
        "one",
        [joint(j, REVOLUTE, tilt if j == 3 else degrees(str(10 * j + 1)), Rational(1, 2)) for j in (1, 2, 3, 4)],
        lengths=[Length("tilt", pi / 6, unit="rad")],
    )
    arm = subject(one, 1, ())
    check_grouping(arm)
    found = list(coefficients(one))
    assert any(written.has(tilt) for written, _ in found)
    for written, number in found:
        assert float(written.subs(tilt, pi / 6)) == pytest.approx(number, rel=1e-12)


def test_many_named_angles_are_written_as_numbers() -> None:
    """As a calibration names them; written in their half tangents the groupings have no end."""
    angles = [sympy.Symbol(f"e{j}", real=True) for j in range(2, 7)]
    named = [Length(str(angle), Rational(k, 1000), unit="rad") for k, angle in enumerate(angles, start=1)]
    right = [pi / 2, Integer(0), -pi / 2, pi / 2, -pi / 2]
    joints = [joint(j, REVOLUTE, a + e, Rational(j, 10)) for j, a, e in zip(range(2, 7), right, angles, strict=True)]
    start = time.process_time()
    arm = subject(robot("named", [joint(1, REVOLUTE), *joints], lengths=named), 1, CORE)
    assert time.process_time() - start < 40
    check_grouping(arm)
    check_core(arm, 1)
