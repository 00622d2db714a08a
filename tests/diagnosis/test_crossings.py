"""How a link bounces in its gap hangs on the smallest error: what it leaves there is not held against a backlash."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from identification.diagnosis.columns.bank import Variant
from identification.diagnosis.columns.hypothesis import ELASTIC, Coefficient, Hypothesis
from identification.diagnosis.verdict import finding
from identification.diagnosis.verdict.crossings import left_between

RATE, ROWS, COLUMN = 50.0, 4000, 3
NUMBERS = (4, 7)


@dataclass(frozen=True)
class Run:
    """Rows of two joints, of which the first few do not count."""

    kept: NDArray[np.bool_] = field(default_factory=lambda: np.tile(np.arange(ROWS) > 20, (2, 1)))
    t: Any = field(default_factory=lambda: np.arange(ROWS) / RATE)
    rate: float = RATE
    period: int = 0
    unsettled: Any = field(default_factory=lambda: np.zeros((2, ROWS), dtype=bool))
    sampled: Any = field(default_factory=lambda: SimpleNamespace(run=SimpleNamespace(name="A.csv")))


def search(column: NDArray[np.float64], left: NDArray[np.float64]) -> Any:
    """A backlash whose torque is the ``column`` on either joint, and what it leaves there beside noise."""
    run, noise = Run(), np.random.default_rng(3).normal(size=ROWS)

    def residual(r: int, k: int, values: Mapping[int, float]) -> NDArray[np.float64]:
        torque = noise + left + column * (1 - values.get(COLUMN, 0.0))
        return np.asarray(torque[run.kept[k]])

    bank = SimpleNamespace(runs=[run], residual=residual, robot=SimpleNamespace(numbers=NUMBERS))
    return SimpleNamespace(bank=bank, weights={COLUMN: 1.0})


def backlash() -> Variant:
    coefficients = (Coefficient("gap4", "rad"),)
    one = Hypothesis("backlash", "", 4, coefficients, lambda *_: np.zeros((1, 2, 1)), kind=ELASTIC)
    return Variant(one, {"gap": 1.0}, (COLUMN,), (0, 1), (0,))


CROSSES = np.arange(ROWS) % 40 < 5
TORQUE = np.where(CROSSES, 8.0, 0.0)


@pytest.mark.parametrize(
    ("column", "left", "size"),
    [
        (TORQUE, 0.0 * TORQUE, 0.0),
        (TORQUE, -0.6 * TORQUE, 0.0),
        # One that comes a row late.
        (TORQUE, 0.6 * np.roll(TORQUE, 1), 0.0),
        (TORQUE, np.where(np.arange(ROWS) % 40 == 20, 8.0, 0.0), np.sqrt(64 / 31)),
    ],
)
def test_what_counts_is_left_between_the_crossings(
    column: NDArray[np.float64], left: NDArray[np.float64], size: float
) -> None:
    found = left_between(search(column, left), backlash())
    assert found == {number: pytest.approx(size, rel=0.1) for number in NUMBERS}


def test_a_link_that_crosses_all_the_time_tells_nothing() -> None:
    assert left_between(search(np.full(ROWS, 2.0), np.zeros(ROWS)), backlash()) == {}


@pytest.mark.parametrize(("remains", "settled"), [(0.6, 0.0), (0.8, 0.8)])
def test_a_backlash_that_hardly_explains_its_crossings_is_held_to_them(remains: float, settled: float) -> None:
    found = search(TORQUE, -0.6 * TORQUE)
    choice: Any = SimpleNamespace(evidence=SimpleNamespace(variant=backlash(), place=0, size=3.0))
    left, rest = finding._settled(found, choice, {4: 1.8, 9: 0.4}, remains)
    assert rest == pytest.approx(settled)
    assert left == ({4: 0.0, 7: 0.0, 9: 0.4} if settled == 0 else {4: 1.8, 9: 0.4})
