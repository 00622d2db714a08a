"""Measured against estimated torque of every motor."""

from __future__ import annotations

from generator.review.markup import Markup, element, join
from identification.report.choice import choice
from identification.report.fit_chart import fit_chart
from identification.report.gains.subject import Subject
from identification.report.norms import norms
from identification.report.series import points_each

TITLE = "Measured and estimated torque"
ORDER = 30


def render(subject: Subject) -> Markup:
    found = subject.found
    numbers = {m: joint.number for m, joint in enumerate(found.robot.moving)}
    count = points_each(3 * len(found.torques))
    panels: dict[str, dict[str, Markup]] = {}
    for one in found.torques:
        number = numbers[one.motor]
        described = f"Measured and estimated torque of motor {number} in {one.run}, and the residual"
        chart = fit_chart(
            one.t, one.measured, {"estimated": one.estimated}, f"torque of motor {number}", "N m", described, count
        )
        panels.setdefault(f"{number}", {})[one.run] = chart
    shown = {number: choice("run", "Run", runs) for number, runs in panels.items()}
    residual = norms(subject.results["residual"], dict.fromkeys(numbers.values(), "N m"), "motor")
    text = "kt times the current, and what the model has for it; rows where a joint stands still are left out."
    return join(element("p", text), choice("motor", "Motor", shown), residual)
