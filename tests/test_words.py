"""Lists and numbers in running text: one of them is no several."""

from __future__ import annotations

import pytest

from generator.symbolic.gauge import Gauge
from generator.symbolic.lean_newton_euler import Strategy
from generator.symbolic.regressor import RegressorStrategy
from generator.words import numbered


@pytest.mark.parametrize(
    ("numbers", "told"), [([2], "joint 2"), ([3, 1], "joints 1 and 3"), ([1, 2, 3, 5], "joints 1 to 3 and 5")]
)
def test_numbers_in_running_text(numbers: list[int], told: str) -> None:
    assert numbered("joint", numbers) == told


def test_ways_to_write_equations_tell_one_from_several() -> None:
    one, two = frozenset({6}), frozenset({4, 5})
    assert str(Gauge(one, one)) == ", frame 6 slid along its axis, a mass kept at O6 against a first moment"
    assert (
        str(Gauge(two, two)) == ", frames 4 and 5 slid along their axes, masses kept at O4 and O5 against first moments"
    )
    assert ", body 6 in axes that do not spin" in str(Strategy(one))
    assert ", bodies 4 and 5 in axes that do not spin" in str(Strategy(two))
    assert str(RegressorStrategy(one, one)).endswith(", behind frame 6 at that frame, frame 6 slid along its axis")
    assert ", behind frames 4 and 5 at those frames" in str(RegressorStrategy(one, two))
