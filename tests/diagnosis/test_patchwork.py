"""Several doubtful effects on one joint say no more than that something acts there."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from identification.diagnosis.diagnosis import NAMED, UNEXPLAINED
from identification.diagnosis.results import document
from identification.diagnosis.verdict.finding import FIRM, TENTATIVE, Finding
from identification.diagnosis.verdict.patchwork import PATCHED, patched
from identification.report.diagnose.report import report
from tests.diagnosis.diagnosed_arm import diagnosis_of, recorded, torque


def found(*said: tuple[int, str]) -> list[Any]:
    """Findings by the joint of their hypothesis, 0 for one of several joints, and status."""
    return [SimpleNamespace(hypothesis=SimpleNamespace(joint=joint), status=status) for joint, status in said]


@pytest.mark.parametrize(
    ("said", "joint"),
    [
        ([(2, TENTATIVE)] * 3, 2),
        ([(1, FIRM), *[(3, TENTATIVE)] * 4], 3),
        ([(2, TENTATIVE)] * 2 + [(1, TENTATIVE)], 0),
        ([(2, TENTATIVE)] * 3 + [(2, FIRM)], 0),
        ([(0, TENTATIVE)] * 3, 0),
        ([], 0),
    ],
)
def test_a_joint_is_patched_by_three_findings_of_which_none_is_firm(said: list[tuple[int, str]], joint: int) -> None:
    assert patched(found(*said)) == joint


def test_a_joint_that_is_patched_is_unexplained(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    regressors, sources = recorded(tmp_path, [torque("asymmetry")] * 3)
    named = diagnosis_of(sources, regressors)
    assert (named.verdict, named.reason) == (NAMED, "")
    monkeypatch.setattr("identification.diagnosis.diagnosis.patched", lambda findings: findings[0].joints[0])
    one = diagnosis_of(sources, regressors)
    assert (one.verdict, one.reason, one.after.joint) == (UNEXPLAINED, PATCHED, 1)
    assert document(one)["unexplained"]["joint"] == 1
    page = report(one, None).decode()
    assert "joint 1 takes several effects of which none is firm" in page
    assert "The findings below are: viscous friction that depends on the direction" in page


@pytest.mark.parametrize("rule", [pytest.param("few_rows.doubted", marks=pytest.mark.long), "doubted"])
def test_the_last_doubts_count(rule: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What is doubted because rows are few, or because a value is contradicted, is not firm either."""
    regressors, sources = recorded(tmp_path, [torque("stribeck asymmetry")] * 3)
    monkeypatch.setattr(f"identification.diagnosis.diagnosis.{rule}", _all_doubted)
    monkeypatch.setattr("identification.diagnosis.diagnosis.patched", _of_several)
    one = diagnosis_of(sources, regressors)
    assert {each.status for each in one.findings} == {TENTATIVE}
    assert (one.verdict, one.reason, one.after.joint) == (UNEXPLAINED, PATCHED, 1)


@pytest.mark.long
def test_without_these_doubts_what_is_patched_is_firm(tmp_path: Path) -> None:
    regressors, sources = recorded(tmp_path, [torque("stribeck asymmetry")] * 3)
    assert {one.status for one in diagnosis_of(sources, regressors).findings} == {FIRM}


def _all_doubted(*given: Any) -> tuple[Finding, ...]:
    (findings,) = (one for one in given if isinstance(one, tuple) and one and isinstance(one[0], Finding))
    return tuple(one.doubted("late") for one in findings)


def _of_several(findings: Sequence[Finding]) -> int:
    """As a joint that takes a finding more."""
    return patched([*findings, findings[0]])
