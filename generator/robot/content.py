"""From the tree that a reader made to the robot it describes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from generator.robot import fields
from generator.robot.description import Joint, Length, Robot
from generator.robot.document import Node, digest
from generator.robot.names import robot_name
from generator.robot.sections.drives import drives
from generator.robot.sections.effects import effects, flexible
from generator.robot.sections.geometry import base, gravity, lengths
from generator.robot.sections.joints import joints
from generator.robot.sections.parameter_sets import parameter_sets
from generator.robot.sections.signals import signals

_REQUIRED = ("name", "gravity", "joints")
_OPTIONAL = ("description", "source", "base", "geometry", "drives", "effects", "flexible", "signals", "parameters")


def robot_from(node: Node) -> Robot:
    """The robot. Raises InputError, with its place, for the first thing that is not as a robot file must be."""
    keys = fields.table(node, "the robot", _REQUIRED, _OPTIONAL)
    name = robot_name(fields.text(keys["name"].value, "name"))
    named_lengths = lengths(keys.get("geometry"))
    all_joints = joints(keys["joints"], named_lengths)
    return Robot(
        name=name,
        description=fields.prose(keys.get("description"), "description"),
        source=fields.prose(keys.get("source"), "source"),
        gravity=gravity(keys["gravity"]),
        base=base(keys.get("base")),
        lengths=_by_use(named_lengths, all_joints),
        joints=all_joints,
        effects=effects(keys.get("effects"), all_joints),
        drives=drives(keys.get("drives"), all_joints),
        flexible=flexible(keys.get("flexible"), all_joints),
        parameter_sets=parameter_sets(keys.get("parameters")),
        place=node.place,
        digest=digest(node),
        signals=signals(keys.get("signals"), all_joints, "drives" in keys),
    )


def _by_use(lengths: Mapping[str, Length], joints: Sequence[Joint]) -> tuple[Length, ...]:
    """The lengths as the joint table meets them, unused ones last: the file's order of keys does not matter."""
    met: dict[str, None] = {}
    for joint in joints:
        for entry in (joint.gamma, joint.b, joint.alpha, joint.d, joint.theta, joint.r):
            met |= dict.fromkeys(sorted(symbol.name for symbol in entry.free_symbols if symbol.name in lengths))
    met |= dict.fromkeys(sorted(lengths))
    return tuple(lengths[name] for name in met)
