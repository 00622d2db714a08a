"""Measured against estimated torque, and the residual below it, over time."""

from __future__ import annotations

from generator.review.markup import Markup, element, join
from identification.report.choice import choice
from identification.report.fit_chart import fit_chart
from identification.report.identify.subject import ShownRun, Subject
from identification.report.series import points_each

TITLE = "Measured and estimated torque"
ORDER = 30


def render(subject: Subject) -> Markup:
    text = (
        "Torques on the joint side as least squares sees them, filtered and decimated; below, what the model leaves."
        " Lines are interrupted where rows were left out. Click on a name to show or hide its curve."
    )
    panels = {
        f"{number}": choice("run", "Run", {run.name: _panel(subject, run, k, number) for run in subject.runs})
        for k, number in enumerate(subject.numbers)
    }
    return join(element("p", text), choice("joint", "Joint", panels))


def _panel(subject: Subject, run: ShownRun, joint: int, number: int) -> Markup:
    one = run.torques[joint]
    if not len(one.t):
        return element("p", f"Joint {number} has no rows in this run.")
    count = points_each(len(subject.runs) * len(subject.numbers) * (1 + 2 * len(subject.models)))
    name, symbol = f"torque of joint {number}", subject.torque_units[number]
    described = f"Measured and estimated torque of joint {number} in {run.name}, and the residual"
    return fit_chart(one.t, one.measured, one.estimated, name, symbol, described, count)
