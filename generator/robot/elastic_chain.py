"""The chain with twice the joints that elastic drive trains make (report section 2.3.3, Table 5).

Each elastic joint becomes a motor joint, which keeps the joint's geometry and carries a body without matter, and an
elastic joint on the same axis, which carries the link. The reduced model of report eq. 10 is the same motion.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import sympy

from generator.robot.description import FIXED, PRISMATIC, EffectUse, Joint, Robot


@dataclass(frozen=True)
class ElasticChain:
    """The expanded ``robot``; ``motor`` and ``link`` map a joint's number to its numbers in the expanded chain.

    A rigid joint has the same number in both.
    """

    robot: Robot
    motor: dict[int, int]
    link: dict[int, int]


def elastic_chain(robot: Robot, motor_effects: Sequence[str], spring: str) -> ElasticChain:
    """Expands the elastic joints of ``robot``.

    Every moving motor joint carries the effects named in ``motor_effects``, every elastic joint the effect ``spring``;
    the robot's other effects stay on the link side of their joints. Drives and parameter sets do not carry over.
    """
    joints: list[Joint] = []
    motor: dict[int, int] = {}
    link: dict[int, int] = {}
    for joint in robot.joints:
        antecedent = link.get(joint.antecedent, 0)
        motor[joint.number] = len(joints) + 1
        joints.append(_renumbered(joint, len(joints) + 1, antecedent))
        if joint.number in robot.flexible:
            joints.append(_elastic(joint, len(joints) + 1))
        link[joint.number] = len(joints)
    effects = [
        EffectUse(effect, tuple(motor[joint.number] for joint in robot.moving)) for effect in motor_effects
    ]
    if robot.flexible:
        effects.append(EffectUse(spring, tuple(link[number] for number in robot.flexible)))
    effects += [
        replace(use, joints=tuple(link[number] for number in use.joints))
        for use in robot.effects
        if use.effect not in motor_effects
    ]
    expanded = replace(
        robot,
        name=f"{robot.name}_elastic_chain",
        joints=tuple(joints),
        effects=tuple(effects),
        drives=None,
        flexible=(),
        parameter_sets={},
    )
    return ElasticChain(expanded, motor, link)


def _renumbered(joint: Joint, number: int, antecedent: int) -> Joint:
    """The joint under another number, its variable renamed with it."""
    if joint.sigma == FIXED:
        return replace(joint, number=number, antecedent=antecedent)
    variable = {joint.variable: sympy.Symbol(f"q{number}", real=True)}
    return replace(
        joint, number=number, antecedent=antecedent, theta=joint.theta.subs(variable), r=joint.r.subs(variable)
    )


def _elastic(joint: Joint, number: int) -> Joint:
    """The elastic joint on the axis of ``joint``, right behind its motor joint."""
    zero, variable = sympy.Integer(0), sympy.Symbol(f"q{number}", real=True)
    slides = joint.sigma == PRISMATIC
    return Joint(
        number=number,
        antecedent=number - 1,
        sigma=joint.sigma,
        alpha=zero,
        d=zero,
        theta=zero if slides else variable,
        r=variable if slides else zero,
        label=f"elastic {joint.number}",
    )
