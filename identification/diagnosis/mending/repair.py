"""What was found goes into the robot file: the text with every addition in its place, all the rest as it was."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import groupby

import numpy as np
import sympy
from scipy.spatial.transform import Rotation

from generator.effects.effect import Effect
from generator.effects.library import library
from generator.effects.rotor_inertia import EFFECT as ROTOR
from generator.errors import InputError
from generator.robot.description import Joint, Robot
from generator.robot.sections.drives import element
from generator.robot.signal_units import signal_unit
from generator.words import listed, numbered
from identification.corrections import NEVER, by_time
from identification.diagnosis.columns.hypothesis import (
    BASE,
    BODY,
    DRIVE,
    EFFECT,
    ELASTIC,
    LENGTH,
    LOAD,
    SHAPE,
    SIGNAL,
    VALUE,
)
from identification.diagnosis.mending.addition import Addition
from identification.robot_file import written
from identification.robot_text import keys_of, robot_of, value_of, with_entries, with_item, with_value

#: What a correction is where the file says nothing.
_NEUTRAL = {
    "position_offset": 0.0,
    "torque_gain": 1.0,
    "torque_delay": 0.0,
    "link_delay": 0.0,
    "current_limit": NEVER,
    "warm_up_time": NEVER,
    "warm_rise": NEVER,
    "warm_torque": NEVER,
}
#: What tells a drive's warmth.
_WARMTH = ("warm_up_time", "warm_rise", "warm_torque")
#: Corrections that replace what the file says; the others are added to it, a gain multiplies it.
_REPLACING = ("current_limit", *_WARMTH)

_PRODUCT = re.compile(r"-?[\w./*]+\Z", re.ASCII)


@dataclass(frozen=True)
class Repaired:
    """The text of the new robot file, the robot that it describes, and what could not be written or needs saying."""

    text: str
    robot: Robot
    notes: tuple[str, ...]


def repaired(text: str, file: str, additions: Sequence[Addition]) -> Repaired:
    """The robot file ``text`` with all additions; an effect on joints with the same values and evidence is one entry.

    ``file`` is its name in messages. An effect that a joint has already is left as it is, and told.

    Raises InputError where the text is no robot file, before or after, and for what needs drives that it lacks.
    """
    notes: list[str] = []
    for one in _grouped(additions, robot_of(text, file)):
        text, said = _ADDING[one.kind](text, robot_of(text, file), one)
        notes += said
    robot = robot_of(text, file)
    return Repaired(text, robot, (*notes, *_of_one_warmth(additions, robot)))


def _grouped(additions: Sequence[Addition], robot: Robot) -> list[Addition]:
    """Effects with the same values, units too, and evidence put together, in the order of their first."""

    def key(one: Addition) -> tuple[object, ...]:
        if one.kind != EFFECT:
            return one.kind, one.effect, one.joints
        joint = robot.joints[one.joints[0] - 1]
        units = {shape.name: shape.unit_on(joint) for shape in library()[one.effect].shapes}
        values = sorted((name, written(value), units.get(name, "")) for name, value in one.values.items())
        return one.kind, one.effect, one.evidence, *values

    first = {key(one): k for k, one in reversed([*enumerate(additions)])}
    result = []
    # An elastic drive train brings a rotor only where none was found by itself.
    for _, group in groupby(sorted(additions, key=lambda one: (one.kind == ELASTIC, first[key(one)])), key):
        each = list(group)
        joints = tuple(sorted({joint for one in each for joint in one.joints}))
        amplitude = {joint: rms for one in each for joint, rms in one.amplitude.items()}
        result.append(replace(each[0], joints=joints, amplitude=amplitude))
    return result


def _of_one_warmth(additions: Sequence[Addition], robot: Robot) -> list[str]:
    """Of what was found by another warmth of a drive than the one that is written."""
    notes = []
    for one in (each for each in additions if each.kind != SIGNAL):
        for k, joint in enumerate(robot.moving):
            if joint.number in one.joints and not as_written(one, robot, k):
                notes.append(
                    f"{one.effect} of joint {joint.number} was found by another warmth than section signals now tells: "
                    "a drive has one, and something else of this joint goes by that"
                )
    return notes


def as_written(one: Addition, robot: Robot, k: int) -> bool:
    """Whether what was found on coordinate k is by the warmth of its drive that the file tells."""
    if "warm_up_time" not in one.values:
        return True
    for key in _WARMTH:
        told: Sequence[sympy.Expr] = getattr(robot.signals, key)
        if written(one.values.get(key, NEVER)) != written(float(told[k]) if told else NEVER):
            return False
    return True


def _add_effect(text: str, robot: Robot, one: Addition) -> tuple[str, list[str]]:
    effect = library()[one.effect]
    there = [j for j in one.joints if robot.has(one.effect, j)]
    new = [j for j in one.joints if j not in there]
    notes = [f"joint {j} has the effect {one.effect} already; the file's stays" for j in there]
    if not new:
        return text, notes
    if "warm_up_time" in one.values:
        cold = [j.number for k, j in enumerate(robot.moving) if j.number in new and not by_time(robot, k)]
        text = _with_signal(text, robot, "warm_up_time", one.values["warm_up_time"], cold) if cold else text
    where = f"joint: {new[0]}" if len(new) == 1 else f"joints: [{', '.join(map(str, new))}]"
    values = _values(effect, robot.joints[new[0] - 1], one.values)
    entry = f"{{effect: {one.effect}, {where}{f', values: {{{values}}}' if values else ''}}}"
    return with_item(text, "effects", entry, _comment(robot, one)), notes


def _comment(robot: Robot, one: Addition) -> str:
    """``title, firm: rms torque 5 N m on joint 1``."""
    units = {joint.number: joint.torque_unit for joint in robot.moving}
    sizes = ", ".join(f"{rms:.3g} {units[joint]} on joint {joint}" for joint, rms in sorted(one.amplitude.items()))
    return _plain(f"{one.evidence}: rms torque {sizes}" if sizes else one.evidence)


def _values(effect: Effect, joint: Joint, shape: Mapping[str, float]) -> str:
    there = [each for each in effect.shapes if each.name in shape]
    return ", ".join(f"{one.name}: {_with_unit(shape[one.name], one.unit_on(joint))}" for one in there)


def _add_signal(text: str, robot: Robot, one: Addition) -> tuple[str, list[str]]:
    for key, value in one.values.items():
        text = _with_signal(text, robot, key, value, one.joints)
    note = f"{one.effect} is in section signals of the robot file: it corrects recorded runs, generated code lacks it"
    return text, [note]


def _with_signal(text: str, robot: Robot, key: str, value: float, joints: Sequence[int]) -> str:
    """The value of a key of ``signals`` changed for some joints."""
    old: Sequence[sympy.Expr] = getattr(robot.signals, key)
    units = [signal_unit(key, joint, robot.drives is not None) for joint in robot.moving]
    changed = {}
    for k in (robot.numbers.index(number) for number in joints):
        was = float(old[k]) if old else _NEUTRAL[key]
        now = value if key in _REPLACING else was * value if key == "torque_gain" else was + value
        changed[k] = _with_unit(now, units[k])
    return with_entries(text, ("signals", key), changed, [_with_unit(_NEUTRAL[key], unit) for unit in units])


def _add_drive(text: str, robot: Robot, one: Addition) -> tuple[str, list[str]]:
    drives = robot.drives
    if drives is None or (one.effect == "torque_drift" and not drives.torque_constants):
        lack = "drives" if drives is None else "torque constants"
        raise InputError(robot.place, f"{robot.name} has no {lack}", f"{lack} in the robot file")
    if one.effect == "gear_ratio":
        for number in one.joints:
            text = _with_ratio(text, robot, number, one.values["gear_ratio"])
        return text, [f"gear_ratio is in section drives of the robot file, changed on {numbered('joint', one.joints)}"]
    drift = {
        k: written(one.values["torque_drift"] + (float(drives.torque_drift[k]) if drives.torque_drift else 0.0))
        for k in (robot.numbers.index(number) for number in one.joints)
    }
    text = with_entries(text, ("drives", "torque_drift"), drift, ["0"] * len(robot.moving))
    for key, value in one.values.items():
        if key != "torque_drift":
            text = _with_signal(text, robot, key, value, one.joints)
    return text, ["torque_drift is in sections drives and signals of the robot file"]


def _with_ratio(text: str, robot: Robot, joint: int, factor: float) -> str:
    """Column ``joint`` of N times ``factor``, by its ratio and what the file's convention makes of the coupling."""
    k = robot.numbers.index(joint)
    text = _times(text, ("drives", "gear_ratios", k), f"*{factor:.9g}")
    entries = keys_of(text, ("drives", "coupling"))
    convention = "row"
    if "convention" in entries:
        convention = value_of(text, ("drives", "coupling", "convention"))
    for key in entries:
        if (pair := element(key)) is None or convention == "as_printed":
            continue
        row, column = pair
        if column == joint:
            text = _times(text, ("drives", "coupling", key), f"*{factor:.9g}")
        elif row == joint and convention == "row":
            text = _times(text, ("drives", "coupling", key), f"/{factor:.9g}")
    return text


def _times(text: str, path: Sequence[str | int], factor: str) -> str:
    old = value_of(text, path)
    return with_value(text, path, f"{old if _PRODUCT.match(old) else f'({old})'}{factor}")


def _add_base(text: str, robot: Robot, one: Addition) -> tuple[str, list[str]]:
    turn = Rotation.from_rotvec([one.values.get(f"tilt_{axis}", 0.0) for axis in "xyz"])
    pose = Rotation.from_matrix(np.array(robot.base[:3, :3].evalf(), dtype=float))
    angles = ", ".join(f"{angle:.9g} rad" for angle in (turn * pose).as_euler("xyz").tolist())
    return with_value(text, ("base", "rotation"), f"[{angles}]"), [
        "the tilt of the base is in section base of the robot file"
    ]


def _add_length(text: str, robot: Robot, one: Addition) -> tuple[str, list[str]]:
    """To the length of which it is so much, where nobody else has that; else into the joint."""
    (number,), ((field, longer),) = one.joints, one.values.items()
    length: sympy.Expr = getattr(robot.joints[number - 1], field)
    stated = float(length.subs(robot.geometry))
    path: list[str | int] = ["joints", number - 1, field]
    others = [
        getattr(each, key) for each in robot.joints for key in ("b", "d", "r") if (each.number, key) != (number, field)
    ]
    factor, name = length.as_coeff_Mul()
    if name.is_Symbol and not any(each.has(name) for each in others):
        path = ["geometry", str(name)]
        path += ["nominal"] if any(each.symbolic for each in robot.lengths if each.name == str(name)) else []
    else:
        factor = sympy.S.One
    text = with_value(text, path, _with_unit((stated + longer) / float(factor), "m"))
    return text, [
        f"the length {field} of joint {number} is {stated + longer:.4g} m in the robot file, not {stated:.4g} m"
    ]


def _add_shape(text: str, robot: Robot, one: Addition) -> tuple[str, list[str]]:
    """Into the entry that one joint has; from an entry of several joints into one of its own."""
    (number,) = one.joints
    use = robot.use(one.effect, number)
    k = robot.effects.index(use)
    note = f"{one.effect} of joint {number} has another shape in the robot file than before"
    if use.joints != (number,):
        others = ", ".join(str(joint) for joint in use.joints if joint != number)
        text = with_value(text, ("effects", k, "joints"), f"[{others}]")
        text, _ = _add_effect(text, robot_of(text, robot.place.file), replace(one, kind=EFFECT))
        return text, [note]
    joint = robot.joints[number - 1]
    for shape in (each for each in library()[one.effect].shapes if each.name in one.values):
        if not (shape.name in use.values and float(use.values[shape.name].value) == one.values[shape.name]):
            value = _with_unit(one.values[shape.name], shape.unit_on(joint))
            text = with_value(text, ("effects", k, "values", shape.name), value)
    return text, [note]


def _add_elastic(text: str, robot: Robot, one: Addition) -> tuple[str, list[str]]:
    joints = sorted({*robot.flexible, *one.joints})
    if joints != sorted(robot.flexible):
        text = with_value(text, ("flexible",), f"[{', '.join(map(str, joints))}]")
    notes = [
        f"the drive train of {numbered('joint', one.joints)} is elastic in the flexible model; on the untouched runs "
        "its swing is integrated with what was found, beside the generated inverse dynamics of rigid joints"
    ]
    for number in one.joints:
        if one.parameters.get(f"Iam{number}") and not robot.has(ROTOR.id, number):
            rotor = Addition(EFFECT, ROTOR.id, (number,), evidence=f"{ROTOR.title}, by how the link swings")
            text, _ = _add_effect(text, robot, rotor)
            robot = robot_of(text, robot.place.file)
            notes.append(f"{ROTOR.id} of joint {number} comes with it: its part of the inertia is told by the swing")
    if one.values.get("gap"):
        text, more = _add_gap(text, robot, replace(one, kind=EFFECT, effect="joint_elasticity", parameters={}))
        notes += more
    return text, notes


def _add_gap(text: str, robot: Robot, one: Addition) -> tuple[str, list[str]]:
    """Into the entry that one joint has without a gap; from an entry of several joints into one of its own."""
    (number,) = one.joints
    for k, use in enumerate(robot.effects):
        if use.effect != one.effect or number not in use.joints or "gap" in use.values:
            continue
        if use.joints == (number,):
            values = _values(library()[one.effect], robot.joints[number - 1], one.values)
            text = with_value(text, ("effects", k, "values"), f"{{{values}}}")
            return text, [f"joint {number} has the effect {one.effect} already; its gap is written there"]
        others = ", ".join(str(joint) for joint in use.joints if joint != number)
        text = with_value(text, ("effects", k, "joints"), f"[{others}]")
        robot = robot_of(text, robot.place.file)
    return _add_effect(text, robot, one)


def _add_body(text: str, robot: Robot, one: Addition) -> tuple[str, list[str]]:
    return text, ["the payload is held by base parameters of the new set; the robot file gets no body for it"]


def _of_sidecars(text: str, robot: Robot, one: Addition) -> tuple[str, list[str]]:
    return text, ["another payload than the stated one is none of the robot: its file and the new set hold none of it"]


def _keep(text: str, robot: Robot, one: Addition) -> tuple[str, list[str]]:
    return text, [f"the new set has {listed(one.values)} with what was found: the robot file has the effect already"]


_ADDING: Mapping[str, Callable[[str, Robot, Addition], tuple[str, list[str]]]] = {
    EFFECT: _add_effect,
    SIGNAL: _add_signal,
    DRIVE: _add_drive,
    BASE: _add_base,
    ELASTIC: _add_elastic,
    SHAPE: _add_shape,
    LENGTH: _add_length,
    BODY: _add_body,
    VALUE: _keep,
    LOAD: _of_sidecars,
}


def _with_unit(value: float, unit: str) -> str:
    return written(value) if unit == "1" else f"{written(value)} {unit}"


def _plain(text: str) -> str:
    """One line."""
    return " ".join(text.split())
