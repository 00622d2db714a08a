"""The residual's spectrum beside the torque's: what is left at the frequencies of the motion is not noise."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from generator.review.markup import Markup, element, join
from identification.arrays import Array
from identification.reconstruction import Reconstruction
from identification.report.chart import HELD_OUT, MEASURED, RESIDUAL, axis, chart, line, log_axis
from identification.report.choice import choice
from identification.report.identify.subject import ALL, Subject
from identification.report.series import numbers
from identification.report.welch import Spectrum, spectrum

TITLE = "Spectrum of the residual"
ORDER = 50


def render(subject: Subject) -> Markup:
    text = (
        "Amplitude densities by Welch's method, up to half of the rate after decimation. Rows that were left out count"
        " as zero, and the density is divided by the part that is there. A residual that follows the torque's spectrum"
        " comes from the motion; a flat one is noise."
    )
    panels = {f"{number}": _panel(subject, k, number) for k, number in enumerate(subject.numbers)}
    return join(element("p", text), choice("joint", "Joint", panels))


def _panel(subject: Subject, joint: int, number: int) -> Markup:
    fitted, held_out = (
        [run.torques[joint] for run in subject.runs if run.held_out is kind and len(run.torques[joint].t)]
        for kind in (False, True)
    )
    kinds: list[tuple[str, str, Sequence[Reconstruction], Callable[[Reconstruction], Array]]] = [
        ("torque, fitted runs", MEASURED, fitted, lambda one: one.measured - one.measured.mean()),
        ("residual, fitted runs", RESIDUAL, fitted, lambda one: one.residual(ALL)),
        ("residual, held-out runs", HELD_OUT, held_out, lambda one: one.residual(ALL)),
    ]
    found: list[tuple[str, str, Spectrum]] = []
    for name, colour, some, signal in kinds:
        density = spectrum([(one.t, signal(one), one.step) for one in some])
        if density is not None:
            found.append((name, colour, density))
    if not found:
        return element("p", f"Joint {number} has too few rows for a spectrum.")
    curves = [line(numbers(one.f), numbers(one.amplitude), name, colour) for name, colour, one in found]
    seen = [float(value) for *_, one in found for value in one.amplitude]
    layout = {
        "xaxis": axis("frequency", "Hz"),
        "yaxis": log_axis("amplitude density", f"{subject.torque_units[number]}/√Hz", seen),
    }
    return chart(curves, layout, f"Spectrum of the torque and of the residual of joint {number}", height=320)
