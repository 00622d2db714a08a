"""Measured against simulated position, and the error below it, over time."""

from __future__ import annotations

from generator.review.markup import Markup, element, join
from identification.report.choice import choice
from identification.report.fit_chart import fit_chart
from identification.report.output_error.subject import ShownRun, Subject
from identification.report.series import points_each

TITLE = "Measured and simulated position"
ORDER = 25

#: Lines of a chart: measured, simulated, and what is left.
_LINES = 3


def render(subject: Subject) -> Markup:
    text = (
        "Positions as they were measured, and as the simulation follows the measured torques; below, what it misses."
        " Where a segment begins anew the error falls back. Click on a name to show or hide its curve."
    )
    units = subject.position_units
    panels = {
        f"{number}": choice("run", "Run", {run.name: _panel(subject, run, k) for run in subject.runs})
        for k, number in enumerate(units)
    }
    return join(element("p", text), choice("joint", "Joint", panels))


def _panel(subject: Subject, run: ShownRun, joint: int) -> Markup:
    number, unit = list(subject.position_units.items())[joint]
    measured, missed = (x[:, :, joint].ravel() for x in (run.experiment.q, run.errors))
    count = points_each(len(subject.runs) * len(subject.position_units) * _LINES)
    described = f"Measured and simulated position of joint {number} in {run.name}, and the error"
    simulated = {"simulated": measured - missed}
    return fit_chart(run.experiment.times.ravel(), measured, simulated, f"q{number}", unit, described, count)
