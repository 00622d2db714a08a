"""Sections ``geometry``, ``gravity`` and ``base``: named lengths, free fall, where the robot stands."""

from __future__ import annotations

import math
import re

import sympy

from generator.errors import InputError
from generator.robot import fields, rounding
from generator.robot.description import Length
from generator.robot.document import Entry, Node, Table, Text
from generator.robot.names import identifier
from generator.robot.parameters import INERTIAL_STEMS

_STEMS = "|".join([*INERTIAL_STEMS, "kt"])
_PARAMETER = re.compile(rf"(?:{_STEMS})\d+R?\Z", re.IGNORECASE)
_VARIABLE = re.compile(r"(?:q|qd|qdd|qm|qe|qa|tau)\d*\Z")
_SIGNALS = ("pi", "wrench", "payload", "parameters", "standard_parameters")


def lengths(entry: Entry | None) -> dict[str, Length]:
    """The named lengths and angles of ``geometry``.

    Raises InputError for a name that the generated code or the model uses otherwise and for a value without a unit, too
    large (``fields.check_size``) or rounded (``rounding``). Whether a name is that of an effect's parameter is checked
    against the library of effects, not here.
    """
    found: dict[str, Length] = {}
    for key, one in fields.named(entry.value, "geometry").items() if entry else ():
        name = _name(Text(key, one.key), found)
        found[name] = _length(name, one)
    return found


def _name(text: Text, found: dict[str, Length]) -> str:
    name = identifier(text, "length")
    if _VARIABLE.match(name) or name in _SIGNALS:
        raise InputError(text.place, f"length {name!r} has the name of a variable", "another name")
    if _PARAMETER.match(name):
        raise InputError(text.place, f"length {name!r} has the name of a parameter", "another name")
    for other in found:
        if other.lower() == name.lower():
            raise InputError(text.place, f"length {name!r} differs from {other!r} in case alone", "another name")
    return name


def _length(name: str, entry: Entry) -> Length:
    symbolic, node = False, entry.value
    if isinstance(node, Table):
        keys = fields.table(node, f"length {name}", ("nominal", "symbolic"))
        symbolic = fields.boolean(keys["symbolic"].value, f"symbolic of {name}")
        node = keys["nominal"].value
    value = fields.quantity(node, f"length {name}", None)
    units = "m, cm or mm for a length, rad, mrad or deg for an angle"
    if value.unit == "1":
        raise InputError(value.place, f"length {name} has no unit", units)
    if value.unit not in ("m", "rad"):
        raise InputError(value.place, f"length {name} is in {value.unit}", units)
    fields.check_size(value.place, f"length {name}", value.value, any_small=True)
    (rounding.check_length if value.unit == "m" else rounding.check_angle)(value.place, name, value.value)
    return Length(name, value.value, value.unit, symbolic, entry.key)


def gravity(entry: Entry) -> tuple[sympy.Expr, sympy.Expr, sympy.Expr]:
    """Acceleration of free fall in the world frame [m/s2]; raises InputError for what no world has."""
    parts = _vector(entry.value, "gravity", "m/s2", "accelerations")
    size = math.hypot(*map(float, parts))
    for node, part in zip(fields.items(entry.value, "gravity"), parts, strict=True):
        rounding.check_gravity(node.place, part, size)
    return parts


def base(entry: Entry | None) -> sympy.ImmutableMatrix:
    """Pose of frame 0 in the world frame, 4 x 4: roll, pitch, yaw about the world's fixed x, y, z, and the position."""
    if entry is None:
        return sympy.ImmutableMatrix(sympy.eye(4))
    keys = fields.table(entry.value, "base", optional=("rotation", "translation"))
    pose = sympy.eye(4)
    if "rotation" in keys:
        node = keys["rotation"].value
        roll, pitch, yaw = _vector(node, "rotation", "rad", "angles")
        for item, angle in zip(fields.items(node, "rotation"), (roll, pitch, yaw), strict=True):
            rounding.check_angle(item.place, "rotation", angle)
        # sympy's rot_axis turn the axes rather than the vector, hence the signs
        pose[:3, :3] = sympy.rot_axis3(-yaw) * sympy.rot_axis2(-pitch) * sympy.rot_axis1(-roll)
    if "translation" in keys:
        pose[:3, 3] = sympy.Matrix(_vector(keys["translation"].value, "translation", "m", "lengths"))
    return sympy.ImmutableMatrix(pose)


def _vector(node: Node, what: str, unit: str, of: str) -> tuple[sympy.Expr, sympy.Expr, sympy.Expr]:
    x, y, z = (fields.sized_quantity(item, what, unit) for item in fields.items(node, what, 3, of))
    return x, y, z
