"""Runs as a controller would record them, made from known parameters: motions, files, and a small robot to drive."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from generator.resources import find_robot
from generator.robot.description import Robot
from generator.robot.readers import read
from identification.dataset import Run
from identification.observation import Motion, Regressors

Array = NDArray[np.float64]

#: Two links in a vertical plane, every effect of a drive train, a coupled second motor.
TWO_LINKS = """\
name: two_links
gravity: [0 m/s2, 0 m/s2, -9.81 m/s2]
geometry:
  d2: 0.5 m
joints:
  - {j: 1, sigma: 0, alpha: pi/2, d: 0, theta: q1, r: 0, limits: [-160 deg, 160 deg]}
  - {j: 2, sigma: 0, alpha: 0, d: d2, theta: q2, r: 0, limits: [-160 deg, 160 deg]}
  - {j: 3, sigma: 2, alpha: 0, d: 0.4 m, theta: 0, r: 0, tool: true}
drives:
  gear_ratios: [100, -80]
  coupling: {convention: direct, N21: 5}
  torque_constants: {unit: N m/A, use: warm, warm: [0.5, 0.4]}
effects:
  - {effect: rotor_inertia, joints: all}
  - {effect: viscous_friction, joints: all}
  - {effect: coulomb_friction, joints: all}
  - {effect: offset, joints: all}
"""

#: A linear axis.
SLIDE = """\
name: slide
gravity: [0 m/s2, 0 m/s2, -9.81 m/s2]
joints:
  - {j: 1, sigma: 1, alpha: pi/2, d: 0, theta: 0, r: q1}
effects:
  - {effect: viscous_friction, joints: all}
  - {effect: coulomb_friction, joints: all}
  - {effect: offset, joints: all}
"""

#: Base parameters of the two links.
TRUTH = {
    "ZZ1R": 9.0,
    "MX1R": 11.0,
    "MY1": 0.6,
    "Fv1": 14.0,
    "Fc1": 9.0,
    "Off1": 1.5,
    "ZZ2": 1.3,
    "MX2": 3.1,
    "MY2": -0.4,
    "Ia2": 0.9,
    "Fv2": 7.0,
    "Fc2": 4.0,
    "Off2": -0.8,
}


#: Units of the parameters of small robots, by how their names begin.
UNITS = {
    "ZZ": "kg m2",
    "MX": "kg m",
    "MY": "kg m",
    "M2": "kg",
    "Ia": "kg m2",
    "Fv": "N m s/rad",
    "Fc": "N m",
    "Fs": "N m",
    "Of": "N m",
    "k1": "N m/rad",
    "k2": "N m/rad",
}


def parameters_text(sets: Mapping[str, Mapping[str, float]]) -> str:
    """The section ``parameters`` of a robot file, from values [SI] by set and name."""
    lines = ["parameters:"]
    for name, values in sets.items():
        lines += [f"  {name}:", "    values:"]
        lines += [f"      {one}: {value:g} {UNITS[one[:2]]}" for one, value in values.items()]
    return "\n".join(lines) + "\n"


def twin_text() -> str:
    """Of the two links' robot file, with the set ``twin``."""
    return TWO_LINKS + parameters_text({"twin": TRUTH})


@cache
def two_links(folder: Path) -> Regressors:
    """The small robot, from a file in ``folder``."""
    path = folder / "two_links.yaml"
    path.write_text(TWO_LINKS)
    return Regressors(read(path))


@cache
def regressors(name: str) -> Regressors:
    """Those of a robot in robots/."""
    return Regressors(read(find_robot(name)))


def fourier(robot: Robot, duration: float, rate: float, seed: int = 1, slowest: float = 0.1) -> tuple[Array, Motion]:
    """Times (N) and a motion within the joints' limits: sums of five sines a joint, exact derivatives."""
    draw = np.random.default_rng(seed)
    t = np.arange(round(duration * rate)) / rate
    n = len(robot.moving)
    q, qd, qdd = (np.zeros((n, len(t))) for _ in range(3))
    for k, joint in enumerate(robot.moving):
        lower, upper = (float(x) if x is not None else s for x, s in ((joint.lower, -2.0), (joint.upper, 2.0)))
        q[k] += (lower + upper) / 2
        for harmonic in range(1, 6):
            amplitude, phase = draw.uniform(0.2, 1) * (upper - lower) / 12, draw.uniform(0, 2 * np.pi)
            w = 2 * np.pi * slowest * harmonic
            q[k] += amplitude / harmonic * np.sin(w * t + phase)
            qd[k] += amplitude / harmonic * w * np.cos(w * t + phase)
            qdd[k] -= amplitude / harmonic * w * w * np.sin(w * t + phase)
    return t, Motion(q, qd, qdd)


@dataclass(frozen=True)
class Recorded:
    """Columns of a run by name (N each)."""

    columns: Mapping[str, Array]

    @classmethod
    def read(cls, path: Path | str) -> Recorded:
        """From text with a line of names."""
        with open(path, encoding="utf-8") as lines:
            names = lines.readline().strip().split(",")
            return cls(dict(zip(names, np.loadtxt(lines, delimiter=",").T, strict=True)))

    def with_columns(self, **columns: Array) -> Recorded:
        return Recorded({**self.columns, **columns})

    def without(self, *names: str) -> Recorded:
        return Recorded({name: values for name, values in self.columns.items() if name not in names})

    def rows(self, start: int, end: int) -> Recorded:
        return Recorded({name: values[start:end] for name, values in self.columns.items()})

    def save(self, path: Path) -> Path:
        """As text with the shortest numbers that are read back as they were."""
        lines = [",".join(self.columns)]
        lines += [",".join(map(repr, row)) for row in zip(*(v.tolist() for v in self.columns.values()), strict=True)]
        path.write_text("\n".join(lines) + "\n")
        return path


def recorded(
    of: Regressors,
    truth: Mapping[str, float],
    duration: float = 20.0,
    rate: float = 200.0,
    seed: int = 1,
    noise: float = 0.0,
    payload: Sequence[float] | None = None,
) -> Recorded:
    """A run of t, q and tau; ``noise`` is in parts of each torque's spread, ``payload`` ten inertial parameters."""
    t, motion = fourier(of.model.robot, duration, rate, seed)
    tau = of.torques(truth, of.completed(motion, 1 / rate))
    if payload is not None:
        tau = tau + np.array([np.asarray(payload) @ W for W in of.payload(motion)])
    tau = tau + noise * tau.std(axis=1)[:, None] * np.random.default_rng(seed + 100).normal(size=tau.shape)
    return as_recorded(of, t, motion.q, tau)


def as_recorded(of: Regressors, t: Array, q: Array, tau: Array) -> Recorded:
    """A run of times (N), positions and torques (n x N)."""
    numbers = of.model.robot.numbers
    named = [
        {f"{stem}{j}": row for j, row in zip(numbers, rows, strict=True)} for stem, rows in (("q", q), ("tau", tau))
    ]
    return Recorded({"t": t, **named[0], **named[1]})


def stacked(run: Recorded, stem: str) -> Array:
    """Signals of the two links (2 x N)."""
    return np.stack([run.columns[f"{stem}{j}"] for j in (1, 2)])


def same(run: Run, good: Recorded) -> bool:
    """Whether a run of the two links was read as it was recorded."""
    return np.allclose(run.q, stacked(good, "q"), atol=1e-12) and np.allclose(run.tau, stacked(good, "tau"), atol=1e-9)
