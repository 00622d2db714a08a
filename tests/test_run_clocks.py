"""Times of a run: uneven, of a clock that jitters or drifts, with samples that were lost."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from generator.errors import InputError
from generator.robot.description import Robot
from identification.dataset import load
from tests.recorded import Recorded, stacked


def test_uneven_times_are_evened_and_told(good: Recorded, robot: Robot, tmp_path: Path) -> None:
    t = good.columns["t"].copy()
    t[1:-1] += 0.001 * np.sin(np.arange(1598))
    shaken = {name: np.interp(t, good.columns["t"], good.columns[name]) for name in ("q1", "q2", "tau1", "tau2")}
    run = load(str(Recorded({"t": t, **shaken}).save(tmp_path / "a.csv")), robot)
    assert "times are uneven; samples were interpolated to 200 Hz" in run.notes[0]
    assert np.abs(run.q - stacked(good, "q")).max() < 1e-4


@pytest.mark.parametrize("size", [0.1, 0.35])
def test_rows_at_even_times_whose_clock_jitters_are_taken_as_even(
    size: float, good: Recorded, robot: Robot, tmp_path: Path
) -> None:
    t = good.columns["t"].copy()
    t[1:-1] += 0.005 * np.random.default_rng(1).uniform(-size, size, 1598)
    run = load(str(good.with_columns(t=t).save(tmp_path / "a.csv")), robot)
    assert "times jitter; positions are smoother at even ones, which were taken" in run.notes[0]
    assert len(run.notes) == 1
    assert np.abs(run.q - stacked(good, "q")).max() < 1e-9


def test_coarse_positions_whose_clock_jitters_are_taken_as_even(good: Recorded, robot: Robot, tmp_path: Path) -> None:
    """Their steps are as rough by any times."""
    t = good.columns["t"].copy()
    speed = np.median([np.abs(np.gradient(good.columns[name], t)) for name in ("q1", "q2")])
    t[1:-1] += 0.05 * 0.005 * np.random.default_rng(1).normal(size=1598)
    step = 5 * 0.05 * 0.005 * speed
    coarse = {name: step * np.round(good.columns[name] / step) for name in ("q1", "q2")}
    run = load(str(good.with_columns(t=t, **coarse).save(tmp_path / "a.csv")), robot)
    assert "times jitter; positions are smoother at even ones, which were taken" in run.notes[0]


def test_a_clock_that_drifts_is_right(good: Recorded, robot: Robot, tmp_path: Path) -> None:
    """Positions in steps are as rough by even times as by true ones."""
    t = good.columns["t"] + 5e-3 * np.sin(2 * np.pi * good.columns["t"] / 8.0)
    at = {name: np.interp(t, good.columns["t"], good.columns[name]) for name in ("q1", "q2", "tau1", "tau2")}
    for name in ("q1", "q2"):
        at[name] = 2e-5 * np.round(at[name] / 2e-5)
    run = load(str(Recorded({"t": t, **at}).save(tmp_path / "a.csv")), robot)
    assert "times are uneven; samples were interpolated" in run.notes[0]


def test_single_lost_samples_are_interpolated_left_out_and_told(good: Recorded, robot: Robot, tmp_path: Path) -> None:
    lost = [300, 700, 701, 702, 1200]
    kept = Recorded({name: np.delete(values, lost) for name, values in good.columns.items()})
    run = load(str(kept.save(tmp_path / "a.csv")), robot)
    assert "5 of 1600 samples are missing; samples were interpolated to 200 Hz" in run.notes[0]
    assert run.samples == 1600
    assert run.unusable is not None
    for row in run.unusable:
        assert np.flatnonzero(row).tolist() == lost
    present = np.delete(np.arange(1600), lost)
    assert np.abs(run.q - stacked(good, "q"))[:, present].max() < 1e-9
    assert np.abs(run.q - stacked(good, "q")).max() < 1e-4


@pytest.mark.parametrize("lost", [range(500, 505), range(10, 1590, 5), range(1500, 1520, 2)])
def test_many_lost_samples_are_refused(lost: range, good: Recorded, robot: Robot, tmp_path: Path) -> None:
    kept = Recorded({name: np.delete(values, list(lost)) for name, values in good.columns.items()})
    with pytest.raises(InputError, match="time steps by"):
        load(str(kept.save(tmp_path / "a.csv")), robot)


@pytest.mark.parametrize("rows", [6, 30])
def test_rows_that_a_log_repeated_are_refused(rows: int, good: Recorded, robot: Robot, tmp_path: Path) -> None:
    held = {name: values.copy() for name, values in good.columns.items()}
    for name, values in held.items():
        if name != "t":
            values[700 : 700 + rows] = values[699]
    with pytest.raises(
        InputError, match=rf"a.csv:702:\d+: nothing changes from here for {rows} rows, and q\d then jumps"
    ):
        load(str(Recorded(held).save(tmp_path / "a.csv")), robot)


def test_rows_that_are_missing_in_even_times_are_refused(good: Recorded, robot: Robot, tmp_path: Path) -> None:
    cut = {name: np.delete(values, range(700, 730)) for name, values in good.columns.items()}
    times = {"t": good.columns["t"][: len(cut["t"])]}
    with pytest.raises(InputError, match=r"a.csv:702:\d+: q\d jumps by -?0\.\d+ in this row alone, expected rows with"):
        load(str(Recorded({**cut, **times}).save(tmp_path / "a.csv")), robot)


def test_a_robot_that_rests_repeats_its_rows(good: Recorded, robot: Robot, tmp_path: Path) -> None:
    """Time for which the run goes on from where it rested, without a jump."""
    rested = {name: np.insert(values, 700, np.full(60, values[700])) for name, values in good.columns.items()}
    t = np.arange(len(rested["t"])) * 0.005
    run = load(str(Recorded({**rested, "t": t}).save(tmp_path / "a.csv")), robot)
    assert run.notes == ()
    assert run.samples == len(t)


def test_samples_lost_by_chance_come_close_to_each_other(good: Recorded, robot: Robot, tmp_path: Path) -> None:
    """Three of five in a row are no other rate."""
    lost = [200, 202, 204, *range(300, 1500, 60)]
    kept = Recorded({name: np.delete(values, lost) for name, values in good.columns.items()})
    run = load(str(kept.save(tmp_path / "a.csv")), robot)
    assert f"{len(lost)} of 1600 samples are missing; samples were interpolated" in run.notes[0]
