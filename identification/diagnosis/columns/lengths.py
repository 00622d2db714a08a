"""Torque per unit of a change of a length d or r of the geometry, along a run.

Standard parameters that make the base parameters give the derivative of the torque by a length. Others that make the
same give another one, but only by what base parameters make: what the columns of the model do not hold is the length's
alone.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
import sympy

from generator.derivation import derive
from generator.robot.description import PRISMATIC, Joint, Robot
from generator.symbolic.model import Model
from identification.arrays import Array
from identification.diagnosis.columns.hypothesis import LENGTH, Coefficient, Hypothesis
from identification.diagnosis.runs.scene import Scene
from identification.observation import generated_module

#: Change [m] by which a derivative is taken, and the largest that is told.
_STEP, _LARGEST = sympy.Rational(1, 10000), 0.5


def hypotheses(robot: Robot) -> list[Hypothesis]:
    """One for each length of the moving joints that is not the zero of a joint's variable: how much longer it is [m]
    than in the robot's file.
    """
    stated = _Bodies(robot)
    return [
        Hypothesis(
            f"length_{field}",
            f"another length {field} than the file's",
            joint.number,
            (Coefficient(f"{field}{joint.number}_longer", "m", -_LARGEST, _LARGEST),),
            _Columns(stated, joint, field),
            kind=LENGTH,
            joints=(joint.number,),
            variable="q",
            would_show="motion of all joints, with other payloads",
            separating={"position_offset": "measured poses of the tool: a length moves it, an offset turns it"},
        )
        for joint, field in _lengths(robot)
    ]


def _lengths(robot: Robot) -> Iterator[tuple[Joint, str]]:
    """Joints with the names of their lengths. Along axes that are parallel, the first r stands for all."""
    for joint in robot.moving:
        yield joint, "d"
        if joint.sigma != PRISMATIC and not (joint.alpha == 0 and robot.antecedent(joint) in robot.moving):
            yield joint, "r"


@dataclass(frozen=True)
class _Columns:
    """The column of ``field`` of ``joint`` along a scene, beside the ``stated`` geometry."""

    stated: _Bodies
    joint: Joint
    field: str

    @cached_property
    def _longer(self) -> _Bodies:
        joints = list(self.stated.robot.joints)
        joints[self.joint.number - 1] = replace(self.joint, **{self.field: getattr(self.joint, self.field) + _STEP})
        return _Bodies(replace(self.stated.robot, joints=tuple(joints)))

    def __call__(self, scene: Scene, shape: Mapping[str, float]) -> Array:
        return (self._longer.torques(scene) - self.stated.torques(scene))[None] / float(_STEP)


class _Bodies:
    """The bodies of ``robot``, and what runs are known to carry, without effects."""

    def __init__(self, robot: Robot) -> None:
        self.robot = replace(robot, effects=(), flexible=(), parameter_sets={})

    def torques(self, scene: Scene) -> Array:
        """Along a scene (n x N) [N m, N], of standard parameters that make its base parameters."""
        signals = [x.T for x in scene.motion.signals]
        model, bodies = self._of_bodies
        # Those that give base parameters their names have their values.
        heads = {base.head: scene.values.get(base.name, 0.0) for base in scene.regressors.model.grouping.base}
        result = bodies(*signals, np.array([heads.get(one.name, 0.0) for one in model.standard_parameters]))
        payload = scene.sampled.run.payload
        if payload is not None:
            result = result + self._of_payload(*signals) @ np.array([payload.known[stem] for stem in payload.names()])
        return np.asarray(result.T)

    @cached_property
    def _of_bodies(self) -> tuple[Model, Callable[..., Array]]:
        return self._function("inverse_dynamics_standard")

    @cached_property
    def _of_payload(self) -> Callable[..., Array]:
        return self._function("payload_regressor")[1]

    def _function(self, name: str) -> tuple[Model, Callable[..., Array]]:
        """A quantity's model, and its generated function of samples (N x ...)."""
        model = derive(self.robot, names=(name,), check=False)
        function: Any = getattr(generated_module(model), name)
        lengths = [model.default_parameters()] if model.functions[name].uses_parameters else []
        return model, lambda *inputs: np.asarray(function(*lengths, *inputs))
