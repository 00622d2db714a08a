"""The simulated robot of ``tests/plant``: its bodies and its laws, against Pinocchio, closed forms and conservation."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest

from tests.bodies import PINOCCHIO, pseudo_inertia
from tests.commands import ROOT
from tests.plant.effect import Effect
from tests.plant.library import LAWS, TORQUES
from tests.plant.machine import FREE_FALL, Machine
from tests.plant.robot import BODY, Array, Joint, Robot, bar, fraction
from tests.plant.robots import ROBOTS
from tests.plant.run import Run
from tests.plant.simulate import make_run, own_effects
from tests.plant.trajectory import Trajectory

PLANT = ROOT / "tests" / "plant"

#: Slides or turns without weight, gently driven by what a test puts on it.
WHEEL = Joint(
    dh=(0.0, 0.0, 0.0, 0.0),
    body=(0.0, 0.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 1.0),
    range=(-10.0, 10.0, 5.0, 10.0),
    rotor=3.0,
    viscous=0.0,
    coulomb=20.0,
    stiffness=4e4,
    ratio="100",
    constant=0.5,
    peak=0.0,
)


def crooked() -> Robot:
    """Six joints anyhow, every other one prismatic."""
    rng = np.random.default_rng(7)
    chain = []
    for j in range(6):
        start, end = rng.uniform(-0.5, 0.5, (2, 3))
        body = bar(float(rng.uniform(1, 5)), tuple(start), tuple(end), 0.1)
        alpha, d, theta, r = rng.uniform(-2, 2, 4).tolist()
        chain.append(replace(WHEEL, dh=(alpha, d, theta, r), body=body, prismatic=j % 2 == 1))
    return Robot("crooked", tuple(chain), base=(0.3, -0.5, 0.9))


@pytest.fixture(params=["crooked", *sorted(ROBOTS)])
def robot(request: pytest.FixtureRequest) -> Robot:
    return crooked() if request.param == "crooked" else ROBOTS[request.param]


def imported(path: Path) -> Iterator[str]:
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (name.name for name in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}: a relative import"
            yield node.module or ""
        elif isinstance(node, ast.Call) and getattr(node.func, "attr", getattr(node.func, "id", "")) == "__import__":
            yield "__import__"


def test_it_shares_no_code_with_what_it_tries() -> None:
    allowed = {"tests.plant", "numpy", "__future__"}
    files = sorted(PLANT.rglob("*.py"))
    assert len(files) > 60
    strange = {
        f"{path.relative_to(ROOT)}: {name}"
        for path in files
        for name in imported(path)
        if not any(name == start or name.startswith(f"{start}.") for start in allowed)
        and name not in ("ast", "ctypes", "hashlib", "importlib", "os", "pkgutil", "subprocess", "tempfile", "typing")
        and name not in ("collections.abc", "dataclasses", "functools", "math", "pathlib")
    }
    assert not strange


def test_every_law_says_what_it_is() -> None:
    assert len(LAWS) >= 40
    assert sum(law.outside for law in LAWS.values()) >= 6
    for name, law in LAWS.items():
        text = ast.get_docstring(ast.parse((PLANT / "laws" / f"{name}.py").read_text(encoding="utf-8")))
        assert text, name
        assert law.about, name
        assert law.unit, name
        assert bool(law.torque) + bool(law.change) + bool(law.reading) >= 1, name


# Bodies.


def in_pinocchio(robot: Robot) -> pin.Model:
    """Placements as products of elementary motions, bodies and rotors from the robot's plain numbers."""
    model = pin.Model()
    place = pin.SE3(pin.rpy.rpyToMatrix(*robot.base), np.zeros(3))
    for j, joint in enumerate(robot.chain):
        alpha, d, theta, r = joint.dh
        for axis, angle, shift in (("x", alpha, [d, 0, 0]), ("z", theta, [0, 0, r])):
            place = place * pin.SE3(pin.utils.rotate(axis, angle), np.array(shift, dtype=float))
        kind = pin.JointModelPZ() if joint.prismatic else pin.JointModelRZ()
        model.addJoint(j, kind, place, f"joint {j}")
        numbers = dict(zip(BODY, joint.body, strict=True))
        inertia = pin.Inertia.FromDynamicParameters(np.array([numbers[name] for name in PINOCCHIO], dtype=float))
        model.appendBodyToJoint(j + 1, inertia, pin.SE3.Identity())
        place = pin.SE3.Identity()
    model.gravity.linear = np.array(FREE_FALL)
    model.armature = robot.column("rotor")
    return model


def test_rigid_bodies_against_pinocchio(robot: Robot) -> None:
    model, machine = in_pinocchio(robot), Machine(robot, ())
    data = model.createData()
    q, qd, qdd = np.random.default_rng(1).uniform(-3, 3, (3, 100, robot.joints))
    ours = machine.rigid_torques(q, qd, qdd)
    theirs = np.array([pin.rnea(model, data, *state) for state in zip(q, qd, qdd, strict=True)])
    np.testing.assert_allclose(ours, theirs, rtol=0, atol=1e-9 * np.max(np.abs(theirs)))
    rest = pin.computePotentialEnergy(model, data, np.zeros(robot.joints))
    for x in q[:20]:
        M = np.triu(pin.crba(model, data, x))
        M = M + np.triu(M, 1).T
        np.testing.assert_allclose(machine.inertia_matrix(x), M, rtol=0, atol=1e-9 * np.max(M))
        energy = machine.potential_energy(x) - machine.potential_energy(np.zeros(robot.joints))
        theirs_energy = pin.computePotentialEnergy(model, data, x) - rest
        assert energy == pytest.approx(theirs_energy, rel=1e-9, abs=1e-9 * np.max(np.abs(theirs)))


def test_payload_and_lean_against_pinocchio(robot: Robot) -> None:
    payload = Effect("payload", size=3.0)
    machine = Machine(robot, (payload, Effect("base_tilt", size=0.2, values={"towards": 0.0})))
    model = in_pinocchio(robot)
    centre = np.array([payload.value(axis, robot) for axis in "xyz"]) + np.array([0, 0, robot.tool])
    body = pin.Inertia(3.0, centre, 3.0 * payload.value("radius", robot) ** 2 * np.eye(3))
    model.appendBodyToJoint(robot.joints, body, pin.SE3.Identity())
    # A base that leans by 0.2 about x sees the weight lean the other way.
    model.gravity.linear = 9.81 * np.array([0.0, -np.sin(0.2), -np.cos(0.2)])
    q, qd, qdd = np.random.default_rng(2).uniform(-3, 3, (3, 20, robot.joints))
    theirs = np.array([pin.rnea(model, model.createData(), *state) for state in zip(q, qd, qdd, strict=True)])
    np.testing.assert_allclose(machine.rigid_torques(q, qd, qdd), theirs, rtol=0, atol=1e-9 * np.max(np.abs(theirs)))


def test_bodies_can_exist(robot: Robot) -> None:
    for joint in robot.chain:
        assert np.min(np.linalg.eigvalsh(pseudo_inertia(joint.body))) > 0


def resting(q: Array | float, duration: float, speed: Array | float = 0.0) -> Trajectory:
    """A reference that stands still at q, and at its start moves with ``speed``."""

    def motion(robot: Robot, t: Array) -> tuple[Array, Array]:
        still = np.tile(np.broadcast_to(q, robot.joints), (len(t), 1)).astype(float)
        moving = np.zeros_like(still)
        moving[0] = speed
        return still, moving

    return Trajectory(motion, duration, 0.0)


def unpowered(robot: Robot) -> Robot:
    return replace(robot, chain=tuple(replace(joint, peak=0.0) for joint in robot.chain))


def energy_of(run: Run) -> Array:
    """Of bodies, rotors and drive trains (T) [J]."""
    machine, truth = run.machine, run.truth
    links = np.array([machine.inertia_matrix(q) - machine.rotor for q in truth.q])
    kinetic = np.einsum("ti,tij,tj->t", truth.qd, links, truth.qd)
    kinetic += np.einsum("ti,ij,tj->t", truth.thd, machine.rotor, truth.thd)
    twist = np.sum(machine.stiffness * (truth.th - truth.q) ** 2, axis=1)
    return np.asarray(0.5 * (kinetic + twist) + [machine.potential_energy(q) for q in truth.q])


@pytest.mark.parametrize("elastic", [False, True])
@pytest.mark.parametrize("name", ["three_axis", "small_wrist", "scara_like"])
def test_energy_is_conserved_without_friction(name: str, elastic: bool) -> None:
    robot = unpowered(ROBOTS[name])
    effects = [Effect("joint_flexibility", j, values={"damping_ratio": 0.0}) for j in (1, 2)] if elastic else []
    run = make_run(robot, resting(robot.centre, 2.0, 0.5), effects, own=())
    energy = energy_of(run)
    swing = np.ptp([run.machine.potential_energy(q) for q in run.truth.q])
    assert np.max(np.abs(energy - energy[0])) < 2e-4 * max(swing, energy[0] - np.min(energy) + 1.0)
    assert np.max(np.abs(run.truth.qd)) > 0.3


def test_elastic_drive_trains_sing_at_their_eigenfrequencies() -> None:
    robot = replace(unpowered(ROBOTS["scara_like"]), home=(0.0, 0.8, 0.1, 0.0))
    soft = [Effect("joint_flexibility", j, values={"damping_ratio": 0.0}) for j in (1, 2)]
    blow = Effect("collision", 2, 0.05, {"start": 0.1, "last": 0.004})
    run = make_run(robot, resting(robot.centre, 4.0), [*soft, blow], own=())
    n = robot.joints
    M = run.machine.inertia_matrix(robot.centre) - run.machine.rotor
    A, K = np.zeros((2, n + 2, n + 2))
    A[:n, :n] = M
    for k, j in ((n, 0), (n + 1, 1)):
        A[k, k] = robot.chain[j].rotor
        K[j, j], K[k, k], K[j, k], K[k, j] = (sign * robot.chain[j].stiffness for sign in (1, 1, -1, -1))
    A[2, 2] += robot.chain[2].rotor
    A[3, 3] += robot.chain[3].rotor
    expected = np.sqrt(np.sort(np.linalg.eigvals(np.linalg.solve(A, K)).real)[-2:]) / (2 * np.pi)
    assert run.machine.fastest(robot.centre) == pytest.approx(2 * np.pi * expected[-1], rel=1e-9)
    twist = (run.truth.th - run.truth.q)[100:, 0]
    lines = np.abs(np.fft.rfft(np.hanning(len(twist)) * twist, 16 * len(twist)))
    f = np.fft.rfftfreq(16 * len(twist), 1 / run.rate)
    for frequency in expected:
        near = np.abs(f - frequency) < 2.0
        assert f[near][np.argmax(lines[near])] == pytest.approx(frequency, rel=1e-3)


# Laws.


def replayed(law: str, q: Array, qd: Array, step: float, robot: Robot | None = None, **values: float) -> Array:
    """Torque (T) of a law of size 1 on the first joint, moved alone."""
    machine = Machine(robot or Robot("wheel", (WHEEL,)), (Effect(law, 1, 1.0, values),))
    still = np.zeros((len(q), machine.robot.joints))
    x, v = still.copy(), still.copy()
    x[:, 0], v[:, 0] = q, qd
    return machine.law_torques(x, v, step)[:, 0]


def test_a_bristle_sticks_like_a_spring_and_slips_at_its_strength() -> None:
    v, step, way = 1e-4, 1e-4, 1e-4
    z = replayed("coulomb", np.zeros(200_000), np.full(200_000, v), step, distance=way)
    x = v * step * (np.arange(200_000) + 0.5)
    np.testing.assert_allclose(z, 1 - np.exp(-x / way), atol=1e-6)
    assert z[-1] == pytest.approx(1.0, abs=1e-6)


def test_stribeck_friction_has_its_steady_curve() -> None:
    for v in (0.002, 0.01, 0.05, -0.02):
        z = replayed("stribeck", np.zeros(3000), np.full(3000, v), 1e-3, speed=0.03, distance=1e-5)
        assert z[-1] == pytest.approx(np.sign(v) * np.exp(-((v / 0.03) ** 2)), rel=1e-9)


@pytest.mark.parametrize(
    ("law", "closed_form"),
    [
        ("viscous", lambda q, v: v),
        ("asymmetric_viscous", lambda q, v: abs(v)),
        ("quadratic_viscous", lambda q, v: v * abs(v)),
        ("concave_viscous", lambda q, v: v / (1 + abs(v))),
        ("cable_spring", lambda q, v: q + 0.1 * q**3),
        ("gradual_rise", lambda q, v: 2 / np.pi * np.arctan(v / 0.15) - np.sign(v)),
        ("position_friction", lambda q, v: np.sign(v) * (np.cos(q - 0.7) + 0.35 * np.cos(2 * q + 1))),
        ("position_bump", lambda q, v: np.exp(-(((q - 0.1) / 0.08) ** 2))),
        ("asymmetric_coulomb", lambda q, v: max(np.sign(v), 0.0)),
    ],
)  # fmt: skip
def test_laws_without_memory(law: str, closed_form) -> None:  # type: ignore[no-untyped-def]
    for q, v in ((0.3, 0.7), (-0.2, -1.1), (0.05, 2.0)):
        found = replayed(law, np.full(2000, q), np.full(2000, v), 1e-3)[-1]
        assert found == pytest.approx(closed_form(q, v), rel=1e-9, abs=1e-12)


@pytest.mark.parametrize(
    ("law", "force"),
    [
        ("spring_balancer", lambda r, r0: r - 0.2),
        ("gas_isotherm", lambda r, r0: 0.5 / (0.5 - r + r0)),
        ("gas_polytrope", lambda r, r0: (0.5 / (0.5 - r + r0)) ** 1.3),
    ],
)
def test_balancers_do_the_work_of_their_force(law: str, force) -> None:  # type: ignore[no-untyped-def]
    def length(q: Array) -> Array:
        return np.asarray(np.sqrt(0.7**2 + 0.18**2 + 2 * 0.7 * 0.18 * np.cos(q - 1.6)))

    q = np.linspace(-2.5, 2.5, 11)
    slope = (length(q + 1e-6) - length(q - 1e-6)) / 2e-6
    expected = force(length(q), length(np.zeros(1))) * slope
    np.testing.assert_allclose(replayed(law, q, np.zeros(11), 1.0), expected, atol=1e-8)


@pytest.mark.parametrize("law", ["presliding_lugre", "presliding_dahl", "hysteresis", "hysteresis_play"])
def test_laws_with_memory_go_round(law: str) -> None:
    t = np.arange(40_000) * 1e-3
    q, v = 0.3 * np.sin(t), 0.3 * np.cos(t)
    torque = replayed(law, q, v, 1e-3)
    way_round = slice(-6283, None)
    work = np.sum((torque * v)[way_round]) * 1e-3
    # Presliding loses less than the Coulomb friction that it replaces; hysteresis loses by itself.
    presliding = law.startswith("presliding")
    assert (work < 0) == presliding
    # After a reversal presliding still pushes the old way where the friction that it replaces pushes the new one.
    assert np.max(np.abs(torque[way_round])) == pytest.approx(2.0 if presliding else 1.0, rel=0.05)
    # The same way at half the speed; the bristles of LuGre alone are weaker at speed.
    slow = replayed(law, q, 0.5 * v, 2e-3)
    if law == "presliding_lugre":
        assert np.max(np.abs(slow - torque)) > 0.05
    else:
        np.testing.assert_allclose(slow, torque, rtol=0, atol=1e-12)


def test_dry_friction_holds_and_lets_go() -> None:
    wheel = Robot("wheel", (WHEEL,))
    for push, moves in ((0.4, False), (1.2, True)):
        damping = Effect("viscous", 1, 0.0 if moves else 2000.0)
        effects = [Effect("coulomb", 1, 20.0), Effect("offset", 1, -push * 20.0), damping]
        run = make_run(wheel, resting(0.0, 1.0), effects, own=())
        way = Effect("coulomb").value("distance", wheel)
        if moves:
            assert run.truth.qd[-1, 0] == pytest.approx(0.2 * 20.0 / 5.0 * run.t[-1], rel=2e-2)
        else:
            assert np.max(np.abs(run.truth.q)) < 3 * way


@pytest.mark.parametrize("name", sorted(ROBOTS))
def test_a_gear_transmits_what_is_behind_it(name: str) -> None:
    robot = ROBOTS[name]
    run = make_run(robot, resting(robot.centre, 0.5))
    expected = Machine(robot, own_effects(robot)).rigid_torques(*(run.truth.q, run.truth.qd, run.truth.qdd))
    expected -= run.truth.qdd @ run.machine.rotor
    for k, effect in enumerate(run.machine.torques):
        if effect.what.of_links:
            expected += np.outer(run.truth.torque[:, k], effect.along(robot))
    np.testing.assert_allclose(run.truth.load[1:], expected[1:], atol=2e-3 * np.max(np.abs(expected)) + 1e-3)


def test_all_torques_are_known_to_c() -> None:
    assert sorted(TORQUES) == list(TORQUES)
    assert fraction("-858/3") == -286.0
    with pytest.raises(ValueError, match="no law"):
        Effect("magic")
    with pytest.raises(ValueError, match="has no colour"):
        Effect("offset", values={"colour": 1.0})
