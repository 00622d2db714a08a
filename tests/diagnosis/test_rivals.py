"""What may stand in the place of an effect, and what may not."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from identification.diagnosis.search.selection import Selection


def instead(joints: tuple[int, ...], beside: bool) -> bool:
    """Whether a rival on some joints stands for a finding on joints 0 and 1, if it passes ``beside`` it or not."""
    finding, rival = (SimpleNamespace(joints=each) for each in ((0, 1), joints))
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


@pytest.mark.parametrize(("joint", "outweighs"), [(0, False), (1, True)])
def test_what_is_common_counts_as_if_nothing_rare_hid_it(joint: int, outweighs: bool) -> None:
    """A rival explains half as much again as what is common does beside something rare, and little without that."""

    def effect(name: str, *joints: int) -> Any:
        return SimpleNamespace(hypothesis=SimpleNamespace(effect=name, kind="effect", stated=False), joints=joints)

    hiding = effect("gradual_friction", joint)
    usual = SimpleNamespace(variant=effect("viscous_friction", 0), drop=100.0, bic=100.0, score=100.0)
    rare = SimpleNamespace(variant=effect("torque_gain", 0), believed=True, bic=150.0, score=150.0)
    weighing: Any = SimpleNamespace(beside=lambda variant, others: (None, 100.0 if hiding in others else 1000.0))
    assert Selection(weighing)._outweighs(rare, usual, [hiding]) == outweighs  # type: ignore[arg-type]
