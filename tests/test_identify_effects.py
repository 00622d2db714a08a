"""Identification of robots whose effects read the load, remember, or drift with the warmth."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from generator.derivation import derive
from generator.resources import find_robot
from generator.robot.description import Robot
from generator.robot.readers import read
from generator.symbolic.parameter_sets import resolved_sets
from identification.effect_states import beginning, integrated
from identification.inverse_model import identify
from identification.observation import Motion, Regressors
from tests.recorded import as_recorded

Array = NDArray[np.float64]

RATE, SECONDS = 250.0, 16.0
#: Effects that are added to kr500: their lines in the robot file, and true values.
EFFECTS: dict[str, tuple[str, dict[str, float]]] = {
    "dahl_friction": ("{effect: dahl_friction, joints: [2], values: {xs: 2 mrad}}", {"Fd2": 900.0}),
    "lugre_friction": (
        "{effect: lugre_friction, joints: [3], values: {xs: 20 mrad, excess: 0.4, vs: 0.1 rad/s}}",
        {"Fz3": 700.0, "Dz3": 300.0},
    ),
    "hysteresis": ("{effect: hysteresis, joints: [1], values: {xs: 5 mrad, exponent: 2}}", {"Fh1": 800.0}),
    "load_friction": ("{effect: load_friction, joints: [2, 3]}", {"Fl2": 0.05, "Fl3": 0.08}),
    "warm_friction": ("{effect: warm_friction, joints: [2]}", {"Fvw2": -2000.0, "Fcw2": -300.0}),
}


def rates_of(effect: str) -> object:
    """Rates as ``integrated`` takes them, for one joint, by the laws' equations."""
    if effect == "dahl":
        return lambda q, qd, z: (qd - np.abs(qd) * z) / 2e-3
    if effect == "lugre":
        return lambda q, qd, z: (qd - np.abs(qd) * z / (1 + 0.4 * np.exp(-((qd / 0.1) ** 2)))) / 2e-2
    exponent, xs = (0.6, 1e-2) if effect == "soft hysteresis" else (2, 5e-3)
    return lambda q, qd, z: (qd - np.abs(z) ** exponent * (qd + np.abs(qd) * np.sign(z)) / 2) / xs


@pytest.mark.parametrize("effect", ["dahl", "lugre", "hysteresis", "soft hysteresis"])
def test_states_are_those_of_an_implicit_integration(effect: str) -> None:
    """Against Radau's method with small tolerances, in a motion with slow reversals."""
    period, rates = 2e-3, rates_of(effect)
    t = np.arange(0, 6, period)

    def speed(at: Array) -> Array:
        return 0.3 * np.sin(2 * np.pi * at / 3) * (1 - np.exp(-at))

    def rate(at: float, z: Array) -> Array:
        return np.asarray(rates(None, np.array([[speed(np.array(at))]]), z[None]))[0]  # type: ignore[operator]

    expected = solve_ivp(rate, (0, t[-1]), [0.0], "Radau", t, rtol=1e-8, atol=1e-10, max_step=0.01).y[0]
    found = integrated(rates, np.zeros((1, len(t))), speed(t)[None], period, np.zeros(1))[0]  # type: ignore[arg-type]
    assert np.sqrt(np.mean((found - expected) ** 2)) < 2e-3
    assert np.abs(found - expected).max() < 0.03


def test_a_record_begins_as_the_joint_moved_before() -> None:
    """Of one that stands nobody knows how it came to rest; what noise its speed has tells nothing."""
    speed = np.sin(np.linspace(0, 20, 20000))
    noise = 1e-3 * np.random.default_rng(1).normal(size=20000)
    starts = beginning(np.stack([np.cos(speed), -np.cos(speed), speed + noise, np.zeros(20000)]))
    np.testing.assert_array_equal(starts, [1, -1, 0, 0])


def test_bristles_bend_as_the_way_goes() -> None:
    """At constant speed Dahl's state is 1 - exp(-way/xs), however long a step is."""
    speed = np.full((1, 2001), 0.05)
    z = integrated(rates_of("dahl"), speed, speed, 1e-2, np.zeros(1))[0]  # type: ignore[arg-type]
    np.testing.assert_allclose(z, 1 - np.exp(-0.05 * 1e-2 * np.arange(2001) / 2e-3), atol=1e-6)


def with_effects(names: tuple[str, ...], folder: Path, more: str = "") -> Path:
    text = find_robot("kr500").read_text()
    lines = "".join(f"  - {EFFECTS[name][0]}\n" for name in names)
    path = folder / "kr500.yaml"
    path.write_text(text.replace("  - effect: gas_balancer", f"{lines}  - effect: gas_balancer") + more)
    return path


def waves(robot: Robot, seed: int, seconds: float = SECONDS) -> Motion:
    """Sums of five sines per joint, analytically differentiated."""
    rng = np.random.default_rng(seed)
    t = np.arange(0, seconds, 1 / RATE)
    w = 2 * np.pi * np.arange(1, 6) / 8.0
    q, qd, qdd = (np.zeros((len(robot.moving), len(t))) for _ in range(3))
    for k, joint in enumerate(robot.moving):
        assert joint.lower is not None
        assert joint.upper is not None
        low, high = float(joint.lower), float(joint.upper)
        a, phase = rng.normal(size=5) / np.arange(1, 6), rng.uniform(0, 2 * np.pi, 5)
        arguments = w[:, None] * t + phase[:, None]
        size = 0.35 * min(high - low, 3.0) / np.abs(a @ np.sin(arguments)).max()
        q[k] = (low + high) / 2 + size * a @ np.sin(arguments)
        qd[k] = size * (a * w) @ np.cos(arguments)
        qdd[k] = -size * (a * w**2) @ np.sin(arguments)
    return Motion(q, qd, qdd)


@cache
def derived(path: Path) -> tuple[Robot, Regressors]:
    robot = read(path)
    return robot, Regressors(robot)


def run_of(
    path: Path, out: Path, seed: int, truth: Mapping[str, float], warm: float | None = None, noise: float = 1.0
) -> Path:
    """A run of the robot with the values ``truth``: states by implicit steps far below a sample."""
    robot, regressors = derived(path)
    motion = waves(robot, seed)
    t = np.arange(motion.samples) / RATE
    if warm is not None:
        motion = Motion(motion.q, motion.qd, motion.qdd, None, np.tile(1 - np.exp(-t / warm), (6, 1)))
    tau = regressors.torques(truth, _remembering(path.read_text(), motion))
    tau = tau + noise * np.random.default_rng(seed).normal(size=tau.shape) * np.abs(tau).max(axis=1)[:, None] * 1e-3
    return as_recorded(regressors, t, motion.q, tau).save(out)


def _remembering(text: str, motion: Motion) -> Motion:
    """The motion with its states, joint by joint as the generated order has them, by backward Euler in 20 steps."""
    kinds = [("dahl_friction", 2, "dahl"), ("hysteresis", 1, "hysteresis"), ("lugre_friction", 3, "lugre")]
    used = sorted((joint, law) for name, joint, law in kinds if f"effect: {name}" in text)
    if not used:
        return motion
    rows = []
    for joint, law in used:
        z, row = 0.0, []
        fine = np.interp(np.arange(motion.samples * 20) / 20, np.arange(motion.samples), motion.qd[joint - 1])
        for k, v in enumerate(fine.tolist()):
            if k % 20 == 0:
                row.append(z)
            z = _backward(law, v, z, 1 / RATE / 20)
        rows.append(row)
    return Motion(motion.q, motion.qd, motion.qdd, np.array(rows), motion.warmth)


def _backward(law: str, v: float, before: float, h: float) -> float:
    """z = before + h f(z); by Newton's method where that is not linear."""
    speed = abs(v)
    if law == "dahl":
        return (before + h * v / 2e-3) / (1 + h * speed / 2e-3)
    if law == "lugre":
        top = 1 + 0.4 * np.exp(-((v / 0.1) ** 2))
        return (before + h * v / 2e-2) / (1 + h * speed / 2e-2 / top)
    z = before
    for _ in range(4):
        up = v if v * z > 0 else 0.0
        z -= (z - before - h * (v - z * z * up) / 5e-3) / (1 + h * 2 * z * up / 5e-3)
    return z


@pytest.fixture(scope="module")
def prior() -> dict[str, float]:
    return resolved_sets(derive(read(find_robot("kr500")), names=(), check=False))["report_table_13"]


@pytest.mark.parametrize(
    "effects", [("dahl_friction", "hysteresis", "lugre_friction"), ("load_friction", "warm_friction")]
)
def test_the_effects_are_identified(effects: tuple[str, ...], tmp_path: Path, prior: dict[str, float]) -> None:
    warm = "\nsignals: {warm_up_time: 10 s}\n" if "warm_friction" in effects else ""
    path = with_effects(effects, tmp_path, warm)
    sought = {name: value for effect in effects for name, value in EFFECTS[effect][1].items()}
    run = run_of(path, tmp_path / "run.csv", 1, prior | sought, 10.0 if warm else None)
    robot, regressors = derived(path)
    found = identify(robot, [run], regressors=regressors)
    solution = found.full.solution
    assert not [note for note in found.notes if "settled" in note]
    for name, value in sought.items():
        assert abs(solution.values[name] - value) < max(0.02 * abs(value), 5 * solution.std(name)), name
        # Bristles that a sliding joint bends show their force, not their damping.
        assert name == "Dz3" or solution.std(name) < 0.1 * abs(value), name
    assert found.full.train.total.relative_to_mean < 1.5
