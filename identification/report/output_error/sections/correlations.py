"""Which parameters the data can only tell together."""

from __future__ import annotations

from generator.review.markup import Markup
from identification.report.correlation import correlation
from identification.report.output_error.subject import Subject

TITLE = "Correlations of the parameters"
ORDER = 40


def render(subject: Subject) -> Markup | None:
    best = subject.found.best
    return correlation(best.names, best.hidden, best.covariance)
