"""Every finding: its values, its evidence, and what may stand in its place."""

from __future__ import annotations

from generator.review.markup import Content, Markup, element, join, table
from identification.diagnosis.verdict.finding import Finding
from identification.report.diagnose.subject import Subject
from identification.report.diagnose.words import capitalised, chance, values
from identification.report.numbers import number

TITLE = "What is missing"
ORDER = 50

_HEADS = ("effect", "values", "", "seen over", "size", "p", "fitted", "others")


def render(subject: Subject) -> Markup | None:
    findings = subject.found.findings
    if not findings:
        return None
    text = (
        "The size is in the noise's rms, beside all that the model can fit. p is the probability that chance explains"
        " as much, for all shapes that were tried. The last columns are by how much the sum of squares falls, in"
        " variances of the noise, on the fitted runs and on runs that were not fitted."
    )
    found = table(_HEADS, [_row(one) for one in findings], class_="remarks")
    return join(element("p", text), found, [_alternatives(one) for one in findings if one.alternatives])


def _row(one: Finding) -> list[Content]:
    e = one.evidence
    sizes = [number(e.size, 3), chance(e.p), number(e.drop, 4), number(e.validation, 4)]
    return [capitalised(one.hypothesis.named), values(one), one.status, one.variable or "–", *sizes]


def _alternatives(one: Finding) -> Markup:
    rows: list[list[Content]] = [
        [capitalised(other.named), number(other.score, 4), other.separating_experiment] for other in one.alternatives
    ]
    title = element("h3", f"What may stand in the place of {one.hypothesis.named}")
    return join(title, table(("effect", "evidence", "what would tell them apart"), rows, class_="remarks"))
