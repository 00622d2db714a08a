"""Several doubtful effects on one joint say no more than that something acts there."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from identification.diagnosis.verdict.finding import FIRM, TENTATIVE
from identification.diagnosis.verdict.patchwork import patched


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
