"""Elastic drive trains: the reduced structure against the chain with a joint for each spring, and their energy.

The 12-joint chain of report Table 5 is simulated as an ordinary robot by the reference, which knows nothing of springs:
each gets its torque -k q_e from outside.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations
from random import Random

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from sympy import Integer, pi

from generator.reference.matter import INERTIAL
from generator.reference.quantities import Reference
from generator.resources import find_robot, robots
from generator.robot.description import FIXED, REVOLUTE, EffectUse, Robot
from generator.robot.readers import read
from generator.units import Quantity
from tests.chains import ElasticChain, elastic_chain, joint, random_robot, robot
from tests.conftest import FURTHER
from tests.subject import Subject, Vector, close, slope, subject

QUANTITIES = (
    "flexible_inverse_dynamics",
    "flexible_direct_dynamics",
    "flexible_regressor",
    "kinetic_energy",
    "potential_energy",
    "inertia_matrix",
)
SEEDS = (21, 22)
MOTOR_SIDE = {"Iam": "Ia", "Fvm": "Fv", "Fcm": "Fc", "Offm": "Off"}

ELASTIC = [
    pytest.param(path.stem, marks=pytest.mark.long) if path.stem in FURTHER else path.stem
    for path in robots()
    if read(path).flexible
]


@pytest.fixture(scope="module", params=ELASTIC)
def elastic(request: pytest.FixtureRequest) -> Subject:
    """Each robot file with elastic joints."""
    return subject(read(find_robot(request.param)), names=QUANTITIES)


# -- Table 5 ----------------------------------------------------------------------------------------------------------


def chain_of(robot: Robot) -> ElasticChain:
    """The robot with a joint per spring, and motors whose inertia and friction are those joints' own."""
    chain = elastic_chain(robot)
    motors = tuple(chain.motor[number] for number in robot.flexible)
    uses = tuple(EffectUse(e, motors) for e in ("rotor_inertia", "viscous_friction", "coulomb_friction", "offset"))
    return elastic_chain(robot, uses)


def chain_values(arm: Subject, chain: ElasticChain) -> dict[str, float]:
    """Standard parameters of the chain: motors without bodies, springs without inertia of their own."""
    values = {}
    for number in (body.number for body in arm.robot.bodies):
        values |= {f"{stem}{chain.link[number]}": arm.values[f"{stem}{number}"] for stem in INERTIAL}
    for number in arm.robot.flexible:
        for ours, theirs in MOTOR_SIDE.items():
            values[f"{theirs}{chain.motor[number]}"] = arm.values[f"{ours}{number}"]
    return values | {length.name: arm.values[length.name] for length in arm.robot.lengths if length.symbolic}


def order(arm: Subject, chain: ElasticChain) -> list[int]:
    """Place in the chain's q of each entry of [q_m; q_e]."""
    numbers = chain.robot.numbers
    motors = [chain.motor[joint.number] for joint in arm.robot.moving]
    springs = [chain.spring[number] for number in arm.robot.flexible]
    return [numbers.index(number) for number in motors + springs]


def unstacked(stacked: Vector, places: list[int]) -> Vector:
    """[q_m; q_e] in the order of the chain's joints."""
    result = np.empty(len(places))
    result[places] = stacked
    return result


def links_alone(arm: Subject) -> Subject:
    """No friction, rotor or balancer on the link side: the chain has no joint whose variable is q_m + q_e."""
    return arm.only(*INERTIAL, *MOTOR_SIDE, "k")


def check_against_chain(arm: Subject, seed: int) -> None:
    """Inverse and direct models of the reduced structure and of the chain."""
    arm = links_alone(arm)
    chain = chain_of(arm.robot)
    values, places = chain_values(arm, chain), order(arm, chain)
    inputs = arm.inputs(arm.model.functions["flexible_inverse_dynamics"], seed)
    n = arm.dof
    springs = -np.array([arm.values[f"k{number}"] for number in arm.robot.flexible]) * inputs["q"][n:]
    elastic = list(arm.model.elastic)

    in_chain = {name: unstacked(inputs[name], places) for name in ("q", "qd", "qdd")}
    torques = Reference(chain.robot, values)("inverse_dynamics", in_chain)["tau"][places]
    seen = arm.generated("flexible_inverse_dynamics", inputs)
    assert close(seen["tau_e"], torques[n:])
    # The chain's motors feel the links' torque, which on a real motion is the spring's.
    motors = torques[:n].copy()
    motors[elastic] += springs - torques[n:]
    assert close(seen["tau_mdi"], motors)

    tau = arm.inputs(arm.model.functions["flexible_direct_dynamics"], seed)["tau"]
    driven = {"q": in_chain["q"], "qd": in_chain["qd"], "tau": unstacked(np.concatenate([tau, springs]), places)}
    expected = Reference(chain.robot, values)("direct_dynamics", driven)["qdd"][places]
    qdd = arm.output("flexible_direct_dynamics", q=inputs["q"], qd=inputs["qd"], tau=tau)
    M = Reference(chain.robot, values)("inertia_matrix", {"q": in_chain["q"]})["M"]
    assert close(qdd, expected, 1e-12 * max(100.0, np.linalg.cond(M)))


@pytest.mark.parametrize("seed", SEEDS)
def test_reduced_structure_is_the_chain_with_a_joint_per_spring(elastic: Subject, seed: int) -> None:
    check_against_chain(elastic, seed)


@pytest.mark.parametrize("count", [3, *(pytest.param(count, marks=pytest.mark.long) for count in (1, 2, 4, 5))])
def test_any_subset_of_axes_may_be_elastic(count: int) -> None:
    robot = read(find_robot("kr500"))
    subsets = list(combinations(range(1, 7), count))
    for flexible in Random(count).sample(subsets, 1):
        check_against_chain(subject(replace(robot, flexible=flexible), names=QUANTITIES), 23)


@given(st.randoms(use_true_random=False))
def test_any_chain_may_be_elastic(draw: Random) -> None:
    robot = random_robot(draw, 3)
    flexible = [j.number for j in robot.moving if draw.random() < 0.6] or [robot.moving[0].number]
    check_against_chain(subject(replace(robot, flexible=tuple(flexible)), names=QUANTITIES), 24)


def test_a_prismatic_joint_may_be_elastic() -> None:
    scara = read(find_robot("scara"))
    sliding = next(one.number for one in scara.moving if one.sigma == 1)
    for flexible in ((sliding,), (1, sliding), tuple(one.number for one in scara.moving)):
        check_against_chain(subject(replace(scara, flexible=flexible), names=QUANTITIES), 25)


# -- the equations ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("seed", SEEDS)
def test_inverse_after_direct_gives_torques_and_springs_back(elastic: Subject, seed: int) -> None:
    inputs = elastic.inputs(elastic.model.functions["flexible_direct_dynamics"], seed)
    qdd = elastic.output("flexible_direct_dynamics", **inputs)
    state = {"q": inputs["q"], "qd": inputs["qd"], "qdd": qdd}
    back = elastic.generated("flexible_inverse_dynamics", state)
    stiffness = np.array([elastic.values[f"k{number}"] for number in elastic.robot.flexible])
    assert close(back["tau_mdi"], inputs["tau"], 1e-9)
    assert close(back["tau_e"], -stiffness * inputs["q"][elastic.dof :], 1e-9)


@pytest.mark.parametrize("seed", SEEDS)
def test_regressor_is_linear_in_link_and_motor_parameters(elastic: Subject, seed: int) -> None:
    inputs = elastic.inputs(elastic.model.functions["flexible_regressor"], seed)
    W = elastic.output("flexible_regressor", **inputs)
    torques = elastic.generated("flexible_inverse_dynamics", inputs)
    stiffness = np.array([elastic.values[f"k{number}"] for number in elastic.robot.flexible])
    balance = torques["tau_e"] + stiffness * inputs["q"][elastic.dof :]
    assert close(W @ elastic.parameters[: W.shape[1]], np.concatenate([torques["tau_mdi"], balance]))


@pytest.mark.parametrize("seed", SEEDS)
def test_power_becomes_energy_and_loss(elastic: Subject, seed: int) -> None:
    quiet = elastic.without("Fv", "Fc", "Off")
    n, at = quiet.dof, list(quiet.model.elastic)
    inputs = quiet.inputs(quiet.model.functions["flexible_direct_dynamics"], seed)
    q, qd, tau = inputs["q"], inputs["qd"], inputs["tau"]
    qdd = quiet.output("flexible_direct_dynamics", **inputs)

    def of_motors(stem: str) -> Vector:
        return np.array([quiet.values[f"{stem}{number}"] for number in quiet.robot.flexible])

    def energy(t: float) -> Vector:
        position, speed = q + qd * t + qdd * t * t / 2, qd + qdd * t
        link_q, link_qd = position[:n].copy(), speed[:n].copy()
        link_q[at] += position[n:]
        link_qd[at] += speed[n:]
        of_links = quiet.output("kinetic_energy", q=link_q, qd=link_qd) + quiet.output("potential_energy", q=link_q)
        return of_links + 0.5 * (of_motors("Iam") @ speed[at] ** 2 + of_motors("k") @ position[n:] ** 2)

    speed = qd[at]
    loss = (of_motors("Fvm") * speed + of_motors("Fcm") * np.sign(speed) + of_motors("Offm")) @ speed
    scale = np.abs(tau) @ np.abs(qd[:n]) + of_motors("k") @ np.abs(q[n:] * qd[n:])
    # The step resolves the fastest oscillation of light motors on stiff springs.
    assert abs(slope(energy, 1e-5) - (tau @ qd[:n] - loss)) <= 1e-6 * scale


def test_the_balancer_acts_on_the_link_side() -> None:
    arm = subject(read(find_robot("kr500")), names=QUANTITIES).only("F0")
    q = np.array([0.1, -1.0, 0.2, 0.3, 0.4, 0.5, 0.01, 0.3, 0.01, 0.02, 0.03, 0.04])
    seen = arm.generated("flexible_inverse_dynamics", {"q": q, "qd": 0 * q, "qdd": 0 * q})
    pull = Reference(arm.robot, arm.values)("balancer", {"q": q[:6] + q[6:]})["torque"]
    assert close(seen["tau_e"], [0, pull, 0, 0, 0, 0])
    assert not seen["tau_mdi"].any()


def test_the_link_side_has_its_own_friction_offset_and_inertia() -> None:
    arm = subject(read(find_robot("kr270")), names=QUANTITIES).only("Ia", "Fv", "Fc", "Off")
    inputs = arm.inputs(arm.model.functions["flexible_inverse_dynamics"], 26)
    seen = arm.generated("flexible_inverse_dynamics", inputs)
    qd, qdd = (inputs[name][:6] + inputs[name][6:] for name in ("qd", "qdd"))
    Ia, Fv, Fc, Off = (np.array([arm.values[f"{s}{j}"] for j in range(1, 7)]) for s in ("Ia", "Fv", "Fc", "Off"))
    assert close(seen["tau_e"], Ia * qdd + Fv * qd + Fc * np.sign(qd) + Off)
    assert not seen["tau_mdi"].any()


def test_stiff_springs_leave_the_rigid_robot() -> None:
    # Motors that hold still against springs at rest: the elongation is the load over the stiffness.
    arm = subject(read(find_robot("kr500")), names=(*QUANTITIES, "gravity")).only(*INERTIAL, "k")
    stiffness = np.array([arm.values[f"k{number}"] for number in arm.robot.flexible]) * 1e6
    stiff = arm.with_values(arm.values | {f"k{j}": k for j, k in zip(arm.robot.flexible, stiffness, strict=True)})
    qm = np.array([0.3, -1.0, 0.5, 0.2, -0.4, 0.6])
    load = stiff.output("gravity", q=qm)
    q = np.concatenate([qm, -load / stiffness])
    seen = stiff.generated("flexible_inverse_dynamics", {"q": q, "qd": 0 * q, "qdd": 0 * q})
    assert close(seen["tau_mdi"], load, 1e-12)
    assert close(seen["tau_e"], load, 1e-6)


def test_behind_a_spring_no_rotor_loads_the_transmission() -> None:
    """The spring carries 2 kg m2 at 3 rad/s2, and half as much again against the friction, whatever the rotor is."""
    joints = (joint(1, REVOLUTE, pi / 2), joint(2, FIXED, tool=True))
    rubbing = EffectUse("load_friction", (1,), {"rotor": Quantity(Integer(8), "kg m2")})
    made = robot("link", joints, gravity=(Integer(0),) * 3, effects=(rubbing,), flexible=(1,))
    of = subject(made, names=QUANTITIES).with_values({"ZZ1": 2.0, "Fl1": 0.5, "Iam1": 8.0, "k1": 1e5})
    state = {"q": np.array([0.0, -9e-5]), "qd": np.array([1.0, 0.0])}
    found = of.generated("flexible_inverse_dynamics", {**state, "qdd": np.array([3.0, 0.0])})
    assert found["tau_e"] == pytest.approx(9)
    qdd = of.output("flexible_direct_dynamics", **state, tau=np.zeros(1))
    assert qdd.sum() == pytest.approx(3)
