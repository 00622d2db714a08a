"""Every generated quantity against three independent implementations: numbers, not formulas, are compared."""

from __future__ import annotations

from random import Random

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from generator.derivation import quantities
from generator.reference.quantities import NAMES
from generator.reference.sample import payload
from tests.bodies import STEMS
from tests.chains import random_anthropomorphic, random_robot
from tests.core_quantities import CORE, check_core, conditioning
from tests.newton_euler import Arm
from tests.pinocchio_model import PinocchioArm
from tests.subject import LOSSES, SPRINGS, Subject, close, subject

SEEDS = (1, 2, pytest.param(3, marks=pytest.mark.long))
#: Quantities that tell weight and balancers from each other and from offsets, where the groupings let them.
FORCES_APART = {"gravity", "potential_energy", "dynamics", "balancer"}
#: Quantities that are checked through others: packed entries, and the groupings as a function.
THROUGH_OTHERS = {"regressor_packed", "regressor_standard_packed", "base_parameters"}


def test_the_reference_knows_every_quantity() -> None:
    assert set(quantities()) - THROUGH_OTHERS == set(NAMES)


@pytest.mark.parametrize("seed", SEEDS)
def test_every_quantity_equals_the_reference(arm: Subject, seed: int) -> None:
    for name, function in arm.model.functions.items():
        if name in THROUGH_OTHERS:
            continue
        apart = (name in FORCES_APART or arm.loaded) and arm.hides(*LOSSES, *SPRINGS)
        one = arm.kept if apart else arm
        inputs = one.inputs(function, seed)
        actual, expected = arm.generated(name, inputs), one.expected(name, inputs)
        assert actual.keys() == expected.keys(), name
        tolerance = 1e-12 * max(100.0, conditioning(arm, inputs["q"])) if "direct_dynamics" in name else 1e-10
        for output, value in expected.items():
            assert close(actual[output], value, tolerance), f"{name}: {output} is {actual[output]}, expected {value}"


@pytest.mark.parametrize("kind", ["regressor", "regressor_standard"])
def test_packed_regressors_hold_the_dense_ones(arm: Subject, kind: str) -> None:
    function = arm.model.functions[f"{kind}_packed"]
    assert function.sparsity is not None
    arm = arm.kept if arm.loaded else arm
    inputs = arm.inputs(function, 4)
    dense = np.zeros(function.sparsity.shape)
    dense[list(function.sparsity.rows), list(function.sparsity.columns)] = arm.output(f"{kind}_packed", **inputs)
    assert close(dense, arm.expected(kind, inputs)["W"])
    assert list(zip(function.sparsity.rows, function.sparsity.columns, strict=True)) == sorted(
        set(zip(function.sparsity.rows, function.sparsity.columns, strict=True))
    )


def test_base_parameters_function_is_the_grouping(arm: Subject) -> None:
    inputs = arm.inputs(arm.model.functions["base_parameters"], 1)
    assert close(arm.output("base_parameters", **inputs), list(arm.base_values.values()))


@pytest.mark.parametrize("seed", SEEDS)
def test_bodies_equal_the_textbook_recursion(arm: Subject, seed: int) -> None:
    bodies, textbook = arm.bodies_alone, Arm(arm.robot, arm.values)
    q, qd, qdd = arm.state(seed)
    load, wrench = payload(seed), bodies.inputs(arm.model.functions["wrench_torque"], seed)["wrench"]
    assert close(bodies.output("inverse_dynamics", q=q, qd=qd, qdd=qdd), textbook.torques(q, qd, qdd))
    loaded = bodies.output("inverse_dynamics_loaded", q=q, qd=qd, qdd=qdd, payload=load, wrench=wrench)
    assert close(loaded, textbook.torques(q, qd, qdd, payload=load, wrench=list(wrench)))
    assert close(bodies.output("inertia_matrix", q=q), textbook.inertia_matrix(q))
    assert close(bodies.output("gravity", q=q), textbook.gravity(q))
    assert close(bodies.output("bias", q=q, qd=qd), textbook.torques(q, qd, 0 * q))


@pytest.mark.parametrize("seed", SEEDS)
def test_bodies_and_rotors_equal_pinocchio(arm: Subject, seed: int) -> None:
    ours = arm.only(*STEMS, "Ia")
    theirs = PinocchioArm(arm.robot, arm.values)
    q, qd, qdd = arm.state(seed)
    tau = ours.output("inverse_dynamics", q=q, qd=qd, qdd=qdd)
    assert close(tau, theirs.inverse_dynamics(q, qd, qdd))
    assert close(ours.output("inertia_matrix", q=q), theirs.inertia_matrix(q))
    assert close(ours.output("bias", q=q, qd=qd), theirs.bias(q, qd))
    assert close(ours.output("kinetic_energy", q=q, qd=qd), theirs.kinetic_energy(q, qd))
    if not arm.hides("Off"):
        assert close(ours.output("gravity", q=q), theirs.gravity(q))
        assert close(ours.output("potential_energy", q=q), theirs.potential_energy(q), 1e-9)
    tolerance = 1e-12 * max(100.0, conditioning(arm, q))
    assert close(ours.output("direct_dynamics", q=q, qd=qd, tau=tau), theirs.direct_dynamics(q, qd, tau), tolerance)


@pytest.mark.parametrize("seed", SEEDS)
def test_frames_equal_pinocchio(arm: Subject, seed: int) -> None:
    theirs = PinocchioArm(arm.robot, arm.values)
    q, _, _ = arm.state(seed)
    numbers = [joint.number for joint in arm.robot.joints]
    assert close(arm.output("transforms", q=q), [theirs.pose(number, q) for number in numbers])
    assert close(arm.output("jacobians", q=q), [theirs.jacobian(number, q) for number in numbers])
    assert close(arm.output("tool_transform", q=q), theirs.pose(arm.robot.tool.number, q))
    assert close(arm.output("tool_jacobian", q=q), theirs.jacobian(arm.robot.tool.number, q))


@pytest.mark.parametrize("seed", SEEDS)
def test_a_payload_equals_pinocchio(arm: Subject, seed: int) -> None:
    theirs = PinocchioArm(arm.robot, arm.values)
    q, qd, qdd = arm.state(seed)
    without, load = theirs.inverse_dynamics(q, qd, qdd), payload(seed)
    theirs.add_payload(load)
    W = arm.output("payload_regressor", q=q, qd=qd, qdd=qdd)
    assert close(W @ load, theirs.inverse_dynamics(q, qd, qdd) - without)


def test_regressor_columns_equal_pinocchio(arm: Subject) -> None:
    theirs = PinocchioArm(arm.robot, arm.values)
    q, qd, qdd = arm.state(5)
    W = dict(zip(arm.standard, arm.output("regressor_standard", q=q, qd=qd, qdd=qdd).T, strict=True))
    columns = theirs.columns(q, qd, qdd)
    assert close(np.stack([W[name] for name in columns]), np.stack(list(columns.values())))


def test_a_wrench_does_the_work_of_its_jacobian(arm: Subject) -> None:
    q, qd, _ = arm.state(6)
    wrench = arm.inputs(arm.model.functions["wrench_torque"], 6)["wrench"]
    T, J = arm.output("tool_transform", q=q), arm.output("tool_jacobian", q=q)
    in_world = np.concatenate([T[:3, :3] @ wrench[:3], T[:3, :3] @ wrench[3:]])
    assert close(arm.output("wrench_torque", q=q, wrench=wrench) @ qd, in_world @ (J @ qd), 1e-9)


@given(st.randoms(use_true_random=False), st.integers(0, 1000))
def test_any_chain_equals_the_textbook_recursion(draw: Random, seed: int) -> None:
    check_core(subject(random_robot(draw), seed, CORE), seed)


@settings(max_examples=8)
@given(st.randoms(use_true_random=False), st.integers(0, 1000))
def test_any_lengths_of_the_reports_structure_equal_the_textbook_recursion(draw: Random, seed: int) -> None:
    arm = subject(random_anthropomorphic(draw), seed, CORE)
    assert len(arm.model.base_parameters) == 58
    check_core(arm, seed)
