"""Samples that stand out alone are interpolated and told; jumps, peaks and steps are the signal's own."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from generator.errors import InputError
from generator.robot.description import Robot
from generator.robot.readers import read
from identification.dataset import load
from identification.glitches import glitches
from identification.observation import Regressors
from tests.recorded import SLIDE, TRUTH, TWO_LINKS, Recorded, fourier

Array = NDArray[np.float64]

PERIOD = 0.002
T = PERIOD * np.arange(8000)
#: A motion's torque, with friction that jumps where it reverses.
SMOOTH = 20 * np.sin(2 * np.pi * 0.3 * T) + 6 * np.sign(np.cos(2 * np.pi * 0.3 * T + 0.2))


def two_links(folder: Path) -> Robot:
    path = folder / "two_links.yaml"
    path.write_text(TWO_LINKS)
    return read(path)


def columns_of(q: Array, tau: Array) -> dict[str, Array]:
    """Columns by name, of which each may be spoilt."""
    return {f"{stem}{k}": row.copy() for stem, x in (("q", q), ("tau", tau)) for k, row in enumerate(x, 1)}


def noisy(x: Array, deviation: float) -> Array:
    return x + deviation * np.random.default_rng(4).normal(size=x.shape)


@pytest.mark.parametrize("noise", [0.0, 0.05, 0.3])
@pytest.mark.parametrize("wrong", [[100], [100, 101], [100, 101, 102], [40, 300, 301, 5000]])
def test_glitches_are_found(wrong: list[int], noise: float) -> None:
    x = noisy(SMOOTH, noise)
    x[wrong] += 15.0
    assert glitches(x, PERIOD).tolist() == wrong


def test_a_dropout_to_zero_is_found() -> None:
    x = noisy(SMOOTH, 0.1)
    x[[90, 91]] = 0.0
    assert glitches(x, PERIOD).tolist() == [90, 91]


@pytest.mark.parametrize(
    "x",
    [
        SMOOTH,
        noisy(SMOOTH, 0.2),
        np.round(noisy(SMOOTH, 0.2)),
        np.abs((0.9 * T) % 2 - 1),
        np.repeat(noisy(SMOOTH, 0.2)[::5], 5),
        np.random.default_rng(1).standard_t(4, size=8000),
        np.zeros(8000),
        np.arange(6.0),
    ],
    ids=["jumps", "noise", "coarse", "kinks", "held", "heavy tails", "nothing", "short"],
)
def test_what_is_the_signals_own_stays(x: Array) -> None:
    assert not glitches(x, PERIOD).size


@pytest.mark.parametrize(("every", "found"), [(120, 67), (90, 0)])
def test_many_are_no_glitches(every: int, found: int) -> None:
    """A hundredth of the samples at most, here of 8000."""
    x = noisy(SMOOTH, 0.1)
    x[40::every] += 10.0
    assert len(glitches(x, PERIOD)) == found


def test_steps_of_a_joint_that_stands_are_no_glitches() -> None:
    x = np.zeros(8000)
    x[::200] = 1e-4
    assert not glitches(x, PERIOD).size


def test_a_short_peak_between_few_samples_is_the_robots() -> None:
    t = 0.01 * np.arange(2000)
    x = noisy(SMOOTH[::4], 0.02) + 20 * np.exp(-(((t - 7.003) / 0.008) ** 2) / 2)
    assert not glitches(x, 0.01).size
    x[350] += 10.0
    assert glitches(x, 0.01).tolist() == [350]


def test_a_run_is_read_without_them_and_says_so(tmp_path: Path) -> None:
    robot = two_links(tmp_path)
    t, motion = fourier(robot, 10.0, 500.0)
    tau = Regressors(robot).torques(TRUTH, motion)
    columns = columns_of(motion.q, tau)
    good = load(str(Recorded({"t": t, **columns}).save(tmp_path / "good.csv")), robot)
    spoilt = columns_of(motion.q, tau)
    spoilt["q1"][700] += 0.02
    spoilt["tau2"][[1200, 1201, 3000]] = -500.0
    run = load(str(Recorded({"t": t, **spoilt}).save(tmp_path / "spoilt.csv")), robot)
    np.testing.assert_allclose(run.q, good.q, atol=1e-9)
    np.testing.assert_allclose(run.tau, good.tau, atol=3e-7)
    first, second = run.notes
    assert "spoilt.csv:702:" in first
    assert first.endswith("q1 is off from its neighbours; it was interpolated")
    assert "spoilt.csv:1202:" in second
    assert "tau2 is off from its neighbours, and 2 further samples too" in second


def test_many_columns_make_one_note(tmp_path: Path) -> None:
    robot = two_links(tmp_path)
    t, motion = fourier(robot, 10.0, 500.0)
    columns = columns_of(motion.q, Regressors(robot).torques(TRUTH, motion))
    columns["tau1"][[900, 1300]] = -500.0
    columns["tau2"][700] = 500.0
    (note,) = load(str(Recorded({"t": t, **columns}).save(tmp_path / "spoilt.csv")), robot).notes
    assert "spoilt.csv:902:" in note
    assert note.endswith(
        "tau1 is off from its neighbours, and 2 further samples of tau1 and tau2 too; they were interpolated"
    )


@pytest.mark.parametrize("wrong", [[700], [700, 701, 702]])
def test_a_position_far_from_all_others_is_refused_at_its_row(wrong: list[int], tmp_path: Path) -> None:
    robot = two_links(tmp_path)
    t, motion = fourier(robot, 10.0, 500.0)
    columns = columns_of(motion.q, motion.qd)
    columns["q1"][wrong] -= 1.5 * np.sign(motion.qd[0, 700])
    with pytest.raises(InputError, match=r"far.csv:702:\d+: q1 jumps"):
        load(str(Recorded({"t": t, **columns}).save(tmp_path / "far.csv")), robot)


@pytest.mark.parametrize(
    ("limits", "hint"), [("limits: [-160 deg, 160 deg]", "another robot"), ("label: free", "turn on")]
)
def test_samples_beyond_the_limits_are_counted(limits: str, hint: str, tmp_path: Path) -> None:
    """One that is wrong is not taken for degrees, though all were inside if they were; without its row the run is
    read.
    """
    path = tmp_path / "two_links.yaml"
    path.write_text(TWO_LINKS.replace("limits: [-160 deg, 160 deg]", limits))
    robot = read(path)
    t, motion = fourier(robot, 10.0, 500.0)
    columns = columns_of(motion.q, motion.qd)
    columns["q1"][700] = 13.5
    spoilt = Recorded({"t": t, **columns})
    counted = (
        rf":702:\d+: q1 gives joint 1 13.5 rad, .*, in 1 of {len(t)} samples, of which this is the first, expected"
    )
    with pytest.raises(InputError, match=rf"{counted}.*; a wrong row may be deleted"):
        load(str(spoilt.save(tmp_path / "far.csv")), robot)
    often = np.where(np.arange(len(t)) % 10, columns["q1"], 13.5)
    with pytest.raises(InputError, match=rf"in 500 of {len(t)} samples, .*{hint}\?$"):
        load(str(spoilt.with_columns(q1=often).save(tmp_path / "often.csv")), robot)
    rest = {name: np.delete(x, 700) for name, x in spoilt.columns.items()}
    (note,) = load(str(Recorded(rest).save(tmp_path / "rest.csv")), robot).notes
    assert "1 of 5000 samples are missing" in note


@pytest.mark.parametrize(
    ("wrong", "lost"),
    [
        ([700, 701, 702, 703], True),
        ([0, 1, 4998, 4999], True),
        ([*range(30, 5000, 60)], True),
        ([*range(700, 705)], False),
        ([*range(700, 1000)], False),
        ([*range(30, 5000, 9)], False),
        ([*range(700, 716, 2)], False),
    ],
    ids=["few", "ends", "often", "five", "long", "many", "every other"],
)
def test_rows_may_be_deleted_where_the_run_is_read_without_them(wrong: list[int], lost: bool, tmp_path: Path) -> None:
    robot = two_links(tmp_path)
    t, motion = fourier(robot, 10.0, 500.0)
    columns = {"t": t, **columns_of(motion.q, motion.qd)}
    rest = {name: np.delete(x, wrong) for name, x in columns.items()}
    columns["q1"][wrong] = 13.5
    hint = "; a wrong row may be deleted" if lost else r"; is this a run of another robot\?$"
    with pytest.raises(InputError, match=hint):
        load(str(Recorded(columns).save(tmp_path / "far.csv")), robot)
    if lost:
        load(str(Recorded(rest).save(tmp_path / "rest.csv")), robot)
    else:
        with pytest.raises(InputError, match=r"time steps by .*, expected one rate without gaps"):
            load(str(Recorded(rest).save(tmp_path / "rest.csv")), robot)


#: How a joint moves [deg], what it is asked where it has limits, and where it has none.
IN_DEGREES = {
    "small": (lambda x: 1.5 + 6.5 * x, "are these degrees", ""),
    "far": (lambda x: 100 + 2 * x, "are these degrees", "are these degrees, or does the joint turn on"),
    "once": (
        lambda x: 600 * np.maximum(x - 0.95, 0),
        "are these degrees",
        "are these degrees, or does the joint turn on",
    ),
    "tiny": (lambda x: 4 * x, "are these degrees, or is this a run of another robot", ""),
    "farther": (
        lambda x: 200 + 2 * x,
        "is this a run of another robot",
        "are these degrees, or does the joint turn on",
    ),
    "turns": (lambda x: 800 + 2 * x, "is this a run of another robot", "does the joint turn on"),
}


@pytest.mark.parametrize("way", IN_DEGREES)
def test_degrees_are_asked_for_where_a_joint_moves_beyond_its_limits(way: str, tmp_path: Path) -> None:
    move, limited, free = IN_DEGREES[way]
    t = np.arange(2000) / 200
    q = np.stack([move(np.sin(0.2 * np.pi * t)), 0.3 * np.sin(t)])
    run = Recorded({"t": t, **columns_of(q, np.cos(np.stack([t, 2 * t])))}).save(tmp_path / "run.csv")
    for limits, hint in (("limits: [-160 deg, 160 deg]", limited), ("label: free", free)):
        path = tmp_path / "two_links.yaml"
        path.write_text(TWO_LINKS.replace("limits: [-160 deg, 160 deg]", limits))
        if hint:
            with pytest.raises(InputError, match=rf"q1 gives joint 1 .*; {re.escape(hint)}\?$"):
                load(str(run), read(path))


def test_millimetres_are_asked_for_where_a_slide_is_beyond_its_limits(tmp_path: Path) -> None:
    path = tmp_path / "slide.yaml"
    path.write_text(SLIDE.replace("r: q1}", "r: q1, limits: [0 m, 0.21 m]}"))
    t = np.arange(2000) / 200
    for way, hint in ((105 + 90 * np.sin(t), "are these millimetres"), (1.5 + np.sin(t), "is this a run of another")):
        run = Recorded({"t": t, "q1": way, "tau1": np.cos(t)}).save(tmp_path / "run.csv")
        with pytest.raises(InputError, match=f"q1 gives joint 1 .* m, outside of .*{hint}"):
            load(str(run), read(path))


def test_the_first_of_several_jumps_is_told_though_others_are_larger(tmp_path: Path) -> None:
    robot = two_links(tmp_path)
    t, motion = fourier(robot, 10.0, 500.0)
    columns = columns_of(motion.q, motion.qd)
    columns["q1"][700] += 0.3
    columns["q1"][3000] += 0.9
    columns["q1"][400] += 0.15
    with pytest.raises(InputError, match=r"several.csv:702:\d+: q1 jumps"):
        load(str(Recorded({"t": t, **columns}).save(tmp_path / "several.csv")), robot)


def test_a_torque_that_is_cut_off_is_not_hidden_by_glitches(tmp_path: Path) -> None:
    robot = two_links(tmp_path)
    t, motion = fourier(robot, 10.0, 500.0)
    tau = Regressors(robot).torques(TRUTH, motion)
    limit = float(np.quantile(np.abs(tau[0]), 0.6))
    tau[0] = np.clip(tau[0], -limit, limit)
    inside = np.flatnonzero(tau[0] == limit)[50]
    tau[0, [900, 2200, inside]] = 20 * limit, -20 * limit, 9 * limit
    columns = columns_of(motion.q, tau)
    with pytest.raises(InputError, match="tau1 stays at"):
        load(str(Recorded({"t": t, **columns}).save(tmp_path / "cut.csv")), robot)


@pytest.mark.parametrize("jitter", [0.05, 0.3])
def test_a_clock_that_jitters_is_told_beside_glitches(jitter: float, tmp_path: Path) -> None:
    robot = two_links(tmp_path)
    even, motion = fourier(robot, 10.0, 500.0)
    t = even + jitter * PERIOD * np.random.default_rng(3).uniform(-1, 1, even.shape)
    columns = columns_of(motion.q, motion.qd)
    columns["q1"][[400, 1500, 2600, 3700]] += 0.1
    run = load(str(Recorded({"t": t, **columns}).save(tmp_path / "run.csv")), robot)
    assert any("times jitter" in note for note in run.notes)
    assert np.max(np.abs(np.diff(run.q[0], 2))) / PERIOD**2 < 2 * np.max(np.abs(motion.qdd[0]))


def test_samples_are_interpolated_at_the_times_of_their_neighbours(tmp_path: Path) -> None:
    robot = two_links(tmp_path)
    even, motion = fourier(robot, 10.0, 500.0)
    t = even + 0.0003 * np.sin(2 * np.pi * even)
    # What each row would have at its own time, of a motion slow enough for lines.
    q = np.stack([np.interp(t, even, x) for x in motion.q])
    columns = columns_of(q, motion.qd)
    good = load(str(Recorded({"t": t, **columns}).save(tmp_path / "good.csv")), robot)
    columns["q2"][2600] += 0.02
    run = load(str(Recorded({"t": t, **columns}).save(tmp_path / "spoilt.csv")), robot)
    assert any("q2 is off from its neighbours" in note for note in run.notes)
    np.testing.assert_allclose(run.q, good.q, atol=1e-6)
