"""Lack of fit is found where it is, and not where it is not."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from identification.diagnosis.verdict.lack_of_fit import Lack, lack_of_fit

Array = NDArray[np.float64]

PERIOD, COUNT = 200, 1000


def one_run(
    period: int = PERIOD,
    name: str = "A.csv",
    unsettled_at: slice = slice(0),
    left_out: slice = slice(0),
    rate: float = 50.0,
    speed: Array | None = None,
) -> Any:
    kept = np.arange(COUNT) % 17 != 0
    kept[left_out] = False
    unsettled = np.zeros((1, COUNT), dtype=bool)
    unsettled[0, unsettled_at] = True
    motion = SimpleNamespace(qd=(np.ones(COUNT) if speed is None else speed)[None])
    sampled = SimpleNamespace(run=SimpleNamespace(name=name), motion=motion)
    return SimpleNamespace(
        period=period,
        times=COUNT / period if period else 0.0,
        t=np.arange(COUNT) / rate,
        rate=rate,
        kept=kept[None],
        unsettled=unsettled,
        sampled=sampled,
        decimated=lambda x: x,
    )


def lack(e: Array, period: int = PERIOD) -> Lack:
    run = one_run(period)
    return lack_of_fit([run], [e[run.kept[0]]], 0, 3)


def test_white_noise_fails_as_often_as_the_level_says() -> None:
    draw = np.random.default_rng(1)
    found = [lack(draw.normal(size=COUNT)) for _ in range(400)]
    p = np.array([one.p for one in found])
    # Uniform: 400 draws lie within 1.63/sqrt(400) of the line at 1 % (Kolmogorov).
    assert np.abs(np.sort(p) - np.arange(1, 401) / 400).max() < 0.082
    assert np.mean([one.ratio for one in found]) == pytest.approx(1.0, abs=0.02)
    assert all(one.repeats and one.joint == 3 for one in found)
    assert not any(one.burst for one in found)


def test_what_repeats_is_measured_in_parts_of_the_noise() -> None:
    draw = np.random.default_rng(2)
    wave = 0.5 * np.sqrt(2) * np.sin(2 * np.pi * np.arange(COUNT) / PERIOD * 4)
    found = lack(draw.normal(size=COUNT) + wave)
    assert found.p < 1e-10
    assert found.size == pytest.approx(0.5, rel=0.2)


def test_noise_that_is_larger_than_thought_is_no_lack_of_fit() -> None:
    draw = np.random.default_rng(3)
    assert lack(2.0 * draw.normal(size=COUNT)).p > 1e-3


def test_what_differs_between_periods_is_not_called_common() -> None:
    draw = np.random.default_rng(4)
    growing = np.arange(COUNT) // PERIOD - 2.0
    assert lack(draw.normal(size=COUNT) + growing).p > 0.5


def test_without_periods_power_is_compared() -> None:
    draw = np.random.default_rng(5)
    assert lack(draw.normal(size=COUNT), 0).p > 1e-3
    found = lack(1.5 * draw.normal(size=COUNT), 0)
    assert not found.repeats
    assert found.p < 1e-10
    assert found.size == pytest.approx(np.sqrt(1.5**2 - 1), rel=0.15)


@pytest.mark.parametrize("period", [0, PERIOD])
def test_an_event_that_happens_once_is_told_with_its_time(period: int) -> None:
    draw = np.random.default_rng(6)
    e = draw.normal(size=COUNT)
    e[620:628] += 8.0
    found = lack(e, period)
    assert found.burst is not None
    assert (found.burst.run, found.burst.count) == ("A.csv", 1)
    assert found.burst.time == pytest.approx(624 / 50, abs=0.15)
    assert found.event == f"once, at {found.burst.time:.2f} s of A.csv"


@pytest.mark.parametrize("at", [620, 621, 625, 633])
def test_the_time_of_an_event_lies_within_it(at: int) -> None:
    """Of three rows, wherever the noise beside it makes the power of ten largest."""
    draw = np.random.default_rng(8)
    for _ in range(20):
        e = draw.normal(size=COUNT)
        e[at : at + 3] += 12.0
        found = lack(e)
        assert found.burst is not None
        assert at / 50 <= found.burst.time <= (at + 2) / 50


def test_events_of_several_moments_and_runs_are_counted() -> None:
    """Two in one run, the second the largest, and one in another."""
    draw = np.random.default_rng(6)
    first, second = one_run(0), one_run(0, "B.csv")
    e, other = draw.normal(size=(2, COUNT))
    e[220:228] += 7.0
    e[620:628] += 8.0
    other[420:428] += 7.0
    found = lack_of_fit([first, second], [e[first.kept[0]], other[second.kept[0]]], 0, 3)
    assert found.burst is not None
    assert found.event == f"at least 3 times, the largest at {found.burst.time:.2f} s of A.csv"
    assert found.burst.time == pytest.approx(624 / 50, abs=0.15)


@pytest.mark.parametrize("run", [one_run(0, left_out=slice(630, 700)), one_run(0, rate=0.8)])
def test_one_event_beside_rows_that_are_left_out_or_slow_counts_once(run: Any) -> None:
    draw = np.random.default_rng(6)
    e = draw.normal(size=COUNT)
    e[620:628] += 8.0
    found = lack_of_fit([run], [e[run.kept[0]]], 0, 3)
    assert found.burst is not None
    assert found.event.startswith("once, at ")


def test_two_events_on_both_sides_of_rows_that_are_left_out_count_twice() -> None:
    draw = np.random.default_rng(6)
    e = draw.normal(size=COUNT)
    e[626:629] += 15.0
    e[700:703] += 12.0
    run = one_run(0, left_out=slice(630, 700))
    found = lack_of_fit([run], [e[run.kept[0]]], 0, 3)
    assert found.event.startswith("at least 2 times, the largest at 12.5")


def test_what_comes_again_with_each_period_is_no_event_but_lacks() -> None:
    draw = np.random.default_rng(6)
    e = draw.normal(size=COUNT)
    for period in range(COUNT // PERIOD):
        e[PERIOD * period + 20 : PERIOD * period + 28] += 8.0
    found = lack(e)
    assert found.burst is None
    assert found.p < 1e-10


def test_no_event_is_told_where_a_joint_is_unsettled() -> None:
    draw = np.random.default_rng(6)
    e = draw.normal(size=COUNT)
    e[620:628] += 8.0
    run = one_run(unsettled_at=slice(615, 640))
    assert lack_of_fit([run], [e[run.kept[0]]], 0, 3).burst is None


@pytest.mark.parametrize(("size", "told"), [(1.0, True), (8.0, False)])
def test_a_swing_that_comes_late_is_no_event(size: float, told: bool) -> None:
    draw = np.random.default_rng(6)
    e, swing = draw.normal(size=COUNT), np.zeros(COUNT)
    e[620:628] += 8.0
    swing[600:650] = size
    run = one_run()
    found = lack_of_fit([run], [e[run.kept[0]]], 0, 3, [swing[run.kept[0]]])
    assert (found.burst is not None) == told


@pytest.mark.parametrize(("hits", "told"), [((), False), ((310,), True), ((310, 710), True)])
def test_noise_that_grows_with_the_speed_is_no_event(hits: tuple[int, ...], told: bool) -> None:
    """In two short moves the joint is fast; in each of them it may hit something."""
    draw = np.random.default_rng(12)
    speed = np.full(COUNT, 0.1)
    speed[300:340], speed[700:740] = 1.0, 0.9
    e = draw.normal(size=COUNT) * np.where(speed > 0.5, 5.0, 0.7)
    for hit in hits:
        e[hit : hit + 4] += 40.0
    run = one_run(period=0, speed=speed)
    found = lack_of_fit([run], [e[run.kept[0]]], 0, 3)
    assert (found.burst is not None) == told
