"""Whether a motion repeats, and which parts of which runs are fitted, validate and test."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from generator.errors import InputError, Place
from generator.resources import find_robot
from generator.robot.description import PRISMATIC, REVOLUTE
from generator.robot.readers import read
from identification.dataset import Run
from identification.diagnosis.runs.periods import period_of, repeating
from identification.diagnosis.runs.prepared import prepared
from identification.diagnosis.runs.roles import roles
from identification.diagnosis.runs.told_files import told_files
from identification.diagnosis.verdict.remarks import of_motion
from identification.observation import Regressors
from identification.recipes import Recipe

Array = NDArray[np.float64]


def series(count: int, period: int, seed: int = 1, noise: float = 0.0) -> Array:
    """Two joints on random Fourier series of four harmonics (2 x count) [rad]."""
    draw = np.random.default_rng(seed)
    t = np.arange(count)
    q = np.zeros((2, count))
    for k in range(1, 5):
        a, b = draw.normal(size=(2, 2, 1)) / k
        q += a * np.cos(2 * np.pi * k * t / period) + b * np.sin(2 * np.pi * k * t / period)
    return q + noise * draw.normal(size=q.shape)


@pytest.mark.parametrize("periods", [2, 3.3, 6])
def test_the_period_is_found(periods: float) -> None:
    assert period_of(series(int(periods * 750) + 1, 750), 0.002) == 750


def test_a_drive_may_catch_up_at_first() -> None:
    q = series(3000, 750)
    q += 0.05 * np.exp(-np.arange(3000) / 50)
    assert period_of(q, 0.002) == 750


@pytest.mark.parametrize(("before", "after", "periods"), [(700, 0, 2), (0, 600, 2.5), (500, 500, 4), (760, 0, 3)])
def test_ways_to_and_from_a_motion_that_repeats_are_no_part_of_it(before: int, after: int, periods: float) -> None:
    """At rest, then by a smooth way to where the motion begins; and back."""
    q = series(int(750 * periods) + 1, 750)
    parts = [0.5 - 0.5 * np.cos(np.linspace(0, np.pi, max(count, 1))) for count in (before, after)]
    to, back = q[:, :1] * parts[0][:before], q[:, -1:] * parts[1][:after][::-1]
    period, stretch = repeating(np.concatenate([to, q, back], axis=1), 0.002)
    assert period == 750
    assert stretch.start == pytest.approx(before, abs=30)
    assert stretch.stop == pytest.approx(before + q.shape[1], abs=30)


def test_all_of_a_motion_that_repeats_counts() -> None:
    assert repeating(series(3000, 750), 0.002) == (750, slice(0, 3000))
    t = np.arange(3000) / 750
    assert repeating(np.sin(2 * np.pi * np.array([[1.0], [np.sqrt(2)]]) * t), 0.002) == (0, slice(0, 3000))


def test_noise_of_encoders_does_no_harm() -> None:
    found = period_of(series(3000, 750, noise=1e-4), 0.002)
    assert found == 750


def test_a_joint_that_rests_does_not_count() -> None:
    q = series(3000, 750)
    q[1] = 0.3
    assert period_of(q, 0.002) == 750
    assert period_of(np.full((2, 3000), 0.3), 0.002) == 0


def test_a_joint_that_is_held_does_not_count() -> None:
    """Its encoder trembles between two steps, which does not repeat; one that is moved a little counts."""
    q = series(3000, 750)
    tremble = np.random.default_rng(3).integers(0, 2, 3000)
    q[1] = 0.3 + 1e-4 * tremble
    assert period_of(q, 0.002) == 750
    q[1] = 0.3 + 0.02 * tremble
    assert period_of(q, 0.002) == 0


def test_a_short_stroke_of_a_slide_counts_beside_a_wide_turn() -> None:
    """Metres are no part of radians: 4 mm that repeat after another time than 5 rad do."""
    t = np.arange(5000) / 250.0
    q = np.stack([2.5 * np.sin(2 * np.pi * t / 5.0), 0.002 * np.sin(2 * np.pi * t / 3.7)])
    assert repeating(q, 0.004, [REVOLUTE, PRISMATIC])[0] == 0
    q[1] = 0.002 * np.sin(2 * np.pi * t / 2.5)
    assert repeating(q, 0.004, [REVOLUTE, PRISMATIC])[0] == 1250


@pytest.mark.parametrize(
    ("name", "period", "rows", "note"),
    [
        ("A", 2000, 200, ""),
        (
            "A",
            2003,
            0,
            "repeats after 2003 samples: periods are not compared; after a multiple of 10, such as 2010, they would be",
        ),
        ("A", 0, 0, "does not repeat, or not after a whole number of samples"),
        ("A@:12", 0, 0, "shows no two periods in a part of it"),
    ],
)
def test_why_periods_are_not_compared_is_told(name: str, period: int, rows: int, note: str) -> None:
    regressors = Regressors(read(find_robot("emps")))
    q = 0.1 * (series(3 * period, period)[:1] if period else np.linspace(0, 8, 6000)[None] ** 1.5)
    one = prepared(Run(name, Place("A"), 0.0, 0.002, q, np.zeros_like(q)), Recipe(), regressors)
    assert (one.period, one.repeats) == (rows, period)
    assert one.unlike == note


def test_ways_to_and_from_a_motion_that_repeats_are_left_out() -> None:
    """A second and a half before three periods of four seconds, and two seconds after them."""
    regressors = Regressors(read(find_robot("emps")))
    q = 0.1 * series(6001, 2000)[:1]
    ramps = [0.5 - 0.5 * np.cos(np.linspace(0, np.pi, count)) for count in (750, 1000)]
    way = np.concatenate([q[:, :1] * ramps[0], q, q[:, -1:] * ramps[1][::-1]], axis=1)
    one = prepared(Run("A", Place("A.csv"), 0.0, 0.002, way, np.zeros_like(way)), Recipe(), regressors)
    assert (one.period, one.repeats) == (200, 2000)
    assert one.times == pytest.approx(3.0, abs=0.05)
    assert not one.kept[0, one.t < 1.4].any()
    assert not one.kept[0, one.t > 13.6].any()
    assert one.kept[0, (one.t > 1.6) & (one.t < 13.4)].mean() > 0.5
    (note,) = of_motion([one], False)
    assert note.startswith("the motion of A repeats for 12.1 s: the other 3.")


@pytest.mark.parametrize(("swing", "kept"), [(1e-4, False), (0.05, True)])
def test_nothing_is_told_of_a_joint_that_is_held(swing: float, kept: bool) -> None:
    """What seems to be its speed is noise: its friction may have any sign."""
    regressors = Regressors(read(find_robot("scara")))
    q = np.zeros((regressors.model.dof, 6000))
    q[0], q[1] = series(6000, 1500)
    q[2] = 0.1 + swing * series(6000, 1500, seed=2)[0] / 4
    one = prepared(Run("A", Place("A"), 0.0, 0.002, q, np.zeros_like(q)), Recipe(), regressors)
    assert one.kept[:2].any(axis=1).all()
    assert one.kept[2].any() == kept


def test_what_does_not_repeat_has_no_period() -> None:
    # Two frequencies without a common period in the run; less than two periods; one joint that drifts away.
    t = np.arange(3000) * 0.002
    assert period_of(np.stack([np.sin(2 * np.pi * t), np.sin(2 * np.pi * np.sqrt(2) * t)]), 0.002) == 0
    assert period_of(series(1400, 750), 0.002) == 0
    drifting = series(3000, 750)
    drifting[0] += 0.1 * t
    assert period_of(drifting, 0.002) == 0


def test_the_shorter_period_is_not_skipped() -> None:
    # Repeats after 250 samples, hence after 500 and 750 too.
    assert period_of(series(3000, 250), 0.01) == 250


def recorded(name: str, start: float = 0.0, seconds: float = 10.0) -> Run:
    """One joint that swings all the time."""
    q = np.sin(2 * np.pi * 0.7 * np.arange(round(seconds / 0.01) + 1) * 0.01)[None]
    tau = np.random.default_rng(list(name.encode())).normal(size=q.shape)
    return Run(name, Place(name), start, 0.01, q, tau, sha256=name)


def parts(names: tuple[str, ...]) -> list[tuple[str, float, float]]:
    """``PATH@FROM:TO`` taken apart."""
    found = []
    for name in names:
        path, _, times = name.rpartition("@")
        start, end = times.split(":")
        found.append((path, float(start), float(end)))
    return found


def test_roles_that_are_given_are_kept() -> None:
    found = roles([recorded("A"), recorded("B")], [recorded("C")], [recorded("D"), recorded("E")])
    assert (found.train, found.validate, found.test) == (("A", "B"), ("C",), ("D", "E"))
    assert found.notes == ()
    assert found.untouched


def test_the_last_of_many_runs_tests_and_the_others_predict_each_other() -> None:
    runs = [recorded(name) for name in "ABC"]
    both = roles(runs, [], [])
    assert (both.train, both.validate, both.test, both.searched) == (("A", "B"), (), ("C",), ("A", "B"))
    assert both.notes[0].startswith("C, the last run, tests")
    one = roles(runs, [], [recorded("T")])
    assert (one.train, one.validate, one.test) == (("A", "B", "C"), (), ("T",))
    other = roles(runs, [recorded("V")], [])
    assert (other.train, other.validate, other.test, other.searched) == (("A", "B"), ("V",), ("C",), ("A", "B", "V"))


@pytest.mark.parametrize("validate", [[], ["V"]], ids=["none", "validates"])
def test_the_ends_of_two_runs_test_without_overlap(validate: list[str]) -> None:
    found = roles(
        [recorded("A", start=5.0, seconds=25.0), recorded("B", seconds=30.0)], [recorded(name) for name in validate], []
    )
    for (_, start, end), (_, first, last), (a, b) in zip(
        parts(found.train), parts(found.test), ((5.0, 30.0), (0.0, 30.0)), strict=True
    ):
        assert start == a
        assert last == b
        assert first - end >= 0.49
        assert last - first == pytest.approx(0.25 * (b - a))
    assert found.searched == (*found.train, *validate)
    assert any("25 % of every run test" in note for note in found.notes)


def test_short_runs_test_too_and_that_is_said() -> None:
    found = roles([recorded("A"), recorded("B")], [], [])
    assert found.test == found.searched == found.train == ("A", "B")
    assert not found.untouched
    assert "tells nothing new" in found.notes[0]


def test_the_end_of_a_long_run_tests_beside_a_short_one() -> None:
    found = roles([recorded("A", seconds=19.0), recorded("B", seconds=40.0)], [], [])
    assert found.untouched
    assert (found.train[0], found.searched) == ("A", found.train)
    ((path, start, end),) = parts(found.test)
    assert (path, start, end) == ("B", pytest.approx(30.0, abs=0.01), pytest.approx(40.0, abs=0.01))
    assert parts(found.train[1:])[0][2] < start
    assert found.notes[0].startswith("the last 25 % of B test, and what is shorter is fitted as a whole")


def test_a_run_that_is_too_short_to_tell_much_tests_and_that_is_said() -> None:
    told = "tests for 1.2 s, which tells little"
    apart = roles([recorded("A"), recorded("B"), recorded("C", seconds=1.2)], [], [])
    assert (apart.test, sum(note.startswith(f"C {told}") for note in apart.notes)) == (("C",), 1)
    given = roles([recorded("A"), recorded("B")], [], [recorded("C", seconds=1.2), recorded("D")])
    assert [note for note in given.notes if "tells little" in note] == [f"C {told}: 5 s or more are better"]


def test_files_of_one_name_are_told_with_their_folders() -> None:
    runs = [recorded(name) for name in ("1/a/run.csv", "2/a/run.csv@1:5", "2/b/run.csv@5:9", "2/b/run.csv", "b.csv")]
    assert told_files(runs) == ["1/a/run.csv", "2/a/run.csv", "b/run.csv", "b/run.csv", "b.csv"]
    assert told_files([recorded("run.csv"), recorded("x/run.csv")]) == ["run.csv", "x/run.csv"]
    (note,) = of_motion([prepared_like(run) for run in runs[:2]], False)
    assert note.startswith("the motion of 1/a/run.csv and 2/a/run.csv ")


def prepared_like(run: Run) -> Any:
    return SimpleNamespace(sampled=SimpleNamespace(run=run), unlike="changes", repeating=5, rate=1.0, t=np.zeros(5))


@pytest.mark.parametrize(("samples", "untouched"), [(19990, False), (20000, True)])
def test_twenty_seconds_have_an_end_that_tests(samples: int, untouched: bool) -> None:
    """The last sample is a period before the end."""
    q = np.sin(0.005 * np.arange(samples))[None]
    assert roles([Run("A", Place("A"), 0.0, 0.001, q, np.zeros_like(q))], [], []).untouched == untouched


@pytest.mark.parametrize("seconds", [2.2, 3.0, 4.5, 40.0])
def test_a_single_run_is_cut_into_blocks_with_gaps(seconds: float) -> None:
    found = roles([recorded("A", start=5.0, seconds=seconds)], [], [recorded("T")])
    mine = parts(found.train)
    assert 2 <= len(mine) <= 4
    assert mine[0][1] == 5.0
    assert mine[-1][2] == pytest.approx(5.0 + seconds)
    assert all(end - start >= 1.0 for _, start, end in mine)
    assert all(
        after[1] - before[2] >= 0.019 * seconds or after[1] - before[2] >= 0.49 for before, after in pairwise(mine)
    )
    assert found.searched == ("A",)


def test_blocks_hold_two_periods_where_the_motion_repeats() -> None:
    t = np.arange(4201) * 0.01
    q = np.sin(2 * np.pi * t / 7.0)[None] + 0.3 * np.sin(2 * np.pi * 3 * t / 7.0)[None]
    found = roles([Run("A", Place("A"), 0.0, 0.01, q, np.zeros_like(q))], [], [recorded("T")])
    assert len(found.train) == 2
    assert all(end - start > 14.0 for _, start, end in parts(found.train))


def test_blocks_hold_two_periods_of_a_short_stroke_beside_a_wide_turn() -> None:
    t = np.arange(6001) * 0.01
    q = np.stack([2.5 * np.sin(2 * np.pi * t / 5.0), 0.002 * np.sin(2 * np.pi * t / 10.0)])
    run = Run("A", Place("A"), 0.0, 0.01, q, np.zeros_like(q))
    found = roles([run], [], [recorded("T")], kinds=[REVOLUTE, PRISMATIC])
    assert all(end - start > 20.0 for _, start, end in parts(found.train))


@pytest.mark.parametrize("start", [0.1, 1700000003.2])
def test_parts_are_told_apart_whatever_the_clock_counts_from(start: float) -> None:
    found = roles([recorded("A", start=start, seconds=20.0)], [], [])
    mine = [*parts(found.train), *parts(found.test)]
    assert all(end - begin > 3.0 for _, begin, end in mine)
    assert all(after[1] - before[2] >= 0.39 for before, after in pairwise(mine))


@pytest.mark.parametrize("samples", [12, 24])
def test_a_run_of_few_samples_is_refused(samples: int) -> None:
    regressors = Regressors(read(find_robot("emps")))
    q = np.sin(0.1 * np.arange(samples))[None]
    run = Run("A", Place("A"), 0.0, 0.1, q, np.zeros_like(q))
    with pytest.raises(InputError, match=rf"A:1:1: {samples} rows .* at 10 Hz\), expected at least \d+"):
        prepared(run, Recipe(), regressors)


def test_a_run_too_short_to_be_split_is_refused() -> None:
    with pytest.raises(InputError, match=r"A:1:1: a run of 1.5 s, expected 2.13 s at least, to be split in time"):
        roles([recorded("A", seconds=1.5)], [], [recorded("T")])


def test_a_part_of_a_run_is_split_by_the_file_s_own_times() -> None:
    found = roles([recorded(str(Path("a@b") / "A.csv@5:15"), start=5.0)], [], [recorded("T")])
    split = parts(found.train)
    assert {path for path, _, _ in split} == {str(Path("a@b") / "A.csv")}
    assert min(start for _, start, _ in split) == 5.0


@pytest.mark.parametrize(
    ("data", "validate", "test", "told"),
    [
        (["A", "A"], [], ["T"], "A:1:1: its samples from 0 s to 10 s fit in A and fit in A, expected"),
        (["A", "B"], ["A@5:9"], ["T"], "A@5:9:1:1: its samples from 5 s to 9 s fit in A and validate in A@5:9, expe"),
        (["A@0:4", "B"], ["V"], ["A@3:9"], "A@3:9:1:1: its samples from 3 s to 4 s fit in A@0:4 and test in A@3:9, ex"),
    ],
    ids=["twice", "part", "overlap"],
)
def test_runs_that_share_samples_are_refused(data: list[str], validate: list[str], test: list[str], told: str) -> None:
    with pytest.raises(InputError, match=told):
        roles(*([piece(name) for name in names] for names in (data, validate, test)))


def piece(name: str) -> Run:
    """A run of the recording A, B ..., or ``A@FROM:TO`` of one."""
    path, _, times = name.partition("@")
    start, end = map(float, times.split(":")) if times else (0.0, 10.0)
    return replace(recorded(path, start, end - start), name=name, place=Place(name))


def test_parts_that_only_touch_are_apart() -> None:
    found = roles([piece("A@0:5"), piece("B")], [piece("A@5:7")], [piece("A@7:10")])
    assert (found.train, found.validate, found.test) == (("A@0:5", "B"), ("A@5:7",), ("A@7:10",))


def test_no_run_is_spent_where_nothing_is_tested() -> None:
    found = roles([recorded(name) for name in "ABC"], [], [], tested=False)
    assert (found.train, found.test, found.searched) == (("A", "B", "C"), (), ("A", "B", "C"))


def test_a_period_of_no_whole_rows_is_compared_with_the_next_but_one() -> None:
    """5 s at 125 Hz are 625 samples: two of them are 625 rows of every other sample."""
    regressors = Regressors(read(find_robot("emps")))
    q = 0.1 * series(2500, 625)[:1]
    one = prepared(Run("A", Place("A"), 0.0, 0.008, q, np.zeros_like(q)), Recipe(), regressors)
    assert (one.sampled.filters.factor, one.period, one.repeats, one.unlike) == (2, 625, 625, "")
    assert one.times == pytest.approx(2.0, abs=0.03)
