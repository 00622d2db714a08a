"""How a link bounces in its gap hangs on the smallest error: what it leaves there is not held against a backlash."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from identification.diagnosis.columns.bank import Variant
from identification.diagnosis.columns.hypothesis import ELASTIC, Coefficient, Hypothesis
from identification.diagnosis.verdict.gap_crossings import left_between

Array = NDArray[np.float64]

RATE, PERIOD, ROWS, COLUMN = 50.0, 800, 4000, 3
NUMBERS = (4, 7)
CROSSES = np.arange(ROWS) % 40 < 5
TORQUE = np.where(CROSSES, 8.0, 0.0)
NOTHING = np.zeros(ROWS)
#: Once between the crossings.
ELSEWHERE = np.where(np.arange(ROWS) % 40 == 20, 8.0, 0.0)


@dataclass(frozen=True)
class Run:
    """Rows of two joints, of which the first ones do not count."""

    kept: NDArray[np.bool_]
    period: int
    t: Array
    unsettled: NDArray[np.bool_]
    sampled: Any
    rate: float = RATE
    times: float = 5.0

    def decimated(self, x: Array) -> Array:
        """Signals have a sample a row."""
        return x


def run(period: int, *left_out: int) -> Run:
    rows = np.arange(ROWS)
    kept = np.array([rows >= first for first in left_out])
    motion = SimpleNamespace(qd=np.ones((2, ROWS)))
    sampled = SimpleNamespace(run=SimpleNamespace(name="A.csv"), motion=motion)
    return Run(kept, period, rows / RATE, np.zeros((2, ROWS), dtype=bool), sampled)


def left(
    column: Array,
    rest: Array,
    runs: list[Run],
    stays: Mapping[int, float],
    explains: float = 4.0,
    rounding: Array = NOTHING,
) -> Any:
    """Beside a backlash whose torque is the ``column`` on either joint, where ``rest`` and noise stay in each run, of
    which ``rounding`` may make as much.
    """
    noise = np.random.default_rng(3).normal(size=(len(runs), 2, ROWS))

    def residual(r: int, k: int, values: Mapping[int, float]) -> Array:
        torque = noise[r, k] + rest + column * (1 - values.get(COLUMN, 0.0))
        return np.asarray(torque[runs[r].kept[k]])

    found: Any = SimpleNamespace(
        bank=SimpleNamespace(
            runs=runs, residual=residual, robot=SimpleNamespace(numbers=NUMBERS), whitened=lambda r, k, rows: rows
        ),
        rounded=[np.array([rounding, rounding])] * len(runs),
        weights={COLUMN: 1.0},
    )
    one = Hypothesis("backlash", "", 4, (Coefficient("gap4", "rad"),), lambda *_: np.zeros((1, 2, ROWS)), kind=ELASTIC)
    evidence: Any = SimpleNamespace(
        variant=Variant(one, {"gap": 1.0}, (COLUMN,), (0, 1), (0,)), sizes={0: explains, 1: explains}
    )
    return left_between(found, evidence, stays)


@pytest.mark.parametrize(
    ("rest", "size"),
    [
        (NOTHING, 0.0),
        (-0.6 * TORQUE, 0.0),
        # What comes a row late.
        (0.6 * np.roll(TORQUE, 1), 0.0),
        (ELSEWHERE - 0.6 * TORQUE, np.sqrt(64 / 31)),
    ],
)
def test_what_counts_is_left_between_the_crossings(rest: Array, size: float) -> None:
    """Whatever other rows a run and a joint leave out; joints that nothing stays on are as they were."""
    runs = [run(PERIOD, 21, 430), run(PERIOD, 0, ROWS), run(PERIOD, 850, 3)]
    found = left(TORQUE, rest, runs, {4: 1.6, 7: 1.4, 9: 0.4})
    assert found == {4: pytest.approx(size, rel=0.1), 7: pytest.approx(size, rel=0.1), 9: 0.4}
    assert left(TORQUE, rest, runs, {4: 1.6}).keys() == {4}


@pytest.mark.parametrize(
    ("column", "period", "explains"),
    [
        (np.full(ROWS, 2.0), PERIOD, 4.0),
        (TORQUE, 0, 4.0),
        (TORQUE, PERIOD, 2.0),
    ],
    ids=["it crosses all the time", "nothing repeats", "it hardly explains its crossings"],
)
def test_otherwise_all_rows_count(column: Array, period: int, explains: float) -> None:
    stays = {4: 1.6, 7: 1.5}
    assert left(column, -0.6 * column, [run(period, 21, 430)] * 2, stays, explains) == stays


@pytest.mark.parametrize(("part", "stays"), [(0.0, True), (1.0, False)])
def test_what_rounding_makes_of_it_does_not_count(part: float, stays: bool) -> None:
    """It is the same in each period."""
    runs, rest = [run(PERIOD, 0, 0)] * 2, 0.6 * np.random.default_rng(4).normal(size=PERIOD)
    rest = np.where(CROSSES, 0.0, np.tile(rest, ROWS // PERIOD))
    found = left(TORQUE, rest, runs, {4: 0.6}, rounding=part * rest * np.sqrt(ROWS / PERIOD))
    assert (found[4] > 0) == stays
