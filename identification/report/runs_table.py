"""The runs that a result is made of."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from generator.review.markup import Content, Markup, element, table


def runs_table(kinds: Mapping[str, Sequence[Mapping[str, Any]]]) -> Markup:
    """Entries of the key ``data`` of results.json by what they were used for."""
    heads = ("run", "use", "samples", "rate", "cut-off", "decimation", "payload", "SHA-256")
    rows: list[list[Content]] = [
        [
            element("span", one["file"], class_="break"), kind, str(one["samples"]), f"{one['rate']:g} Hz",
            f"{one['cutoff']:g} Hz, order {one['order']}", str(one["factor"]), one["payload"] or "none",
            element("code", one["sha256"][:12]),
        ]
        for kind, runs in kinds.items()
        for one in runs
    ]  # fmt: skip
    return table(heads, rows, class_="numbers")
