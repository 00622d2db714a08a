"""Section ``joints``: the table of the modified Denavit-Hartenberg parameters, checked as a tree."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import sympy

from generator.errors import InputError, Place
from generator.robot import fields
from generator.robot.description import FIXED, PRISMATIC, REVOLUTE, Joint, Length
from generator.robot.document import Entry, Node
from generator.robot.sections.placement import constant, sum_with_variable

_REQUIRED = ("j", "sigma", "alpha", "d", "theta", "r")
#: What limits a joint either way: its units, revolute and prismatic.
_EITHER_WAY = {
    "speed_limit": ("rad/s", "m/s"),
    "acceleration_limit": ("rad/s2", "m/s2"),
    "torque_limit": ("N m", "N"),
}
_OPTIONAL = ("antecedent", "gamma", "b", "limits", *_EITHER_WAY, "tool", "label")
_LABEL = re.compile(r"[A-Za-z0-9_]{1,16}\Z", re.ASCII)
_SIGMA = "0 (revolute), 1 (prismatic) or 2 (fixed)"


@dataclass(frozen=True)
class _Located:
    joint: Joint
    place: Place
    antecedent: Place
    tool: Place


def joints(entry: Entry, lengths: Mapping[str, Length]) -> tuple[Joint, ...]:
    """The joints in order.

    Raises InputError for a row that is not a joint's, for numbers that are not 1, 2, 3 ..., for antecedents with a
    cycle or a gap, for a second tool and for a robot of which nothing moves.
    """
    rows: list[_Located] = []
    for node in fields.items(entry.value, "joints", of="joints"):
        rows.append(_row(node, lengths, rows))
    _check_antecedents(rows)
    _check_tool(rows)
    if all(row.joint.sigma == FIXED for row in rows):
        raise InputError(entry.value.place, "no joint moves", "at least one revolute or prismatic joint")
    return tuple(row.joint for row in rows)


def moving_joints(node: Node, what: str, all_joints: Sequence[Joint]) -> tuple[int, ...]:
    """Numbers of moving joints, from a list or the word ``all``; InputError for any other and for one given twice."""
    moving = [joint.number for joint in all_joints if joint.sigma != FIXED]
    if getattr(node, "content", None) == "all":
        return tuple(moving)
    found: list[int] = []
    for item in fields.items(node, what, of="joint numbers, or all"):
        number = moving_joint(item, what, all_joints)
        if number in found:
            raise InputError(item.place, f"{what}: joint {number} is given twice", "it once")
        found.append(number)
    return tuple(found)


def moving_joint(node: Node, what: str, all_joints: Sequence[Joint]) -> int:
    """The number of a moving joint."""
    moving = [joint.number for joint in all_joints if joint.sigma != FIXED]
    expected = f"a moving joint, one of {', '.join(map(str, moving))}"
    number = fields.integer(node, what, expected)
    if number not in moving:
        known = any(joint.number == number for joint in all_joints)
        raise InputError(node.place, f"{what}: joint {number} {'is fixed' if known else 'does not exist'}", expected)
    return number


def _row(node: Node, lengths: Mapping[str, Length], rows: Sequence[_Located]) -> _Located:
    keys = fields.table(node, "joint", _REQUIRED, _OPTIONAL)
    number = _number(keys["j"].value, rows)
    name = f"joint {number}"
    sigma = fields.integer(keys["sigma"].value, f"sigma of {name}", _SIGMA)
    if sigma not in (REVOLUTE, PRISMATIC, FIXED):
        raise InputError(keys["sigma"].value.place, f"sigma of {name} is {sigma}", _SIGMA)

    def placed(key: str, unit: str, moved_by: int | None = None) -> sympy.Expr:
        if key not in keys:
            return sympy.Integer(0)
        what = f"{key} of {name}"
        if sigma == moved_by:
            return sum_with_variable(keys[key].value, what, unit, lengths, f"q{number}")
        return constant(keys[key].value, what, unit, lengths)

    lower, upper = _limits(keys.get("limits"), name, sigma)
    antecedent = keys.get("antecedent")
    joint = Joint(
        number=number,
        antecedent=fields.integer(antecedent.value, f"antecedent of {name}") if antecedent else number - 1,
        sigma=sigma,
        alpha=placed("alpha", "rad"),
        d=placed("d", "m"),
        theta=placed("theta", "rad", REVOLUTE),
        r=placed("r", "m", PRISMATIC),
        gamma=placed("gamma", "rad"),
        b=placed("b", "m"),
        lower=lower,
        upper=upper,
        **{key: _limit(keys.get(key), f"{key} of {name}", sigma, units) for key, units in _EITHER_WAY.items()},
        tool=fields.boolean(keys["tool"].value, f"tool of {name}") if "tool" in keys else False,
        label=_label(keys.get("label"), name),
    )
    tool = keys["tool"].value.place if "tool" in keys else node.place
    return _Located(joint, keys["j"].value.place, antecedent.value.place if antecedent else node.place, tool)


def _number(node: Node, rows: Sequence[_Located]) -> int:
    number = fields.integer(node, "j", "the joint's number")
    for row in rows:
        if row.joint.number == number:
            raise InputError(node.place, f"joint {number} is given twice", f"it once (line {row.place.line})")
    if number != len(rows) + 1:
        raise InputError(node.place, f"joint {number} comes in place {len(rows) + 1}", f"joint {len(rows) + 1}")
    return number


def _limits(entry: Entry | None, name: str, sigma: int) -> tuple[sympy.Expr | None, sympy.Expr | None]:
    if entry is None:
        return None, None
    if sigma == FIXED:
        raise InputError(entry.key, f"limits on fixed {name}", "limits on moving joints only")
    what, unit = f"limits of {name}", "m" if sigma == PRISMATIC else "rad"
    lower, upper = (fields.sized_quantity(item, what, unit) for item in fields.items(entry.value, what, 2, "limits"))
    if not float(lower) < float(upper):
        raise InputError(entry.value.place, f"{what} are not in order", "the lower, then the higher limit")
    return lower, upper


def _limit(entry: Entry | None, what: str, sigma: int, units: tuple[str, str]) -> sympy.Expr | None:
    if entry is None:
        return None
    if sigma == FIXED:
        raise InputError(entry.key, f"{what}, which is fixed", "limits on moving joints only")
    value = fields.sized_quantity(entry.value, what, units[sigma == PRISMATIC])
    if not float(value) > 0:
        raise InputError(entry.value.place, f"{what} is {float(value):g}", "a positive limit, which holds either way")
    return value


def _label(entry: Entry | None, name: str) -> str:
    if entry is None:
        return ""
    label = fields.text(entry.value, f"label of {name}").content
    if not _LABEL.match(label):
        raise InputError(entry.value.place, f"label of {name} is {label!r}", "up to 16 letters, digits and _")
    return label


def _check_antecedents(rows: Sequence[_Located]) -> None:
    for row in rows:
        number, antecedent = row.joint.number, row.joint.antecedent
        what, earlier = f"antecedent {antecedent} of joint {number}", f"a number from 0 to {number - 1}"
        if not 0 <= antecedent <= len(rows):
            raise InputError(row.antecedent, f"{what} does not exist", earlier)
        if cycle := _cycle(number, rows):
            path = " -> ".join(map(str, cycle))
            raise InputError(row.antecedent, f"the antecedents go in a cycle, {path}", "a chain or tree that ends at 0")
        if antecedent > number:
            raise InputError(row.antecedent, f"{what} comes after it", earlier)


def _cycle(number: int, rows: Sequence[_Located]) -> list[int]:
    """The way from joint ``number`` along the antecedents back to itself; empty if it does not lead there."""
    path = [number]
    while len(path) <= len(rows):
        following = rows[path[-1] - 1].joint.antecedent
        if not 0 < following <= len(rows):
            return []
        path.append(following)
        if following == number:
            return path
    return []


def _check_tool(rows: Sequence[_Located]) -> None:
    tools = [row for row in rows if row.joint.tool]
    for tool in tools:
        if tool.joint.sigma != FIXED:
            raise InputError(tool.tool, f"joint {tool.joint.number} is a tool and moves", "a tool with sigma 2")
    if len(tools) > 1:
        raise InputError(tools[1].tool, f"joint {tools[1].joint.number} is a second tool", "one tool")
    for row in rows:
        if tools and row.joint.antecedent == tools[0].joint.number:
            raise InputError(row.antecedent, f"joint {row.joint.number} hangs on the tool", "nothing on a tool")
