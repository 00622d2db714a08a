"""What may stand in the place of an effect, and what may not."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from identification.diagnosis.search.evidence import Evidence
from identification.diagnosis.search.selection import Selection


def instead(joints: tuple[int, ...], beside: bool) -> bool:
    """Whether a rival on some joints stands for a finding on joints 0 and 1, if it passes ``beside`` it or not."""
    finding, rival = (SimpleNamespace(coordinates=each) for each in ((0, 1), joints))
    weighing: Any = SimpleNamespace(of=lambda one, others: SimpleNamespace(passes=beside and finding in others))
    return Selection(weighing)._instead(rival, finding, [])  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("joints", "beside", "stands"),
    [((1,), True, True), ((1, 2), False, True), ((2,), False, True), ((2,), True, False)],
)
def test_on_other_joints_what_is_found_beside_it_is_no_rival(
    joints: tuple[int, ...], beside: bool, stands: bool
) -> None:
    assert instead(joints, beside) == stands


@pytest.mark.parametrize(
    ("alone", "hides", "joint", "outweighs"),
    [
        (1050.0, "gradual_friction", 0, False),
        (1200.0, "gradual_friction", 0, True),
        (1050.0, "gradual_friction", 1, True),
        (1050.0, "gas_balancer", 0, True),
        (1050.0, "coulomb_friction", 0, True),
    ],
)
def test_what_is_rare_outweighs_what_is_common_without_what_hides_that(
    alone: float, hides: str, joint: int, outweighs: bool
) -> None:
    """Beside a rare effect on some joint it explains half as much again; on theirs only that hides what is common."""

    def effect(name: str, *joints: int) -> Any:
        hypothesis = SimpleNamespace(effect=name, kind="effect", stated=False, usual=True, coefficients=())
        return SimpleNamespace(hypothesis=hypothesis, coordinates=joints, used=())

    def found(name: str, drop: float) -> Evidence:
        return Evidence(effect(name, 0), np.ones(1), drop, 0.0, drop, drop, {}, True, "", True)

    hiding, usual, rare = effect(hides, joint), found("viscous_friction", 100), found("torque_gain", 150)
    drops = {id(usual.variant): 1000.0, id(rare.variant): alone}
    weighing: Any = SimpleNamespace(beside=lambda variant, others: (None, 0.0 if others else drops[id(variant)]))
    assert Selection(weighing)._displaces(rare, usual, [hiding]) == outweighs
    # What is common does not come back for what it would explain without a right one.
    assert not Selection(weighing)._displaces(usual, rare, [hiding])
