"""Noise told from what a model lacks; products of columns as they are added."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from identification.diagnosis.columns.whitening import Colour, colour
from identification.diagnosis.noise.measured import colours
from identification.diagnosis.noise.noise_floor import density
from tests.matrices import bank, hypothesis, process, run, whitened

Array = NDArray[np.float64]

LAW, DEVIATION = np.array([1.0, -0.8]), 2.0
#: Of the stationary process.
POWER = DEVIATION**2 / (1 - 0.8**2)
PERIOD, COUNT = 500, 3000


def noise(seed: int, count: int = COUNT) -> Array:
    return process(LAW, DEVIATION, count, seed)


def base(count: int = COUNT) -> Array:
    t = 2 * np.pi * np.arange(count) / PERIOD
    return np.stack([np.sin(t), np.cos(t), np.ones(count)])


def missing(size: float) -> Array:
    """What repeats with the motion and is in no column."""
    return size * np.sign(np.sin(2 * np.pi * 3 * np.arange(COUNT) / PERIOD + 0.1))


def expect_the_noise(found: Colour, near: float = 0.1) -> None:
    assert found.deviations[-1] == pytest.approx(DEVIATION, rel=near)
    assert found.filters[-1][1] == pytest.approx(LAW[1], abs=0.08)


def test_what_every_period_has_is_not_noise() -> None:
    """Whatever the model lacks, noise is what differs between periods."""
    tau = [[5.0, -3.0, 1.0] @ base() + missing(40.0) + noise(seed) for seed in (1, 2)]
    repeating = bank([run(base(), one, period=PERIOD) for one in tau])
    for one in colours(repeating):
        expect_the_noise(one[0])
    # Without periods all of it looks like noise, unless a column takes it away.
    others = bank([run(base(), one) for one in tau])
    assert colours(others)[0][0].deviations[0] > 8 * np.sqrt(POWER) / 1.2
    others.add(hypothesis("square", lambda r, shape: missing(1.0)), {})
    for one in colours(others):
        expect_the_noise(one[0])


def test_gaps_in_some_periods() -> None:
    kept = np.ones(COUNT, dtype=bool)
    kept[np.arange(COUNT) % PERIOD < 60] = False
    kept[700:760] = False
    tau = np.where(kept, base()[0] + missing(30.0) + noise(5), 1e6)
    found = colours(bank([run(base(), tau, kept, PERIOD)]))
    expect_the_noise(found[0][0])


def test_many_columns_do_not_make_the_noise_small() -> None:
    """What columns take from the noise by chance is given back."""
    draw = np.random.default_rng(6)
    one = bank([run(base(), base()[0] + noise(7))])
    for _ in range(COUNT // 12):
        column = draw.normal(size=COUNT)
        one.add(hypothesis("chance", lambda r, shape, column=column: column), {})  # type: ignore[misc]
    assert colours(one)[0][0].deviations[-1] == pytest.approx(DEVIATION, rel=0.05)


def test_slow_columns_do_not_make_slow_noise_small() -> None:
    """In a short run they take seven eighths of what noise has there, and little of what it has elsewhere.

    What is given back is a little too little on average; that of single runs is skew.
    """
    count, found = 700, []
    t = np.arange(count)
    for seed in range(40):
        one = bank([run(np.ones((1, count)), noise(seed, count))])
        for k in range(1, 60):
            column = np.sin(np.pi * (k + 0.3) * t / count + 0.7 * k)
            one.add(hypothesis(f"slow{k}", lambda r, shape, column=column: column), {})  # type: ignore[misc]
        found.append(colours(one)[0][0].spectrum(np.array([0.005, 0.3]), 1.0) / 2)
    expected = [DEVIATION**2 / np.abs(1 - 0.8 * np.exp(-2j * np.pi * f)) ** 2 for f in (0.005, 0.3)]
    assert np.mean(found, axis=0) == pytest.approx(expected, rel=0.2)


def test_a_column_that_holds_the_record_s_noise_does_not_make_it_small() -> None:
    """A current beyond a limit is the noise of a joint that holds a weight."""
    tau = base()[0] + noise(7)
    one = bank([run(base(), tau)])
    recorded = replace(hypothesis("limit", lambda r, shape: tau - 0.9), recorded=True)
    one.add(recorded, {})
    assert colours(one)[0][0].deviations[-1] == pytest.approx(DEVIATION, rel=0.05)
    other = bank([run(base(), tau)])
    other.add(replace(recorded, recorded=False), {})
    assert colours(other)[0][0].deviations[-1] < 0.1 * DEVIATION


def test_columns_added_late_count_as_those_from_the_start() -> None:
    """The Gram matrix that grows is the one that is made at once; both are the products of white rows."""
    draw = np.random.default_rng(8)
    kept = draw.random((2, COUNT)) > 0.1
    tau = draw.normal(size=(2, COUNT))
    columns = draw.normal(size=(3, 2, COUNT))
    known = colour([noise(9)], order=3)

    def offered(i: int):  # type: ignore[no-untyped-def]
        return hypothesis(f"column{i}", lambda r, shape: columns[i, r])

    early, late = (bank([run(base(), y, rows) for y, rows in zip(tau, kept, strict=True)]) for _ in range(2))
    for i in range(3):
        early.add(offered(i), {})
    early.whiten([[known], [known]])
    late.add(offered(0), {})
    late.whiten([[known], [known]])
    for i in (1, 2):
        variant = late.add(offered(i), {})
        assert variant is not None
        assert variant.columns == (3 + i,)
    for r in range(2):
        rows = known.white(np.vstack([base(), columns[:, r], tau[r]]), kept[r])
        assert late.grams[r] == pytest.approx(rows @ rows.T, rel=1e-9, abs=1e-6)
        assert early.grams[r] == pytest.approx(late.grams[r], rel=1e-9, abs=1e-6)
        values = {0: 0.5, 4: -2.0, 5: 1.0}
        left = tau[r] - 0.5 * base()[0] + 2.0 * columns[1, r] - columns[2, r]
        assert late.residual(r, 0, values, white=False) == pytest.approx(left)
        assert late.residual(r, 0, values) == pytest.approx(known.white(left[None], kept[r])[0])


def test_columns_that_are_only_tried_have_the_products_of_those_that_are_kept() -> None:
    draw = np.random.default_rng(8)
    tau, columns, kept = draw.normal(size=(2, COUNT)), draw.normal(size=(2, 2, COUNT)), draw.random((2, COUNT)) > 0.1
    known = colour([noise(9)], order=3)
    first, tried = (hypothesis(f"column{i}", lambda r, shape, i=i: columns[i, r]) for i in range(2))  # type: ignore[misc]
    one = bank([run(base(), y, rows) for y, rows in zip(tau, kept, strict=True)])
    one.add(first, {})
    one.whiten([[known], [known]])
    count = one.count
    products = one.products(tried, {}, [1, count - 1], [0, 1])
    assert products is not None
    assert one.count == count
    one.add(tried, {})
    expected = sum(one.grams)[count, [1, count - 1, count, count + 1]]
    assert products[0] == pytest.approx(expected)


def test_columns_that_are_nothing_or_no_numbers_are_refused() -> None:
    one = whitened(bank([run(base(), noise(10))]))
    before = one.count
    assert one.add(hypothesis("nothing", lambda r, shape: np.zeros(COUNT)), {}) is None
    assert one.add(hypothesis("impossible", lambda r, shape: np.full(COUNT, np.nan)), {}) is None
    assert one.count == before
    assert not one.variants


@pytest.mark.parametrize("count", [150, 400])
@pytest.mark.parametrize("times", [0.2, 1.0, 5.0])
def test_a_short_run_has_its_own_power(times: float, count: int) -> None:
    """Beside a long one that repeats, whatever that has; about as much as the long one's is the long one's."""
    found = []
    for seed in range(10):
        runs = [run(base(), base()[0] + noise(seed), period=PERIOD)]
        runs.append(run(base(count), base(count)[0] + times * noise(seed + 50, count)))
        of_each = colours(bank(runs))
        assert of_each[0][0].deviations[-1] == pytest.approx(DEVIATION, rel=0.1)
        found.append(of_each[1][0].deviations[-1] / DEVIATION)
    assert np.mean(found) == pytest.approx(times, rel=0.08)
    assert np.std(found) < 0.1 * times


def test_rows_of_one_rate_have_one_colour() -> None:
    """The law that is that of rows at one rate is not that of rows at another, whose noise is white."""
    runs = [run(base(), base()[0] + noise(1), period=PERIOD)]
    white = DEVIATION * np.random.default_rng(2).normal(size=COUNT)
    runs.append(run(base(), base()[0] + white, period=PERIOD))
    runs[1].rate, runs[1].factor = 75.0, 1
    first, second = colours(bank(runs))
    expect_the_noise(first[0])
    assert second[0].filters[-1][1:] == pytest.approx(np.zeros(10), abs=0.12)


def test_noise_beyond_the_rows_of_a_slow_run_is_as_strong_as_at_their_end() -> None:
    """It is no mirror image of what is below."""
    runs = [run(base(), base()[0] + noise(1), period=PERIOD)]
    one = bank(runs)
    one.whiten(colours(one))
    end = runs[0].rate / 2
    inside, *beyond = density(one, 0, np.array([end, 1.2 * end, 1.9 * end]))
    assert beyond == pytest.approx([inside, inside])
    assert density(one, 0, np.array([0.1 * end]))[0] > 2 * inside


@pytest.mark.parametrize("periods", [1.8, 2.0, 4.0, 10.0])
def test_rounding_counts_as_itself_however_few_periods_there_are(periods: float) -> None:
    """It is known, and nothing of it is lost in what the periods have in common."""
    draw, period, power = np.random.default_rng(7), 400, []
    for _ in range(8):
        count = round(periods * period)
        W = np.stack([np.sin(2 * np.pi * np.arange(count) / period), np.ones(count)])
        tau = W[0] + 1e-3 * draw.normal(size=count)
        ((colour,),) = colours(bank([run(W, tau, period=period)]), [draw.normal(size=(1, count))])
        power.append(colour.deviations[-1] ** 2)
    assert np.mean(power) == pytest.approx(1.0, abs=0.12)
