"""One robot's model: its chain, effects, parameters and groupings on one straight-line program."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import cached_property
from typing import TypeAlias

import numpy as np
import sympy

from generator.effects.effect import accelerates
from generator.effects.library import Instance, effects_of, motor_side, states_of, undefined
from generator.errors import InputError, Place
from generator.grouping.grouping import Grouping
from generator.grouping.observability import STEMS
from generator.grouping.special_lengths import elsewhere, general_grouping
from generator.robot.description import Robot
from generator.robot.parameters import INERTIAL_STEMS, Parameter, inertial_parameters
from generator.robot.undefined import hardly_defined
from generator.symbolic.absorption import NotGrouped, absorbed
from generator.symbolic.bodies import Body, body
from generator.symbolic.dynamics import Dynamics
from generator.symbolic.effect_torques import STATES, WARMTH
from generator.symbolic.flexible import FlexibleDynamics
from generator.symbolic.frames import Chain, build_chain
from generator.symbolic.function import PARAMETERS, Function
from generator.symbolic.lowering import lower
from generator.symbolic.sparse import Columns, HardlyDefined, sampled
from generator.symbolic.statements import Node, Program
from generator.symbolic.strategy import PROJECTED, TEXTBOOK, Strategies, choose
from generator.symbolic.vectors import Array

Vector: TypeAlias = np.ndarray[tuple[int], np.dtype[np.float64]]

#: Input signal of the standard parameters; unlike ``parameters`` it may change at every call.
STANDARD = "standard_parameters"


class Model:
    """The symbolic model of ``robot``; ``functions`` is filled by the quantities.

    A ``plain`` model writes the textbook recursion throughout, with SYMORO's names, to be read beside a paper.
    ``constants`` are parameters whose values [SI] stand in the equations as numbers (see ``symbolic.built_in``).

    Raises InputError where the robot's effects are not those of the library; reading the groupings raises it where they
    cannot be told from other parameters by constant coefficients.
    """

    def __init__(self, robot: Robot, plain: bool = False, constants: Mapping[str, Fraction] | None = None) -> None:
        self.robot = robot
        self.plain = plain
        self.constants = constants or {}
        self.program = Program((PARAMETERS,))
        self.effects = effects_of(robot)
        self.motor_effects = motor_side(robot)
        self.functions: dict[str, Function] = {}

    # -- parameters -----------------------------------------------------------------------------------------------

    @cached_property
    def standard_parameters(self) -> tuple[Parameter, ...]:
        """Ten inertial parameters of each body and the parameters of its effects, joint by joint (report eq. 4)."""
        result: list[Parameter] = []
        for joint in self.robot.joints:
            if not joint.tool:
                result += inertial_parameters(joint)
            for instance in self.effects:
                if instance.joint.number == joint.number:
                    result += instance.parameters
        return tuple(result)

    @cached_property
    def grouping(self) -> Grouping:
        """The exact groupings, with effects that repeat other parameters' torques grouped with them."""
        names = [parameter.name for parameter in self.standard_parameters]
        exact = general_grouping(self.robot, tuple(names))
        others = self._beside_the_bodies
        if not others:
            return exact
        try:
            nominal = _absorbed(self.robot, exact, others)
        except NotGrouped as found:
            raise InputError(self._place(found.name), found.problem, found.expected) from None
        if symbolic := [length.name for length in self.robot.lengths if length.symbolic]:
            moved = _absorbed(elsewhere(self.robot, symbolic), exact, others)
            for name in others:
                here, there = nominal.coefficients(name), moved.coefficients(name)
                if len(here) != len(there) or not np.allclose(here, there, rtol=1e-8, atol=1e-8):
                    problem = f"{name} is grouped with other parameters by symbolic lengths"
                    raise InputError(self._place(name), problem, "lengths that are numbers")
        return nominal

    @property
    def _beside_the_bodies(self) -> list[str]:
        """Parameters of effects that the exact groupings do not know; those of drive trains, which keep their names
        where others make the same torque, come first.
        """
        first = sorted(self.effects, key=lambda one: not one.effect.drive_train)
        pairs = (pair for one in first for pair in zip(one.names, one.effect.parameters, strict=True))
        return [name for name, parameter in pairs if parameter.stem not in STEMS]

    def _place(self, name: str) -> Place:
        """Where the file asks for the effect of a parameter."""
        one = next(one for one in self.effects if name in one.names)
        return self.robot.use(one.effect.id, one.joint.number).place

    def sampled_columns(self, columns: Columns, parameters: Mapping[str, Vector]) -> dict[str, Vector]:
        """Columns of the standard regressor over random states, one after the other.

        ``parameters`` are the signals of parameters that the columns read; what effects read beside the motion is
        random, and so are the standard parameters behind a load. Raises InputError for an effect that is defined hardly
        anywhere.
        """
        loads = np.random.default_rng(1).uniform(0.3, 3.0, len(self.standard_parameters))
        varying = {STATES: len(self.effect_states), WARMTH: self.dof}
        try:
            return sampled(self.program, columns, self.dof, {STANDARD: loads, **parameters}, varying)
        except HardlyDefined as found:
            guilty = undefined(self.effects, found.names)
            if guilty is None:
                raise
            raise hardly_defined(self.robot, guilty.effect.id, guilty.joint.number) from None

    @cached_property
    def base_parameters(self) -> tuple[Parameter, ...]:
        """The base parameters, in the order of their heads among the standard parameters."""
        standard = {parameter.name: parameter for parameter in self.standard_parameters}
        result = []
        for base in self.grouping.base:
            head = standard[base.head]
            bounds = (head.lower, head.upper) if base.alone else (None, None)
            grouped = "" if base.alone else f"; holds {' '.join(name for _, name in base.terms[1:])}"
            result.append(Parameter(base.name, head.unit, head.joint, head.meaning + grouped, *bounds))
        return tuple(result)

    @cached_property
    def motor_parameters(self) -> tuple[Parameter, ...]:
        """Iam, Fvm, Fcm, Offm, k of each elastic joint (report eq. 12)."""
        return tuple(parameter for instance in self.motor_effects for parameter in instance.parameters)

    @cached_property
    def torque_constants(self) -> tuple[Parameter, ...]:
        """kt of each motor, where the drives are known (report eq. 16)."""
        drives = self.robot.drives
        if drives is None or not drives.torque_constants:
            return ()
        return tuple(
            Parameter(f"kt{joint.number}", "N m/A", joint.number, "torque constant of the motor", 0.0, positive=True)
            for joint in self.robot.moving
        )

    @cached_property
    def symbolic_lengths(self) -> tuple[Parameter, ...]:
        """Lengths [m] and angles [rad] of the geometry that are parameters of the code, in the file's order."""
        return tuple(
            Parameter(length.name, length.unit, 0, f"{'length' if length.unit == 'm' else 'angle'} of the geometry")
            for length in self.robot.lengths
            if length.symbolic
        )

    @cached_property
    def all_parameters(self) -> tuple[Parameter, ...]:
        """Base, motor side, torque constants, symbolic lengths."""
        return self.base_parameters + self.motor_parameters + self.torque_constants + self.symbolic_lengths

    @cached_property
    def parameters(self) -> tuple[Parameter, ...]:
        """Order of the generated parameter vector: all that are not constants."""
        return tuple(parameter for parameter in self.all_parameters if parameter.name not in self.constants)

    @cached_property
    def parameter_nodes(self) -> dict[str, Node]:
        """The nodes of all parameters by name."""
        nodes = {name: self.program.constant(value) for name, value in self.constants.items()}
        return nodes | {p.name: self.program.input(PARAMETERS, index) for index, p in enumerate(self.parameters)}

    def default_parameters(self) -> Vector:
        """The parameter vector with nominal lengths and torque constants in place, zero elsewhere."""
        known: dict[str, float] = {length.name: float(length.value) for length in self.robot.lengths}
        drives = self.robot.drives
        if drives is not None and self.torque_constants:
            constants = drives.torque_constants[drives.torque_constant]
            known |= {p.name: float(kt) for p, kt in zip(self.torque_constants, constants, strict=True)}
        return np.array([known.get(parameter.name, 0.0) for parameter in self.parameters])

    @cached_property
    def effect_states(self) -> tuple[Parameter, ...]:
        """The states inside the effects, in the order of the signal ``states``."""
        return tuple(
            Parameter(one.name, one.state.unit(one.joint), one.joint.number, one.state.meaning)
            for one in states_of(self.effects)
        )

    # -- signals --------------------------------------------------------------------------------------------------

    def signal(self, name: str, size: int) -> Array:
        """The nodes of an input signal."""
        result = np.empty(size, dtype=object)
        result[:] = [self.program.input(name, index) for index in range(size)]
        return result

    @property
    def dof(self) -> int:
        """Number of moving joints n: the size of q."""
        return len(self.robot.moving)

    @cached_property
    def elastic(self) -> tuple[int, ...]:
        """Coordinates of the elastic joints."""
        return tuple(k for k, joint in enumerate(self.robot.moving) if joint.number in self.robot.flexible)

    @property
    def flexible_dof(self) -> int:
        """Size of q = [q_m; q_e]."""
        return self.dof + len(self.elastic)

    @cached_property
    def q(self) -> Array:
        """Joint positions (n) [rad, m]: the nodes of the input signal ``q``, in the order of ``robot.moving``."""
        return self.signal("q", self.dof)

    @cached_property
    def qd(self) -> Array:
        """Joint speeds (n) [rad/s, m/s]: the nodes of the input signal ``qd``."""
        return self.signal("qd", self.dof)

    @cached_property
    def qdd(self) -> Array:
        """Joint accelerations (n) [rad/s2, m/s2]: the nodes of the input signal ``qdd``."""
        return self.signal("qdd", self.dof)

    @cached_property
    def tau(self) -> Array:
        """Motor torques (n) [N m, N], on the joint side, positive along z: the nodes of the input signal ``tau``."""
        return self.signal("tau", self.dof)

    # -- models ---------------------------------------------------------------------------------------------------

    def chain_at(self, q: Array) -> Chain:
        """The chain with the joint variables read from ``q``."""
        return build_chain(self.robot, self.program, self.lengths | self.variables(q))

    @cached_property
    def lengths(self) -> dict[sympy.Symbol, Node]:
        """Nodes of the named lengths: numbers, or parameters where they stay symbolic."""
        values: dict[sympy.Symbol, Node] = {}
        for length in self.robot.lengths:
            symbol = sympy.Symbol(length.name, real=True)
            values[symbol] = (
                self.parameter_nodes[length.name] if length.symbolic else lower(self.program, length.value, {})
            )
        return values

    @cached_property
    def chain(self) -> Chain:
        """The chain at the joint positions ``q``."""
        return self.chain_at(self.q)

    @cached_property
    def kept(self) -> dict[str, Node]:
        """Standard names of the kept parameters with the nodes of their base parameters."""
        return {base.head: self.parameter_nodes[base.name] for base in self.grouping.base}

    @cached_property
    def standard_nodes(self) -> dict[str, Node]:
        """Nodes of the standard parameters by name: the input signal ``standard_parameters``."""
        return {p.name: self.program.input(STANDARD, index) for index, p in enumerate(self.standard_parameters)}

    @cached_property
    def base(self) -> Dynamics:
        """The dynamic model in base parameters."""
        return Dynamics(self.chain, self.effects, self.kept, self.qd, self.qdd, strategies=self.strategies)

    @cached_property
    def strategies(self) -> Strategies:
        """How the equations in base parameters are written; the textbook recursion if the model is ``plain``."""
        if self.plain:
            return TEXTBOOK
        matter = Dynamics(self.chain, self.effects, self.kept, self.qd, self.qdd).matter
        return choose(self.chain, matter, self.qd, self.qdd, tuple(self.kept))

    @cached_property
    def standard(self) -> Dynamics:
        """The dynamic model in standard parameters."""
        ways = TEXTBOOK if self.plain else PROJECTED
        return Dynamics(self.chain, self.effects, self.standard_nodes, self.qd, self.qdd, strategies=ways)

    @cached_property
    def base_columns(self) -> Columns:
        """Regressor columns of the base parameters: those of the standard parameters that stay (report eq. 41)."""
        return self.base.regressor_columns(self.kept)

    @cached_property
    def standard_columns(self) -> Columns:
        """Regressor columns of the standard parameters (report eq. 3)."""
        return self.standard.regressor_columns(parameter.name for parameter in self.standard_parameters)

    @cached_property
    def loaded(self) -> Dynamics:
        """The model in base parameters with a payload in the tool frame, signal ``payload`` (report eq. 50)."""
        return Dynamics(self.chain, self.effects, self.kept, self.qd, self.qdd, self._payload())

    @cached_property
    def flexible(self) -> FlexibleDynamics:
        """The model with elastic drive trains, in base parameters on the link side."""
        n, size = self.dof, self.flexible_dof
        q, qd, qdd = (self.signal(name, size) for name in ("q", "qd", "qdd"))
        at_links = []
        for stacked in (q, qd, qdd):
            link = stacked[:n].copy()
            for k, joint in enumerate(self.elastic):
                link[joint] = stacked[joint] + stacked[n + k]
            at_links.append(link)
        chain = self.chain_at(at_links[0])
        effects = [self._past_the_spring(one) for one in self.effects]
        side = Dynamics(chain, effects, self.kept, at_links[1], at_links[2], strategies=self.strategies)
        return FlexibleDynamics(side, self.motor_effects, self.parameter_nodes, self.elastic, q, qd, qdd)

    def _past_the_spring(self, one: Instance) -> Instance:
        """An effect as the flexible model has it: the load of an elastic joint's link holds no rotor."""
        if "rotor" not in one.site.values or self.robot.moving.index(one.joint) not in self.elastic:
            return one
        return replace(one, site=replace(one.site, values={**one.site.values, "rotor": sympy.S.Zero}))

    def _payload(self) -> Body:
        nodes = self.signal("payload", len(INERTIAL_STEMS))
        return body(self.program, dict(zip(INERTIAL_STEMS, nodes, strict=True)))

    def variables(self, q: Array) -> dict[sympy.Symbol, Node]:
        """What the joints' variables stand for where the positions are ``q`` (n)."""
        return {joint.variable: q[index] for index, joint in enumerate(self.robot.moving)}


def _absorbed(robot: Robot, exact: Grouping, others: Sequence[str]) -> Grouping:
    """The grouping with effects in it, at the robot's lengths as numbers."""
    lengths = tuple(replace(one, symbolic=False) for one in robot.lengths)
    numeric = Model(replace(robot, lengths=lengths))
    columns = numeric.standard_columns
    pairs = [
        pair for one in numeric.effects if not one.effect.loads for pair in zip(one.names, one.columns(), strict=True)
    ]
    rubbing = {name for name, column in pairs if not accelerates(column)}
    read = {k for k, joint in enumerate(robot.moving) if _reads_load(numeric.effects, joint.number)}
    loading = {name for name, column in columns.items() if name not in rubbing and read & column.keys()}
    return absorbed(exact, others, numeric.sampled_columns(columns, {}), loading, rubbing)


def _reads_load(effects: Sequence[Instance], number: int) -> bool:
    return any("load" in one.effect.needs for one in effects if one.joint.number == number)
