"""A blocked output: torque over the motor's angle, measured and estimated."""

from __future__ import annotations

import numpy as np

from generator.review.markup import Markup, element, join
from identification.locked_output import LockedOutput
from identification.report.chart import ESTIMATED, MEASURED, axis, chart, line
from identification.report.choice import choice
from identification.report.series import numbers, resolved, some
from identification.report.stiffness.subject import Subject

TITLE = "Torque over the motor's angle"
ORDER = 30

_POINTS = 2000


def render(subject: Subject) -> Markup | None:
    found = subject.found
    if not isinstance(found, LockedOutput):
        return None
    chi = [one.value or 0.0 for one in found.values.values()]
    joint = found.joint
    angle, torque = joint.position_unit, joint.torque_unit
    panels = {}
    for (run, _), rows in zip(found.runs, found.rows, strict=True):
        at = some(len(rows), _POINTS)
        q, Y = resolved(rows[at, 3]), numbers(rows[at, -1])
        estimated = numbers(np.asarray(rows[at, :-1] @ chi))
        curves = [
            line(q, Y, "measured", f"{MEASURED}/45", line={"width": 4}),
            line(q, estimated, "estimated", ESTIMATED),
        ]
        layout = {"xaxis": axis(f"q{joint.number}", angle), "yaxis": axis("torque less the balancer's", torque)}
        described = f"Torque of joint {joint.number} over its motor's angle in {run.name}"
        panels[run.name] = chart(curves, layout, described, height=420)
    text = (
        "The output is blocked: the slope is the drive train's stiffness, the width of the loop its friction"
        " (report eq. 70). Signals are filtered and decimated."
    )
    return join(element("p", text), choice("run", "Run", panels))
