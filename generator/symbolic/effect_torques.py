"""Torques and energies of the effects as nodes: what the effects' files say in symbols, lowered once."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

import sympy

from generator.effects.effect import Column
from generator.effects.library import Instance, states_of
from generator.symbolic.frames import Chain
from generator.symbolic.lowering import lower
from generator.symbolic.statements import Node
from generator.symbolic.vectors import Array, Nodes, zeros

#: Input signals of what effects read beside the motion.
STATES, WARMTH = "states", "warmth"


@dataclass(frozen=True)
class JointMotion:
    """Nodes of the joints' positions, speeds and accelerations (n each), and elastic coordinates by joint number.

    ``others`` are further symbols that effects read, by name: loads, warmth, their own states.
    """

    q: Nodes
    qd: Nodes
    qdd: Nodes
    elongation: Mapping[int, Node]
    others: Mapping[str, Node] = field(default_factory=dict)

    def symbols(self, chain: Chain) -> dict[sympy.Symbol, Node]:
        """The effects' symbols q1, qd1, qdd1, qe1 ... with their nodes."""
        values: dict[sympy.Symbol, Node] = {}
        for index, joint in enumerate(chain.robot.moving):
            for stem, signal in (("q", self.q), ("qd", self.qd), ("qdd", self.qdd)):
                values[sympy.Symbol(f"{stem}{joint.number}", real=True)] = signal[index]
        for number, node in self.elongation.items():
            values[sympy.Symbol(f"qe{number}", real=True)] = node
        return values | {sympy.Symbol(name, real=True): node for name, node in self.others.items()}


def reads(instances: Iterable[Instance], what: str) -> bool:
    """Whether an effect needs ``what``: load, warmth, state."""
    return any(what in instance.effect.needs for instance in instances)


def inputs(chain: Chain, instances: Iterable[Instance]) -> dict[str, Node]:
    """What effects read beside the motion, as inputs of the functions: their states in order, warmth joint by joint."""
    result = {one.name: chain.program.input(STATES, k) for k, one in enumerate(states_of(instances))}
    if reads(instances, "warmth"):
        for k, joint in enumerate(chain.robot.moving):
            result[f"warmth{joint.number}"] = chain.program.input(WARMTH, k)
    return result


def rates(chain: Chain, instances: Iterable[Instance], motion: JointMotion) -> list[Node]:
    """Time derivatives of the effects' states, in their order."""
    values = motion.symbols(chain)
    return [lower(chain.program, one.rate, values) for one in states_of(instances)]


def columns(chain: Chain, instances: Iterable[Instance], motion: JointMotion) -> dict[str, dict[int, Node]]:
    """Regressor columns by parameter name, each {coordinate: torque per unit parameter}."""
    values = motion.symbols(chain)
    result: dict[str, dict[int, Node]] = {}
    for instance in instances:
        for name, column in zip(instance.names, instance.columns(), strict=True):
            result[name] = _lowered(chain, column, values)
    return result


def torques(chain: Chain, instances: Iterable[Instance], motion: JointMotion, parameters: Mapping[str, Node]) -> Array:
    """Torque of the effects on each joint; parameters that are absent have no effect."""
    total = zeros(chain.program, chain.dof)
    for name, column in columns(chain, instances, motion).items():
        if name in parameters:
            for coordinate, entry in column.items():
                total[coordinate] = total[coordinate] + parameters[name] * entry
    return total


def inertia(chain: Chain, instances: Iterable[Instance], motion: JointMotion, parameters: Mapping[str, Node]) -> Array:
    """What the effects add to the inertia matrix (n x n): their torque per unit joint acceleration.

    Friction by load is left out: it is not affine in the acceleration.
    """
    values = motion.symbols(chain)
    total = zeros(chain.program, chain.dof, chain.dof)
    accelerations = [sympy.Symbol(f"qdd{joint.number}", real=True) for joint in chain.robot.moving]
    for instance in instances:
        if "load" in instance.effect.needs:
            continue
        for name, column in zip(instance.names, instance.columns(), strict=True):
            if name not in parameters:
                continue
            for k, acceleration in enumerate(accelerations):
                slope = {j: sympy.diff(torque, acceleration) for j, torque in column.items()}
                for coordinate, entry in _lowered(chain, slope, values).items():
                    total[coordinate, k] = total[coordinate, k] + parameters[name] * entry
    return total


def energy(
    chain: Chain, instances: Iterable[Instance], kind: str, motion: JointMotion, parameters: Mapping[str, Node]
) -> Node:
    """Energy of the effects [J]; ``kind`` is "kinetic_energy" or "potential_energy"."""
    values = motion.symbols(chain)
    total = chain.program.zero
    for instance in instances:
        of_unit = getattr(instance.effect, kind)
        if of_unit is None:
            continue
        for name, expression in zip(instance.names, of_unit(instance.site), strict=True):
            if name in parameters:
                total = total + parameters[name] * lower(chain.program, expression, values)
    return total


def _lowered(chain: Chain, column: Column, values: Mapping[sympy.Symbol, Node]) -> dict[int, Node]:
    coordinates = {joint.number: index for index, joint in enumerate(chain.robot.moving)}
    entries = {coordinates[j]: lower(chain.program, torque, values) for j, torque in column.items() if torque != 0}
    return dict(sorted(entries.items()))
