"""What each cell of the study is asked, and which share of its cases should answer so."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from benchmarks.diagnosis_study.scoring import NOTHING, UNEXPLAINED

Score = Mapping[str, Any]

TITLES = {
    "null": "nothing hidden",
    "one_3x": "one effect, 3 x noise",
    "one_1x": "one effect, 1 x noise",
    "two": "two effects, 3 x noise",
    "pair": "two that hide each other",
    "three": "three effects, 3 x noise",
    "outside": "outside the library",
}


@dataclass(frozen=True)
class Question:
    """``answer`` of a case's score, None where the case has nothing to say; ``asked`` is the share, such as 95 %."""

    asked: str
    answer: Callable[[Score], bool | None]


def _if_seen(answer: Callable[[Score], bool]) -> Callable[[Score], bool | None]:
    return lambda score: answer(score) if score["visible"] else None


def _one(first: str, alone: str) -> Mapping[str, Question]:
    """Of one hidden effect: shares in which it comes first, and in which nothing else is named."""
    return {
        "right effect and joint first": Question(first, _if_seen(lambda s: bool(s["first"]))),
        "first, or listed as an equal alternative": Question(
            "all", _if_seen(lambda s: s["first"] or bool(s["listed"]))
        ),
        "nothing else named": Question(alone, _if_seen(lambda s: not s["extra"])),
        "the right joint in `where`": Question("98 %", lambda s: s["joint_right"]),
        "the right variable in `where`": Question("90 %", lambda s: s["variable_right"]),
        "invisible ones answered as such, or named": Question(
            "all", lambda s: s["invisible_told"] > 0 if s["invisible"] else None
        ),
    }


def _several(all_found: str, only: str) -> Mapping[str, Question]:
    """Of several hidden effects: shares in which all, and all and nothing else, are named."""
    return {
        "all named": Question(all_found, _if_seen(_all)),
        "all named, or listed as equal alternatives": Question("", _if_seen(_all_listed)),
        "all and only those named": Question(only, _if_seen(lambda s: _all(s) and not s["extra"])),
    }


def _all(score: Score) -> bool:
    return bool(score["found"] == score["visible"])


def _all_listed(score: Score) -> bool:
    """Each by a finding of its own: two that stand in one finding are not both found."""
    return bool(score["found"] + score["listed"] == score["visible"] <= len(score["named"]))


QUESTIONS: Mapping[str, Mapping[str, Question]] = {
    "null": {
        "nothing named": Question("99 %", lambda s: not s["named"]),
        "answered `no_discrepancy`": Question("", lambda s: s["verdict"] == NOTHING),
    },
    "one_3x": _one("95 %", "93 %"),
    "one_1x": _one("88 %", "88 %"),
    "two": _several("85 %", "85 %"),
    "pair": _several("85 %", "85 %"),
    "three": _several("75 %", ""),
    "outside": {
        "nothing firmly named": Question("all", lambda s: not s["firm"]),
        "called unexplained": Question(
            "95 %", lambda s: s["verdict"] == UNEXPLAINED if s["joint_right"] is not None else None
        ),
        "the right joint in `where`": Question("98 %", lambda s: s["joint_right"]),
    },
}
