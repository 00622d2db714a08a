"""Whether a motion repeats, and which parts of which runs are fitted, validate and test."""

from __future__ import annotations

import itertools
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from generator.errors import InputError, Place
from identification.dataset import Run
from identification.diagnosis.periods import period_of
from identification.diagnosis.roles import roles

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


def test_noise_of_encoders_does_no_harm() -> None:
    found = period_of(series(3000, 750, noise=1e-4), 0.002)
    assert found == 750


def test_a_joint_that_rests_does_not_count() -> None:
    q = series(3000, 750)
    q[1] = 0.3
    assert period_of(q, 0.002) == 750
    assert period_of(np.full((2, 3000), 0.3), 0.002) == 0


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
    return Run(name, Place(name), start, 0.01, q, np.zeros_like(q))


def parts(names: tuple[str, ...]) -> list[tuple[str, float, float]]:
    """``PATH@FROM:TO`` taken apart."""
    found = []
    for name in names:
        path, _, times = name.rpartition("@")
        start, end = times.split(":")
        found.append((path, float(start), float(end)))
    return found


def test_what_is_said_is_kept() -> None:
    found = roles([recorded("A"), recorded("B")], ["C"], ["D", "E"])
    assert (found.train, found.validate, found.test) == (("A", "B"), ("C",), ("D", "E"))
    assert found.notes == ()


def test_the_last_of_many_runs_take_the_roles_that_are_missing() -> None:
    runs = [recorded(name) for name in "ABCD"]
    both = roles(runs, [], [])
    assert (both.train, both.validate, both.test) == (("A", "B"), ("C",), ("D",))
    assert [note[0] for note in both.notes] == ["C", "D"]
    one = roles(runs[:3], [], ["T"])
    assert (one.train, one.validate, one.test) == (("A", "B"), ("C",), ("T",))
    other = roles(runs[:3], ["V"], [])
    assert (other.train, other.validate, other.test) == (("A", "B"), ("V",), ("C",))


@pytest.mark.parametrize(
    ("validate", "test"), [([], []), (["V"], []), ([], ["T"])], ids=["neither", "validates", "tests"]
)
def test_few_runs_are_split_in_time_without_overlap(validate: list[str], test: list[str]) -> None:
    found = roles([recorded("A", start=5.0, seconds=25.0), recorded("B", seconds=30.0)], validate, test)
    split = [*parts(found.train), *([] if validate else parts(found.validate)), *([] if test else parts(found.test))]
    assert not validate or found.validate == tuple(validate)
    assert not test or found.test == tuple(test)
    for name, start, end in (("A", 5.0, 30.0), ("B", 0.0, 30.0)):
        mine = sorted((a, b) for path, a, b in split if path == name)
        assert mine[0][0] >= start
        assert mine[-1][1] <= end + 1e-9
        assert all(after[0] - before[1] >= 0.19 for before, after in itertools.pairwise(mine))
        fitted = sum(b - a for path, a, b in parts(found.train) if path == name)
        assert fitted > 0.3 * (end - start)
    (note,) = found.notes
    assert ("validates" in note) == (not validate)
    assert ("tests" in note) == (not test)
    if not test:
        # The end of each run, and nothing that is known reaches into it.
        begins = {path: a for path, a, _ in parts(found.test)}
        assert all(b < begins[path] for path, _, b in parts(tuple(one for one in found.known if "@" in one)))


def test_where_runs_are_short_one_part_validates_and_tests() -> None:
    found = roles([recorded("A", start=5.0), recorded("B", seconds=30.0)], [], [])
    assert found.test == found.validate
    assert found.known == ("A", "B")
    for name, start, end in (("A", 5.0, 15.0), ("B", 0.0, 30.0)):
        mine = sorted((a, b) for path, a, b in parts((*found.train, *found.validate)) if path == name)
        assert mine[0][0] >= start
        assert mine[-1][1] <= end + 1e-9
        assert all(after[0] - before[1] >= 0.19 for before, after in itertools.pairwise(mine))
    (note,) = found.notes
    assert "since the runs are short, tests too" in note


@pytest.mark.parametrize("seconds", [2.2, 3.0, 4.5])
@pytest.mark.parametrize(("validate", "test"), [([], []), ([], ["T"])], ids=["neither", "tests"])
def test_every_part_of_a_short_run_is_a_second_long(seconds: float, validate: list[str], test: list[str]) -> None:
    found = roles([recorded("A", seconds=seconds)], validate, test)
    assert found.train
    assert all(end - start >= 1.0 for _, start, end in parts((*found.train, *found.validate)))


def test_a_run_too_short_to_be_split_is_refused() -> None:
    with pytest.raises(InputError, match=r"A:1:1: a run of 1.5 s, expected 2.1 s at least, to be split in time"):
        roles([recorded("A", seconds=1.5)], [], ["T"])
    with pytest.raises(InputError, match=r"A:1:1: a run of 2 s, expected 2.1 s at least, to be split in time"):
        roles([recorded("A", seconds=2.0)], ["V"], [])


def test_the_validating_block_lies_where_every_joint_moves() -> None:
    t = np.arange(2001) * 0.01
    late = np.where((t > 9) & (t < 19), np.sin(5 * t), 0.0)
    q = np.stack([np.sin(5 * t), late])
    found = roles([Run("A", Place("A"), 0.0, 0.01, q, np.zeros_like(q))], [], ["T"])
    ((_, start, end),) = parts(found.validate)
    assert start > 8
    fitted = parts(found.train)
    assert sum(max(0.0, min(b, 19) - max(a, 9)) for _, a, b in fitted) > 2
    assert all(b <= start or a >= end for _, a, b in fitted)


def test_a_part_of_a_run_is_split_by_the_file_s_own_times() -> None:
    found = roles([recorded(str(Path("a@b") / "A.csv@5:15"), start=5.0)], [], ["T"])
    split = [*parts(found.train), *parts(found.validate)]
    assert {path for path, _, _ in split} == {str(Path("a@b") / "A.csv")}
    assert min(start for _, start, _ in split) == 5.0
