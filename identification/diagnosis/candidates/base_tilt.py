"""A base that leans against the pose in the robot's file.

Turned by small angles phi about the world's axes, the robot feels the weight of gravity g - phi x g in its old pose:
the measured torque holds the torque of gravity g x e_k per radian about axis k. It is linear in the bodies' first
moments and masses, some of which an upright base does not show at all, such as the first moments about a vertical first
axis. For these the base parameters tell nothing: their products with the angles are coefficients of their own.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
import sympy

from generator.derivation import derive
from generator.robot.description import Robot
from generator.symbolic.model import Model
from identification.arrays import Array
from identification.diagnosis.columns.hypothesis import BASE, PRIOR, Coefficient, Hypothesis
from identification.diagnosis.runs.scene import Scene
from identification.observation import generated_module

#: Largest angle [rad].
_LARGEST = 0.3
#: Positions at which columns are compared; the part of one, and the torque per unit [N m], that are nothing.
_POSITIONS, _NOTHING = 200, 1e-6
#: Part of a torque by which one that stays the same changes.
_SAME = 0.01


def hypotheses(scenes: Sequence[Scene]) -> list[Hypothesis]:
    """One for the robot: angles [rad] about the two of the world's axes that are not along gravity, by which the base
    is turned beyond its pose in the file (rotation vector, in the world); none without gravity or weight.
    """
    if not scenes or not any(scenes[0].robot.gravity):
        return []
    robot = scenes[0].robot
    gravity = sympy.Matrix(robot.gravity)
    along = max(range(3), key=lambda axis: abs(float(gravity[axis])))
    weights = {"xyz"[axis]: Weight(robot, gravity.cross(sympy.eye(3).col(axis))) for axis in range(3) if axis != along}
    model = scenes[0].regressors.model
    hidden = _hidden(weights, model, _some_positions(scenes))
    columns = _Columns(model, weights, hidden)
    if not _varies([columns(scene, {}) for scene in scenes]):
        return []
    standard = {one.name: one.unit for one in model.standard_parameters}
    return [
        Hypothesis(
            "base_tilt",
            "tilt of the base",
            0,
            (
                *(Coefficient(f"tilt_{axis}", "rad", -_LARGEST, _LARGEST, essential=True) for axis in weights),
                *(Coefficient(f"{name}_tilt_{axis}", f"{standard[name]} rad") for name, axis in hidden),
            ),
            columns,
            kind=BASE,
            joints=robot.numbers,
            variable="q",
            would_show=f"{PRIOR}, and the first joint turned over its whole range",
            separating={
                "position_offset": "a level on the base; a tilt turns with the first joint, an offset does not",
                "offset": "the first joint turned over its whole range: a tilt's torque changes its sign",
            },
        )
    ]


def _varies(torques: Sequence[Array]) -> bool:
    """Whether torques (... x N each) change along the runs: what stays the same is an offset's."""
    least = np.min([one.min(axis=-1) for one in torques], axis=0)
    most = np.max([one.max(axis=-1) for one in torques], axis=0)
    return bool(np.any(most - least > _SAME * np.maximum(np.abs(least), np.abs(most))))


class Weight:
    """Torques of the bodies' weight under another ``gravity`` [m/s2] in the world, per standard parameter."""

    def __init__(self, robot: Robot, gravity: sympy.Matrix) -> None:
        self._bare = replace(robot, gravity=tuple(gravity), effects=(), flexible=(), parameter_sets={})
        model = derive(self._bare, names=("regressor_standard",), check=False)
        self._bodies = {one.name: p for p, one in enumerate(model.standard_parameters)}
        self._regressor = _at_rest(model, "regressor_standard")

    @cached_property
    def _payload(self) -> Callable[[Array], Array]:
        # Most runs carry none that is known, and deriving takes its time.
        return _at_rest(derive(self._bare, names=("payload_regressor",), check=False), "payload_regressor")

    def __call__(self, q: Array, standard: Mapping[str, float]) -> Array:
        """Torques (n x N) at rest in q (n x N), of values of the bodies' standard parameters; absent ones are zero."""
        columns = [(p, standard[name]) for name, p in self._bodies.items() if standard.get(name)]
        w = self._regressor(q)
        return np.asarray(sum((x * w[..., p] for p, x in columns), start=np.zeros_like(q.T)).T)

    def carried(self, q: Array, body: Array) -> Array:
        """Torques (n x N) at rest in q (n x N) of a body in the tool's frame, by its inertial parameters (10) [SI]."""
        return np.asarray(self._payload(q) @ body).T if body.any() else np.zeros_like(q)


def _at_rest(model: Model, name: str) -> Callable[[Array], Array]:
    """A generated regressor at rest in positions (n x N): N x n x columns."""
    function: Any = getattr(generated_module(model), name)
    lengths = [model.default_parameters()] if model.functions[name].uses_parameters else []
    return lambda q: np.asarray(function(*lengths, q.T, np.zeros_like(q.T), np.zeros_like(q.T)))


@dataclass(frozen=True)
class _Columns:
    """The columns along a scene: of the angles about the axes of ``weights``, then of the products ``hidden``."""

    model: Model
    weights: Mapping[str, Weight]
    hidden: Sequence[tuple[str, str]]

    def __call__(self, scene: Scene, shape: Mapping[str, float]) -> Array:
        # Standard parameters that make the base parameters: those that give them their names have their values.
        heads = {base.head: scene.values.get(base.name, 0.0) for base in self.model.grouping.base}
        q = scene.motion.q
        known = [weight(q, heads) + weight.carried(q, scene.body) for weight in self.weights.values()]
        unknown = [self.weights[axis](q, _unseen(self.model, name)) for name, axis in self.hidden]
        return np.stack([*known, *unknown])


def _unseen(model: Model, name: str) -> dict[str, float]:
    """Standard parameters that the model's torques do not show: one of ``name``, less what it adds to the others."""
    coefficients = model.grouping.coefficients(name)
    pairs = zip(model.grouping.base, coefficients, strict=True)
    return {name: 1.0, **{base.head: -coefficient for base, coefficient in pairs if coefficient}}


def _hidden(weights: Mapping[str, Weight], model: Model, q: Array) -> list[tuple[str, str]]:
    """Eliminated parameters and axes whose products with the angle show, as few as tell all that can be seen."""
    found: list[tuple[str, str]] = []
    basis = np.empty((q.size, 0))
    for one in model.grouping.eliminated:
        for axis, weight in weights.items():
            column = weight(q, _unseen(model, one.name)).reshape(-1)
            size = np.linalg.norm(column)
            column = column - basis @ (basis.T @ column)
            if size > _NOTHING * np.sqrt(q.size) and np.linalg.norm(column) > _NOTHING * size:
                found.append((one.name, axis))
                basis = np.column_stack([basis, column / np.linalg.norm(column)])
    return found


def _some_positions(scenes: Sequence[Scene]) -> Array:
    """Positions (n x N) spread over the runs."""
    q = np.concatenate([scene.motion.q for scene in scenes], axis=1)
    return q[:, :: max(1, q.shape[1] // _POSITIONS)]
