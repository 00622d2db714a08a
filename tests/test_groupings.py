"""Base parameters: the report's groupings term by term, the counts, and the numerical rank of another regressor."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from decimal import Decimal
from random import Random

import numpy as np
import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st

from generator.derivation import derive
from generator.resources import find_robot
from generator.robot.description import EffectUse, Robot
from generator.robot.readers import read
from generator.symbolic.model import Model
from tests.chains import DRIVE_TRAIN, elastic_chain, on_all_joints, random_anthropomorphic, random_robot
from tests.printed_groupings import SECTION_5_1, SECTION_6_1, SYMBOLIC, in_symbols, printed
from tests.regressor_rank import check_grouping, rank
from tests.subject import Subject, bare, subject

IN_SYMBOLS = in_symbols(SYMBOLIC)


def grouped(model: Model) -> dict[str, dict[str, float]]:
    """The model's groupings of more than one term."""
    return {name: terms for name, terms in model.grouping.numeric().items() if len(terms) > 1}


# -- the report's groupings -------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("name", "text"), [("kr270_calibrated", SECTION_5_1), ("kr500", SECTION_6_1)])
def test_the_17_groupings_are_the_printed_ones(name: str, text: str) -> None:
    expected = printed(text)
    assert len(expected) == 17
    found = grouped(bare(name))
    assert found.keys() == expected.keys()
    for base, terms in expected.items():
        # The print keeps five digits and drops trailing zeros; 1.05365 has six.
        digits = {term: 6 if value == Decimal("1.05365") else 5 for term, value in terms.items()}
        assert {t: Decimal(f"{c:.{digits[t]}g}") for t, c in found[base].items()} == terms, base


def test_the_nominal_lengths_do_not_reproduce_the_kr270_print() -> None:
    found = grouped(bare("kr270"))
    expected = printed(SECTION_5_1)
    assert {base: terms.keys() for base, terms in found.items()} == {b: t.keys() for b, t in expected.items()}
    assert Decimal(f"{found['ZZ1R']['M2']:.5g}") != expected["ZZ1R"]["M2"]


@pytest.mark.parametrize("name", ["kr270", "kr270_calibrated", "kr500"])
def test_groupings_in_symbols(name: str) -> None:
    model = bare(name)
    found = {base.name: base.terms for base in model.grouping.base if len(base.terms) > 1}
    assert found.keys() == IN_SYMBOLS.keys()
    symbols = {n: sympy.Symbol(n, real=True) for n in ("d2", "d3", "d4", "rl1", "rl4", "rl6")}
    for base, terms in found.items():
        (one, head), *rest = terms
        assert (one, f"{head}R") == (1, base)
        expected = {t: sympy.sympify(e, locals=symbols) for t, e in IN_SYMBOLS[base].items()}
        assert {term: sympy.expand(c) for c, term in rest} == expected, base


def test_what_stands_alone_keeps_its_name() -> None:
    model = bare("kr500")
    alone = [base.name for base in model.grouping.base if len(base.terms) == 1]
    inertial = [name for name in alone if name[0] in "XYZM"]
    assert inertial == [
        *("XY2", "YZ2", "MY2", "XZ3", "YZ3", "XY4", "XZ4", "YZ4", "MX4", "XY5", "XZ5", "YZ5", "MX5"),
        *("XY6", "XZ6", "YZ6", "ZZ6", "MX6", "MY6"),
    ]
    assert [name for name in alone if name[0] == "I"] == ["Ia3", "Ia4", "Ia5", "Ia6"]


def test_what_has_no_effect_is_named() -> None:
    eliminated = bare("kr500").grouping.eliminated
    without_effect = [one.name for one in eliminated if not one.into]
    assert without_effect == ["XX1", "XY1", "XZ1", "YY1", "YZ1", "MX1", "MY1", "MZ1", "M1", "MZ2"]


# -- counts -----------------------------------------------------------------------------------------------------------


def count(robot: Robot, effects: Sequence[EffectUse]) -> int:
    """Number of base parameters with these effects alone; the derivation checks it against the numerical rank."""
    return len(derive(replace(robot, effects=tuple(effects), flexible=()), ()).base_parameters)


@pytest.mark.parametrize(
    ("name", "all_effects"),
    [("kr270", 60), pytest.param("kr270_calibrated", 60, marks=pytest.mark.long), ("kr500", 59)],
)
def test_counts_of_the_reports_robots(name: str, all_effects: int) -> None:
    robot = read(find_robot(name))
    assert count(robot, ()) == 36
    assert count(robot, on_all_joints(robot.joints, "rotor_inertia")) == 40
    assert count(robot, on_all_joints(robot.joints, *DRIVE_TRAIN)) == 58
    assert count(robot, robot.effects) == all_effects


@pytest.mark.parametrize("name", ["kr270", "kr500"])
def test_counts_of_the_12_joint_chain(name: str) -> None:
    twelve, rigid = read(find_robot(f"{name}_table5")), read(find_robot(name))
    for robot in (twelve, elastic_chain(rigid).robot):
        motors = tuple(range(1, 13, 2))
        assert count(robot, ()) == 72
        assert count(robot, [EffectUse("rotor_inertia", motors)]) == 76
        assert count(robot, on_all_joints(robot.joints, "rotor_inertia")) == 82


@pytest.mark.parametrize("name", ["kr270", "kr500"])
def test_reduced_flexible_regressor_has_66_columns(name: str) -> None:
    robot = replace(read(find_robot(name)), effects=())
    model = derive(robot, ("flexible_regressor",))
    (output,) = model.functions["flexible_regressor"].outputs
    assert output.signal.shape == (12, 66)
    arm = subject(robot, names=("flexible_regressor",))
    W = np.concatenate([arm.output("flexible_regressor", **arm.inputs(model.functions["flexible_regressor"], s))
                        for s in range(20)])  # fmt: skip
    assert rank(W) == 66


@settings(max_examples=6)
@given(st.randoms(use_true_random=False))
def test_counts_hold_for_any_lengths_of_the_reports_structure(draw: Random) -> None:
    robot = random_anthropomorphic(draw)
    assert count(robot, ()) == 36
    assert count(robot, robot.effects) == 58


# -- rank -------------------------------------------------------------------------------------------------------------


def test_groupings_agree_with_the_reference(arm: Subject) -> None:
    check_grouping(arm)


@given(st.randoms(use_true_random=False))
def test_groupings_of_any_chain_agree_with_the_reference(draw: Random) -> None:
    check_grouping(subject(random_robot(draw), names=()))


def test_each_rule_is_told(arm: Subject) -> None:
    grouping = arm.model.grouping
    assert all(one.rule for one in grouping.eliminated)
    acting = [one for one in grouping.eliminated if "antecedent" in one.rule]
    assert all(one.rule.endswith("where no torque shows them") != bool(one.into) for one in acting)
    for base in grouping.base:
        assert base.terms[0] == (1, base.head)
        assert base.name == (base.head if len(base.terms) == 1 else f"{base.head}R")
