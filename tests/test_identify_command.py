"""``counterpoise identify``: files that it leaves, the summary, and what it refuses."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from generator.robot.readers import read
from tests.commands import Done, command
from tests.recorded import TRUTH, TWO_LINKS, recorded, two_links


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("identify")
    links = two_links(folder)
    recorded(links, TRUTH, seed=1, noise=0.02).save(folder / "a.csv")
    recorded(links, TRUTH, seed=2, noise=0.02).save(folder / "b.csv")
    recorded(links, TRUTH, seed=3, noise=0.02).save(folder / "c.csv")
    return folder


def identified(folder: Path, capsys: pytest.CaptureFixture[str], *more: str) -> Done:
    robot, runs = folder / "two_links.yaml", [folder / "a.csv", folder / "b.csv"]
    words = ["identify", robot, "--data", *runs, "--test", folder / "c.csv", "--out", folder / "out", *more]
    return command(*words, capsys=capsys)


def test_a_held_out_run_without_a_row_tells_nothing(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Its joints creep below the speed of a standstill."""
    links = two_links(folder)
    run = recorded(links, TRUTH, noise=0.02)
    slow = {f"q{j}": 0.3 + 1e-3 * np.sin(0.1 * run.columns["t"]) for j in (1, 2)}
    creep = run.with_columns(**slow).save(folder / "creep.csv")
    robot, out = folder / "two_links.yaml", folder / "creeping"
    done = command("identify", robot, "--data", folder / "a.csv", "--test", creep, "--out", out, capsys=capsys)
    assert done.status == 0, done.err
    page = (out / "report.html").read_text()
    assert "No row that was held out counts, so nothing tells how it carries over." in page


def results(folder: Path) -> dict[str, Any]:
    contents: dict[str, Any] = json.loads((folder / "out" / "results.json").read_text())
    return contents


def test_results_and_robot_file(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    done = identified(folder, capsys, "--dynamics", "4")
    assert (done.status, done.err.splitlines()[-1]) == (0, "writing the report")
    assert done.out.startswith("two_links: 13 parameters, ")
    found = results(folder)
    table = [line.split(maxsplit=5) for line in done.out.splitlines()]
    told = {line[0]: line[5] for line in table if line and line[0] in TRUTH}
    assert told == {name: one["unit"] for name, one in found["parameters"].items()}
    assert set(found["parameters"]) == set(TRUTH)
    for name, one in found["parameters"].items():
        assert one["value"] == pytest.approx(TRUTH[name], abs=5 * one["std"] + 0.01 * abs(TRUTH[name]))
        assert one["relative_std_percent"] == pytest.approx(100 * one["std"] / abs(one["value"]))
        assert {"essential", "unit"} <= set(one)
    for kind, rows in (("train", 2), ("test", 1)):
        residual = found["residual"][kind]
        assert [one["joint"] for one in residual["per_joint"]] == [1, 2]
        assert 0 < residual["total"]["relative_percent"] < residual["total"]["relative_to_mean_percent"] < 3
        assert len(found["data"][kind]) == rows
    assert all(len(one["sha256"]) == 64 for one in found["data"]["train"])
    assert found["condition"] > found["condition_scaled"] > 1
    assert found["method"]["name"] == "IDIM-LS"
    again = read(folder / "out" / "two_links.yaml")
    values = again.parameter_sets["identified"].values
    assert {n: v.value for n, v in values.items()} == pytest.approx(
        {n: one["value"] for n, one in found["parameters"].items()}, rel=1e-5
    )
    essential = again.parameter_sets["identified_essential"].values
    assert set(essential) == {n for n, one in found["parameters"].items() if one["essential"]}
    standard = again.parameter_sets["identified_consistent"].values
    assert {n: v.value for n, v in standard.items()} == pytest.approx(
        {n: one["value"] for n, one in found["consistent"]["parameters"].items()}, rel=1e-5, abs=1e-6
    )
    assert found["consistent"]["residual"]["test"]["total"]["relative_to_mean_percent"] < 3
    q = ("--q", "0.3", "0.2", "--qd", "1", "1", "--qdd", "1", "1")
    robot = folder / "out" / "two_links.yaml"
    done = command("evaluate", robot, "inverse_dynamics", *q, "--parameters", "identified", capsys=capsys)
    assert done.status == 0


def test_a_consistent_set_of_an_earlier_identification_is_told(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    note = "the set identified_consistent in the robot file is of an earlier identification"
    assert identified(folder, capsys).status == 0
    (folder / "before.yaml").write_text((folder / "out" / "two_links.yaml").read_text())
    words = ["identify", folder / "before.yaml", "--data", folder / "a.csv", "--out", folder / "again"]
    assert f"note: {note}\n" not in command(*words, capsys=capsys).out
    assert f"note: {note}\n" in command(*words, "--no-consistent", capsys=capsys).out
    assert note in json.loads((folder / "again" / "results.json").read_text())["notes"]


def test_bodies_of_a_set_lack_what_it_leaves_out(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Points of mass, about whose own centres nothing is said."""
    values = [f"{stem}{j}: 5 {unit}" for j in (1, 2) for stem, unit in (("M", "kg"), ("YY", "kg m2"), ("ZZ", "kg m2"))]
    text = f"parameters:\n  points: {{values: {{{', '.join(values)}}}}}\n"
    (folder / "points.yaml").write_text(TWO_LINKS + text)
    words = ["--data", folder / "a.csv", "--prior", "points", "--out", folder / "points"]
    done = command("identify", folder / "points.yaml", *words, capsys=capsys)
    assert done.status == 0, done.err
    assert json.loads((folder / "points" / "results.json").read_text())["consistent"] is not None


@pytest.mark.parametrize(
    ("lacking", "told"), [("", []), ("M1", ["M1"]), ("M1 M2", ["M1 and M2"]), ("M1 M2 YY1 YY2 ZZ1", [])]
)
def test_a_set_of_bodies_without_a_mass_is_told(
    lacking: str, told: list[str], folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """ZZ2 is a base parameter too: a set with it alone need not be of bodies."""
    units = {"M": "kg", "YY": "kg m2", "ZZ": "kg m2"}
    values = {f"{stem}{j}": f"{stem}{j}: 5 {unit}" for j in (1, 2) for stem, unit in units.items()}
    kept = ", ".join(text for name, text in values.items() if name not in lacking.split())
    robot = folder / "lacking.yaml"
    robot.write_text(f"{TWO_LINKS}parameters:\n  points: {{values: {{{kept}}}}}\n")
    words = ["--data", folder / "a.csv", "--prior", "points", "--out", folder / "lacking"]
    done = command("identify", robot, *words, capsys=capsys)
    assert done.status == 0, done.err
    found = json.loads((folder / "lacking" / "results.json").read_text())
    assert found["consistent"]["prior"] is (not lacking)
    notes = [note for note in found["notes"] if "does not tell" in note]
    assert notes == [f"the set points does not tell {one}: no parameters were kept near its bodies" for one in told]


def test_a_cutoff_above_the_highest_is_told(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    note = "a.csv: the cut-off is 90 Hz, the highest at 200 Hz, not 120 Hz"
    assert note in identified(folder, capsys, "--cutoff", "120").out
    assert "the cut-off is" not in identified(folder, capsys, "--cutoff", "80").out


def test_identifying_twice_gives_the_same_files(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    identified(folder, capsys)
    first = {path.name: path.read_bytes() for path in (folder / "out").iterdir()}
    identified(folder, capsys)
    assert {path.name: path.read_bytes() for path in (folder / "out").iterdir()} == first


def test_unknown_parameters_are_infinite_in_json_and_tell_nothing_in_the_set(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = (folder / "a.csv").read_text().splitlines()
    rows = [line.split(",") for line in text[1:]]
    held = [",".join([t, q1, "0.5", tau1, tau2]) for t, q1, _, tau1, tau2 in rows]
    (folder / "held.csv").write_text("\n".join([text[0], *held]) + "\n")
    # The torques are of a moving joint 2, which the model cannot explain well: enough of it to go on.
    robot = folder / "two_links.yaml"
    done = command(
        "identify", robot, "--data", folder / "held.csv", "--fix", "Fc1=9", "--out", folder / "out", capsys=capsys
    )
    assert done.status == 0, done.err
    found = results(folder)
    unknown = {name for name, one in found["parameters"].items() if one["value"] is None}
    assert "Fv2" in unknown
    assert all(math.isinf(found["parameters"][name]["std"]) for name in unknown)
    assert "Infinity" not in (folder / "out" / "results.json").read_text()
    values = read(folder / "out" / "two_links.yaml").parameter_sets["identified"].values
    assert "Fv2" not in values
    assert {name for name, one in values.items() if one.relative_std == 1e5} == unknown & values.keys()
    assert set(values) | unknown == set(TRUTH)


def test_options_of_the_method(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    done = identified(
        folder, capsys, "--fix", "Off*=0", "Fc1=9", "--weights", "none", "--robust", "--essential", "15", "--cutoff",
        "20", "--order", "3", "--factor", "8", "--standstill", "0.02", "--payload", "M=0", "--no-consistent",
        "--recipe", str(_recipe(folder)),
    )  # fmt: skip
    assert done.status == 0
    found = results(folder)
    assert found["consistent"] is None
    assert found["method"]["fixed"] == {"Fc1": 9.0, "Off1": 0.0, "Off2": 0.0}
    assert (found["method"]["least_squares"], found["method"]["robust"]) == ("ordinary", True)
    assert found["essential"]["ratio"] == 15
    run = found["data"]["train"][0]
    assert (run["cutoff"], run["order"], run["factor"], run["payload"]) == (20, 3, 8, "L")
    assert any("payload L" in note for note in found["notes"])
    assert found["parameters"]["Fc1"]["fixed"]
    written = read(folder / "out" / "two_links.yaml").parameter_sets["identified"].values
    given = {name: one.value for name, one in written.items() if one.note == "given, not identified"}
    assert given == found["method"]["fixed"]


def _recipe(folder: Path) -> Path:
    path = folder / "recipe.yaml"
    path.write_text("description: mine\ndynamics: 3\ndropped_first: 7\nfreedom: samples\n")
    return path


def test_sensitivity_to_the_filters(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    done = identified(folder, capsys, "--cutoff", "3", "--factor", "10", "--sensitivity")
    assert done.status == 0
    found = results(folder)["sensitivity"]
    assert [(one["setting"], one["value"]) for one in found] == [
        ("cutoff", 1.5),
        ("cutoff", 6),
        ("factor", 5),
        ("factor", 20),
    ]
    # Half of the cut-off filters what the runs hold, twice of it does not.
    assert found[0]["change"] > 2 * found[1]["change"] > 0
    assert "cutoff 6: no parameter moves by more than" in done.out


REFUSED = {
    ("--fix", "Fv9=1"): "error: --fix:1:1: the robot has no base parameter 'Fv9', expected perhaps 'Fv2'",
    ("--fix", "Fv1=1", "ZZ1=1"): "error: --fix:1:1: ZZ1 is grouped: the runs show it only in ZZ1R, expected ZZ1R",
    ("--fix", "M1=1"): "error: --fix:1:1: M1 acts in no torque, expected a base parameter",
    ("--fix", "Fv1"): "error: --fix:1:1: Fv1 has no value, expected Fv1=VALUE, or --prior SET to take it from",
    ("--fix", "Fc1=1", "Fc1=2"): "error: --fix:1:1: Fc1 is given twice, expected it once",
    ("--payload", "M=1", "M=2"): "error: --payload:1:1: M is given twice, expected it once",
    ("--fix", "Fv1=1", "Fv*=2"): "error: --fix:1:1: Fv1 is given twice, expected it once",
    ("--payload", "M=1", "name=XL"): "error: --payload:1:1: payload name 'XL' begins with an axis, expected one that",
    ("--prior-weight", "1e300"): "error: --prior-weight:1:1: 1e+300, expected a number above 0, 1e+12 at most",
    ("--fix", "Fv1=x"): "error: --fix:1:1: 'x' is not a number, expected numbers, pi and + - * / ^ ( )",
    ("--prior", "mine"): "error: --prior:1:1: two_links has no parameter set 'mine', expected one in ",
    ("--payload", "K=1"): "error: --payload:1:1: payload value 'K=1', expected NAME=VALUE with one of XX, XY",
    ("--cutoff", "-1"): "error: --cutoff:1:1: -1, expected a number above 0",
    ("--order", "0"): "error: --order:1:1: 0, expected a whole number from 1 on",
    ("--order", "100"): "error: --order:1:1: order is 100, expected a whole number up to 20",
    ("--dynamics", "1e-9"): "error: --dynamics:1:1: dynamics is 1e-09, expected a frequency from 0.001 Hz on",
    ("--factor", "0"): "error: --factor:1:1: 0, expected a whole number from 1 on",
    ("--factor", "17"): "error: --factor:1:1: factor is 17, expected a product of numbers up to 13",
    ("--standstill", "-1"): "error: --standstill:1:1: -1, expected a number that is not negative",
    ("--standstill", "inf"): "error: --standstill:1:1: inf, expected a number that is not negative",
    ("--bootstrap", "0"): "error: --bootstrap:1:1: 0, expected a whole number from 50 to 100000",
    ("--payload", "M=-3"): "error: --payload:1:1: M=-3, expected a number that is not negative",
    ("--bootstrap", "3"): "error: --bootstrap:1:1: 3, expected a whole number from 50 to 100000",
    ("--essential", "1"): "error: --essential:1:1: 1, expected a number above 1",
}


@pytest.mark.parametrize("words", REFUSED, ids=" ".join)
def test_bad_options_are_refused(words: tuple[str, str], folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    done = identified(folder, capsys, *words)
    assert done.status == 2
    assert done.err.splitlines()[-1].startswith(REFUSED[words])


def test_a_run_that_is_not_there_is_refused(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    done = command("identify", folder / "two_links.yaml", "--data", "none.csv", capsys=capsys)
    told = "error: none.csv:1:1: there is no such file, expected a run in .csv or "
    assert (done.status, done.err.splitlines()[-1].startswith(told)) == (2, True)


def test_bad_recipes_are_refused(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for text, message in (
        ("", "1:1: the file is empty, expected a recipe"),
        ("cutof: 3\n", "1:1: unknown key 'cutof' in the recipe, expected perhaps 'cutoff'"),
        ("dynamics: 0\n", "1:11: dynamics is 0, expected a number above 0"),
        ("order: 0\n", "1:8: order is 0, expected a whole number from 1 on"),
        ("order: 21\n", "1:8: order is 21, expected a whole number up to 20"),
        ("cutoff: 1e-4\n", "1:9: cutoff is 0.0001, expected a frequency from 0.001 Hz on"),
        ("factor: 17\n", "1:9: factor is 17, expected a product of numbers up to 13"),
        ("weights: all\n", "1:10: weights is 'all', expected one of joint, none"),
    ):
        path = folder / "bad.yaml"
        path.write_text(text)
        done = identified(folder, capsys, "--recipe", str(path))
        assert done.status == 2
        assert done.err.splitlines()[-1] == f"error: {path}:{message}"


@pytest.mark.parametrize("read", ["robot", "recipe", "sidecar"])
def test_nothing_that_is_read_is_written_over(read: str, folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out, run = folder / read, folder / read / "two_links.csv"
    out.mkdir()
    run.write_bytes((folder / "a.csv").read_bytes())
    source = out / "two_links.yaml"
    source.write_text({"robot": TWO_LINKS, "recipe": "order: 2\n", "sidecar": "robot: two_links\n"}[read])
    robot = source if read == "robot" else folder / "two_links.yaml"
    words = {"robot": [folder / "a.csv"], "recipe": [folder / "a.csv", "--recipe", source], "sidecar": [f"{run}@1:2"]}
    before = source.read_text()
    done = command("identify", robot, "--data", *words[read], "--out", out, capsys=capsys)
    assert (done.status, done.err.strip().splitlines()[-1]) == (
        2,
        f"error: {source}:1:1: it would be written over {source}, which is read, expected another --out",
    )
    assert source.read_text() == before


def test_the_small_robot_is_a_robot_file(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert (folder / "two_links.yaml").read_text() == TWO_LINKS
    assert command("check", folder / "two_links.yaml", capsys=capsys).status == 0


def test_samples_that_are_fitted_twice_are_refused(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    run = folder / "a.csv"
    done = command(
        "identify", folder / "two_links.yaml", "--data", run, f"{run}@2:", "--out", folder / "o", capsys=capsys
    )
    assert done.status == 2
    last = done.err.splitlines()[-1]
    assert last.startswith(f"error: {run}:1:1: its samples from 2 s to ")
    assert last.endswith("fit in a.csv and fit in a.csv@2:, expected runs, or parts, that share none")


def test_a_run_that_tests_itself_is_told(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    run = folder / "a.csv"
    words = ["identify", folder / "two_links.yaml", "--data", run, "--test", run, "--out", folder / "o"]
    done = command(*words, "--no-consistent", capsys=capsys)
    assert done.status == 0, done.err
    assert "a.csv tests what is fitted in a.csv, from 0 s to " in done.out
