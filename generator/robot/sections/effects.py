"""Sections ``effects`` and ``flexible``: what adds torque to the rigid chain, and which drive trains are elastic."""

from __future__ import annotations

from collections.abc import Sequence

from generator.errors import InputError
from generator.robot import fields
from generator.robot.description import EffectUse, Joint
from generator.robot.document import Entry, Node
from generator.robot.sections.joints import moving_joint, moving_joints


def effects(entry: Entry | None, joints: Sequence[Joint]) -> tuple[EffectUse, ...]:
    """The uses of effects in the order of the file.

    Raises InputError for a use without joints or with joints that do not move; whether the effect and its values exist
    is checked against the library of effects, not here.
    """
    if entry is None:
        return ()
    return tuple(_use(node, joints) for node in fields.items(entry.value, "effects", of="effects"))


def _use(node: Node, joints: Sequence[Joint]) -> EffectUse:
    keys = fields.table(node, "effect", ("effect",), ("joint", "joints", "values"))
    effect = fields.text(keys["effect"].value, "effect", "the name of an effect")
    if ("joint" in keys) == ("joints" in keys):
        problem = "both joint and joints" if "joint" in keys else "neither joint nor joints"
        raise InputError(node.place, f"effect {effect.content!r} has {problem}", "one of them")
    if "joint" in keys:
        numbers: tuple[int, ...] = (moving_joint(keys["joint"].value, "joint of the effect", joints),)
    else:
        numbers = moving_joints(keys["joints"].value, "joints of the effect", joints)
        if not numbers:
            place = keys["joints"].value.place
            raise InputError(place, f"effect {effect.content!r} has no joint", "one at least, or all")
    given = fields.named(keys["values"].value, "values") if "values" in keys else {}
    values = {name: fields.quantity(one.value, f"value {name}", None) for name, one in given.items()}
    return EffectUse(effect.content, numbers, values, effect.place)


def flexible(entry: Entry | None, joints: Sequence[Joint]) -> tuple[int, ...]:
    """Numbers of the joints with an elastic drive train, in order."""
    if entry is None:
        return ()
    return tuple(sorted(moving_joints(entry.value, "flexible", joints)))
