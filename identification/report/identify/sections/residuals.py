"""Both norms of the residual, by joint and model, of fitted and held-out runs."""

from __future__ import annotations

from generator.review.markup import Markup, element, join
from identification.report.choice import choice
from identification.report.identify.subject import Subject
from identification.report.norms import norms

TITLE = "Fitted and held-out runs"
ORDER = 20


def render(subject: Subject) -> Markup:
    text = (
        "e is the measured torque less the model's, on the filtered and decimated rows. Held-out runs took no part in"
        " the estimate. In total, the mean is each joint's own."
    )
    panels = {name: norms(one, subject.torque_units) for name, one in subject.residuals.items()}
    return join(element("p", text), choice("model", "Model", panels))
