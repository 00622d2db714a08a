"""Torque per unit of a change of a length d or r of the geometry, along a run.

Standard parameters that make the base parameters give the torque with another length. Others that make the same give
another one, but only by what base parameters make: what the columns of the model do not hold is the length's alone. Of
known parameters those that are known are right.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
import sympy

from generator.derivation import derive
from generator.robot.description import PRISMATIC, Joint, Robot
from generator.symbolic.model import Model
from identification.arrays import Array
from identification.diagnosis.columns.hypothesis import LENGTH, Coefficient, Hypothesis
from identification.diagnosis.runs.scene import Scene
from identification.observation import generated_module

#: Change [m] by which a derivative is taken before one was found, and the largest that is told.
_STEP, _LARGEST = 1e-4, 0.5


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
            (Coefficient(columns.name, "m", -_LARGEST, _LARGEST),),
            columns,
            kind=LENGTH,
            joints=(joint.number,),
            variable="q",
            would_show="motion of all joints, with other payloads",
            separating={"position_offset": "measured poses of the tool: a length moves it, an offset turns it"},
        )
        for joint, field in _lengths(robot)
        for columns in [_Columns(stated, joint, field)]
    ]


def _lengths(robot: Robot) -> Iterator[tuple[Joint, str]]:
    """Joints with the names of their lengths. Along axes that are parallel, the first r stands for all."""
    for joint in robot.moving:
        yield joint, "d"
        if joint.sigma != PRISMATIC and not (joint.alpha == 0 and robot.antecedent(joint) in robot.moving):
            yield joint, "r"


@dataclass(frozen=True)
class _Columns:
    """The column of the length ``which`` (d or r) of ``joint`` along a scene, beside the ``stated`` geometry: a secant
    to what was found of it before.
    """

    stated: _Bodies
    joint: Joint
    which: str
    _by_step: dict[sympy.Rational, _Bodies] = field(default_factory=dict, compare=False)

    @property
    def name(self) -> str:
        """Of the coefficient."""
        return f"{self.which}{self.joint.number}_longer"

    def __call__(self, scene: Scene, shape: Mapping[str, float]) -> Array:
        step = sympy.Rational(f"{scene.found(self.name) or _STEP:.7f}")
        return (self._longer(step).torques(scene) - self.stated.torques(scene))[None] / float(step)

    def _longer(self, step: sympy.Rational) -> _Bodies:
        if step not in self._by_step:
            joints = list(self.stated.robot.joints)
            joints[self.joint.number - 1] = replace(self.joint, **{self.which: getattr(self.joint, self.which) + step})
            self._by_step[step] = _Bodies(replace(self.stated.robot, joints=tuple(joints)))
        return self._by_step[step]


def _standard(scene: Scene) -> dict[str, float]:
    """Standard parameters by name that make a scene's base parameters: where the robot's first set tells them its own,
    but for those that give base parameters their names.
    """
    model = scene.regressors.model
    told = next(iter(model.robot.parameter_sets.values()), None)
    values = {} if told is None else {name: one.value for name, one in told.values.items()}
    terms = model.grouping.numeric()
    heads = {
        base.head: scene.values.get(base.name, 0.0)
        - sum(factor * values.get(name, 0.0) for name, factor in terms[base.name].items() if name != base.head)
        for base in model.grouping.base
    }
    return values | heads


class _Bodies:
    """The bodies of ``robot``, and what its tool carries, without effects."""

    def __init__(self, robot: Robot) -> None:
        lengths = tuple(replace(one, symbolic=False) for one in robot.lengths)
        self.robot = replace(robot, lengths=lengths, effects=(), flexible=(), parameter_sets={})

    def torques(self, scene: Scene) -> Array:
        """Along a scene (n x N) [N m, N], of standard parameters that make its base parameters."""
        signals = [x.T for x in scene.motion.signals]
        model, bodies = self._of_bodies
        known = _standard(scene)
        result = bodies(*signals, np.array([known.get(one.name, 0.0) for one in model.standard_parameters]))
        if (carried := scene.body).any():
            result = result + self._of_payload(*signals) @ carried
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
        return model, getattr(generated_module(model), name)
