"""Friction that is simulated: directions and stand-ins for sign(speed), sticking and sliding with located events."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from sympy import Integer, pi

from generator.backends.printing.runge_kutta import METHODS
from generator.robot.description import FIXED, REVOLUTE
from tests.chains import joint, on_all_joints, robot
from tests.simulated import PLANTS, QUANTITIES, Make, Vector, arm, positions, state_of
from tests.subject import Subject, close, subject

NAMES = [method.name.upper() for method in METHODS]


# -- quantities -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("name", "plant"), PLANTS)
def test_signs_as_directions_are_the_model_itself(name: str, plant: str) -> None:
    of, prefix = arm(name), "" if plant == "rigid" else "flexible_"
    q, _ = state_of(of, plant)
    qd = np.random.default_rng(4).uniform(-2, 2, len(q))
    n, state = of.dof, {"q": q, "qd": qd, "tau": 50 * np.cos(np.arange(of.dof))}
    expected = of.expected(f"{prefix}direct_dynamics", state)["qdd"]
    if plant == "flexible":
        state["tau_ext"] = np.zeros(n)
    speeds = np.concatenate([qd[:n], qd[list(of.model.elastic)] + qd[n:]]) if plant == "flexible" else qd
    sliding = of.output(f"{prefix}direct_dynamics_sliding", **state, direction=np.sign(speeds))
    assert close(sliding, expected, 1e-8)
    smooth = of.output(f"{prefix}direct_dynamics_smooth", **state, width=np.full(len(q), 1e-9))
    assert close(smooth, expected, 1e-8)
    wide = of.output(f"{prefix}direct_dynamics_smooth", **state, width=np.full(len(q), 1e9))
    without = of.without("Fc", "Fcm").output(f"{prefix}direct_dynamics_sliding", **state, direction=np.sign(speeds))
    assert close(wide, without, 1e-6)


# -- sign friction ----------------------------------------------------------------------------------------------------


def wheel(*effects: str, **values: float) -> Subject:
    """One joint without weight; parameters by stem."""
    joints = [joint(1, REVOLUTE), joint(2, FIXED, tool=True)]
    weightless = (Integer(0), Integer(0), Integer(0))
    used = on_all_joints(joints, "rotor_inertia", "coulomb_friction", *effects)
    flexible = (1,) if "k" in values else ()
    of = subject(robot("wheel", joints, gravity=weightless, effects=used, flexible=flexible), names=QUANTITIES)
    return of.with_values({f"{stem}1": value for stem, value in values.items()})


@pytest.mark.parametrize("method", NAMES)
def test_a_wheel_slows_down_and_sticks(method: str, make: Make) -> None:
    simulated = make(wheel(Ia=2.0, Fc=3.0))
    speed, deceleration = 0.7, 1.5
    state, how = simulated.start([0.1], [speed]), simulated.integration(method, 3)
    for k in range(1, 60):
        simulated.advance(state, how, 0.01, [0.0])
        t = min(0.01 * k, speed / deceleration)
        assert state.q[0] == pytest.approx(0.1 + speed * t - deceleration * t * t / 2, abs=1e-13)
    assert state.qd[0] == 0.0
    assert state.contact[0] == simulated.constant("CONTACT_STUCK")


def test_what_friction_can_hold_stays_at_rest(make: Make) -> None:
    simulated = make(wheel(Ia=2.0, Fc=3.0))
    state, how = simulated.start([0.0], [0.0]), simulated.integration("RK4", 2)
    for tau in (1.0, -2.9, 3.0):
        simulated.advance(state, how, 0.1, [tau])
        assert (state.q[0], state.qd[0]) == (0.0, 0.0)
        assert state.direction[0] == pytest.approx(tau / 3.0)
    simulated.advance(state, how, 0.1, [-5.0])
    assert state.qd[0] == pytest.approx(-0.1, abs=1e-13)
    assert state.direction[0] == -1.0
    simulated.advance(state, how, 0.2, [5.0])  # to rest after 0.025 s, then the other way
    assert state.qd[0] == pytest.approx(0.175, abs=1e-9)
    assert state.direction[0] == 1.0


@pytest.mark.parametrize("method", NAMES)
def test_a_dry_oscillator_loses_the_same_amplitude_each_half_swing(method: str, make: Make) -> None:
    inertia, stiffness, friction, amplitude = 2.0, 200.0, 5.0, 0.33
    simulated = make(wheel("joint_spring", Ia=inertia, ks=stiffness, Fc=friction))
    state, how = simulated.start([amplitude], [0.0]), simulated.integration(method, 10)
    omega, shift = np.sqrt(stiffness / inertia), friction / stiffness

    def exact(t: float) -> float:
        half = np.pi / omega
        swing, start = 0, amplitude
        while abs(start) > shift and t > half:
            start, t, swing = -(start - np.sign(start) * 2 * shift), t - half, swing + 1
        if abs(start) <= shift:
            return start
        middle = np.sign(start) * shift
        return float(middle + (start - middle) * np.cos(omega * t))

    for k in range(1, 301):
        simulated.advance(state, how, 0.01, [0.0])
        assert state.q[0] == pytest.approx(exact(0.01 * k), abs=1e-6 if method == "RK4" else 1e-10)
    assert state.contact[0] == simulated.constant("CONTACT_STUCK")
    assert abs(state.q[0]) < shift


def test_a_link_lets_go_when_its_spring_overcomes_the_friction(make: Make) -> None:
    motor, stiffness, friction, drive, link = 1.5, 400.0, 6.0, 5.0, 0.8
    simulated = make(wheel(Ia=link, Fc=friction, Iam=motor, k=stiffness), "flexible")
    free, stuck, sliding = (simulated.constant(f"CONTACT_{name}") for name in ("FREE", "STUCK", "SLIDING"))
    state, how = simulated.start([0.0, 0.0], [0.0, 0.0]), simulated.integration("DP8", 1)
    assert list(state.contact) == [free, stuck]
    omega = np.sqrt(stiffness / motor)
    release = np.arccos(1 - friction / drive) / omega
    times = np.arange(1, 40) * 4e-3
    assert 0.02 < release < 0.15

    def rate(_: float, x: Vector) -> Vector:
        pull = stiffness * (x[0] - x[1])
        return np.array([x[2], x[3], (drive - pull) / motor, (pull - friction) / link])

    start = [
        drive / stiffness * (1 - np.cos(omega * release)),
        0,
        drive / stiffness * omega * np.sin(omega * release),
        0,
    ]
    later = solve_ivp(rate, (release, times[-1]), start, "DOP853", rtol=1e-12, atol=1e-15, dense_output=True).sol
    for t in times:
        simulated.advance(state, how, 4e-3, [drive])
        moved = later(t)[:2] if t > release else [drive / stiffness * (1 - np.cos(omega * t)), 0]
        assert [state.q[0], state.q[0] + state.q[1]] == pytest.approx(list(moved), abs=1e-9)
        assert state.contact[1] == (sliding if t > release else stuck)


@pytest.mark.parametrize(("name", "plant"), PLANTS)
def test_narrow_smooth_friction_comes_near_to_sign_friction(name: str, plant: str, make: Make) -> None:
    of = arm(name)
    simulated = make(of, plant)
    q, qd = state_of(of, plant)
    tau = np.zeros(of.dof)
    located = simulated.advance(simulated.start(q, qd), simulated.integration("RK4", 400), 0.2, tau)
    apart = []
    for width in (1e-2, 1e-3):
        smooth = simulated.advance(simulated.start(q, qd), simulated.integration("RK4", 8000, width), 0.2, tau)
        apart.append(np.abs(positions(smooth) - positions(located)).max())
    assert apart[1] < 0.35 * apart[0]
    assert apart[1] < 1e-3


def test_stuck_surfaces_hold_the_rest_of_the_robot_in_balance(make: Make) -> None:
    of = arm("tree_two_arms")
    heavy = of.with_values({name: (1e5 if name.startswith("Fc") else value) for name, value in of.values.items()})
    simulated = make(heavy)
    q, _ = state_of(heavy, "rigid")
    state = simulated.start(q, np.zeros(of.dof))
    simulated.advance(state, simulated.integration("RK4", 1), 1e-3, np.zeros(of.dof))
    held = heavy.expected("bias", {"q": q, "qd": np.zeros(of.dof)})["H"]
    assert positions(state) == pytest.approx(q, abs=0)
    assert 1e5 * np.array(list(state.direction)) == pytest.approx(-held, abs=1e-6 * np.abs(held).max())


# -- friction by load -------------------------------------------------------------------------------------------------


def pendulum(*effects: str, **values: float) -> Subject:
    """One horizontal axis whose friction goes with the load alone; it lies across gravity at q = 0."""
    joints = [joint(1, REVOLUTE, pi / 2), joint(2, FIXED, tool=True)]
    used = on_all_joints(joints, "rotor_inertia", "load_friction", *effects)
    of = subject(
        robot("pendulum", joints, gravity=(Integer(0), Integer(0), Integer(-10)), effects=used), names=QUANTITIES
    )
    return of.with_values({f"{stem}1": value for stem, value in values.items()})


def test_friction_by_load_holds_what_lies_on_it(make: Make) -> None:
    """A weight of 30 N m: torques from 27 to 33 N m hold it."""
    simulated = make(pendulum(Ia=2.0, MX=3.0, Fl=0.1))
    state, how = simulated.start([0.0], [0.0]), simulated.integration("RK4", 4)
    assert state.contact[0] == simulated.constant("CONTACT_STUCK")
    for tau in (32.0, 27.5, 30.0):
        simulated.advance(state, how, 0.1, [tau])
        assert (state.q[0], state.qd[0]) == (0.0, 0.0)
    simulated.advance(state, how, 1e-3, [35.0])
    assert state.qd[0] == pytest.approx(1e-3 * (35 / 1.1 - 30) / 2, rel=1e-4)


def test_a_drive_that_supplies_nothing_lets_go(make: Make) -> None:
    """At rest without torque the transmission carries nothing: there is no friction to hold the weight."""
    simulated = make(pendulum(Ia=2.0, MX=3.0, Fl=0.1))
    state, how = simulated.start([0.3], [0.0]), simulated.integration("RK4", 10)
    for _ in range(30):
        simulated.advance(state, how, 0.1, [0.0])
        assert state.qd[0] ** 2 == pytest.approx(30 * (np.sin(0.3) - np.sin(state.q[0])), abs=1e-3)
    assert state.contact[0] == simulated.constant("CONTACT_SLIDING")
