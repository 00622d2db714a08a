"""Runs whose times are times of day: the same run as with seconds."""

from __future__ import annotations

from datetime import datetime, timedelta, timezone
from pathlib import Path

import numpy as np
import pyarrow
import pytest
from pyarrow import parquet

from generator.errors import InputError
from generator.robot.description import Robot
from identification.clock_times import is_clock_time, seconds
from identification.dataset import load
from tests.recorded import Recorded, recorded, same, two_links

BEGIN = datetime(2026, 3, 2, 23, 59, 58, 125000, tzinfo=timezone(timedelta(hours=1)))
TOLD = "holds times of day, read as s from the first row"


@pytest.fixture
def good(tmp_path: Path) -> Recorded:
    links = two_links(tmp_path)
    return recorded(links, dict.fromkeys(links.names, 1.0), duration=8.0)


@pytest.fixture
def robot(tmp_path: Path) -> Robot:
    return two_links(tmp_path).model.robot


def stamps(run: Recorded) -> list[datetime]:
    return [BEGIN + timedelta(microseconds=round(1e6 * t)) for t in run.columns["t"].tolist()]


def written(run: Recorded, words: list[str], path: Path, separator: str = ",") -> Path:
    """The run with ``words`` in place of its times."""
    header, *rows = run.save(path).read_text().splitlines()
    changed = [",".join([word, *row.split(",")[1:]]) for word, row in zip(words, rows, strict=True)]
    path.write_text("\n".join(line.replace(",", separator) for line in (header, *changed)) + "\n")
    return path


@pytest.mark.parametrize(
    "form", ["%H:%M:%S.%f", "%Y-%m-%dT%H:%M:%S.%f", "%Y-%m-%d %H:%M:%S.%f", "%Y-%m-%dT%H:%M:%S.%f%z"]
)
def test_times_of_day_are_seconds_past_midnight_too(form: str, good: Recorded, robot: Robot, tmp_path: Path) -> None:
    words = [one.strftime(form) for one in stamps(good)]
    run = load(str(written(good, words, tmp_path / "a.csv")), robot)
    assert same(run, good)
    assert run.rate == pytest.approx(200.0)
    assert [note.partition(": ")[2] for note in run.notes] == [f"t {TOLD}"]


def test_they_may_have_decimal_commas(good: Recorded, robot: Robot, tmp_path: Path) -> None:
    words = [one.strftime("%H:%M:%S.%f") for one in stamps(good)]
    path = written(good, words, tmp_path / "a.csv", ";")
    path.write_text(path.read_text().replace(".", ","))
    assert same(load(str(path), robot), good)


def test_a_time_that_is_none_is_refused_at_its_row(good: Recorded, robot: Robot, tmp_path: Path) -> None:
    words = [one.strftime("%H:%M:%S.%f") for one in stamps(good)]
    words[700] = "25:00:00"
    with pytest.raises(InputError, match=r"a.csv:702:1: t is nan, expected a finite number"):
        load(str(written(good, words, tmp_path / "a.csv")), robot)


def test_a_column_that_nothing_reads_may_lack_some(good: Recorded, robot: Robot, tmp_path: Path) -> None:
    path = written(good, ["", *["12:00:00"] * 1599], tmp_path / "a.csv")
    header, *rows = path.read_text().splitlines()
    times = good.columns["t"].tolist()
    lines = ["t,stamp" + header[1:], *(f"{t!r},{row}" for t, row in zip(times, rows, strict=True))]
    path.write_text("\n".join(lines) + "\n")
    run = load(str(path), robot)
    assert same(run, good)


def test_points_in_time_of_a_parquet_file(good: Recorded, robot: Robot, tmp_path: Path) -> None:
    parquet.write_table(pyarrow.table({**good.columns, "t": stamps(good)}), tmp_path / "a.parquet")
    run = load(str(tmp_path / "a.parquet"), robot)
    assert same(run, good)
    assert [note.partition(": ")[2] for note in run.notes] == [f"t {TOLD}"]


def test_what_is_a_time_of_day() -> None:
    for text in ("7:03:04", " 12:03:04,5 ", "2026-03-02 12:03:04Z", "2026-03-02T12:03:04.123456+0130"):
        assert is_clock_time(text)
    for text in ("12:03", "24:00:00", "12:60:00", "2026-02-30T12:00:00", "12:03:04 PM", "1", "", "١٢:٠٣:٠٤"):
        assert not is_clock_time(text)


def test_zones_count_and_digits_stay() -> None:
    t = seconds(["2026-03-02T12:03:04.000001+01:00", "2026-03-02T11:03:04.000003Z", "2026-03-02T06:03:05-05:00"])
    np.testing.assert_allclose(t, [0, 2e-6, 1 - 1e-6], atol=1e-11)
