"""The study's page and picture, from the results of its cases."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from textwrap import fill
from typing import Any

from benchmarks.diagnosis_study.pages import summary
from benchmarks.diagnosis_study.pages.power_curve import power_curve
from benchmarks.diagnosis_study.pages.simpler_ways import rows_of_simpler_ways
from benchmarks.diagnosis_study.runner import MISMATCH
from benchmarks.diagnosis_study.sizing import INVISIBLE, LIMIT
from benchmarks.diagnosis_study.study import STUDY
from benchmarks.table import table

ROOT = Path(__file__).parents[3]
JSON, PAGE = ROOT / "benchmarks" / "diagnosis.json", ROOT / "docs" / "diagnosis_study.md"
PICTURE = ROOT / "docs" / "images" / "diagnosis_power.svg"
_POWER = "Share of cases in which an effect is named, over its size"


def tables(results: Sequence[summary.Result], every: Sequence[summary.Result]) -> dict[str, Any]:
    """All that the page shows, for JSON: ``results`` of the code as it is, and ``every`` case as last answered."""
    shown, every_shown = summary.placed(results), summary.placed(every)
    return {
        "counts": summary.counts(results),
        "cells": summary.rows_of_cells(shown),
        "every": {"codes": len({one["code"] for one in every}), **summary.counts(every)},
        "every cell": summary.rows_of_cells(every_shown),
        "apart": summary.rows_apart(every_shown),
        "laws": summary.rows_of_laws(every_shown),
        "numbers": summary.rows_of_numbers(every_shown),
        "baselines": rows_of_simpler_ways(every_shown),
        "limits": summary.detection_limits(every_shown),
        "power": {
            law: [{"size": size, "hits": one.hits, "count": one.count} for size, one in curve]
            for law, curve in summary.power(every_shown).items()
        },
    }


def page(found: Mapping[str, Any]) -> str:
    """The page in Markdown."""
    counts, every = found["counts"], found["every"]
    parts = [
        "# How well the diagnosis does",
        _INTRODUCTION,
        "## What was asked, and what came out",
        f"One study of one state of the code: {counts['scored']} cases, {counts['scored apart']} of them scored apart; "
        f"{counts['failed']} broke off. {counts['out of reach']} draws were left out, since no plausible size of the "
        "law was as large as wanted. "
        f"{_misplaced(counts)}`make study-diagnosis` makes 200 cases of each kind and mode; what it has made "
        "once, with the same code but for other commands, comments and docstrings, it does not make again. Where the "
        "cases are few the intervals are wide. Under `asked` stands the share that is to be reached.",
        table(found["cells"]),
        "## Every case that was ever drawn",
        f"Studies of {every['codes']} states of the code drew {every['scored']} cases. "
        f"{_misplaced(every)}Each counts once, as the last state that was asked about it answered: a study goes "
        "through the draws from the first on, or, with `--new`, from behind the last that was asked, whatever came out "
        "before. The diagnosis was worked on between them. All tables from here on are of these cases.",
        table(found["every cell"]),
        *(["Scored apart:", table(found["apart"])] if found["apart"] else []),
        "## Each law, three times the noise",
        "What counts as right is in `benchmarks/diagnosis_study/study.json`. `named instead`: what was first where the "
        "law was not found.",
        table(found["laws"]),
        "## Parameters and the gap",
        "Asked are 90 % in both.",
        table(found["numbers"]),
        "## Simpler ways on the same runs",
        "Stepwise BIC, a held-out gate alone and sequentially thresholded least squares (PySINDy's STLSQ) see the rows "
        "and candidates of the diagnosis, each joint weighted by its noise; BIC is asked on white rows as well.",
        table(found["baselines"]),
    ]
    if found["power"]:
        parts += [
            "## Power",
            "![Share of cases in which an effect is named, over its size](images/diagnosis_power.svg)",
            "Detection limit: the smallest size of the curve from which on at least nine of ten cases that show the "
            "effect are named.",
            table(found["limits"]),
        ]
    return "\n\n".join(_filled(part) for part in parts if part) + "\n"


def _misplaced(counts: Mapping[str, int]) -> str:
    """What is said of cases that no table counts, if there are any."""
    if not (count := counts["misplaced"]):
        return ""
    return (
        f"{count} with a law on a joint where no effect of the library may stand for it, or two that share the "
        "Coulomb friction of a joint, are in no table. "
    )


def _filled(text: str) -> str:
    """Paragraphs in lines of at most 120; tables, headings and pictures as they are."""
    if text.startswith(("|", "#", "!")):
        return text
    return "\n\n".join(fill(part, 120, break_long_words=False, break_on_hyphens=False) for part in text.split("\n\n"))


def write(every: Sequence[summary.Result], found: Mapping[str, Any]) -> None:
    """Page, and picture where there is a power curve."""
    PAGE.write_text(page(found), encoding="utf-8")
    curves = summary.power(summary.placed(every))
    if curves:
        PICTURE.write_text(power_curve(_POWER, curves), encoding="utf-8")


_INTRODUCTION = f"""\
`make study-diagnosis` hides effects in simulated robots and asks `counterpoise diagnose` what is missing. The robots
of `tests/plant` share no code with the diagnosis: their rigid bodies, friction, control loop and sensors are their
own, and many of their laws are not the formula of any candidate. The robot file that the command gets holds every
effect that the robot has but the hidden one, among them, in a third of the cases, one more of a law that is only nearly
the textbook's ({", ".join(STUDY.beside)}); its values are wrong by draws of the standard deviations that it states,
2 % of inertial values and 5 % of friction. There are three runs of 30 s to fit, one of 20 s to validate, one of 20 s
to test, at 500 Hz, with 2 % coloured noise of the currents. Robot, law, joint and motion are drawn at random from the
seed in `benchmarks/diagnosis_study/study.json`. Kept from all development were the laws {", ".join(STUDY.reserved)}.

The size of an effect is the rms of what it adds to the torque over that of the noise, both white, up to {LIMIT:g} Hz,
on the fitted runs and the joints on which it acts, after projection on all that the mode can fit. Joints act whose
part is at least a tenth of the largest. Rows near standstill are left out. Of what keeps less than
{100 * INVISIBLE:g} % of its norm the right answer is that these data cannot show it.

In cases that count here, the robot file's laws differ from the robot's own by at most {MISMATCH:g} of the noise;
others are scored apart. A finding counts as named if it is firm, or if it is tentative and tells what else it may be,
while nothing is left unexplained. Shares have Wilson intervals of 95 %."""
