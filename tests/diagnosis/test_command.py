"""`counterpoise diagnose` as a user runs it, on runs of a simulated arm that shares no code with it."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import pytest

from generator.robot.readers import read
from identification import recipes
from identification.dataset import load
from identification.diagnosis.candidates import hypotheses
from identification.diagnosis.columns.hypothesis import SHAPE
from identification.diagnosis.runs.prepared import prepared
from identification.diagnosis.runs.scene import Scene
from identification.observation import Regressors
from tests.commands import Done, command, process
from tests.plant.effect import Effect
from tests.plant.robot_file import robot_file
from tests.plant.robots import ROBOTS
from tests.plant.run import write_csv
from tests.plant.simulate import make_run
from tests.plant.trajectories.fourier import fourier

ARM = ROBOTS["three_axis"]
#: Hidden in the runs: friction of joint 2 that changes with the position, and its size [N m].
HIDDEN = Effect("position_friction", 2, 1.0 * ARM.chain[1].coulomb)


def record(folder: Path, seeds: tuple[int, ...], effects: tuple[Effect, ...]) -> list[str]:
    """Runs of three periods of 5 s."""
    for seed in seeds:
        run = make_run(ARM, fourier(seed, period=5.0, periods=3), effects, seed=seed)
        write_csv(run, folder / f"{seed}.csv")
    return [f"{seed}.csv" for seed in seeds]


@dataclass(frozen=True)
class Case:
    """A folder with the robot's file and runs; what the command said and wrote into ``out``."""

    folder: Path
    done: Done

    @cached_property
    def result(self) -> dict[str, Any]:
        return result(self.folder / "out")


def result(folder: Path) -> dict[str, Any]:
    found: dict[str, Any] = json.loads((folder / "diagnosis.json").read_text(encoding="utf-8"))
    return found


def diagnose(folder: Path, *arguments: str) -> Done:
    return process("diagnose", *arguments, cwd=folder)


@pytest.fixture(scope="module")
def hidden(tmp_path_factory: pytest.TempPathFactory) -> Case:
    folder = tmp_path_factory.mktemp("hidden")
    (folder / "arm.yaml").write_text(robot_file(ARM), encoding="utf-8")
    a, b, c = record(folder, (1, 2, 3), (HIDDEN,))
    done = diagnose(folder, "arm.yaml", a, "--validate", b, "--test", c, "--out", "out")
    assert done.status == 0, done.err
    return Case(folder, done)


def test_the_hidden_effect_is_named_and_nothing_else(hidden: Case) -> None:
    result = hidden.result
    assert (result["robot"], result["mode"], result["verdict"]) == ("three_axis", "free_fit", "effects_named")
    (found,) = result["findings"]
    assert (found["effect"], found["joints"], found["status"]) == ("position_friction", [2], "firm")
    assert result["where"]["joint"] == 2
    assert result["unexplained"] is None
    assert set(found["parameters"]) >= {"Fqc2", "Fqs2"}
    assert "firm             " in hidden.done.out
    assert "on joint 2" in hidden.done.out
    assert "invisible        " in hidden.done.out
    for one in hidden.result["invisible"]:
        assert f"{one['effect']} [" in hidden.done.out
    assert "Traceback" not in hidden.done.err


def test_every_key_of_the_contract_is_there(hidden: Case) -> None:
    """docs/diagnosis.md has a row for each key."""
    page = (Path(__file__).parents[2] / "docs" / "diagnosis.md").read_text(encoding="utf-8")
    keys = set(hidden.result) | set(hidden.result["findings"][0]) | set(hidden.result["findings"][0]["evidence"])
    keys |= set(hidden.result["where"]) | set(hidden.result["lack_of_fit"]["after"][0]) | set(hidden.result["residual"])
    missing = [key for key in sorted(keys) if f"`{key}`" not in page]
    assert not missing
    assert (hidden.folder / "out" / hidden.result["robot_file"]).is_file()
    assert (hidden.folder / "out" / hidden.result["generated"] / "c" / "three_axis.c").is_file()
    assert (hidden.folder / "out" / "report.html").stat().st_size > 100_000


def test_the_gap_closes_on_the_run_that_nothing_touched(hidden: Case) -> None:
    each = {
        kind: {one["joint"]: one["norm"] for one in hidden.result["residual"][kind]["per_joint"]}
        for kind in ("before", "after")
    }
    assert each["after"][2] < 0.6 * each["before"][2]
    for joint in (1, 3):
        assert each["after"][joint] == pytest.approx(each["before"][joint], rel=0.05)
    data = hidden.result["data"]
    fitted = [one["file"] for kind in ("train", "validate") for one in data[kind]]
    assert not any(name.endswith("3.csv") for name in fitted)
    assert [one["file"].endswith("3.csv") for one in data["test"]] == [True]


@pytest.mark.long
def test_the_repaired_robot_lacks_nothing_on_fresh_runs(hidden: Case) -> None:
    folder = hidden.folder
    a, b = record(folder, (5, 6), (HIDDEN,))
    done = diagnose(folder, "out/three_axis.yaml", a, "--validate", b, "--test", "3.csv", "--out", "again")
    assert done.status == 0, done.err
    again = result(folder / "again")
    assert (again["verdict"], again["findings"]) == ("no_discrepancy", [])


def test_an_effect_of_the_file_is_not_offered_again(hidden: Case) -> None:
    offered = {}
    for name in ("arm.yaml", "out/three_axis.yaml"):
        robot = read(hidden.folder / name)
        regressors, recipe = Regressors(robot), recipes.recipe_of(robot.name)
        run = prepared(load(str(hidden.folder / "1.csv"), robot, recipe.columns), recipe, regressors)
        scene = Scene(run.sampled, regressors, dict.fromkeys(regressors.names, 1.0))
        offered[name] = {(one.effect, one.joint) for one in hypotheses([scene]) if one.kind != SHAPE}
    assert ("position_friction", 2) in offered["arm.yaml"]
    assert ("position_friction", 2) not in offered["out/three_axis.yaml"]
    assert ("position_friction", 1) in offered["out/three_axis.yaml"]
    assert not {("viscous_friction", j) for j in (1, 2, 3)} & offered["arm.yaml"]


def test_a_dry_run_only_locates(hidden: Case) -> None:
    folder = hidden.folder
    done = diagnose(
        folder, "arm.yaml", "1.csv@0:10", "--validate", "2.csv@0:10", "--test", "3.csv", "--dry-run", "--out", "dry"
    )
    assert done.status == 0, done.err
    assert "where            joint 2" in done.out
    assert sorted(path.name for path in (folder / "dry").iterdir()) == ["diagnosis.json", "report.html"]
    dry = result(folder / "dry")
    assert (dry["verdict"], dry["findings"], dry["robot_file"]) == ("located", [], None)
    assert dry["contradicted"] is None
    assert dry["unexplained"] is None
    assert "located (free_fit)" in done.out


def cut_off(folder: Path) -> str:
    """A run that ends too soon, with other samples at its times than the run it is of."""
    head, *lines = (folder / "1.csv").read_text(encoding="utf-8").splitlines(keepends=True)
    rows = [t.partition(",")[0] + "," + row.partition(",")[2] for t, row in zip(lines[:19], lines[-19:], strict=True)]
    (folder / "short.csv").write_text("".join([head, *rows]), encoding="utf-8")
    return "short.csv"


def in_milliseconds(folder: Path) -> str:
    """A run whose times are a thousand times too large."""
    lines = (folder / "1.csv").read_text(encoding="utf-8").splitlines()
    rows = [line.partition(",") for line in lines[1:]]
    changed = [f"{1000 * float(t)!r},{rest}" for t, _, rest in rows]
    (folder / "slow.csv").write_text("\n".join([lines[0], *changed]) + "\n", encoding="utf-8")
    return "slow.csv"


def without_last_column(folder: Path) -> str:
    lines = (folder / "1.csv").read_text(encoding="utf-8").splitlines()
    (folder / "cut.csv").write_text("\n".join(line.rpartition(",")[0] for line in lines) + "\n", encoding="utf-8")
    return "cut.csv"


@pytest.mark.parametrize(
    ("run", "options", "parts"),
    [
        ("2.csv", ("--prior", "knwon"), ("--prior:1:1: ", "no parameter set 'knwon'", "known")),
        (cut_off, (), ("short.csv", "a run of 0.038 s, expected 1 s at least")),
        (in_milliseconds, (), ("slow.csv", "expected at least 4.44 Hz; are the times in s?")),
        (without_last_column, (), ("cut.csv",)),
        ("gone.csv", (), ("gone.csv",)),
    ],
    ids=["prior", "short", "slow", "column", "absent"],
)
def test_bad_input_is_one_line_and_nothing_is_written(
    hidden: Case,
    run: str | Callable[[Path], str],
    options: tuple[str, ...],
    parts: tuple[str, ...],
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(hidden.folder)
    name = run if isinstance(run, str) else run(hidden.folder)
    done = command(
        "diagnose", "arm.yaml", "1.csv", name, "--validate", "2.csv", "--test", "3.csv", *options, "--out", "bad",
        capsys=capsys,
    )  # fmt: skip
    last = done.err.strip().splitlines()[-1]
    assert done.status == 2
    assert last.startswith("error: ")
    assert "Traceback" not in done.err
    assert all(part in last for part in parts), last
    assert not (hidden.folder / "bad").exists()


@pytest.mark.parametrize(
    ("options", "told"),
    [
        (("--validate", "2.csv", "--test", "gone.csv"), "gone.csv:1:1: there is no such file"),
        (("--validate", "2.csv", "--test", "3.csv@0:0.5"), "3.csv:1:1: a run of 0.502 s, expected 1 s at least"),
        (("--test", "1.csv@2:8"), "1.csv:1:1: its samples from 2 s to 8 s fit in 1.csv and test in 1.csv@2:8"),
        (("--test", "3.csv", "--out", "1.csv"), "1.csv:1:1: it cannot be written (File exists)"),
    ],
    ids=["absent", "short", "fitted", "out"],
)
def test_what_would_fail_at_the_end_is_refused_first(
    hidden: Case,
    options: tuple[str, ...],
    told: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(hidden.folder)
    out = () if "--out" in options else ("--out", "bad")
    done = command("diagnose", "arm.yaml", "1.csv", *options, *out, capsys=capsys)
    assert done.status == 2
    assert done.err.strip().splitlines()[-1].startswith(f"error: {told}")
    assert "making the columns" not in done.err
    assert not (hidden.folder / "bad").exists()


@pytest.mark.parametrize(
    ("robot", "out"),
    [("out/three_axis.yaml", "out"), ("three_axis.yaml", "."), ("linked.yaml", "out")],
    ids=["second_round", "here", "link"],
)
def test_the_robot_file_is_not_written_over(
    hidden: Case, robot: str, out: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(hidden.folder)
    Path("three_axis.yaml").write_bytes(Path("arm.yaml").read_bytes())
    Path("linked.yaml").unlink(missing_ok=True)
    Path("linked.yaml").symlink_to("out/three_axis.yaml")
    arguments = ("diagnose", robot, "1.csv", "--validate", "2.csv", "--test", "gone.csv", "--out", out)
    done = command(*arguments, capsys=capsys)
    target = "three_axis.yaml" if out == "." else "out/three_axis.yaml"
    assert done.status == 2
    assert done.err.strip().splitlines()[-1] == (
        f"error: {target}:1:1: it would be written over {robot}, which is read, expected another --out"
    )
    assert "reading" not in done.err
    # Nothing is written over the file without findings: the run that is missing is what stops it.
    done = command(*arguments, "--dry-run", capsys=capsys)
    assert done.err.strip().splitlines()[-1].startswith("error: gone.csv:1:1: there is no such file")


def test_a_sidecar_is_not_written_over(
    hidden: Case, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(hidden.folder)
    run = Path("beside/three_axis.csv")
    run.parent.mkdir()
    run.write_bytes(Path("2.csv").read_bytes())
    sidecar = run.with_suffix(".yaml")
    sidecar.write_text("notes: a run\n")
    done = command("diagnose", "arm.yaml", "1.csv", "--test", f"{run}@0:5", "--out", "beside", capsys=capsys)
    assert done.status == 2
    assert done.err.strip().splitlines()[-1] == (
        f"error: {sidecar}:1:1: it would be written over {sidecar}, which is read, expected another --out"
    )
