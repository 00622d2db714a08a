"""``counterpoise output-error``: what it writes, where its starts run, what survives a worker that dies, bad input."""

from __future__ import annotations

import json
import os
import pickle
import signal
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import dask
import distributed
import numpy as np
import pytest

from generator.cli.main import main
from generator.derivation import derive
from generator.errors import InputError, Place
from generator.robot.readers import read
from generator.symbolic.parameter_sets import resolved
from identification.corrections import TooWarm, Untold
from identification.executors import cluster
from identification.executors.cluster import Cluster
from identification.executors.here import Here
from identification.executors.processes import Processes
from identification.output_error.multi_start import output_error
from identification.output_error.search import Settings
from identification.recipes import Recipe
from identification.study import key_of, study
from tests.commands import command
from tests.recorded import SLIDE
from tests.study_tasks import dies, first_dies, refuses, squared

STARTS = 3

#: What is simulated, of one axis, which workers compile quickly.
TWIN = """\
parameters:
  twin:
    values: {M1: 95 kg, Fv1: 200 N s/m, Fc1: 20 N, Off1: -3 N}
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A robot file, and a run of it with noise."""
    place = tmp_path_factory.mktemp("command")
    (place / "slide.yaml").write_text(SLIDE + TWIN)
    words = ["--duration", "6", "--noise", "0.3", "--parameters", "twin", "--out"]
    assert main(["simulate", str(place / "slide.yaml"), *words, str(place / "A.csv")]) == 0
    return place


def tasks(place: Path) -> dict[str, tuple[int, str]]:
    return {f"task_{k}": (k, str(place)) for k in range(5)}


SQUARES = {f"task_{k}": k * k for k in range(5)}


def test_a_study_goes_on_where_it_was(tmp_path: Path) -> None:
    kept = tmp_path / "kept"
    counts: list[tuple[int, int]] = []
    some = dict(list(tasks(tmp_path).items())[:2])
    study(squared, some, Here(), kept)
    assert sorted(path.name for path in kept.iterdir()) == ["task_0.json", "task_1.json"]
    found = study(squared, tasks(tmp_path), Here(), kept, lambda done, total: counts.append((done, total)))
    assert found == SQUARES
    assert counts == [(2, 5), (3, 5), (4, 5), (5, 5)]
    assert (tmp_path / "done_1").read_text() == "once"
    assert list(found) == list(SQUARES)
    for text, keys in (("{", ()), ("{}", ("rms",)), ("3", ("rms",))):
        (kept / "task_3.json").write_text(text)
        with pytest.raises(InputError, match=r"task_[03]\.json:1:1: this is no result of a study"):
            study(squared, tasks(tmp_path), Here(), kept, keys=keys)
    assert key_of({"a": 1.0}) != key_of({"a": 1.5})


def test_a_process_that_dies_loses_nothing(tmp_path: Path) -> None:
    assert study(first_dies, tasks(tmp_path), Processes(2)) == SQUARES
    assert (tmp_path / "died").exists()


def test_a_function_that_kills_every_process_is_given_up(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="processes die before any task is done"):
        study(dies, {"one": 1}, Processes(1))


def test_processes_that_die_while_tasks_are_given_out_are_given_up() -> None:
    with pytest.raises(InputError, match="processes die before any task is done"):
        study(dies, {f"{k}": k for k in range(200)}, Processes(20))


def test_bad_input_is_told_from_another_process() -> None:
    with pytest.raises(InputError, match=r"^cc:1:1: there is no compiler, expected gcc$") as told:
        study(refuses, {"one": 1}, Processes(1))
    assert (told.value.place, told.value.problem) == (Place("cc"), "there is no compiler")
    for error in (Untold(3, Place("run.csv"), True), TooWarm(2, Place("run.csv"), "it is hot")):
        again = pickle.loads(pickle.dumps(error))
        assert (type(again), str(again), again.joint) == (type(error), str(error), error.joint)


@pytest.fixture(scope="module")
def serial(folder: Path) -> dict[str, Any]:
    """The starts one after the other, by name: what each ends with."""
    return dict(starts_of(folder, Here()))


def starts_of(folder: Path, executor: Any, counted: Callable[[int, int], None] = lambda done, total: None) -> Any:
    settings = Settings(Recipe(), spread=3.0, seed=5)
    found = output_error(
        read(folder / "slide.yaml"), [folder / "A.csv"], (), settings, count=STARTS, executor=executor, counted=counted
    )
    return {"scores": found.scores, "chosen": found.chosen, "values": found.best.values, "hidden": found.best.hidden}


@pytest.mark.long
def test_a_cluster_that_loses_a_worker_gives_the_same_result(folder: Path, serial: dict[str, Any]) -> None:
    """A worker is killed when the first start is done; the others are done by the one that is left."""
    killed: list[int] = []
    with two_workers() as workers:

        def kill(done: int, total: int) -> None:
            if done == 1 and not killed:
                killed.append(kill_one(workers))

        with cluster.opened(workers.scheduler_address) as executor:
            assert isinstance(executor, Cluster)
            found = starts_of(folder, executor, kill)
    assert killed
    assert len(found["scores"]) == STARTS
    assert found == serial


@pytest.mark.long
def test_results_that_die_with_their_worker_are_made_again(tmp_path: Path) -> None:
    """All tasks are done, on either worker, when one of them is killed with what was not fetched from it."""
    killed: list[int] = []
    with two_workers() as workers:

        def kill(done: int, total: int) -> None:
            if done == 1 and not killed:
                while len(list(tmp_path.glob("done_*"))) < total:
                    time.sleep(0.01)
                killed.append(kill_one(workers))

        with cluster.opened(workers.scheduler_address) as executor:
            assert study(squared, tasks(tmp_path), executor, counted=kill) == SQUARES
    assert killed


def test_a_cluster_that_is_lost_is_told(tmp_path: Path) -> None:
    with two_workers() as workers, cluster.opened(workers.scheduler_address) as executor:
        lost = pytest.raises(InputError, match="--scheduler:1:1: the cluster is lost")
        with lost:
            study(
                squared, tasks(tmp_path), executor, counted=lambda done, total: workers.close() if done == 1 else None
            )


@contextmanager
def two_workers() -> Iterator[Any]:
    """A cluster on this machine. No client of it is the process's default, as none is in the command."""
    # By default the scheduler tries half a minute to reach a worker that is dead.
    with (
        dask.config.set({"distributed.comm.timeouts.connect": "10s"}),
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as workers,
    ):
        yield workers


def kill_one(workers: Any) -> int:
    """Kills a worker's process, whose number is returned."""
    with distributed.Client(workers, set_as_default=False) as client:
        number = int(next(iter(client.run(os.getpid).values())))
    os.kill(number, signal.SIGKILL)
    return number


def test_the_command_writes_its_results_and_resumes(
    folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    robot, run, out = folder / "slide.yaml", folder / "A.csv", tmp_path / "out"
    words = ["output-error", robot, "--data", run, "--test", f"{run}@1:4.5", "--starts", "2", "--out", out]
    done = command(*words, capsys=capsys)
    assert done.status == 0, done.err
    assert "starts: 2 of 2 done" in done.err
    results = json.loads((out / "results.json").read_text())
    assert set(results["parameters"]["M1"]) >= {"value", "std", "relative_std_percent", "unit", "fixed"}
    assert results["method"]["name"] == "output error"
    for kind in ("train", "test"):
        assert [one["joint"] for one in results["residual"][kind]["per_joint"]] == [1]
        assert results["residual"][kind]["total"]["relative_to_mean_percent"] < 5
    assert results["inertia"]["smallest"] > results["inertia"]["margin"]
    assert len(results["inertia"]["eigenvalues"]) == len(results["inertia"]["q"])
    added = read(out / "slide.yaml").parameter_sets["identified_output_error"]
    assert added.values["M1"].value == pytest.approx(results["parameters"]["M1"]["value"], rel=1e-5)

    (first,) = (out / "starts").iterdir()
    assert sorted(path.name for path in first.iterdir()) == ["start_001.json", "start_002.json"]
    before = (out / "results.json").read_bytes()
    (first / "start_002.json").unlink()
    done = command(*words, capsys=capsys)
    assert "starts: 1 of 2 done\nstarts: 2 of 2 done" in done.err
    assert (out / "results.json").read_bytes() == before
    kept = json.loads((first / "start_002.json").read_text())
    for key, damaged in (("rms", ["1"]), ("chi", [*kept["chi"], 1.0]), ("states", 3), ("scale", [[1.0], 2.0])):
        (first / "start_002.json").write_text(json.dumps(kept | {key: damaged}))
        done = command(*words, capsys=capsys)
        told = f"error: {first}/start_002.json:1:1: these are not the numbers of a start, expected a file that"
        assert (done.status, done.err.splitlines()[-1].startswith(told)) == (2, True)
    (first / "start_002.json").write_text(json.dumps(kept))
    fast = tmp_path / "fast.csv"
    values = np.loadtxt(run, delimiter=",", skiprows=1)
    values[:, -1] *= 1e6
    np.savetxt(fast, values, delimiter=",", header=run.read_text().splitlines()[0], comments="")
    done = command(*words[:5], fast, *words[6:], capsys=capsys)
    assert "note: the simulation diverges on what was held out" in done.out, done.err
    assert "nan" not in (out / "results.json").read_text() + done.out
    assert json.loads((out / "results.json").read_text())["residual"]["test"]["total"]["norm"] == float("inf")
    command(*words, "--segment", "0.5", capsys=capsys)
    assert len(list((out / "starts").iterdir())) == 2


def test_what_is_given_is_written_beside_what_is_found(
    folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["--data", folder / "A.csv", "--fix", "Fv1=210", "Off1=0", "--iterations", "2", "--out", tmp_path]
    done = command("output-error", folder / "slide.yaml", *words, capsys=capsys)
    assert done.status == 0, done.err
    found = json.loads((tmp_path / "results.json").read_text())["parameters"]
    assert found["Fv1"] == {
        "value": 210.0,
        "std": 0.0,
        "relative_std_percent": 0.0,
        "essential": False,
        "fixed": True,
        "identifiable": True,
        "unit": "N s/m",
    }
    assert found["Off1"].keys() == found["M1"].keys() == found["Fv1"].keys()
    assert not found["M1"]["fixed"]
    robot = read(tmp_path / "slide.yaml")
    written = robot.parameter_sets["identified_output_error"].values
    assert {name: (one.value, one.note) for name, one in written.items() if one.note} == {
        "Fv1": (210.0, "given, not identified"),
        "Off1": (0.0, "given, not identified"),
    }
    played = resolved(derive(robot, names=(), check=False), written)
    assert played["Fv1"] == 210.0
    assert played["Fc1"] == pytest.approx(found["Fc1"]["value"], rel=1e-5)
    assert any(line.split()[0] == "Fv1" and line.endswith("given") for line in done.out.splitlines())


@pytest.mark.parametrize(("iterations", "settled"), [("1", False), ("30", True)])
def test_a_search_that_was_cut_short_is_told(
    iterations: str, settled: bool, folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["--data", folder / "A.csv", "--iterations", iterations, "--out", tmp_path]
    done = command("output-error", folder / "slide.yaml", *words, capsys=capsys)
    assert done.status == 0, done.err
    assert json.loads((tmp_path / "results.json").read_text())["method"]["settled"] is settled
    assert ("came to its last iteration or second before it settled" not in done.out) is settled


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("--method newton", "error: --method:1:1: there is no method 'newton', expected perhaps"),
        ("--segment long", "error: --segment:1:1: 'long', expected a time in s, or none"),
        ("--segment 0.01", "segments of 0.01 s, expected at least 0.08 s"),
        ("--starts 0", "error: --starts:1:1: 0, expected a whole number from 1 on"),
        ("--seconds -1", "error: --seconds:1:1: -1, expected a number above 0"),
        ("--fix Fc9=1", "error: --fix:1:1: the robot has no base parameter 'Fc9'"),
        ("--workers many", "error: --workers:1:1: 'many', expected a whole number from 1 to 1024"),
        ("--workers 2 --scheduler tcp://x:1", "--workers:1:1: --scheduler is given as well, expected one of them"),
        ("--scheduler tcp://127.0.0.1:9", "error: --scheduler:1:1: 'tcp://127.0.0.1:9': "),
        ("--scheduler nothing:at:all", "error: --scheduler:1:1: 'nothing:at:all': "),
    ],
)
def test_bad_input_is_one_line(
    folder: Path,
    tmp_path: Path,
    words: str,
    message: str,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(cluster, "_ANSWER", 1)
    robot, run, out = folder / "slide.yaml", folder / "A.csv", tmp_path / "out"
    done = command("output-error", robot, "--data", run, "--out", out, *words.split(), capsys=capsys)
    lines = [line for line in done.err.splitlines() if line.startswith("error: ")]
    assert done.status == 2
    assert len(lines) == 1
    assert message in lines[0]
    assert not out.exists()


def test_a_run_with_a_payload_is_refused(folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    loaded = tmp_path / "loaded.csv"
    loaded.write_bytes((folder / "A.csv").read_bytes())
    loaded.with_suffix(".yaml").write_text("payload: {name: L, M: 2 kg}\n")
    done = command("output-error", folder / "slide.yaml", "--data", loaded, "--out", tmp_path / "o", capsys=capsys)
    assert done.status == 2
    assert "the run carries payload L, expected a run without payload" in done.err
