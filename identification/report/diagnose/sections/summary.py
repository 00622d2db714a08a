"""The diagnosis in words, then in a few numbers."""

from __future__ import annotations

from collections.abc import Iterator

from generator.review.markup import Markup, element, join
from generator.words import plural
from identification.diagnosis.diagnosis import LOCATED, NAMED, NOTHING
from identification.report.diagnose import words
from identification.report.diagnose.subject import Subject
from identification.report.numbers import card, plain
from identification.report.told import notes

TITLE = "Diagnosis"
ORDER = 10

#: Part of what is left of which less is no change; least noise [N m, N], which a ratio can be told to.
_LITTLE, _NONE = 0.02, 1e-12
_VERDICTS = {NAMED: "named", NOTHING: "no discrepancy", LOCATED: "located"}


def render(subject: Subject) -> Markup:
    mended = () if subject.mended is None else subject.mended.notes
    return join(
        element("p", " ".join([*words.verdict(subject), *words.change(subject)]), class_="verdict"),
        [element("p", " ".join(words.finding(subject, group))) for group in words.alike(subject.found.findings)],
        element("p", words.mode(subject)),
        element("div", list(_cards(subject)), class_="cards results"),
        notes([*subject.found.notes, *mended]),
    )


def _cards(subject: Subject) -> Iterator[Markup]:
    found = subject.found
    yield card(_VERDICTS.get(found.verdict, "unexplained"), "verdict", plural(len(found.findings), "finding"))
    if found.before.joint:
        yield card(f"joint {found.before.joint}", "disagrees most", f"over {found.before.variable or 'no variable'}")
    worst = max(found.before.lack, key=lambda one: one.size)
    left = max(found.after.lack, key=lambda one: one.size)
    if worst.size:
        yield card(
            f"{plain(worst.size, 2)} → {plain(left.size, 2)}", "lack of fit, in the noise", "worst joint, all runs"
        )
    if subject.tried:
        number = _told(subject)
        one = subject.tried[number]
        change = f"{plain(one.before.relative_to_mean, 3)} → {plain(one.after.relative_to_mean, 3)}\u202f%"
        yield card(change, f"left on joint {number}", f"{subject.found.roles.tested}, of the spread")


def _told(subject: Subject) -> int:
    """The joint that stays unexplained; without one, that on which most is closed; where nothing is, the one in
    question, or that with most beside the noise.
    """
    if subject.found.after.joint in subject.tried:
        return subject.found.after.joint
    closed = {k: one.before.rms - one.after.rms for k, one in subject.tried.items()}
    best, asked = max(closed, key=lambda k: closed[k]), subject.found.before.joint
    if closed[best] > _LITTLE * subject.tried[best].before.rms:
        return best
    far = {k: one.after.rms / max(one.floor, _NONE) for k, one in subject.tried.items()}
    return asked if asked in subject.tried else max(far, key=lambda k: far[k])
