"""Torque per unit of a change of a length d or r of the geometry, along a run.

Standard parameters that make the base parameters give the torque with another length. Others that make the same give
another one, but only by what base parameters make, as long as the change groups them alike: what the columns of the
model do not hold is the length's alone. Of known parameters those that are known are right.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
import sympy

from generator.derivation import derive
from generator.robot.description import PRISMATIC, Joint, Robot
from generator.robot.parameters import INERTIAL_STEMS
from generator.symbolic.model import Model
from identification.arrays import Array
from identification.diagnosis.columns.hypothesis import LENGTH, Coefficient, Hypothesis
from identification.diagnosis.runs.scene import Scene
from identification.observation import generated_module

#: Change [m] by which a derivative is taken before one was found, and the largest that is told.
_STEP, _LARGEST = 1e-4, 0.5


def hypotheses(model: Model) -> list[Hypothesis]:
    """One for each length of the moving joints that the torque can depend on and that is not the zero of a joint's
    variable: how much longer it is [m] than in the robot's file.
    """
    stated = _Bodies(model.robot)
    return [
        Hypothesis(
            f"length_{which}",
            f"another length {which} than the file's",
            joint.number,
            (Coefficient(columns.name, "m", -_LARGEST, _LARGEST),),
            columns,
            kind=LENGTH,
            joints=(joint.number,),
            variable="q",
            would_show="motion of all joints, with other payloads",
            separating={"position_offset": "measured poses of the tool: a length moves it, an offset turns it"},
        )
        for joint, which in _lengths(model)
        for columns in [_Columns(stated, joint, which)]
    ]


def _lengths(model: Model) -> Iterator[tuple[Joint, str]]:
    """Joints with the names of their lengths. Those of joints on the base move all of the robot. Along axes that are
    parallel, the first r stands for all. What a length that is zero keeps from the base parameters is to be known.
    """
    robot = model.robot
    known = not _told(robot).keys().isdisjoint(one.name for one in model.grouping.eliminated)
    for joint in robot.moving:
        if (before := robot.antecedent(joint)) is None:
            continue
        parallel = joint.alpha == 0 and before in robot.moving
        for which in ("d",) if joint.sigma == PRISMATIC or parallel else ("d", "r"):
            if known or getattr(joint, which) != 0:
                yield joint, which


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
        before = scene.found(self.name)
        step = sympy.Rational(f"{before if abs(before) > _STEP else _STEP:.7f}")
        return (self._longer(step).torques(scene) - self.stated.kept(scene))[None] / float(step)

    def _longer(self, step: sympy.Rational) -> _Bodies:
        if step not in self._by_step:
            joints = list(self.stated.robot.joints)
            own = joints[self.joint.number - 1]
            joints[self.joint.number - 1] = replace(own, **{self.which: getattr(own, self.which) + step})
            self._by_step[step] = _Bodies(replace(self.stated.robot, joints=tuple(joints)))
        return self._by_step[step]


class _Bodies:
    """The bodies of ``robot``, and what its tool carries, without effects."""

    def __init__(self, robot: Robot) -> None:
        self._tool = robot.tool.number
        self.robot = replace(
            robot,
            lengths=tuple(replace(one, symbolic=False) for one in robot.lengths),
            # What the tool carries is a body like others.
            joints=tuple(replace(one, tool=False) for one in robot.joints),
            effects=(),
            flexible=(),
            parameter_sets={},
        )
        #: With the scenes, so that no other one gets their identity.
        self._along: dict[int, tuple[Scene, Array]] = {}

    def kept(self, scene: Scene) -> Array:
        """The ``torques`` along a scene, which are asked for again for every length."""
        if id(scene) not in self._along:
            self._along[id(scene)] = scene, self.torques(scene)
        return self._along[id(scene)][1]

    def torques(self, scene: Scene) -> Array:
        """Along a scene (n x N) [N m, N], of standard parameters that make its base parameters."""
        names, torques = self._function
        values = _standard(scene)
        for stem, value in zip(INERTIAL_STEMS, scene.body.tolist(), strict=True):
            name = f"{stem}{self._tool}"
            values[name] = values.get(name, 0.0) + value
        signals = [x.T for x in scene.motion.signals]
        tau = torques(*signals, np.array([values.get(name, 0.0) for name in names]))
        return np.asarray(tau.T)

    @cached_property
    def _function(self) -> tuple[list[str], Callable[..., Array]]:
        """Names of the standard parameters, and the generated inverse dynamics in these."""
        name = "inverse_dynamics_standard"
        model = derive(self.robot, names=(name,), check=False)
        return [one.name for one in model.standard_parameters], getattr(generated_module(model), name)


def _standard(scene: Scene) -> dict[str, float]:
    """Standard parameters by name that make a scene's base parameters: where the robot's first set tells them its own,
    but for those that give base parameters their names.
    """
    model = scene.regressors.model
    values = _told(model.robot)
    terms = model.grouping.numeric()
    heads = {
        base.head: scene.values.get(base.name, 0.0)
        - sum(factor * values.get(name, 0.0) for name, factor in terms[base.name].items() if name != base.head)
        for base in model.grouping.base
    }
    return values | heads


def _told(robot: Robot) -> dict[str, float]:
    """What the robot's first set tells, by name [SI]."""
    first = next(iter(robot.parameter_sets.values()), None)
    return {} if first is None else {name: one.value for name, one in first.values.items()}
