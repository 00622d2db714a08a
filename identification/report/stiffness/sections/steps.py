"""Steps of force: torque over the drive train's twist, pose by pose, with the line of the stiffness."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from generator.review.markup import Markup, element, join
from generator.robot.description import PRISMATIC
from identification.drive_train import coupling
from identification.force_steps import ForceSteps
from identification.outcome import Value
from identification.report.chart import COLOURS, INK, Trace, axis, chart, line, points
from identification.report.choice import choice
from identification.report.series import numbers, some
from identification.report.stiffness.subject import Subject

TITLE = "Torque over twist and current"
ORDER = 40

Array = NDArray[np.float64]
Pair = tuple[str, Array, Array]

_POINTS = 1500


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
    length, torque = ("m", "N") if joint.sigma == PRISMATIC else ("rad", "N m")
    twists = [(pose.run.name, pose.q[k], pose.held[k]) for pose in found.poses]
    across, upward = axis(f"change of q{number}", length), axis("torque of the wrench", torque)
    drawn = [_chart(twists, found.stiffness.get(f"k{number}"), f"k{number}", across, upward)]
    to_motors = np.linalg.inv(coupling(found.robot)).T
    currents = [
        (pose.run.name, pose.i[k], (to_motors @ (pose.held + pose.rotors))[k])
        for pose in found.poses
        if pose.i is not None
    ]
    if currents:
        across, upward = axis(f"change of i{number}", "A"), axis(f"torque of motor {number}", "N m")
        drawn.append(_chart(currents, found.constants.get(f"kt{number}"), f"kt{number}", across, upward))
    return drawn


def _chart(pairs: list[Pair], value: Value | None, name: str, across: Trace, upward: Trace) -> Markup:
    data: list[Trace] = []
    for k, (run, x, y) in enumerate(pairs):
        at = some(len(x), _POINTS)
        data.append(points(numbers(x[at]), numbers(y[at]), run, COLOURS[k % len(COLOURS)]))
    if value is not None and value.value is not None:
        ends = np.array([min(x.min() for _, x, _ in pairs), max(x.max() for _, x, _ in pairs)])
        data.append(line(numbers(ends), numbers(value.value * ends), name, INK))
    caption = value.refused if value is not None and value.refused else None
    layout = {"xaxis": across, "yaxis": upward, "showlegend": True}
    return chart(data, layout, f"Measurements and the line of {name}", caption and f"{name}: {caption}", height=360)
