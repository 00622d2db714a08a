"""Names of runs: files, parts of them by times, and what names none."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pyarrow
import pytest
import scipy.io
from pyarrow import parquet

from generator.errors import InputError
from generator.robot.description import Robot
from identification import recipes, sidecar
from identification.dataset import load
from identification.run_source import RunSource, part_of
from tests.recorded import Recorded


def test_a_part_of_a_run(good: Recorded, robot: Robot, tmp_path: Path) -> None:
    path = good.save(tmp_path / "a.csv")
    run = load(f"{path}@2:5", robot)
    assert (run.start, run.samples) == (2.0, 601)
    assert load(f"{path}@:5", robot).samples == 1001
    with pytest.raises(InputError, match=r"no sample from 20 s to inf s, expected times from 0 to 7.995"):
        load(f"{path}@20:", robot)
    for part in ("@2:x", "@a:b", "@nan:6", "@1,5:6", "@1e:6"):
        told = "this is no part of a run, expected FILE@FROM:TO with times in s, decimals after a point"
        with pytest.raises(InputError, match=f"a.csv{part}:1:1: {told}"):
            load(f"{path}{part}", robot)
    with pytest.raises(
        InputError, match=r"a.csv@5:2:1:1: the part would end at 2 s, before it begins at 5 s, expected FI"
    ):
        load(f"{path}@5:2", robot)
    with pytest.raises(InputError, match=r"a run file ending in"):
        load(f"{tmp_path / 'none.csv'}@a:b", robot)


@pytest.mark.parametrize(("part", "told"), [("@1:900", True), ("@-1:6", True), ("@0:8", False), ("@7:", False)])
def test_a_part_beyond_the_file_is_told(part: str, told: bool, good: Recorded, robot: Robot, tmp_path: Path) -> None:
    path = good.save(tmp_path / "a.csv")
    beyond = f"{path}{part}: the file's times go from 0 s to 7.995 s, what is asked for goes beyond"
    assert load(f"{path}{part}", robot).notes == ((beyond,) if told else ())


def test_each_formula_of_a_recipe_is_used_where_it_can_be(good: Recorded, robot: Robot, tmp_path: Path) -> None:
    (tmp_path / "recipe.yaml").write_text("columns: {q1: a1 * pi / 180, q2: 2 * q1, temp1: warmth + 273}\n")
    named = good.without("q1").with_columns(a1=np.degrees(good.columns["q1"]))
    run = load(str(named.save(tmp_path / "a.csv")), robot, recipes.read(tmp_path / "recipe.yaml").columns)
    assert run.q[0] == pytest.approx(good.columns["q1"], abs=1e-12)
    assert run.q[1].tolist() == good.columns["q2"].tolist()
    assert "temp1" not in run.others


def test_formulas_of_one_signal_are_used_together(good: Recorded, robot: Robot, tmp_path: Path) -> None:
    """Of the torques one cannot be made: the currents are there."""
    (tmp_path / "recipe.yaml").write_text("columns: {tau1: 100 * i1, tau2: 90 * i2 - 5 * brake2}\n")
    columns = recipes.read(tmp_path / "recipe.yaml").columns
    motors = {"t": good.columns["t"], "qm1": good.columns["q1"], "qm2": good.columns["q2"]}
    path = str(Recorded(motors | {f"i{j}": good.columns[f"tau{j}"] / 100 for j in (1, 2)}).save(tmp_path / "a.csv"))
    np.testing.assert_array_equal(load(path, robot, columns).tau, load(path, robot).tau)


@pytest.mark.parametrize("first", [0.0, 1700000000.0])
def test_a_part_between_two_samples_holds_both(good: Recorded, robot: Robot, tmp_path: Path, first: float) -> None:
    """Also at a rate whose period is no whole number of microseconds."""
    t = first + good.columns["t"] * 5 / 7
    path = str(good.with_columns(t=t).save(tmp_path / "a.csv"))
    assert load(part_of(path, t[200], t[801]), robot).samples == 602


def test_a_column_that_was_left_out_is_told_where_it_lacks(good: Recorded, robot: Robot, tmp_path: Path) -> None:
    count = len(good.columns["t"])
    short = {"t": good.columns["t"][:-5]} | {
        stem: np.stack([good.columns[f"{stem}{j}"] for j in (1, 2)], axis=1) for stem in ("q", "tau")
    }
    scipy.io.savemat(tmp_path / "a.mat", short)
    with pytest.raises(InputError, match=f"or qm1 to qm2; q is {count} x 2, of runs of {count - 5} samples: it is"):
        load(str(tmp_path / "a.mat"), robot)
    for name in ("t", "q1"):
        columns = dict(good.columns) | {name: ["x"] * count}
        parquet.write_table(pyarrow.table(columns), tmp_path / "a.parquet")
        with pytest.raises(InputError, match=f"there is no column {name}, .*; {name} held no number and is left out"):
            load(str(tmp_path / "a.parquet"), robot)


@pytest.mark.parametrize("source", ["", ".", "/"])
def test_a_path_without_a_name_is_refused(source: str, robot: Robot) -> None:
    sidecar.path_of(RunSource.of(source).path)
    with pytest.raises(InputError, match="a run file ending in ''"):
        load(source, robot)


def test_a_folder_may_look_like_a_part() -> None:
    assert part_of("data@1:2/run.csv", 0.0, 5.0) == str(Path("data@1:2/run.csv@0:5"))


@pytest.mark.parametrize("ending", ["yaml", "yml", "YAML", "YML"])
def test_a_sidecar_is_read_whatever_its_ending(ending: str, good: Recorded, robot: Robot, tmp_path: Path) -> None:
    path = good.save(tmp_path / "a.csv")
    (tmp_path / f"a.{ending}").write_text("robot: another\n")
    with pytest.raises(InputError, match=rf"a.{ending}:1:1: this is a run of another, expected one of two_links"):
        load(str(path), robot)


def test_a_folder_is_no_sidecar_and_two_are_one_too_many(good: Recorded, robot: Robot, tmp_path: Path) -> None:
    path = good.save(tmp_path / "a.csv")
    (tmp_path / "a.yml").mkdir()
    with pytest.raises(InputError, match=r"a.yml:1:1: "):
        load(str(path), robot)
    (tmp_path / "a.yaml").write_text("notes: here\n")
    with pytest.raises(InputError, match=r"a.yml:1:1: a.yaml is a sidecar of a.csv too, expected one of them"):
        load(str(path), robot)
