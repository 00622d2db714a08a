"""Steps of force: torque over the drive train's twist, pose by pose, with the line of the stiffness."""

from __future__ import annotations

import numpy as np

from generator.review.markup import Markup, element, join
from identification.drive_train import coupling
from identification.force_steps import ForceSteps
from identification.outcome import Value
from identification.report.chart import Trace, axis
from identification.report.choice import choice
from identification.report.stiffness.slope import Pair, slope_chart
from identification.report.stiffness.subject import Subject

TITLE = "Torque over twist and current"
ORDER = 40


def render(subject: Subject) -> Markup | None:
    found = subject.found
    if not isinstance(found, ForceSteps):
        return None
    text = (
        "Each about its mean in a pose: the torque that the wrench asks of a joint, over the change of its motor's"
        " position; and that of a motor, with its rotor's acceleration, over its current (report eq. 73-78)."
    )
    panels = {f"{joint.number}": _panel(found, k) for k, joint in enumerate(found.robot.moving)}
    return join(element("p", text), choice("joint", "Joint", panels))


def _panel(found: ForceSteps, k: int) -> list[Markup]:
    joint = found.robot.moving[k]
    number = joint.number
    length, torque = joint.position_unit, joint.torque_unit
    twists = [(pose.run.name, pose.q[k], pose.wrench_torque[k]) for pose in found.poses]
    across, upward = axis(f"change of q{number}", length), axis("torque of the wrench", torque)
    drawn = [_chart(twists, found.stiffness.get(f"k{number}"), f"k{number}", across, upward)]
    to_motors = np.linalg.inv(coupling(found.robot)).T
    currents = [
        (pose.run.name, pose.i[k], (to_motors @ (pose.wrench_torque + pose.rotors))[k])
        for pose in found.poses
        if pose.i is not None
    ]
    if currents:
        across, upward = axis(f"change of i{number}", "A"), axis(f"torque of motor {number}", "N m")
        drawn.append(_chart(currents, found.constants.get(f"kt{number}"), f"kt{number}", across, upward))
    return drawn


def _chart(pairs: list[Pair], value: Value | None, name: str, across: Trace, upward: Trace) -> Markup:
    slope = None if value is None else value.value
    caption = f"{name}: {value.refused}" if value is not None and value.refused else None
    return slope_chart(pairs, slope, name, across, upward, caption)
