"""A shape value of a drive train is as uncertain as what the model leaves makes it."""

from __future__ import annotations

from dataclasses import replace
from math import log
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from identification.diagnosis.columns.hypothesis import EFFECT, ELASTIC, ShapeRange
from identification.diagnosis.verdict import shape_reach
from identification.diagnosis.verdict.shape_reach import reaching

ROWS, K = 400, 1000.0
SHAPES = (ShapeRange("k", "N m/rad", 1e1, 1e5, step=0.2), ShapeRange("gap", "rad", 1e-4, 1e-2, step=0.1))


class Valley:
    """Of a drop of 900 that falls by ``fall`` with the square of the logarithm of k about K; a gap that costs more."""

    def __init__(self, fall: float, kind: str) -> None:
        self.hypothesis = SimpleNamespace(kind=kind, shapes=SHAPES, twice={"gap1": ("gap", 1)}, numbers=(2,))
        self.bank: Any = SimpleNamespace(
            add=lambda hypothesis, shape: self.variant(shape),
            rows=lambda run: np.array([ROWS, ROWS]),
            robot=SimpleNamespace(numbers=(1, 2)),
        )
        self.weighing: Any = SimpleNamespace(
            bank=self.bank,
            refresh=lambda: None,
            beside=lambda variant, others: (None, 900.0 - fall * log(variant.shape["k"] / K) ** 2),
        )

    def variant(self, shape: dict[str, float]) -> Any:
        one = SimpleNamespace(hypothesis=self.hypothesis, shape=shape, used=())
        one.only = lambda used: one
        return one

    def std(self, left: float, monkeypatch: pytest.MonkeyPatch) -> dict[str, float]:
        monkeypatch.setattr(shape_reach, "refined", lambda weighing, variant, *_: variant)
        variant = self.variant({"k": K, "gap": 1e-3})
        found: Any = SimpleNamespace(bank=self.bank, weighing=self.weighing, variants=[variant], train=(0,))
        choice: Any = SimpleNamespace(evidence=SimpleNamespace(variant=variant))
        return reaching(found, choice, {"k": 5.0, "gap": 1e-5}, {2: left})


def test_a_value_goes_as_far_as_what_is_left_allows(monkeypatch: pytest.MonkeyPatch) -> None:
    """0.5 of the noise's rms in 400 rows is 100, which 25 times the square of log(k) is at log(k) = 2."""
    assert Valley(25.0, ELASTIC).std(0.5, monkeypatch) == {"k": pytest.approx(K * (np.exp(2.0) - 1)), "gap": 1e-5}
    assert Valley(2500.0, ELASTIC).std(0.5, monkeypatch)["k"] == pytest.approx(K * (np.exp(0.2) - 1))


def test_a_value_that_nothing_bounds_goes_to_the_end_of_its_range(monkeypatch: pytest.MonkeyPatch) -> None:
    assert Valley(1e-3, ELASTIC).std(0.5, monkeypatch)["k"] == pytest.approx(1e5 - K)


def test_what_is_lost_at_an_end_counts_and_a_value_falls_to_nothing_at_most(monkeypatch: pytest.MonkeyPatch) -> None:
    """Up to 2000 and down to 10; up to 1050 alone; and a way of 3.5 on which the last step ends at 4.6."""
    for low, high, fall, std in (
        (1e1, 2e3, 1e-3, K),
        (1e-1, K * 1.05, 1e9, 5.0),
        (K / 1.05, 1e5, 100 / 3.5**2, K * (np.exp(3.5) - 1)),
    ):
        ends = (replace(SHAPES[0], low=low, high=high), SHAPES[1])
        valley = Valley(fall, ELASTIC)
        valley.hypothesis.shapes = ends
        assert valley.std(0.5, monkeypatch)["k"] == pytest.approx(std, rel=0.011)


def test_where_nothing_is_left_and_of_other_effects_the_curvature_counts(monkeypatch: pytest.MonkeyPatch) -> None:
    assert Valley(25.0, ELASTIC).std(0.0, monkeypatch) == {"k": 5.0, "gap": 1e-5}
    assert Valley(25.0, EFFECT).std(0.5, monkeypatch) == {"k": 5.0, "gap": 1e-5}
    assert Valley(1e9, ELASTIC).std(0.5, monkeypatch)["k"] == 5.0
