"""What a drive train's swing leaves, and a gap that is hardly one, are not firm."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import pytest

from identification.diagnosis.columns.bank import Variant
from identification.diagnosis.columns.hypothesis import DRIVE, EFFECT, ELASTIC, SIGNAL
from identification.diagnosis.verdict.alternatives import OTHER_GEOMETRY, OTHER_TORQUE
from identification.diagnosis.verdict.doubts import doubted, doubted_drive_train
from identification.diagnosis.verdict.finding import FIRM, TENTATIVE
from identification.diagnosis.verdict.unexplained import _loose
from tests.diagnosis.findings import finding


@pytest.mark.parametrize(
    ("effect", "kind", "left", "status"),
    [
        ("backlash", ELASTIC, {1: 0.5, 2: 0.5}, FIRM),
        ("backlash", ELASTIC, {1: 1.5, 2: 0.5}, TENTATIVE),
        ("joint_elasticity", ELASTIC, {2: 3.0}, TENTATIVE),
        ("joint_elasticity", ELASTIC, {3: 3.0}, FIRM),
        ("stribeck_friction", EFFECT, {2: 3.0}, FIRM),
    ],
)
def test_far_more_than_noise_is_left(effect: str, kind: str, left: dict[int, float], status: str) -> None:
    assert doubted_drive_train(finding(effect, kind, 1e-5), left, 0.1).status == status


@pytest.mark.parametrize(
    ("repeats", "apart", "status"), [(False, False, TENTATIVE), (True, False, FIRM), (False, True, FIRM)]
)
def test_values_that_are_not_told_one_by_one_are_not_firm_without_repetition(
    repeats: bool, apart: bool, status: str
) -> None:
    one = replace(finding("warm_friction", EFFECT, 1e-5), apart=apart)
    assert doubted(one, 0.0, (), repeats).status == status


@pytest.mark.parametrize(("remains", "status"), [(0.25, FIRM), (0.35, TENTATIVE)])
def test_much_of_what_was_explained_is_left(remains: float, status: str) -> None:
    assert doubted_drive_train(finding("backlash", ELASTIC, 1e-5), {2: 0.9}, remains).status == status


@pytest.mark.parametrize(
    ("effect", "size", "loose"),
    [("backlash", 5.5e-4, [1, 2]), ("backlash", 8e-4, []), ("backlash", 0.0, []), ("joint_elasticity", 5.5e-4, [])],
)
def test_a_gap_that_is_told_alike_twice_lets_a_link_bounce(effect: str, size: float, loose: list[int]) -> None:
    """By the time of a fall it is 5e-4 rad; of a third joint its torque is nothing."""
    one = replace(finding(effect, ELASTIC, 1e-5).hypothesis, twice={"c": ("gap", 1)})
    variant = Variant(one, {"gap": 5e-4}, (7,), (0, 1, 2), (0,))
    bank = SimpleNamespace(robot=SimpleNamespace(numbers=(1, 2, 3)))
    evidence = SimpleNamespace(variant=variant, sizes={0: 0.4, 1: 2.0, 2: 0.1})
    found: Any = SimpleNamespace(weights={7: size}, bank=bank, choices=[SimpleNamespace(evidence=evidence)])
    assert _loose(found) == loose


@pytest.mark.parametrize(
    ("effect", "kind", "size", "free", "status"),
    [
        ("gear_ratio", DRIVE, 0.2, True, TENTATIVE),
        ("gear_ratio", DRIVE, 0.2, False, FIRM),
        ("gear_ratio", DRIVE, 0.4, True, FIRM),
        ("position_offset", SIGNAL, 0.2, True, TENTATIVE),
        ("torque_gain", SIGNAL, 0.2, True, FIRM),
        ("torque_drift", DRIVE, 0.2, True, FIRM),
    ],
)
def test_little_that_misplaces_links_may_be_another_fault_of_the_geometry(
    effect: str, kind: str, size: float, free: bool, status: str
) -> None:
    """Of which a free fit takes up most."""
    evidence: Any = SimpleNamespace(score=100.0, size=size)
    one = doubted(replace(finding(effect, kind, 1e-5), evidence=evidence), 0.0, (), True, free)
    assert one.status == status
    assert [other.effect for other in one.alternatives] == [OTHER_GEOMETRY] * (status == TENTATIVE)


def test_each_doubt_says_why() -> None:
    """Of friction whose values are not determined, that leaves too much, that is hardly known; of a loose spring."""
    friction, spring = finding("stribeck_friction", EFFECT, 1e-5), finding("joint_spring", EFFECT, 3e-4)
    assert doubted(replace(friction, apart=False), 0.0, (), False).doubts == (
        "the runs do not determine its values, and no motion repeats",
    )
    assert doubted(friction, 1.2, (), True).doubts == ("it leaves more on its joint than it explains there",)
    assert doubted(finding("stribeck_friction", EFFECT, 7e-4), 0.0, (), True).doubts == (
        "the standard deviations of its values are more than half of them",
    )
    one = doubted(finding("stribeck_friction", EFFECT, 2e-3), 0.0, (), True)
    assert (one.doubts, one.sure) == (("its values are no larger than their standard deviations",), False)
    assert doubted(spring, 0.2, (2,), True).doubts == (
        "much is left on its joint beside what it explains there",
        "another torque of the position was found on its joint",
        "the runs do not determine its values to a fifth",
    )
    assert doubted(spring, 0.0, (), True).alternatives[0].effect == OTHER_TORQUE
    assert doubted_drive_train(finding("backlash", ELASTIC, 1e-5), {1: 1.5}, 0.0).doubts == (
        "more than the noise is left on a joint that its torque reaches",
    )


def test_a_gap_that_may_be_none_is_an_elasticity_as_well() -> None:
    one = doubted_drive_train(finding("backlash", ELASTIC, 4e-4), {}, 0.0)
    assert (one.status, [other.effect for other in one.alternatives]) == (TENTATIVE, ["joint_elasticity"])
    assert doubted_drive_train(finding("backlash", ELASTIC, 1e-4), {}, 0.0).status == FIRM
    assert doubted_drive_train(finding("joint_elasticity", ELASTIC, 4e-4), {}, 0.0).alternatives == ()
