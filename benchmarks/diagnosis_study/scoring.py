"""What ``diagnosis.json`` says, held against the truth of the case."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

from benchmarks.diagnosis_study.study import STUDY

#: Verdicts of ``diagnosis.json``.
NAMED, NOTHING, UNEXPLAINED = "effects_named", "no_discrepancy", "unexplained"


@dataclass(frozen=True)
class Score:
    """``found`` of the ``visible`` hidden effects are named, ``first`` says that the first finding is one of
    them, ``listed`` counts those that are an alternative of a finding only, ``invisible_told`` those of
    ``invisible`` that are said to be so, or named all the same. ``extra`` are named effects that are not hidden,
    ``firm`` counts those of status firm.
    ``within`` is whether the named parameter is within two standard deviations of the truth, ``closed`` the share of
    the explainable gap that closed on the untouched run; None where there is nothing to say.
    """

    verdict: str
    named: tuple[str, ...]
    visible: int
    found: int
    first: bool
    listed: int
    extra: int
    firm: int
    tentative: int
    invisible: int
    invisible_told: int
    joint_right: bool | None
    variable_right: bool | None
    within: bool | None
    closed: float | None

    def record(self) -> dict[str, Any]:
        """For JSON."""
        return asdict(self)


def scored(truth: Mapping[str, Any], diagnosis: Mapping[str, Any]) -> Score:
    """The score of a diagnosis."""
    inside = [one for one in truth["hidden"] if one["law"] in STUDY.laws]
    visible = [one for one in inside if not one["invisible"]]
    hidden = [one for one in inside if one["invisible"]]
    findings = [one for one in diagnosis["findings"] if _told(one, diagnosis["verdict"])]
    tentative = len(diagnosis["findings"]) - len(findings)
    hits = {id(one): next((k for k, told in enumerate(findings) if _is(told, one)), None) for one in visible}
    matched = {k for k in hits.values() if k is not None}
    # What nobody could see may be named all the same: that is right, not a false alarm.
    lucky = {k for k, told in enumerate(findings) if any(_is(told, one) for one in hidden)}
    listed = sum(hits[id(one)] is None and any(_alternative(told, one) for told in findings) for one in visible)
    # An equal alternative in the place of the truth is no further effect.
    stand_ins = {
        k for k, told in enumerate(findings) if k not in matched and any(_alternative(told, one) for one in inside)
    }
    extra = len(findings) - len(matched | lucky | stand_ins)
    where = diagnosis.get("where") or {}
    within = None
    if len(visible) == 1 and (k := hits[id(visible[0])]) is not None:
        within = _within(findings[k], visible[0])
    return Score(
        verdict=diagnosis["verdict"],
        named=tuple(f"{one['effect']} {_joints(one)}" for one in findings),
        visible=len(visible),
        found=len(matched),
        first=bool(findings) and 0 in matched,
        listed=listed,
        extra=extra,
        firm=sum(one["status"] == "firm" for one in findings),
        tentative=tentative,
        invisible=len(hidden),
        invisible_told=sum(
            _told_invisible(diagnosis, one) or any(_is(told, one) for told in findings) for one in hidden
        ),
        joint_right=_joint_right(where, truth["hidden"]) if _seen(truth) else None,
        variable_right=_variable_right(where, visible) if len(visible) == 1 == len(truth["hidden"]) else None,
        within=within,
        closed=_closed(diagnosis, visible) if visible else None,
    )


def _told(one: Mapping[str, Any], verdict: str) -> bool:
    """Whether a finding is a name: firm, or tentative with alternatives while nothing is left unexplained."""
    return one["status"] == "firm" or (verdict == NAMED and bool(one.get("alternatives")))


def _seen(truth: Mapping[str, Any]) -> bool:
    return any(not one["invisible"] for one in truth["hidden"])


def _joints(told: Mapping[str, Any]) -> list[int]:
    return [int(str(j).removeprefix("joint").strip()) for j in told.get("joints") or []]


def _is(told: Mapping[str, Any], one: Mapping[str, Any]) -> bool:
    expected = STUDY.laws[one["law"]]
    if told["effect"] not in expected.named:
        return False
    return expected.anywhere or int(one["joint"]) in _joints(told)


def _alternative(told: Mapping[str, Any], one: Mapping[str, Any]) -> bool:
    return any(
        _is({"joints": told.get("joints"), **(other if isinstance(other, Mapping) else {"effect": other})}, one)
        for other in told.get("alternatives") or []
    )


def _told_invisible(diagnosis: Mapping[str, Any], one: Mapping[str, Any]) -> bool:
    return any(_is({"joints": [one["joint"]], **told}, one) for told in diagnosis.get("invisible") or [])


def _joint_right(where: Mapping[str, Any], hidden: Sequence[Mapping[str, Any]]) -> bool:
    acting = {int(j) for one in hidden if not one["invisible"] for j in one["joints"]}
    joint = where.get("joint")
    return joint is not None and int(joint) in acting


def _variable_right(where: Mapping[str, Any], visible: Sequence[Mapping[str, Any]]) -> bool:
    variables = STUDY.laws[visible[0]["law"]].variables
    return str(where.get("variable", "")).replace("_", " ") in variables


def _within(told: Mapping[str, Any], one: Mapping[str, Any]) -> bool | None:
    """None where the law's size is no parameter of the named effect."""
    expected = STUDY.laws[one["law"]]
    if not expected.parameter:
        return None
    for name, parameter in told.get("parameters", {}).items():
        if name.rstrip("0123456789") == expected.parameter and parameter.get("std") is not None:
            error = float(parameter["value"]) - expected.value(float(one["size"]))
            return abs(error) <= 2 * float(parameter["std"])
    return None


def _closed(diagnosis: Mapping[str, Any], visible: Sequence[Mapping[str, Any]]) -> float | None:
    """Mean square before less after, over before less noise, on the joints on which the hidden effects act.

    None where nothing was played on untouched runs, or where the effect does not show there.
    """
    residual = diagnosis.get("residual")
    if not residual:
        return None
    acting = {int(j) for one in visible for j in one["joints"]}
    squares = {
        kind: {one["joint"]: float(one["norm"]) ** 2 / one["rows"] for one in residual[kind]["per_joint"]}
        for kind in ("before", "after")
    }
    floors = {one["joint"]: float(one["rms"]) ** 2 for one in residual["noise_floor"]["per_joint"]}
    # Each joint counts in units of its own noise, so that a strong axis does not speak for all.
    noise = {j: floors[j] for j in acting if floors.get(j)}
    gap = sum(squares["before"][j] / floor - 1 for j, floor in noise.items())
    left = sum(squares["after"][j] / floor - 1 for j, floor in noise.items())
    return (gap - left) / gap if gap > 0 else None
