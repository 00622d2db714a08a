"""Every finding: its values, its evidence, and what may stand in its place."""

from __future__ import annotations

from collections.abc import Iterator

from generator.review.markup import Content, Markup, element, join, table
from identification.diagnosis.finding import Finding
from identification.report.diagnose.subject import Subject
from identification.report.diagnose.words import chance, values
from identification.report.numbers import plain
from identification.report.told import facts

TITLE = "What is missing"
ORDER = 50


def render(subject: Subject) -> Markup | None:
    if not subject.found.findings:
        return None
    return join([list(_finding(one)) for one in subject.found.findings])


def _finding(one: Finding) -> Iterator[Markup]:
    title = one.hypothesis.title
    yield element("h3", f"{title[:1].upper()}{title[1:]} on {one.hypothesis.where}: {one.status}")
    e = one.evidence
    yield facts(
        {
            "effect": one.hypothesis.effect,
            "values": values(one),
            "seen over": one.hypothesis.variable or "no single variable",
            "size": f"{plain(e.size, 3)} times the noise, beside all that the model can fit",
            "chance": f"{chance(e.p)}, for all shapes that were tried",
            "fitted runs": f"the sum of squares falls by {plain(e.drop, 4)} variances of the noise",
            "other runs": f"it falls by {plain(e.validation, 4)} on runs that were not fitted",
        }
    )
    if one.alternatives:
        rows: list[list[Content]] = [
            [other.title, other.where, plain(other.score, 4), other.separating_experiment] for other in one.alternatives
        ]
        yield table(("or else", "on", "evidence", "what would tell them apart"), rows, class_="remarks")
