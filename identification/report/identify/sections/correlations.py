"""Which parameters the data can only tell together."""

from __future__ import annotations

from generator.review.markup import Markup
from identification.report.correlation import correlation
from identification.report.identify.subject import Subject

TITLE = "Correlations of the parameters"
ORDER = 70


def render(subject: Subject) -> Markup | None:
    solution = subject.found.full.solution
    return correlation(solution.names, solution.hidden, solution.covariance)
