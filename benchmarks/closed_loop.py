"""A closed loop to be simulated: moves from point to point, a cascade controller, parameters of a robot's twin."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from generator.derivation import derive
from generator.resources import find_robot
from generator.robot.readers import read
from generator.symbolic.interpret import evaluate
from generator.symbolic.model import Model
from generator.symbolic.parameter_sets import resolved_sets
from tests.simulated import Gains

Vector = NDArray[np.float64]

#: What the simulation calls, and what the loop is made of.
QUANTITIES = (
    "bias",
    "direct_dynamics_sliding",
    "direct_dynamics_smooth",
    "flexible_direct_dynamics_sliding",
    "flexible_direct_dynamics_smooth",
    "inertia_matrix",
    "joint_torque",
    "motor_position",
    "motor_speed",
    "motor_torque",
)
#: Parts of the way between the joints' limits, point by point.
_POINTS = (
    (0.50, 0.50, 0.55, 0.50, 0.65, 0.50),
    (0.62, 0.70, 0.45, 0.56, 0.35, 0.60),
    (0.42, 0.40, 0.65, 0.44, 0.62, 0.40),
    (0.55, 0.75, 0.40, 0.54, 0.55, 0.56),
    (0.38, 0.55, 0.60, 0.46, 0.38, 0.52),
    (0.50, 0.50, 0.55, 0.50, 0.65, 0.50),
)
#: From point to point [s]: of a move and its rest, and of the move.
_TACT, _MOVE = 2.0, 1.6
#: The motors' torque limits, in parts of what the moves ask for at most.
_PART = 0.97


@dataclass(frozen=True)
class ClosedLoop:
    """A flexible robot with its controller: ``reference`` by name, (samples x n) each; ``q`` the state at rest."""

    model: Model
    parameters: Vector
    gains: Gains
    reference: dict[str, Vector]
    q: Vector
    drives: Vector

    @property
    def qd(self) -> Vector:
        return np.zeros_like(self.q)


def closed_loop(robot: str, parameter_set: str, period: float, duration: float = 10.0) -> ClosedLoop:
    """Moves of ``duration`` [s] for a robot whose six joints are elastic; torques against weight are fed forward.

    The motors' torques are cut a little below what the moves ask for at most, so that some samples are in saturation.
    """
    model = derive(read(find_robot(robot)), names=QUANTITIES, check=False)
    values = resolved_sets(model)[parameter_set]
    parameters = np.array([values.get(parameter.name, 0.0) for parameter in model.parameters])
    q, qd = _moves(model, np.arange(round(duration / period)) * period)
    held = evaluate(model.functions["bias"], {"q": q, "qd": np.zeros_like(q), "parameters": parameters})["H"]
    N = evaluate(model.functions["motor_position"], {"q": np.eye(model.dof)})["qr"].T
    M = evaluate(model.functions["inertia_matrix"], {"q": q[0], "parameters": parameters})["M"]
    inertia = np.diag(M) + _named(model, values, "Iam")
    ratio = np.abs(np.diag(N))
    asked = held + inertia * np.gradient(qd, period, axis=0)
    asked += _named(model, values, "Fvm") * qd + _named(model, values, "Fcm") * np.sign(qd)
    limit = _PART * np.abs(asked).max(axis=0) / ratio
    gains = Gains(12.0, 40.0 * inertia / ratio**2, 15.0, limit, period)
    at_rest = np.concatenate([q[0], -held[0] / _named(model, values, "k")])
    return ClosedLoop(model, parameters, gains, {"q": q, "qd": qd, "tau": held}, at_rest, N)


def control(loop: ClosedLoop, k: int, q: ArrayLike, qd: ArrayLike, z: Vector) -> tuple[Vector, Vector]:
    """Joint torques of sample ``k`` and the integrals after it, written apart from the generated controller."""
    n, g, N = loop.model.dof, loop.gains, loop.drives
    wanted = loop.reference
    e = g.kp * (N @ (wanted["q"][k] - np.asarray(q)[:n])) + N @ (wanted["qd"][k] - np.asarray(qd)[:n])
    grown = z + g.ki * g.period * e
    free = g.kv * (e + grown) + np.linalg.solve(N.T, wanted["tau"][k])
    tau = np.clip(free, -np.asarray(g.limit), g.limit)
    driven = (free - tau) * (grown - z) > 0
    return N.T @ tau, np.where(driven, z, grown)


def _moves(model: Model, t: Vector) -> tuple[Vector, Vector]:
    """Positions and speeds at times ``t``: quintics from point to point, each with a rest."""
    lower, upper = (np.array([float(getattr(j, side)) for j in model.robot.moving]) for side in ("lower", "upper"))
    points = lower + (upper - lower) * np.array(_POINTS)
    leg = np.minimum((t / _TACT).astype(int), len(points) - 2)
    s = np.clip((t - leg * _TACT) / _MOVE, 0, 1)[:, None]
    way = (points[1:] - points[:-1])[leg]
    return points[leg] + way * s**3 * (10 - 15 * s + 6 * s**2), way * 30 * (s * (1 - s)) ** 2 / _MOVE


def _named(model: Model, values: Mapping[str, float], stem: str) -> Vector:
    """A parameter of every joint."""
    return np.array([values[f"{stem}{joint.number}"] for joint in model.robot.moving])


def folder(build: Path, name: str) -> Path:
    """A place to build in."""
    made = build / name
    made.mkdir(parents=True, exist_ok=True)
    return made
