"""Link-side encoders: what they lag behind the motors, over speed, and what torque is left to twist the drive train."""

from __future__ import annotations

import numpy as np

from generator.review.markup import Markup, element, join
from identification.arrays import Array
from identification.link_encoders import LinkEncoders
from identification.report.chart import axis
from identification.report.choice import choice
from identification.report.stiffness.slope import Pair, slope_chart
from identification.report.stiffness.subject import Subject

TITLE = "Twist over speed and torque"
ORDER = 40


def render(subject: Subject) -> Markup | None:
    found = subject.found
    if not isinstance(found, LinkEncoders):
        return None
    text = (
        "q − qs about its mean in a run, over the speed: the slope is the latency. Below, what the motor's own motion"
        " (speed and its sign, acceleration, an eccentric encoder) cannot explain of q − qs, over what it cannot"
        " explain of the torque: the slope is 1/k."
    )
    panels = {f"{found.robot.moving[k].number}": _panel(found, k) for k, rows in found.rows.items() if len(rows.twist)}
    return join(element("p", text), choice("joint", "Joint", panels))


def _panel(found: LinkEncoders, k: int) -> list[Markup]:
    joint, rows = found.robot.moving[k], found.rows[k]
    number = joint.number
    length, torque = joint.position_unit, joint.torque_unit
    latency, stiffness = found.latency[f"latency{number}"], found.stiffness[f"k{number}"]
    means = rows.constants @ (rows.constants.T @ rows.twist / np.maximum(rows.constants.sum(axis=0), 1))
    twist, left = rows.beside_motion()
    upward = axis(f"q{number} − qs{number}", length)
    over_speed = slope_chart(
        _by_run(found, k, rows.own[:, 0], rows.twist - means),
        latency.value,
        f"latency{number}",
        axis(f"speed of joint {number}", f"{length}/s"),
        upward,
    )
    over_torque = slope_chart(
        _by_run(found, k, left, twist),
        1 / stiffness.value if stiffness.value else None,
        f"1/k{number}",
        axis(f"rest of tau{number}", torque),
        axis(f"rest of q{number} − qs{number}", length),
        f"k{number}: {stiffness.refused}" if stiffness.refused else None,
    )
    return [over_speed, over_torque]


def _by_run(found: LinkEncoders, k: int, x: Array, y: Array) -> list[Pair]:
    """Numbers (N each) of joint ``k`` (from 0), taken apart by the run that they are of; none of runs without rows."""
    number = found.robot.moving[k].number
    names = [run.name for run, _ in found.runs if f"qs{number}" in run.others]
    each = zip(names, found.rows[k].constants.T > 0, strict=True)
    return [(name, x[own], y[own]) for name, own in each if own.any()]
