"""The short equations: how short they are, and that they compute what the textbook recursion does."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from random import Random

import numpy as np
import pytest
import sympy

from generator.derivation import derive
from generator.resources import find_robot
from generator.robot.description import Robot
from generator.robot.readers import read
from generator.symbolic import lean_motion, regressor
from generator.symbolic.candidates import meetings, slides
from generator.symbolic.factoring import factored
from generator.symbolic.function import PARAMETERS
from generator.symbolic.gauge import slid_origins
from generator.symbolic.interpret import evaluate, evaluate_nodes
from generator.symbolic.lean_screws import screws_beside
from generator.symbolic.model import Model
from generator.symbolic.statements import Node, Program
from tests.conftest import ALL, EVERY

#: Multiplications, additions and divisions that a function of a robot of the report's structure may cost at most, in
#: base parameters with numeric geometry: with all its effects, with rotor inertias, with rotor inertias and friction.
AT_MOST = {
    "inertia_matrix": 210,
    "gravity": 43,
    "direct_dynamics": 754,
    "flexible_direct_dynamics": 813,
    "inverse_dynamics": 458,
    "regressor": 659,
    "dynamics": 661,
}
AT_MOST_WITH_ROTORS = {"inverse_dynamics": 426, "direct_dynamics": 722, "regressor": 652, "dynamics": 629}
AT_MOST_WITH_FRICTION = {"inverse_dynamics": 444, "direct_dynamics": 740, "dynamics": 647}
ROTORS = {"rotor_inertia"}
FRICTION = {"rotor_inertia", "viscous_friction", "coulomb_friction"}

#: Share of the operations of the textbook recursion that arms of other structures save at least.
SAVED = {
    "puma560": {
        "inverse_dynamics": 0.23,
        "inertia_matrix": 0.32,
        "gravity": 0.44,
        "direct_dynamics": 0.26,
        "dynamics": 0.33,
        "regressor": 0.31,
    },
    "lbr_iiwa14": {
        "inverse_dynamics": 0.2,
        "inertia_matrix": 0.25,
        "gravity": 0.29,
        "direct_dynamics": 0.2,
        "dynamics": 0.26,
        "regressor": 0.08,
    },
}


def _robot(name: str) -> Robot:
    return read(find_robot(name))


def _with_effects(robot: Robot, kept: set[str]) -> Robot:
    return replace(robot, effects=tuple(use for use in robot.effects if use.effect in kept), flexible=())


def _with_random_lengths(robot: Robot, seed: int) -> Robot:
    draw = Random(seed)
    return replace(
        robot,
        lengths=tuple(replace(length, value=sympy.Rational(draw.randint(100, 1500), 1000)) for length in robot.lengths),
    )


def _above(robot: Robot, limits: dict[str, int]) -> dict[str, int]:
    functions = derive(robot, list(limits), check=False).functions
    return {f: functions[f].count.total for f, limit in limits.items() if functions[f].count.total > limit}


@pytest.mark.parametrize("name", ["kr500", "kr270"])
def test_operation_counts(name: str) -> None:
    robot = _robot(name)
    assert _above(robot, AT_MOST) == {}
    assert _above(_with_effects(robot, ROTORS), AT_MOST_WITH_ROTORS) == {}
    assert _above(_with_effects(robot, FRICTION), AT_MOST_WITH_FRICTION) == {}


@pytest.mark.parametrize("seed", [0, *(pytest.param(seed, marks=pytest.mark.long) for seed in (1, 2))])
def test_operation_counts_belong_to_the_structure(seed: int) -> None:
    robot = _with_random_lengths(_robot("kr500"), seed)
    assert _above(robot, AT_MOST) == {}
    assert _above(_with_effects(robot, ROTORS), AT_MOST_WITH_ROTORS) == {}
    assert _above(_with_effects(robot, FRICTION), AT_MOST_WITH_FRICTION) == {}


@pytest.mark.parametrize("name", SAVED)
@pytest.mark.parametrize("seed", [None, *(pytest.param(seed, marks=pytest.mark.long) for seed in (0, 1))])
def test_other_structures_save_too(name: str, seed: int | None) -> None:
    robot = _robot(name) if seed is None else _with_random_lengths(_robot(name), seed)
    names = list(SAVED[name])
    lean, plain = (derive(robot, names, check=False, plain=plain).functions for plain in (False, True))
    saved = {f: 1 - lean[f].count.total / plain[f].count.total for f in names}
    assert {f: share for f, share in saved.items() if share < SAVED[name][f]} == {}


@pytest.mark.parametrize("name", SAVED)
def test_inverse_dynamics_with_motor_inertias_saves_a_fifth(name: str) -> None:
    robot = _with_effects(_robot(name), ROTORS)
    short, textbook = (
        derive(robot, ["inverse_dynamics"], check=False, plain=plain).functions["inverse_dynamics"].count.total
        for plain in (False, True)
    )
    assert short <= 0.8 * textbook


#: What docs/performance.md says of regressors: operations of the columns of the bodies by the textbook recursion, by
#: projection on screws, and of the short ones; of motion and screws among the latter; distinct entries, and those of
#: them that are products.
REGRESSORS = {"puma560": (961, 679, 661, 244, 121, 89), "lbr_iiwa14": (1138, 1077, 1046, 301, 188, 145)}


@pytest.mark.parametrize("name", REGRESSORS)
def test_regressors_are_products_of_screws_and_wrenches(name: str) -> None:
    model = Model(_robot(name))
    chain, names, way = model.chain, tuple(model.kept), model.strategies.regressor

    def operations(nodes: Iterable[Node]) -> int:
        return chain.program.count(node for node in nodes if not node.parameter_only).total

    ways = (None, regressor.RegressorStrategy(), way)
    textbook, projected, short = (
        [e for column in columns.values() for e in column.values() if e is not chain.program.zero]
        for columns in (regressor.columns(chain, names, model.qd, model.qdd, one) for one in ways)
    )
    origins = slid_origins(chain, way.slide if way else ())
    factors: list[Node] = []
    for motion in lean_motion.own_motions(chain, origins, model.qd, model.qdd).values():
        factors += [*motion.u.ravel(), *motion.a, *motion.w, *motion.wd, *motion.differences]
    for carried in screws_beside(chain, origins.positions).values():
        factors += [node for screw in carried.values() for node in (*getattr(screw, "w", ()), *screw.v)]
    needed, known = chain.program.reachable(short), set(chain.program.reachable(factors))
    entries = {e.arguments[0] if e.operation == "neg" else e for e in short}
    found = (
        operations(chain.program.reachable(textbook)),
        operations(chain.program.reachable(projected)),
        operations(needed),
        operations(node for node in needed if node in known),
        len(set(short)),
        len(entries - known),
    )
    assert found == REGRESSORS[name]


@pytest.mark.parametrize("name", ["lbr_iiwa14", "scara", "stanford", "tree_two_arms"])
def test_wrenches_may_meet_screws_at_the_end_of_any_segment(name: str) -> None:
    model = Model(_robot(name))
    chain = model.chain

    def entries(way: regressor.RegressorStrategy | None) -> list[Node]:
        found = regressor.columns(chain, tuple(model.kept), model.qd, model.qdd, way, readable=False)
        return [column[c] for column in found.values() for c in sorted(column)]

    ends = [frozenset({j}) for j in meetings(chain)]
    assert len(ends) > 1
    ways = [
        regressor.RegressorStrategy(slide, met) for slide in slides(chain) for met in (*ends, frozenset().union(*ends))
    ]
    wanted, *all_found = map(entries, (None, *ways))
    random = np.random.default_rng(1)
    inputs = {name: random.uniform(-2.0, 2.0, (5, chain.dof)) for name in ("q", "qd", "qdd")}
    values = evaluate_nodes(chain.program.reachable([*wanted, *(e for found in all_found for e in found)]), inputs)
    for found in all_found:
        for entry, expected in zip(found, wanted, strict=True):
            np.testing.assert_allclose(values[entry], values[expected], rtol=0, atol=1e-11)


@pytest.mark.parametrize("name", [name for name in ALL if name != EVERY])
def test_short_and_textbook_equations_agree(name: str) -> None:
    """And those that are counted are never longer."""
    robot = _robot(name)
    counted = ["inverse_dynamics", "gravity", "inertia_matrix"]
    names = [*counted, "bias", "regressor", "payload_regressor"]
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
    assert [n for n in counted if lean.functions[n].count.total > plain.functions[n].count.total] == []


@pytest.mark.parametrize("plain", [False, True])
def test_friction_along_a_speed_takes_no_product(plain: bool) -> None:
    function = derive(_robot("kr500"), ["inverse_dynamics"], check=False, plain=plain).functions["inverse_dynamics"]
    assert sum(node.operation == "directed" for node in function.moving) == 6
    assert not any(node.operation == "sign" for node in function.moving)


def test_products_of_sums_are_multiplied_out_where_that_is_shorter() -> None:
    program = Program()
    a, b, c, d, f, g, x = (program.input("q", index) for index in range(7))
    # x (f a + g b) + f c + g d = f (x a + c) + g (x b + d).
    (shorter,) = factored(program, [x * (f * a + g * b) + f * c + g * d])
    assert program.count(program.reachable([shorter])).total == 7
    # Without another product with g there is nothing to gain.
    (same,) = factored(program, [x * (f * a + g * b) + f * c])
    assert program.count(program.reachable([same])).total == 6
    q = np.arange(2.0, 9.0)
    expected = q[6] * (q[4] * q[0] + q[5] * q[1]) + q[4] * q[2] + q[5] * q[3]
    assert evaluate_nodes(program.reachable([shorter]), {"q": q[None, :]})[shorter] == expected
