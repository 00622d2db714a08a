"""Which parameters the motion will only show together."""

from __future__ import annotations

from generator.review.markup import Markup
from identification.excitation.results import Excitation
from identification.report.correlation import correlation

TITLE = "Correlations of the parameters"
ORDER = 40


def render(found: Excitation) -> Markup | None:
    solution = found.expected
    return correlation(solution.names, solution.hidden, solution.covariance)
