"""Blocked outputs and steps of force of an arm whose drive trains twist, simulated apart from the code under test."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from scipy.signal import lfilter

from generator.resources import find_robot
from generator.robot.readers import read
from identification.force_steps import ForceSteps, force_steps
from tests.newton_euler import Arm
from tests.recorded import Array, Recorded

RATE = 100.0
ROBOT = read(find_robot("kr500"))
N = np.array([[float(x) for x in row] for row in ROBOT.drives.coupling]) if ROBOT.drives else np.eye(6)
K = np.array([6.2e6, 6.7e6, 3.9e6, 1.1e6, 0.9e6, 0.5e6])
KT = np.array([1.6, 1.5, 1.4, 1.2, 1.1, 1.05])
IA = np.array([4000.0, 4000.0, 3500.0, 300.0, 500.0, 200.0])
#: tau = Iam qdd + Fvm qd + Fcm sign(qd) + k q + Offk + balancer, about q2 = -1.5 rad.
LOCKED = {"Iam2": 900.0, "Fvm2": 8.0e3, "Fcm2": 60.0, "k2": 1.9e6, "Offk2": 2.85e6 + 300.0}


def blocked(
    path: Path, seed: int = 0, noise: float = 40.0, balancer: float = 0.0, colour: float = 0.0, second: float = 0.8e-3
) -> str:
    """A motor that goes slowly to and fro by a few mrad, up to some kN m; the other joints stand and hum.

    Of noise that is coloured, each sample has so much of the one before. A ``second`` wave is slower [rad].
    """
    draw = np.random.default_rng(seed)
    t = np.arange(round(60 * RATE)) / RATE
    w = 2 * np.pi * 0.15
    x = 1.5e-3 * np.sin(w * t) + second * np.sin(0.4 * w * t)
    v = 1.5e-3 * w * np.cos(w * t) + 0.4 * second * w * np.cos(0.4 * w * t)
    a = -1.5e-3 * w * w * np.sin(w * t) - 0.16 * second * w * w * np.sin(0.4 * w * t)
    q, tau = np.zeros((6, len(t))), draw.normal(scale=5.0, size=(6, len(t)))
    q[1] = -1.5 + x
    tau[1] = 900 * a + 8e3 * v + 60 * np.sign(v) + 1.9e6 * q[1] + LOCKED["Offk2"] + balancer
    tau[1] += lfilter([1.0], [1.0, -colour], draw.normal(scale=noise, size=len(t)))
    columns = {"t": t} | {f"q{j + 1}": q[j] for j in range(6)} | {f"tau{j + 1}": tau[j] for j in range(6)}
    return str(Recorded(columns).save(path))


#: Poses in which a force along the tool's z turns axes 2 and 3 alone, or 1 to 3. It goes through the wrist's centre.
STRAIGHT = (0.2, -1.2, 0.9, 0.0, 0.0, 0.0)
TURNED = (0.1, -1.3, 1.1, 0.9, 1.1, 0.3)


def torques_of_force(q: tuple[float, ...]) -> Array:
    """Joint torques (6 x 3) [N m/N] that press with 1 N along the tool's x, y, z, by the tests' Newton-Euler."""
    still, arm = np.zeros(6), Arm(ROBOT, {})
    unit = np.eye(6)[:3]
    return np.stack([arm.torques(q, still, still, weight=False, wrench=tuple(one)) for one in unit], axis=1)


def pressed(
    path: Path,
    q0: tuple[float, ...],
    seed: int = 0,
    noise: float = 1.0,
    axes: str = "z",
    orient: bool = False,
    resolution: float = 0.0,
) -> str:
    """Steps of force with finite slopes: motors twist by tau / k; where ``orient``, q5 is moved by q2 + q3 besides."""
    draw = np.random.default_rng(seed)
    t = np.arange(round(40 * RATE)) / RATE
    slope = np.hanning(41) / np.hanning(41).sum()
    force = np.zeros((3, len(t)))
    for axis in axes:
        level = 1500 + 1200 * np.sign(np.sin(2 * np.pi * {"x": 0.1, "y": 0.075, "z": 0.125}[axis] * t))
        force["xyz".index(axis)] = np.convolve(np.pad(level, 20, mode="edge"), slope, mode="valid")
    held = torques_of_force(q0) @ force
    twist = held / K[:, None]
    if orient:
        twist[4] += twist[1] + twist[2]
    qdd = np.gradient(np.gradient(twist, t, axis=1), t, axis=1)
    gravity = np.array([50.0, -900.0, 700.0, 30.0, -40.0, 10.0])
    i = np.linalg.solve(N.T, held + gravity[:, None] + IA[:, None] * qdd) / KT[:, None]
    q = np.array(q0)[:, None] + twist + noise * 2e-6 * draw.normal(size=twist.shape)
    if resolution:
        q = np.round(q / resolution) * resolution
    i = i + noise * 0.02 * draw.normal(size=i.shape)
    columns = {"t": t} | {f"q{j + 1}": q[j] for j in range(6)} | {f"i{j + 1}": i[j] for j in range(6)}
    force = force + noise * 5 * draw.normal(size=force.shape)
    return str(Recorded(columns | {f"f{axis}": force["xyz".index(axis)] for axis in axes}).save(path))


def steps(folder: Path, seed: int = 0, noise: float = 1.0) -> ForceSteps:
    runs = [
        pressed(folder / "straight.csv", STRAIGHT, 2 * seed, noise, orient=True),
        pressed(folder / "turned.csv", TURNED, 2 * seed + 1, noise, "xyz"),
    ]
    inertias = {f"Ia{j}": value for j, value in enumerate(IA, 1)}
    return force_steps(ROBOT, runs, inertias)
