"""The short equations: how short they are, and that they compute what the textbook recursion does."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from random import Random

import numpy as np
import pytest
import sympy

from generator.derivation import derive
from generator.resources import find_robot, robots
from generator.robot.description import Robot
from generator.robot.readers import read
from generator.symbolic.function import PARAMETERS
from generator.symbolic.interpret import evaluate

#: Multiplications, additions and divisions that a function of a robot of the report's structure may cost at most, in
#: base parameters with numeric geometry.
AT_MOST = {
    "inertia_matrix": 222,
    "gravity": 62,
    "direct_dynamics": 794,
    "flexible_direct_dynamics": 850,
    "inverse_dynamics": 492,
    "regressor": 692,
    "dynamics": 741,
}


def _robot(name: str) -> Robot:
    return read(find_robot(name))


def _with_random_lengths(robot: Robot, seed: int) -> Robot:
    draw = Random(seed)
    return replace(
        robot,
        lengths=tuple(replace(length, value=sympy.Rational(draw.randint(100, 1500), 1000)) for length in robot.lengths),
    )


@pytest.mark.parametrize("name", ["kr500", "kr270"])
def test_operation_counts(name: str) -> None:
    model = derive(_robot(name), list(AT_MOST), check=False)
    assert {f: model.functions[f].count.total for f in AT_MOST if model.functions[f].count.total > AT_MOST[f]} == {}


@pytest.mark.parametrize("seed", range(3))
def test_operation_counts_belong_to_the_structure(seed: int) -> None:
    robot = _robot("kr500")
    names = ["inertia_matrix", "gravity", "direct_dynamics", "inverse_dynamics", "regressor"]
    other = derive(_with_random_lengths(robot, seed), names, check=False)
    assert [other.functions[n].count.total for n in names if other.functions[n].count.total > AT_MOST[n]] == []


@pytest.mark.parametrize("path", robots(), ids=lambda path: path.stem)
def test_short_and_textbook_equations_agree(path: Path) -> None:
    robot = read(path)
    names = ["inverse_dynamics", "bias", "gravity", "inertia_matrix", "regressor", "payload_regressor"]
    lean, plain = derive(robot, names, check=False), derive(robot, names, check=False, plain=True)
    random = np.random.default_rng(1)
    inputs = {name: random.uniform(-2.0, 2.0, (20, lean.dof)) for name in ("q", "qd", "qdd")}
    parameters = lean.default_parameters()
    parameters[: len(lean.base_parameters)] = random.uniform(-1.0, 1.0, len(lean.base_parameters))
    for name in names:
        short = evaluate(lean.functions[name], {**inputs, PARAMETERS: parameters})
        textbook = evaluate(plain.functions[name], {**inputs, PARAMETERS: parameters})
        for output, expected in textbook.items():
            np.testing.assert_allclose(short[output], expected, rtol=0, atol=1e-11 * np.abs(expected).max(initial=1.0))


@pytest.mark.parametrize("path", robots(), ids=lambda path: path.stem)
def test_no_equation_is_longer_than_the_textbooks(path: Path) -> None:
    robot = read(path)
    names = ["inverse_dynamics", "gravity", "inertia_matrix"]
    lean, plain = derive(robot, names, check=False), derive(robot, names, check=False, plain=True)
    assert [n for n in names if lean.functions[n].count.total > plain.functions[n].count.total] == []
