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
