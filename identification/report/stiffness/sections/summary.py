"""What was found, in words."""

from __future__ import annotations

from collections.abc import Iterator

from generator.review.markup import Markup, element, join
from generator.words import listed, unit
from identification.link_encoders import LinkEncoders
from identification.report.numbers import plain
from identification.report.stiffness.subject import Subject
from identification.report.told import notes

TITLE = "Summary"
ORDER = 10


def render(subject: Subject) -> Markup:
    return join(element("p", " ".join(_text(subject)), class_="verdict"), notes(subject.results["notes"]))


def _text(subject: Subject) -> Iterator[str]:
    values = subject.results["parameters"]
    wanted = {name: one for name, one in values.items() if name.startswith(("k", "latency")) and name[:2] != "kt"}
    told = [
        f"{name} = {plain(one['value'], 4)} {unit(one['unit'])} (std {plain(one['relative_std_percent'], 2)}\u202f%)"
        for name, one in wanted.items()
        if one["value"] is not None
    ]
    refused = [name for name, one in wanted.items() if one["value"] is None]
    if told:
        yield f"{listed(told)}."
    if refused:
        yield f"{listed(refused)} cannot be told from these runs."
    total = subject.results["residual"]["train"]["total"]
    signals = "differences q − qs" if isinstance(subject.found, LinkEncoders) else "torques"
    yield f"{plain(total['relative_percent'], 3)}\u202f% of the {signals} are left unexplained (‖e‖ / ‖Y‖)."
