"""The residual's spectrum beside that of the noise, before and after."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from generator.review.markup import Markup, element, join
from identification.arrays import Array
from identification.diagnosis.noise.noise_floor import density
from identification.report.chart import ESTIMATED, MEASURED, RESIDUAL, axis, chart, line, log_axis
from identification.report.choice import choice
from identification.report.diagnose.subject import Subject
from identification.report.series import numbers
from identification.report.welch import Spectrum, spectrum

TITLE = "Where: spectrum of the residual"
ORDER = 40


def render(subject: Subject) -> Markup:
    text = (
        "Amplitude densities of the runs that are fitted and that validate; rows near standstill count as zero. The"
        " noise is that by which all evidence is weighed: what repetitions of the motion do not share, or what all"
        " candidates together leave."
    )
    panels = {f"{number}": _panel(subject, subject.numbers.index(number), number) for number in subject.numbers}
    return join(element("p", text), choice("joint", "Joint", panels, subject.leading))


def _panel(subject: Subject, k: int, number: int) -> Markup:
    found = subject.found
    before, after = (_spectrum(subject, each, k) for each in (found.residuals_before, found.residuals_after))
    if before is None or after is None:
        return element("p", f"Joint {number} has too few rows for a spectrum.")
    noise = np.sqrt(density(found.search.bank, k, before.f))
    curves = [
        line(numbers(before.f), numbers(noise), "noise", f"{MEASURED}/60", line={"width": 4}),
        line(numbers(before.f), numbers(before.amplitude), "before", RESIDUAL),
        line(numbers(after.f), numbers(after.amplitude), "with the findings", ESTIMATED),
    ]
    seen = [float(value) for one in (noise, before.amplitude, after.amplitude) for value in one]
    layout = {
        "xaxis": axis("frequency", "Hz"),
        "yaxis": log_axis("residual", f"{subject.torque_units[number]}/√Hz", seen),
    }
    return chart(curves, layout, f"Spectrum of the residual of joint {number} beside the noise", height=320)


def _spectrum(subject: Subject, residuals: Sequence[Array], k: int) -> Spectrum | None:
    parts = []
    for run, e in zip(subject.found.search.bank.runs, residuals, strict=True):
        kept = run.kept[k]
        parts.append((run.t[kept], e[k, kept], run.sampled.run.period * run.sampled.filters.factor))
    return spectrum(parts)
