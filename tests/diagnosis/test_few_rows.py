"""Joints with few rows: what is left out there, what is not, and what that makes of findings beside it."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

from identification.diagnosis.verdict import few_rows
from identification.diagnosis.verdict.finding import FIRM, TENTATIVE
from tests.diagnosis.test_swinging import finding

ROBOT: Any = SimpleNamespace(numbers=(1, 2, 3))
#: Coordinate 1, which is joint 2, has few rows.
FEW = {1: (90, 12)}


def choice(effect: str, joints: tuple[int, ...], size: float, believed: bool = True) -> Any:
    hypothesis = SimpleNamespace(kind="effect", effect=effect, stated=False, named=f"{effect} of a joint")
    variant = SimpleNamespace(joints=joints, hypothesis=hypothesis)
    return SimpleNamespace(evidence=SimpleNamespace(variant=variant, size=size, believed=believed))


def test_what_is_small_there_is_left_out_but_for_what_every_robot_has() -> None:
    choices = [
        choice("viscous_friction", (1,), 0.3),
        choice("stribeck_friction", (1,), 0.3),
        choice("torque_delay", (0, 1, 2), 0.7),
        choice("torque_gain", (1,), 2.0, believed=False),
        choice("stribeck_friction", (1,), 0.9),
        choice("stribeck_friction", (2,), 0.3),
    ]
    found: Any = SimpleNamespace(choices=choices, keeping=lambda kept: kept)
    kept, small = few_rows.without_small(found, FEW)
    assert (kept, small) == ([choices[0], *choices[4:]], choices[1:4])
    found.choices = choices[4:]
    assert few_rows.without_small(found, FEW) == (found, [])


def test_what_was_left_out_is_told_and_makes_findings_beside_it_tentative() -> None:
    """A finding on joint 2 reaches joint 1 too; nothing was left out of the fit of joint 3."""
    firm = finding("stribeck_friction", "effect", 1e-5)
    whole, wrist = choice("torque_delay", (0, 1, 2), 0.3), choice("coupled_rotor", (0, 2), 0.3)
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
