"""Joints with few rows: what is left out there, what is not, and what that makes of findings beside it."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from identification.diagnosis.search.few_rows import small
from identification.diagnosis.verdict import few_rows
from identification.diagnosis.verdict.finding import FIRM, TENTATIVE
from tests.diagnosis.findings import finding

ROBOT: Any = SimpleNamespace(numbers=(1, 2, 3))
#: Coordinate 1, which is joint 2, has few rows.
FEW = {1: (90, 12)}


def variant(effect: str, joints: tuple[int, ...], preset: bool = False) -> Any:
    hypothesis = SimpleNamespace(kind="effect", effect=effect, stated=False, named=f"{effect} of a joint")
    return SimpleNamespace(coordinates=joints, hypothesis=hypothesis, preset=[0.1] if preset else None)


@pytest.mark.parametrize(
    ("effect", "joints", "size", "believed", "preset", "left_out"),
    [
        ("viscous_friction", (1,), 0.3, True, False, False),
        ("stribeck_friction", (1,), 0.3, True, False, True),
        ("stribeck_friction", (1,), 0.9, True, False, False),
        ("stribeck_friction", (2,), 0.3, True, False, False),
        ("torque_gain", (1,), 2.0, False, False, True),
        ("torque_delay", (0, 1, 2), 0.7, True, False, True),
        ("torque_delay", (0, 1, 2), 0.7, True, True, False),
    ],
)
def test_what_is_small_there_is_left_out_but_for_what_every_robot_has_or_another_fit_tells(
    effect: str, joints: tuple[int, ...], size: float, believed: bool, preset: bool, left_out: bool
) -> None:
    one: Any = SimpleNamespace(variant=variant(effect, joints, preset), size=size, believed=believed)
    assert small(one, FEW) == left_out
    assert not small(one, {})


def test_of_what_was_left_out_the_best_is_told_on_each_joint() -> None:
    def evidence(_: Any) -> list[Any]:
        return [
            SimpleNamespace(variant=variant("torque_delay", (0, 1)), small=True),
            SimpleNamespace(variant=variant("stribeck_friction", (1,)), small=True),
            SimpleNamespace(variant=variant("coupled_rotor", (1, 3)), small=True),
            SimpleNamespace(variant=variant("dahl_friction", (2,)), small=False),
            SimpleNamespace(variant=variant("stribeck_friction", (2,)), small=True),
        ]

    found: Any = SimpleNamespace(variants=[], weighing=SimpleNamespace(few={**FEW, 2: (80, 11)}, evidence=evidence))
    told = [(one.hypothesis.effect, one.coordinates) for one in few_rows.left_out(found)]
    assert told == [("torque_delay", (0, 1)), ("stribeck_friction", (2,))]
    found.weighing.few = {}
    assert few_rows.left_out(found) == []


def test_what_was_left_out_is_told_and_makes_findings_beside_it_tentative() -> None:
    """A finding on joint 2 reaches joint 1 too; nothing was left out of the fit of joint 3."""
    firm = finding("stribeck_friction", "effect", 1e-5)
    whole, wrist = variant("torque_delay", (0, 1, 2)), variant("coupled_rotor", (0, 2))
    (doubted,) = few_rows.doubted(FEW, ROBOT, [firm], [whole])
    assert (doubted.status, doubted.sure) == (TENTATIVE, False)
    assert few_rows.doubted(FEW, ROBOT, [firm], [wrist])[0].status == FIRM
    assert few_rows.doubted(FEW, ROBOT, [firm], [])[0].status == FIRM
    plain, left_out = few_rows.notes(FEW, ROBOT, [whole])
    assert plain.startswith("rows are too few for the base parameters that act there, 90 for 12 on joint 2")
    assert left_out.startswith(
        "left out there, smaller than 0.75 of the noise or larger than is believed: torque_delay of a joint;"
    )
    assert few_rows.notes(FEW, ROBOT, []) == [plain]
