"""What was found goes into the robot file: the text with every addition in its place, all the rest as it was."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import groupby

import numpy as np
from numpy.typing import NDArray

from generator.effects.effect import Effect
from generator.effects.library import library
from generator.robot.description import PRISMATIC, Drives, Joint, Robot
from identification.diagnosis.hypothesis import BASE, BODY, DRIVE, EFFECT, ELASTIC, SIGNAL
from identification.robot_text import robot_of, with_item, with_value

Array = NDArray[np.float64]

#: Corrections that replace what the file says; the others are added to it, a gain and a ratio multiply it.
_REPLACING = ("current_limit", "warm_up_time", "warm_rise")
#: What a correction is where the file says nothing; one that is replaced has no such value.
_NEUTRAL = {"position_offset": 0.0, "torque_gain": 1.0, "torque_delay": 0.0, "link_delay": 0.0}
_UNITS = {"torque_delay": "s", "link_delay": "s", "current_limit": "A", "warm_up_time": "s", "warm_rise": "K"}
#: What a joint has that nothing limits or warms.
_NEVER = 1e9
#: Time constant of the warmth [s] that effects of the library are tried with, written where the file says none.
WARM_UP_TIME = 60.0


@dataclass(frozen=True)
class Addition:
    """A finding as it goes into the robot file; ``kind`` as in ``hypothesis``, ``evidence`` a line for people.

    ``shape`` holds values of the effect in the file [SI]. ``values`` of what is no effect are, by ``kind``:

    - SIGNAL: ``effect`` is the key of section ``signals``, with its value for the joints: an offset or a delay is added
      to the file's, a gain multiplies it, a limit, time or rise replaces it.
    - DRIVE: ``gear_ratios``, a factor of the joints' ratios; ``torque_drift``, added to the motors'.
    - BASE: ``roll``, ``pitch``, ``yaw`` [rad] about the world's fixed axes, after the file's rotation.

    ELASTIC makes the joints' drive trains elastic, with ``gap`` in ``shape`` where there is backlash. BODY is a payload
    that base parameters hold: the file's text does not change.
    """

    kind: str
    effect: str
    joints: tuple[int, ...]
    shape: Mapping[str, float] = field(default_factory=dict)
    values: Mapping[str, float] = field(default_factory=dict)
    evidence: str = ""


@dataclass(frozen=True)
class Repaired:
    """The text of the new robot file, the robot that it describes, and what could not be written or needs saying."""

    text: str
    robot: Robot
    notes: tuple[str, ...]


def repaired(text: str, file: str, additions: Sequence[Addition]) -> Repaired:
    """The robot file ``text`` with all additions; an effect on several joints with the same values is one entry.

    ``file`` is its name in messages. An effect that a joint has already is left as it is, and told.

    Raises InputError where the text is no robot file, before or after.
    """
    notes: list[str] = []
    for one in _grouped(additions):
        text, said = _ADDING[one.kind](text, robot_of(text, file), one)
        notes += said
    return Repaired(text, robot_of(text, file), tuple(notes))


def _grouped(additions: Sequence[Addition]) -> list[Addition]:
    """Effects with the same values put together, in the order of their first."""

    def key(one: Addition) -> tuple[object, ...]:
        if one.kind != EFFECT:
            return one.kind, one.effect, one.joints
        return one.kind, one.effect, *sorted((name, _number(value)) for name, value in one.shape.items())

    first = {key(one): k for k, one in reversed([*enumerate(additions)])}
    result = []
    for _, group in groupby(sorted(additions, key=lambda one: first[key(one)]), key):
        each = list(group)
        joints = tuple(sorted({joint for one in each for joint in one.joints}))
        evidence = "; ".join(dict.fromkeys(one.evidence for one in each if one.evidence))
        same = each[0]
        result.append(Addition(same.kind, same.effect, joints, same.shape, same.values, evidence))
    return result


def _add_effect(text: str, robot: Robot, one: Addition) -> tuple[str, list[str]]:
    effect = library()[one.effect]
    there = [j for j in one.joints if any(u.effect == one.effect and j in u.joints for u in robot.effects)]
    new = [j for j in one.joints if j not in there]
    notes = [f"joint {j} has the effect {one.effect} already; the file's stays" for j in there]
    if not new:
        return text, notes
    if "warmth" in effect.needs:
        text = _with_warmth(text, robot)
    where = f"joint: {new[0]}" if len(new) == 1 else f"joints: [{', '.join(map(str, new))}]"
    values = _values(effect, robot.joints[new[0] - 1], one.shape)
    entry = f"{{effect: {one.effect}, {where}{f', values: {{{values}}}' if values else ''}}}"
    return with_item(text, "effects", entry, _plain(one.evidence)), notes


def _values(effect: Effect, joint: Joint, shape: Mapping[str, float]) -> str:
    parts = []
    for name in (each for each in effect.shapes if each.name in shape):
        unit = name.unit_on(joint)
        parts.append(f"{name.name}: {_number(shape[name.name])}{'' if unit == '1' else f' {unit}'}")
    return ", ".join(parts)


def _add_signal(text: str, robot: Robot, one: Addition) -> tuple[str, list[str]]:
    value = next(iter({**one.values, **one.shape}.values()))
    old: Sequence[object] = getattr(robot.signals, one.effect)
    now = [float(x) for x in old] or [_NEUTRAL.get(one.effect, _NEVER)] * len(robot.moving)  # type: ignore[arg-type]
    for k, joint in enumerate(robot.moving):
        if joint.number in one.joints:
            now[k] = value if one.effect in _REPLACING else now[k] * value if "gain" in one.effect else now[k] + value
    units = [_signal_unit(one.effect, joint) for joint in robot.moving]
    written = [f"{_number(x)}{f' {unit}' if unit else ''}" for x, unit in zip(now, units, strict=True)]
    return with_value(text, ("signals", one.effect), f"[{', '.join(written)}]"), []


def _signal_unit(key: str, joint: Joint) -> str:
    if key == "position_offset":
        return "m" if joint.sigma == PRISMATIC else "rad"
    return _UNITS.get(key, "")


def _with_warmth(text: str, robot: Robot) -> str:
    if robot.signals.warm_up_time or robot.signals.warm_rise:
        return text
    return with_value(text, ("signals", "warm_up_time"), f"{_number(WARM_UP_TIME)} s")


def _add_drive(text: str, robot: Robot, one: Addition) -> tuple[str, list[str]]:
    drives = robot.drives
    if drives is None or (one.effect == "torque_drift" and not drives.torque_constants):
        lack = "drives" if drives is None else "torque constants"
        return text, [f"{one.effect} cannot be written: {robot.name} has no {lack}"]
    value = next(iter({**one.values, **one.shape}.values()))
    motors = [k for k, joint in enumerate(robot.moving) if joint.number in one.joints]
    if one.effect == "torque_drift":
        drift = [float(part) for part in drives.torque_drift] or [0.0] * len(robot.moving)
        for k in motors:
            drift[k] += value
        text = _with_warmth(text, robot)
        return with_value(text, ("drives", "torque_drift"), f"[{', '.join(map(_number, drift))}]"), []
    for k in motors:
        text = with_value(text, ("drives", "gear_ratios", k), f"{float(drives.ratios[k]) * value:.9g}")
    return text, _coupled(drives, robot, motors)


def _coupled(drives: Drives, robot: Robot, motors: Sequence[int]) -> list[str]:
    numbers = [robot.moving[m].number for m in motors if any(n for k, n in enumerate(drives.coupling[m]) if k != m)]
    return [f"the coupling coefficients of motor {number} stay what they were" for number in numbers]


def _add_base(text: str, robot: Robot, one: Addition) -> tuple[str, list[str]]:
    found = {**one.values, **one.shape}
    turn = _rotation(*(found.get(name, 0.0) for name in ("roll", "pitch", "yaw")))
    pose = np.array(robot.base[:3, :3].evalf(), dtype=float)
    angles = ", ".join(f"{_number(angle)} rad" for angle in _angles(turn @ pose))
    return with_value(text, ("base", "rotation"), f"[{angles}]"), []


def _rotation(roll: float, pitch: float, yaw: float) -> Array:
    """Rz(yaw) Ry(pitch) Rx(roll)."""
    (a, b, c), (x, y, z) = np.cos([roll, pitch, yaw]), np.sin([roll, pitch, yaw])
    return np.array(
        [
            [c * b, c * y * x - z * a, c * y * a + z * x],
            [z * b, z * y * x + c * a, z * y * a - c * x],
            [-y, b * x, b * a],
        ]
    )


def _angles(R: Array) -> tuple[float, float, float]:
    """Roll, pitch, yaw of a rotation matrix."""
    pitch = float(np.arctan2(-R[2, 0], np.hypot(R[0, 0], R[1, 0])))
    if np.hypot(R[0, 0], R[1, 0]) < 1e-9:
        return float(np.arctan2(-R[1, 2], R[1, 1])), pitch, 0.0
    return float(np.arctan2(R[2, 1], R[2, 2])), pitch, float(np.arctan2(R[1, 0], R[0, 0]))


def _add_elastic(text: str, robot: Robot, one: Addition) -> tuple[str, list[str]]:
    joints = sorted({*robot.flexible, *one.joints})
    if joints != sorted(robot.flexible):
        text = with_value(text, ("flexible",), f"[{', '.join(map(str, joints))}]")
    if not one.shape.get("gap"):
        return text, []
    gap = Addition(EFFECT, "joint_elasticity", one.joints, {"gap": one.shape["gap"]}, evidence=one.evidence)
    return _add_effect(text, robot, gap)


def _add_body(text: str, robot: Robot, one: Addition) -> tuple[str, list[str]]:
    return text, ["the payload is held by base parameters of the new set; the robot file gets no body for it"]


_ADDING: Mapping[str, Callable[[str, Robot, Addition], tuple[str, list[str]]]] = {
    EFFECT: _add_effect,
    SIGNAL: _add_signal,
    DRIVE: _add_drive,
    BASE: _add_base,
    ELASTIC: _add_elastic,
    BODY: _add_body,
}


def _number(value: float) -> str:
    """Six significant digits."""
    mantissa, _, exponent = f"{value:.6g}".partition("e")
    return f"{mantissa}e{int(exponent)}" if exponent else mantissa


def _plain(text: str) -> str:
    """One line."""
    return " ".join(text.split())
