"""Scores of many cases as the rows of tables."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from statistics import median
from typing import Any

from benchmarks.diagnosis_study.case import FREE, KNOWN, Hidden
from benchmarks.diagnosis_study.drawing import SIZES, has_place, shares_coulomb
from benchmarks.diagnosis_study.pages.intervals import Share, share
from benchmarks.diagnosis_study.pages.questions import QUESTIONS, TITLES
from benchmarks.diagnosis_study.runner import MISMATCH
from benchmarks.diagnosis_study.scoring import UNEXPLAINED
from benchmarks.diagnosis_study.study import STUDY

#: Share of cases in which an effect must be named to be called detected.
_NEARLY_ALWAYS = 0.9

Result = Mapping[str, Any]
Row = dict[str, object]

MODES = {FREE: "free fit", KNOWN: "known parameters"}


def rows_of_cells(results: Sequence[Result]) -> list[Row]:
    """What is asked of each cell, by mode."""
    rows: list[Row] = []
    for cell, questions in QUESTIONS.items():
        for mode, title in MODES.items():
            scores = [one["score"] for one in of(results, cell, mode)]
            for question, one in questions.items():
                flags = [flag for flag in map(one.answer, scores) if flag is not None]
                if flags:
                    row = {"cell": TITLES[cell], "mode": title, "": question}
                    rows.append({**row, "asked": one.asked, "cases": str(share(flags))})
    return rows


def rows_apart(results: Sequence[Result]) -> list[Row]:
    """Cases whose robot file's laws are further from the robot's own: names beside the hidden ones are no mistake."""
    cases = [one for one in results if "score" in one and _apart(one)]
    rows: list[Row] = []
    for cell, title in TITLES.items():
        scores = [one["score"] for one in cases if one["case"]["cell"] == cell]
        if scores:
            found = [score["found"] == score["visible"] for score in scores if score["visible"]]
            rows.append(
                {
                    "cell": title,
                    "all hidden ones named": str(share(found)),
                    "something else named": str(share([score["extra"] > 0 for score in scores])),
                    "called unexplained": str(share([score["verdict"] == UNEXPLAINED for score in scores])),
                }
            )
    return rows


def rows_of_laws(results: Sequence[Result]) -> list[Row]:
    """Each law of one hidden effect at three times the noise, both modes together."""
    rows: list[Row] = []
    cases = [one for mode in MODES for one in of(results, "one_3x", mode)]
    for law in STUDY.laws:
        mine = [one for one in cases if one["truth"]["hidden"][0]["law"] == law]
        if not mine:
            continue
        scores = [one["score"] for one in mine]
        seen = [score for score in scores if score["visible"]]
        wrong = [name for score in seen if not score["found"] for name in score["named"][:1] or ["nothing"]]
        rows.append(
            {
                "law": f"{law} (reserved)" if law in STUDY.reserved else law,
                "first": str(share([bool(score["first"]) for score in seen])),
                "nothing else": str(share([not score["extra"] for score in seen])),
                "joint": str(share([bool(score["joint_right"]) for score in seen])),
                "variable": str(
                    share([score["variable_right"] for score in seen if score["variable_right"] is not None])
                ),
                "invisible": str(share([score["invisible_told"] > 0 for score in scores if score["invisible"]])),
                "named instead": ", ".join(sorted({name.split()[0] for name in wrong})),
            }
        )
    return rows


def rows_of_numbers(results: Sequence[Result]) -> list[Row]:
    """Parameters within two deviations, and the gap that closed, of correct cases with one effect at three times."""
    rows: list[Row] = []
    for mode, title in MODES.items():
        scores = [one["score"] for one in of(results, "one_3x", mode) if one["score"]["found"]]
        within, closed = _said(scores, "within"), _said(scores, "closed")
        rows.append(
            {
                "mode": title,
                "parameter within 2 std": str(share(within)),
                "explainable gap closed on the untouched run, median": f"{100 * median(closed):.0f} %"
                if closed
                else "",
                "cases": len(closed),
            }
        )
    return rows


def power(results: Sequence[Result]) -> dict[str, list[tuple[float, Share]]]:
    """For each law of the power curve the share of cases in which it is named, over the size."""
    curves: dict[str, list[tuple[float, Share]]] = {}
    for law in STUDY.power:
        for size in SIZES:
            if cases := _visible(results, law, size):
                curves.setdefault(law, []).append((size, share([one["score"]["found"] > 0 for one in cases])))
    return curves


def _visible(results: Sequence[Result], law: str, size: float) -> list[Result]:
    """Cases of the power curve in which a law of a size shows at all."""
    cases = [one for mode in MODES for one in of(results, f"power_{size:g}x", mode)]
    hidden = [one["truth"]["hidden"][0] for one in cases]
    return [one for one, what in zip(cases, hidden, strict=True) if what["law"] == law and not what["invisible"]]


def detection_limits(results: Sequence[Result]) -> list[Row]:
    """For each law of the power curve the smallest size from which on it is nearly always named, in torque too."""
    rows: list[Row] = []
    for law, curve in power(results).items():
        weak = [size for size, one in curve if one.hits < _NEARLY_ALWAYS * one.count]
        strong = [size for size, _ in curve if size > max(weak, default=0.0)]
        limit = f"{strong[0]:g}" if strong else f"above {curve[-1][0]:g}"
        at = strong[0] if strong else curve[-1][0]
        torque = median(one["truth"]["hidden"][0]["torque"] for one in _visible(results, law, at))
        rows.append({"law": law, "size over the noise": limit, "rms torque there, median, N m or N": f"{torque:.3g}"})
    return rows


def placed(results: Sequence[Result]) -> list[Result]:
    """Without those that hide a law where nothing may stand for it, or two that share Coulomb friction."""
    return [one for one in results if not _misplaced(one)]


def counts(results: Sequence[Result]) -> dict[str, int]:
    """Cases scored, left out since no size would do, broken off, and scored apart."""
    return {
        "scored": sum("score" in one for one in results),
        "out of reach": sum("skipped" in one for one in results),
        "failed": sum("failed" in one for one in results),
        "scored apart": sum("score" in one and _apart(one) for one in results),
        "misplaced": sum("score" in one and _misplaced(one) for one in results),
    }


def _said(scores: Sequence[Mapping[str, Any]], what: str) -> list[Any]:
    return [score[what] for score in scores if score[what] is not None]


def _apart(one: Result) -> bool:
    return bool(one["truth"]["mismatch"] > MISMATCH)


def _misplaced(one: Result) -> bool:
    """Whether a hidden law acts where the library has no effect that it may be called, or two of them share the
    Coulomb friction of a joint, as earlier studies drew some.
    """
    robot, hidden = one["case"]["robot"], [Hidden(**what) for what in one["case"]["hidden"]]
    nowhere = any(not has_place(what.law, robot, what.joint) for what in hidden if what.law in STUDY.laws)
    return nowhere or shares_coulomb(hidden)


def of(results: Iterable[Result], cell: str, mode: str) -> list[Result]:
    """Scored cases of a cell and mode, without those that are scored apart."""
    return [
        one
        for one in results
        if (one["case"]["cell"], one["case"]["mode"]) == (cell, mode) and "score" in one and not _apart(one)
    ]
