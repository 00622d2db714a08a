"""What is said to tell two effects apart that explain the same runs."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pytest

from generator.effects.library import library
from identification.diagnosis.columns.hypothesis import Hypothesis
from identification.diagnosis.verdict.alternatives import separating


def effect(
    name: str, would_show: str = "a larger range of the joint", apart: Mapping[str, str] | None = None
) -> Hypothesis:
    return Hypothesis(
        name, name, 1, (), lambda scene, shape: np.zeros((0, 1, 1)), would_show=would_show, separating=apart or {}
    )


@pytest.mark.parametrize(
    "pair",
    [
        ("motor_ripple", "cycloid_ripple"),
        ("motor_ripple", "wave_generator_ripple"),
        ("cycloid_ripple", "wave_generator_ripple"),
        ("joint_spring", "cable_spring"),
    ],
)
def test_no_motion_tells_apart_what_is_one_torque(pair: tuple[str, str]) -> None:
    assert set(pair) <= set(library())
    for mine, other in (pair, pair[::-1]):
        told = separating(effect(mine), effect(other))
        assert "one torque" in told
        assert "range" not in told


def test_what_an_effect_says_itself_comes_first() -> None:
    first = effect("motor_ripple", apart={"cycloid_ripple": "count the lobes"})
    assert separating(first, effect("cycloid_ripple")) == "count the lobes"
    assert separating(effect("cycloid_ripple"), first) == "count the lobes"
    assert separating(effect("a"), effect("b")) == "a larger range of the joint"
    assert "more motion" in separating(effect("a"), effect("b", would_show=""))
