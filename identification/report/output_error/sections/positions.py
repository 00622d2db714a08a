"""By how much simulated positions miss the measured ones, joint by joint."""

from __future__ import annotations

from generator.review.markup import Markup, element, join
from identification.report.norms import norms
from identification.report.output_error.subject import Subject

TITLE = "Errors of the positions"
ORDER = 20


def render(subject: Subject) -> Markup:
    segment = subject.results["method"]["segment"]
    how = "over the whole run" if segment is None else f"beginning anew every {segment:g} s"
    text = (
        f"e is the measured position less that of the simulation in open loop, {how}, driven by the measured torques."
        " Y are the measured positions. Held-out runs took no part in the estimate."
    )
    return join(element("p", text), norms(subject.results["residual"], subject.position_units))
