"""A robot to compare on: bodies and rotors alone, which every library models, with physical parameters and states."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import numpy as np
import sympy
from numpy.typing import NDArray

from generator.derivation import derive
from generator.reference.quantities import Reference
from generator.reference.sample import physical_parameters
from generator.resources import find_robot
from generator.robot.description import FIXED, ParameterValue, Robot
from generator.robot.readers import read
from generator.symbolic.model import Model
from generator.symbolic.parameter_sets import parameter_vector
from tests.bodies import PINOCCHIO

#: The functions that are compared, by the names of the generated ones.
FUNCTIONS = ("inverse_dynamics", "inertia_matrix", "direct_dynamics", "regressor", "gravity")
#: Those of the robot with all its effects that are timed for scale.
WHOLE_FUNCTIONS = ("inverse_dynamics", "direct_dynamics")

#: States, all of which fit into the first cache with their results.
STATES = 64

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Link:
    """A moving joint with its body.

    ``rotation`` and ``position`` [m] place its frame in its antecedent's at q = 0, products of sines and cosines exact;
    the first link's antecedent is the world. The joint then turns about z, or slides along it if ``prismatic``.
    """

    number: int
    prismatic: bool
    rotation: Array
    position: Array


class Chain:
    """A serial chain of ``robots/`` reduced to bodies and rotors, its lengths numbers.

    ``model`` is that; ``whole`` has friction, offsets and balancers too. ``values`` are standard parameters by name.
    """

    def __init__(self, name: str) -> None:
        given = read(find_robot(name))
        lengths = tuple(replace(length, symbolic=False) for length in given.lengths)
        whole = replace(given, lengths=lengths, flexible=(), drives=None, parameter_sets={})
        self.robot = replace(whole, effects=tuple(use for use in whole.effects if use.effect == "rotor_inertia"))
        self.model = derive(self.robot, FUNCTIONS)
        self.whole = derive(whole, WHOLE_FUNCTIONS)
        self.values = physical_parameters(whole, 1)

    @property
    def name(self) -> str:
        return self.robot.name

    @property
    def dof(self) -> int:
        return self.model.dof

    @property
    def base(self) -> tuple[str, ...]:
        """Names of the base parameters: columns of the generated regressor."""
        return tuple(parameter.name for parameter in self.model.base_parameters)

    @property
    def standard(self) -> tuple[str, ...]:
        """Names of the bodies' standard parameters: columns of Pinocchio's regressor."""
        return tuple(f"{stem}{link.number}" for link in self.links for stem in PINOCCHIO)

    def parameters(self, model: Model) -> Array:
        """The parameter vector of ``model``, the reduced one or the whole robot's."""
        known = {parameter.name for parameter in model.standard_parameters}
        given = {name: ParameterValue(value, "") for name, value in self.values.items() if name in known}
        return parameter_vector(model, given)

    def expected(self, function: str, state: int) -> Array:
        """What a function of the whole robot returns, by the independent implementation of the self-tests."""
        signals = dict(zip(("q", "qd", "qdd", "tau"), self.states[state], strict=True))
        (result,) = Reference(self.whole.robot, self.values)(function, signals).values()
        return result

    @cached_property
    def grouping(self) -> Array:
        """The coefficients (base x standard) of the standard parameters in the base parameters."""
        of = self.model.grouping.numeric()
        rows = ([of[base].get(name, 0.0) for name in self.standard] for base in self.base)
        return np.array(list(rows), dtype=float)

    @cached_property
    def links(self) -> tuple[Link, ...]:
        return tuple(_links(self.robot))

    @cached_property
    def states(self) -> Array:
        """Q, qd, qdd and tau (states x 4 x n): any position, moderate speeds, accelerations and torques."""
        scale = np.array([3.1, 2.0, 5.0, 500.0])
        states: Array = np.random.default_rng(1).uniform(-1.0, 1.0, (STATES, 4, self.dof)) * scale[:, None]
        return states

    def body(self, link: Link) -> list[float]:
        """The dynamic parameters of a link's body, in Pinocchio's order."""
        return [self.values[f"{stem}{link.number}"] for stem in PINOCCHIO]

    def rotor(self, link: Link) -> float:
        """Inertia of a joint's rotor, on the joint side [kg m2]."""
        return self.values.get(f"Ia{link.number}", 0.0)


def write(values: Sequence[float] | Array, path: Path) -> Path:
    """Numbers as the libraries read them."""
    path.write_bytes(np.asarray(values, dtype=float).tobytes())
    return path


def _links(robot: Robot) -> list[Link]:
    lengths = {sympy.Symbol(length.name, real=True): length.value for length in robot.lengths}
    carried, links = robot.base, []
    for joint in robot.joints:
        if joint.tool:
            continue
        if joint.sigma == FIXED or joint.antecedent != joint.number - 1:
            raise ValueError(f"{robot.name} is no serial chain of moving joints")
        at = {joint.variable: 0, **lengths}
        alpha, d, theta, r = (sympy.sympify(value).subs(at) for value in (joint.alpha, joint.d, joint.theta, joint.r))
        place = carried * _about(0, alpha) * _along(d, 0, 0) * _about(2, theta) * _along(0, 0, r)
        numbers = np.array(place.tolist(), dtype=float)
        links.append(Link(joint.number, bool(joint.sigma), numbers[:3, :3], numbers[:3, 3]))
        carried = sympy.eye(4)
    return links


def _about(axis: int, angle: sympy.Expr) -> sympy.Matrix:
    return (
        (sympy.rot_ccw_axis1(angle) if axis == 0 else sympy.rot_ccw_axis3(angle))
        .row_join(sympy.zeros(3, 1))
        .col_join(sympy.Matrix([[0, 0, 0, 1]]))
    )


def _along(*position: sympy.Expr | int) -> sympy.Matrix:
    return sympy.eye(3).row_join(sympy.Matrix(position)).col_join(sympy.Matrix([[0, 0, 0, 1]]))
