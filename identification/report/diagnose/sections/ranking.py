"""What was tried and how it fared, before anything was named and beside the findings."""

from __future__ import annotations

from collections.abc import Sequence

from generator.review.markup import Content, Markup, element, join, table
from identification.diagnosis.columns.bank import Variant
from identification.diagnosis.diagnosis import LOCATED
from identification.diagnosis.search.evidence import Evidence
from identification.report.choice import choice
from identification.report.diagnose.subject import Subject
from identification.report.diagnose.words import chance
from identification.report.numbers import NONE, number

TITLE = "Ranking of the candidates"
ORDER = 60

_LISTED = 12


def render(subject: Subject) -> Markup | None:
    if subject.found.verdict == LOCATED:
        return None
    weighing = subject.found.search.weighing
    chosen = subject.found.search.variants
    tables = {"before anything is named": _table(weighing.evidence([]), chosen)}
    if chosen:
        tables["beside the findings"] = _table(weighing.evidence(chosen), chosen)
    offered, made = subject.found.search.offered, weighing.bank.variants
    tried = len({one.key for one in offered} | {one.key for one in made})
    text = (
        f"{tried} effects on joints were tried, each with the shape that fits best. Evidence is the drop of the sum of"
        " squares, in variances of the noise, less what its"
        " parameters and shapes cost (BIC), plus the drop on runs that were not fitted. The size is in the noise's rms."
        " A name is given where all"
        " conditions hold; the last column says which one does not."
    )
    return join(element("p", text), choice("ranking", "Ranking", tables))


def _table(ranked: Sequence[Evidence], chosen: Sequence[Variant]) -> Markup:
    named = {one.key for one in chosen}
    rows: list[list[Content]] = []
    for place, one in enumerate(ranked[:_LISTED], 1):
        hypothesis = one.variant.hypothesis
        is_named = (hypothesis.effect, hypothesis.joint) in named
        remark = element("b", "named") if is_named else element("span", one.why_not or "passes", class_="faint")
        # Of what is within chance nothing else is looked at.
        validation = number(one.validation, 4) if one.validation else NONE
        sizes = [number(one.score, 4), number(one.drop, 4), validation, number(one.size, 2), chance(one.p)]
        rows.append([str(place), hypothesis.named, *sizes, remark])
    heads = ("", "effect", "evidence", "fitted", "others", "size", "p", "")
    return table(heads, rows, class_="ranking") if rows else element("p", "Nothing in the library explains anything.")
