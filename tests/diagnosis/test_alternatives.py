"""What is said to tell two effects apart that explain the same runs."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import combinations

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


def alike() -> list[tuple[str, str]]:
    """Pairs of the library's effects that may be one torque of the position: ripples, and springs."""
    kinds = [[name for name in library() if name.endswith(ending)] for ending in ("_ripple", "_spring")]
    return [pair for kind in kinds for pair in combinations(kind, 2)]


def test_there_are_effects_that_are_alike() -> None:
    assert len(alike()) >= 4


@pytest.mark.parametrize("pair", alike(), ids="-".join)
def test_no_motion_tells_apart_what_is_one_torque(pair: tuple[str, str]) -> None:
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
