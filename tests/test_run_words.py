"""Runs with columns of words, or of names that are spelt otherwise."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pyarrow
import pytest
import scipy.io
from numpy.typing import NDArray
from pyarrow import parquet

from generator.errors import InputError
from generator.robot.description import Robot
from generator.robot.readers import read
from identification.dataset import load
from tests.commands import PENDULUM
from tests.recorded import Recorded, stacked


def test_a_column_without_a_number_is_left_out_and_told(good: Recorded, robot: Robot, tmp_path: Path) -> None:
    header, *rows = good.save(tmp_path / "a.csv").read_text().splitlines()
    words = [f"{header},mode", f"{rows[0]},", *(f"{row},AUT" for row in rows[1:])]
    (tmp_path / "b.csv").write_text("\n".join(words) + "\n")
    run = load(str(tmp_path / "b.csv"), robot)
    assert np.allclose(run.q, stacked(good, "q"), atol=1e-12)
    (note,) = run.notes
    assert note.endswith("b.csv: mode held no number and is left out")


@pytest.mark.parametrize(
    ("clock", "told"),
    [
        (
            ["", *1599 * ["12:03"]],
            "a.csv:3:{at}: clock holds no number in any row, the first is '12:03', expected numbers for the "
            "formula at {side}:1:14; a time of day as seconds, 12:00:01.5 as 43201.5",
        ),
        (
            1600 * ["AUT"],
            "a.csv:2:{at}: clock holds no number in any row, the first is 'AUT', expected numbers for the",
        ),
    ],
)
def test_a_formula_over_words_is_told_so(
    clock: list[str], told: str, good: Recorded, robot: Robot, tmp_path: Path
) -> None:
    header, *rows = good.save(tmp_path / "a.csv").read_text().replace(",", ";").splitlines()
    lines = [
        header.replace("t;", "s;", 1) + ";clock",
        *(f"{row};{word}" for row, word in zip(rows, clock, strict=True)),
    ]
    (tmp_path / "a.csv").write_text("\n".join(lines) + "\n")
    side = tmp_path / "a.yaml"
    side.write_text("columns: {t: clock / 1000}\n")
    at = lines[1 if clock[0] else 2].rindex(";") + 2
    with pytest.raises(InputError) as caught:
        load(str(tmp_path / "a.csv"), robot)
    assert told.format(at=at, side=side) in str(caught.value)


def test_a_formula_over_words_of_a_parquet_file_is_told_so(good: Recorded, robot: Robot, tmp_path: Path) -> None:
    table = pyarrow.table({**good.without("t").columns, "clock": ["12:03"] * 1600})
    parquet.write_table(table, tmp_path / "a.parquet")
    (tmp_path / "a.yaml").write_text("columns: {t: clock / 1000}\n")
    with pytest.raises(InputError, match=r"a.parquet:1:5: clock holds no number in any row, the first is '12:03', exp"):
        load(str(tmp_path / "a.parquet"), robot)


@pytest.mark.parametrize(("spelt", "near"), [(str.upper, "Q1"), (lambda name: f"{name[:-1]}_{name[-1]}", "q_1")])
def test_columns_of_another_spelling_are_hinted_at(
    spelt: Callable[[str], str], near: str, good: Recorded, robot: Robot, tmp_path: Path
) -> None:
    other = {name if name == "t" else spelt(name): values for name, values in good.columns.items()}
    with pytest.raises(
        InputError, match=f"no columns of positions, expected .*; perhaps {near} is meant, which a sidecar"
    ):
        load(str(Recorded(other).save(tmp_path / "a.csv")), robot)


def test_a_mat_file_has_each_column_once(robot: Robot, tmp_path: Path) -> None:
    path = tmp_path / "a.mat"
    t, q = np.arange(100) * 0.01, np.ones((100, 2))
    scipy.io.savemat(path, {"t": t, "q1": q[:, 0], "q": q, "tau": q})
    with pytest.raises(InputError, match=r"a.mat:1:1: column q1 is there twice, expected each column once"):
        load(str(path), robot)


def test_a_date_has_points_beside_decimal_commas(good: Recorded, robot: Robot, tmp_path: Path) -> None:
    header, *rows = good.save(tmp_path / "a.csv").read_text().splitlines()
    lines = [f"{header},date", *(f"{row},01.02.2020" for row in rows)]
    comma = [line.replace(",", ";").replace(".", ",").replace("01,02,2020", "01.02.2020") for line in lines[1:]]
    (tmp_path / "b.csv").write_text("\n".join([lines[0].replace(",", ";"), *comma]) + "\n")
    run = load(str(tmp_path / "b.csv"), robot)
    assert np.allclose(run.q, stacked(good, "q"), atol=1e-12)
    (note,) = run.notes
    assert note.endswith("b.csv: date held no number and is left out")


def test_words_in_a_parquet_file_are_left_out_and_a_name_is_there_once(
    good: Recorded, robot: Robot, tmp_path: Path
) -> None:
    columns = dict(good.columns)
    count = len(columns["t"])
    words = {"mode": ["AUT"] * count, "digits": ["12"] * count, "on": [True] * count}
    parquet.write_table(pyarrow.table({**columns, **words}), tmp_path / "a.parquet")
    run = load(str(tmp_path / "a.parquet"), robot)
    assert np.allclose(run.q, stacked(good, "q"), atol=1e-12)
    assert [note.partition(": ")[2] for note in run.notes] == ["mode, digits and on held no number and are left out"]
    spans = pyarrow.array((1e9 * columns["t"]).astype("timedelta64[ns]"))
    parquet.write_table(pyarrow.table({**columns, "t": spans}), tmp_path / "spans.parquet")
    run = load(str(tmp_path / "spans.parquet"), robot)
    assert np.allclose(run.q, stacked(good, "q"), atol=1e-12)
    exact = pyarrow.array(columns["q1"].round(6)).cast(pyarrow.decimal128(12, 6))
    parquet.write_table(pyarrow.table({**columns, "q1": exact}), tmp_path / "exact.parquet")
    run = load(str(tmp_path / "exact.parquet"), robot)
    assert np.allclose(run.q, stacked(good, "q"), atol=1e-6)
    twice = pyarrow.table([*columns.values(), columns["q1"]], names=[*columns, "q1"])
    parquet.write_table(twice, tmp_path / "b.parquet")
    with pytest.raises(InputError, match=r"b.parquet:1:\d+: column q1 is there twice, expected each column once"):
        load(str(tmp_path / "b.parquet"), robot)


def cells(words: list[str]) -> NDArray[np.object_]:
    """As MATLAB has a text a sample."""
    return np.array(words, dtype=object)[:, None]


def test_words_in_a_mat_file_are_left_out_and_told(good: Recorded, robot: Robot, tmp_path: Path) -> None:
    count = len(good.columns["t"])
    words = {"mode": cells(["AUT"] * count), "day": np.array(["Monday"] * count), "by": "Ann", "size": cells(["1 m"])}
    scipy.io.savemat(tmp_path / "a.mat", {**good.columns, **words})
    run = load(str(tmp_path / "a.mat"), robot)
    assert np.allclose(run.q, stacked(good, "q"), atol=1e-12)
    assert [note.partition(": ")[2] for note in run.notes] == ["mode and day held no number and are left out"]
    scipy.io.savemat(tmp_path / "b.mat", {**good.columns, "q1": words["mode"]})
    with pytest.raises(InputError, match=r"there is no column q1, expected .*; q1 held no number and is left out"):
        load(str(tmp_path / "b.mat"), robot)
    (tmp_path / "c.yaml").write_text("columns: {t: clock / 1000}\n")
    scipy.io.savemat(tmp_path / "c.mat", {**good.without("t").columns, "clock": cells(["", *["12:03"] * (count - 1)])})
    with pytest.raises(InputError, match=r"c.mat:2:5: clock holds no number in any row, the first is '12:03', exp"):
        load(str(tmp_path / "c.mat"), robot)


@pytest.mark.parametrize("ending", ["parquet", "mat"])
def test_a_file_of_words_alone_is_told_so(ending: str, good: Recorded, robot: Robot, tmp_path: Path) -> None:
    path = tmp_path / f"a.{ending}"
    columns = {name: ["", "s", *map(str, values)] for name, values in good.columns.items()}
    if ending == "mat":
        scipy.io.savemat(path, {name: cells(words) for name, words in columns.items()})
    else:
        parquet.write_table(pyarrow.table(columns), path)
    told = rf"a.{ending}:2:1: t is the text 's', expected a column of numbers that are no text, without a row of units$"
    with pytest.raises(InputError, match=told):
        load(str(path), robot)


def test_a_formula_over_words_tells_the_first_of_a_parquet_file(good: Recorded, robot: Robot, tmp_path: Path) -> None:
    count = len(good.columns["t"])
    table = pyarrow.table({**good.without("t").columns, "clock": [None, *["12:03"] * (count - 1)]})
    parquet.write_table(table, tmp_path / "a.parquet")
    (tmp_path / "a.yaml").write_text("columns: {t: clock / 1000}\n")
    with pytest.raises(InputError, match=r"a.parquet:2:5: clock holds no number in any row, the first is '12:03', exp"):
        load(str(tmp_path / "a.parquet"), robot)


def test_vectors_of_a_mat_file_are_those_of_the_only_joint(tmp_path: Path) -> None:
    (tmp_path / "pendulum.yaml").write_text(PENDULUM)
    t = np.arange(1000) * 0.01
    q, tau = np.sin(3 * t), np.cos(3 * t)
    scipy.io.savemat(tmp_path / "a.mat", {"t": t[:, None], "q": q[:, None], "tau": tau[:, None]})
    run = load(str(tmp_path / "a.mat"), read(tmp_path / "pendulum.yaml"))
    np.testing.assert_array_equal(run.q[0], q)
    np.testing.assert_array_equal(run.tau[0], tau)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (
            "t q1 tau1\n0 1 2\n",
            "a.csv:1:1: column name 't q1 tau1', expected names with commas, semicolons or tabs between",
        ),
        (
            "# t,q1,tau1\n0,1,2\n",
            "a.csv:2:1: column name '0', expected a header row with the columns' names; a line that",
        ),
    ],
)
def test_a_header_in_another_form_is_told(text: str, told: str, robot: Robot, tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text(text)
    with pytest.raises(InputError, match=told):
        load(str(tmp_path / "a.csv"), robot)


def test_a_column_that_nothing_reads_may_hold_words_among_numbers(good: Recorded, robot: Robot, tmp_path: Path) -> None:
    header, *rows = good.save(tmp_path / "a.csv").read_text().splitlines()
    states = ["0"] * 7 + ["STOP"] + ["1"] * (len(rows) - 8)
    sparse = ["2.5" if k % 10 == 0 else "" for k in range(len(rows))]
    lines = [f"{header},state,force", *map(",".join, zip(rows, states, sparse, strict=True))]
    (tmp_path / "b.csv").write_text("\n".join(lines) + "\n")
    run = load(str(tmp_path / "b.csv"), robot)
    assert np.allclose(run.q, stacked(good, "q"), atol=1e-12)
    at = [lines[k].index(word, len(rows[k - 1])) + 1 for k, word in ((2, ""), (8, "STOP"))]
    assert [note.partition("b.csv:")[2] for note in run.notes] == [
        f"3:{lines[2].rindex(',') + 2}: force is missing; the column is left out",
        f"9:{at[1]}: state is 'STOP'; the column is left out",
    ]
    side = tmp_path / "b.yaml"
    side.write_text("columns: {tau2: tau2 + state}\n")
    with pytest.raises(InputError, match=r"b.csv:9:\d+: state is 'STOP', expected a number"):
        load(str(tmp_path / "b.csv"), robot)
    side.write_text("columns: {tau2: tau1, t: t, q1: q1}\n")
    (tmp_path / "b.csv").write_text("\n".join(lines).replace(rows[4], rows[4].rpartition(",")[0] + ",ERR") + "\n")
    assert np.array_equal(load(str(tmp_path / "b.csv"), robot).tau[1], run.tau[0])
    side.unlink()
    with pytest.raises(InputError, match=r"b.csv:6:\d+: tau2 is 'ERR', expected a number"):
        load(str(tmp_path / "b.csv"), robot)
