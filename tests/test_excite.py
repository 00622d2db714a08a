"""Designed motions: within every limit, better than random ones, and as telling as they are said to be."""

from __future__ import annotations

import json
import re
from argparse import ArgumentParser
from collections.abc import Iterator
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from generator.cli.main import main
from generator.errors import InputError, Place
from generator.robot.readers import read
from identification.cli.excite import configure
from identification.dataset import Run
from identification.excitation.design import improved
from identification.excitation.excite import excite
from identification.excitation.expectation import expected
from identification.excitation.noise import Noise
from identification.excitation.request import Request
from identification.factors import factors
from identification.inverse_model import Options, identify
from identification.least_squares import Problem
from identification.observation import Motion, Regressors
from identification.readers import csv
from identification.recipes import Recipe
from identification.sampling import rows_of, sampled
from identification.simulation.machine import Machine, compiled
from identification.simulation.settings import Settings
from identification.simulation.simulate import simulate
from tests.commands import PENDULUM, ROOT, command
from tests.documents import blocks
from tests.elastic_links import N
from tests.recorded import TRUTH, TWO_LINKS, fourier, parameters_text, regressors
from tests.scattering import squares

Array = NDArray[np.float64]

#: The two links with limits of every kind, and their parameters.
LIMITED = (
    TWO_LINKS.replace("limits: [-160 deg, 160 deg]}", "limits: [-60 deg, 90 deg], speed_limit: 70 deg/s}", 1)
    .replace("limits: [-160 deg, 160 deg]}", "limits: [-90 deg, 90 deg], acceleration_limit: 1.5 rad/s2}", 1)
    .replace("r: 0, limits: [-60", "r: 0, torque_limit: 125 N m, limits: [-60", 1)
)
NOISE = (0.05, 0.08)
WORDS = ("--evaluations", "3000", "--noise", *map(str, NOISE), "--rate", "500")


def with_truth(text: str) -> str:
    return text + parameters_text({"twin": TRUTH})


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("excite") / "two_links.yaml"
    path.write_text(with_truth(LIMITED))
    return path


def test_the_command_asks_for_what_a_request_does() -> None:
    """Unless something else is said; noise and recipe have no words of their own."""
    parser = ArgumentParser()
    configure(parser)
    asked = vars(parser.parse_args(["kr500"]))
    own = asdict(Request())
    assert {name: asked[name] or own[name] for name in own} == own


@pytest.fixture(scope="module")
def folder(file: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    result = tmp_path_factory.mktemp("designed") / "two_links"
    assert main(["excite", str(file), "--out", str(result), *WORDS]) == 0
    return result


@pytest.fixture(scope="module")
def machine(file: Path) -> Iterator[Machine]:
    with compiled(read(file)) as made:
        yield made


def motion_of(found: dict[str, Any], times: Array) -> Motion:
    """The series of excitation.json, its derivatives written out by hand."""
    series = found["series"]
    a, b = np.array(series["sine"]), np.array(series["cosine"])
    q, qd, qdd = (np.zeros((len(a), len(times))) for _ in range(3))
    q += np.array(series["centre"])[:, None]
    for order in range(1, a.shape[1] + 1):
        w = 2 * np.pi * series["frequency"] * order
        s, c = np.sin(w * times), np.cos(w * times)
        q += np.outer(a[:, order - 1], s) + np.outer(b[:, order - 1], c)
        qd += w * (np.outer(a[:, order - 1], c) - np.outer(b[:, order - 1], s))
        qdd -= w**2 * (np.outer(a[:, order - 1], s) + np.outer(b[:, order - 1], c))
    return Motion(q, qd, qdd)


def test_every_limit_holds_between_the_samples_too(file: Path, folder: Path) -> None:
    found = json.loads((folder / "excitation.json").read_text())
    motion = motion_of(found, np.linspace(0, 10, 200_001))
    room = np.radians([[-60, 90], [-90, 90]])
    assert (motion.q.min(axis=1) >= room[:, 0]).all()
    assert (motion.q.max(axis=1) <= room[:, 1]).all()
    assert (np.abs(motion.qd).max(axis=1) <= [np.radians(70), 1.0]).all()
    assert (np.abs(motion.qdd).max(axis=1) <= [2.0, 1.5]).all()
    torque = np.abs(Regressors(read(file)).torques(TRUTH, motion)[0]).max()
    assert torque <= 125.0
    assert torque > 120.0, "the limit is not beside the point"
    assert found["largest_load"] == pytest.approx(torque / 125, rel=1e-4)
    assert motion.qd[:, 0] == pytest.approx([0, 0], abs=1e-12)
    assert motion.qdd[:, 0] == pytest.approx([0, 0], abs=1e-12)


def test_the_run_is_the_series(folder: Path) -> None:
    found = json.loads((folder / "excitation.json").read_text())
    columns = csv.read(folder / "trajectory.csv").columns
    motion = motion_of(found, columns["t"])
    assert len(columns["t"]) == 10_001
    for rest in (0, -1):
        assert [columns[f"qd{k}"][rest] for k in (1, 2)] == pytest.approx([0, 0], abs=1e-10)
    for k in range(2):
        assert columns[f"qr{k + 1}"] == pytest.approx(motion.q[k], abs=1e-10)
        assert columns[f"qd{k + 1}"] == pytest.approx(motion.qd[k], abs=1e-10)


def test_the_search_repeats_itself_and_beats_chance(
    file: Path, folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    done = command("excite", file, "--out", tmp_path / "again", *WORDS, capsys=capsys)
    assert (done.status, done.err.splitlines()[-1]) == (0, "searching among 3000 motions")
    for one in folder.iterdir():
        assert one.read_bytes() == (tmp_path / "again" / one.name).read_bytes()
    search = json.loads((folder / "excitation.json").read_text())["search"]
    assert search["cost"] < search["cost_of_best_random_motion"] - 0.1
    words = ("--criterion", "condition", "--evaluations", "3000", "--noise", *map(str, NOISE))
    assert command("excite", file, "--out", tmp_path / "condition", *words, capsys=capsys).status == 0
    conditions = [json.loads((one / "excitation.json").read_text()) for one in (tmp_path / "condition", folder)]
    assert conditions[0]["condition_scaled"] < conditions[1]["condition_scaled"]


def test_the_expected_deviations_are_those_of_repeated_runs(machine: Machine, folder: Path, tmp_path: Path) -> None:
    """Over N noises the sum of squared errors in units of the expected std is that of chi-squared numbers, one a
    parameter: each sum lies between the quantiles that one of 13 leaves in 1 of 1000 tests.
    """
    count, regressors = 40, Regressors(machine.robot)
    settings = Settings(
        trajectory="played", trajectory_settings={"file": str(folder / "trajectory.csv")}, duration=20.0, rate=500.0
    )
    clean = simulate(machine, settings).columns
    draw = np.random.default_rng(5)
    errors = []
    for seed in range(count):
        noisy = {name: values.copy() for name, values in clean.items()}
        for k, rms in enumerate(NOISE):
            noisy[f"i{k + 1}"] += draw.normal(0.0, rms, len(noisy["t"]))
        path = tmp_path / f"{seed}.csv"
        np.savetxt(path, np.column_stack(list(noisy.values())), delimiter=",", header=",".join(noisy), comments="")
        found = identify(machine.robot, [str(path)], [], Options(recipe=Recipe()), regressors).full.solution
        errors.append([found.values[name] for name in TRUTH])
    expected = json.loads((folder / "excitation.json").read_text())["expected"]
    std = np.array([expected[name]["std"] for name in TRUTH])
    scattered = squares(errors, std)
    # All together: the ratio of variances is 1 within what 13 parameters, as good as 5 independent ones, allow.
    assert scattered.mean() / (count - 1) == pytest.approx(1.0, abs=4 * np.sqrt(2 / (5 * (count - 1))))


def test_ordinary_least_squares_are_expected_to_scatter_as_they_do() -> None:
    """Joints of very unequal noise, whose rows count alike: estimates from drawn rows are the judge."""
    arm, names, noise = regressors("tilted_two_link"), regressors("tilted_two_link").names, np.array([60.0, 0.6])
    _, motion = fourier(arm.model.robot, 20.0, 200.0)
    recipe = Recipe(weights="none")
    foreseen = expected(motion, 200.0, arm, recipe, dict.fromkeys(names, 3.0), Noise(noise, np.zeros(2)))
    still = Run("designed", Place("designed"), 0.0, 1 / 200.0, motion.q, np.zeros_like(motion.q))
    rows, factor = [*rows_of(sampled(still, recipe, arm), arm)], recipe.at(200.0).factor
    draw = np.random.default_rng(3)
    errors = []
    for _ in range(60):
        noisy = [replace(one, Y=noise[one.joint] / np.sqrt(factor) * draw.normal(size=len(one.Y))) for one in rows]
        found = Problem(factors(noisy), names, {}, weighted=False).solve()
        errors.append([found.values[name] for name in names])
    squares(errors, np.array([foreseen.std(name) for name in names]))


def test_the_passage_for_python_designs_what_the_command_does(
    file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """With another robot, and with so few motions that they are seen through at once."""
    (passage,) = (one.text for one in blocks((ROOT / "docs" / "excite.md").read_text()) if one.language == "python")
    passage = passage.replace('"kr500"', f'"{file}"').replace("speed=0.8", "speed=0.8, evaluations=256")
    monkeypatch.chdir(tmp_path)
    exec(compile(passage, "docs/excite.md", "exec"), {})
    relative, duration = map(float, capsys.readouterr().out.split())
    words = ("--noise", "0.3", "--speed", "0.8", "--evaluations", "256")
    assert command("excite", file, "--out", "command", *words, capsys=capsys).status == 0
    for name in ("excitation.json", "trajectory.csv", "trajectory.yaml"):
        assert Path("excitation", "kr500", name).read_bytes() == Path("command", name).read_bytes()
    told = json.loads(Path("command", "excitation.json").read_text())
    assert (duration, relative) == (20.0, told["expected"]["Fv1"]["relative_std_percent"])


def test_a_request_for_an_unknown_criterion_is_refused(file: Path) -> None:
    with pytest.raises(InputError, match=r"^--criterion:1:1: 'trace', expected determinant or condition$"):
        excite(read(file), Request(criterion="trace"))


def test_what_no_row_shows_is_named(file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    slow = tmp_path / "slow.yaml"
    slow.write_text(file.read_text().replace("acceleration_limit: 1.5 rad/s2", "speed_limit: 0.02 rad/s"))
    done = command("excite", slow, "--out", tmp_path / "slow", "--evaluations", "300", capsys=capsys)
    assert done.status == 0
    assert "note: Ia2, Fv2, Fc2 and Off2 will not be identifiable from this motion" in done.out.splitlines()
    expected = json.loads((tmp_path / "slow" / "excitation.json").read_text())["expected"]
    assert expected["Fc2"]["std"] == np.inf
    assert not expected["Fc2"]["identifiable"]
    assert expected["Fc1"]["identifiable"]


def test_a_period_is_a_whole_number_of_samples(file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ("--frequency", "0.3", "--rate", "101", "--evaluations", "256", "--periods", "6")
    done = command("excite", file, "--out", tmp_path / "out", *words, capsys=capsys)
    assert "note: 0.299703 Hz for 0.3: a period is a whole number of samples" in done.out.splitlines()
    columns = csv.read(tmp_path / "out" / "trajectory.csv").columns
    assert len(columns["t"]) == 6 * 337 + 1
    assert columns["qr2"][337:] == pytest.approx(columns["qr2"][:-337], abs=1e-10)


REFUSED = {
    ("--frequency", "0"): "error: --frequency:1:1: 0, expected a number above 0",
    ("--evaluations", "255"): "error: --evaluations:1:1: 255, expected a whole number from 256 to 10000000",
    ("--harmonics", "1"): "error: --harmonics:1:1: 1, expected a whole number from 2 to 50",
    ("--noise", "0.1", "0.1", "1"): "error: --noise:1:1: 3 numbers, expected one, or one for each of 2 motors",
    ("--noise", "-1"): "error: --noise:1:1: -1, expected a number that is not negative, 1e+12 at most",
    ("--noise", "1e300"): "error: --noise:1:1: 1e+300, expected a number that is not negative, 1e+12 at most",
    ("--noise-part", "1e308"): "error: --noise-part:1:1: 1e+308, expected a number that is not negative, 1e+12 at most",
    ("--noise", "1e-300"): "error: --noise:1:1: 1e-300, expected a number above 1e-12, 1e+12 at most",
    ("--acceleration", "1e300"): "error: --acceleration:1:1: 1e+300, expected a number above 0, 1e+12 at most",
    ("--noise", "0"): "error: --noise:1:1: a motor without noise, expected noise on every motor, or --noise-part",
    ("--noise-part", "0"): "error: --noise-part:1:1: 0, and no --noise, expected a measurement that is not exact",
    ("--rate", "5"): "error: --rate:1:1: 5, expected 20 times the highest harmonic, 0.5 Hz",
    ("--frequency", "5", "--periods", "1", "--rate", "1000"): (
        "error: --periods:1:1: 201 samples at 1000 Hz, expected at least 2000 for the filters"
    ),
    ("--parameters", "twim"): "error: --parameters:1:1: two_links has no parameter set 'twim', expected perhaps 'twin'",
}


@pytest.mark.parametrize("words", REFUSED)
def test_a_wrong_option_is_one_line(
    words: tuple[str, ...], file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    done = command("excite", file, "--out", tmp_path / "out", *words, capsys=capsys)
    assert (done.status, done.err.splitlines()[-1]) == (2, REFUSED[words])
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("sets", "expected"),
    [
        ({}, "one in section parameters of the robot file, which has none; estimated values will do"),
        ({"rough": TRUTH}, "one of rough"),
    ],
)
def test_a_robot_without_the_default_set_is_told_before_the_search(
    sets: dict[str, dict[str, float]], expected: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "bare.yaml").write_text(LIMITED + (parameters_text(sets) if sets else ""))
    told = f"error: --parameters:1:1: two_links has no parameter set 'twin', the default, expected {expected}"
    for name in ("excite", "simulate"):
        done = command(name, tmp_path / "bare.yaml", "--out", tmp_path / "out.csv", capsys=capsys)
        assert (done.status, done.err.splitlines()) == (2, [told])


def test_limits_that_no_motion_can_keep(file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for old, new, problem in (
        (
            "torque_limit: 125 N m",
            "torque_limit: 1 N m",
            "1:1: weight and dry friction alone are beyond the torque limit of joint 1, expected a limit",
        ),
        (
            "\neffects:",
            "\nsignals: {current_limit: [0.001 A, 900 A]}\neffects:",
            "weight and dry friction alone are beyond the current limit of motor 1",
        ),
        ("speed_limit: 70 deg/s", "speed_limit: 0 deg/s", "speed_limit of joint 1 is 0"),
    ):
        path = tmp_path / "two_links.yaml"
        path.write_text(file.read_text().replace(old, new))
        done = command("excite", path, "--out", tmp_path / "out", "--evaluations", "300", capsys=capsys)
        assert done.status == 2
        assert problem in done.err.splitlines()[-1]
    done = command("excite", file, "--out", tmp_path / "out", "--speed", "0.001", capsys=capsys)
    assert done.status == 2
    assert "no joint can be faster than its standstill threshold" in done.err.splitlines()[-1]


ONE_OF_TWO = "t,qr1\n0,0\n0.1,0\n0.2,0\n"
PLAYED = {
    "t,qr1,qr2\n0,0,0\n0.1,1,0\n0.2,5,0\n0.3,1,0\n": "run.csv:4:5: qr1 is 5, expected a position from -1.047 to 1.571",
    ONE_OF_TWO: "run.csv:1:3: there is no column qr2, expected qr1 to qr2",
    "qr1,qr2\n0,0\n0,0\n0,0\n": "run.csv:1:1: there is no column t, expected times in s",
    "t,qr1,qr2\n0,0,0\n0.1,nan,0\n0.2,0,0\n": "run.csv:3:5: qr1 is nan, expected a finite number",
    "t,qr1,qr2\n0,0,0\n0.1,0.1,0\n0.2,0.2,0\n0.3,0.3,0\n": "does not begin at rest",
}


@pytest.mark.parametrize("text", PLAYED)
def test_a_file_that_cannot_be_played(text: str, machine: Machine, tmp_path: Path) -> None:
    run = tmp_path / "run.csv"
    run.write_text(text)
    with pytest.raises(InputError, match=re.escape(PLAYED[text])):
        simulate(machine, Settings(trajectory="played", trajectory_settings={"file": str(run)}, duration=1.0))


def test_of_a_file_that_cannot_be_played_the_command_says_so(
    file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    run = tmp_path / "run.csv"
    run.write_text(ONE_OF_TWO)
    words = ("--trajectory", "played", "--set", f"file={run}", "--duration", "1")
    done = command("simulate", file, "--out", tmp_path / "out.csv", *words, capsys=capsys)
    assert done.status == 2
    assert PLAYED[ONE_OF_TWO] in done.err.splitlines()[-1]


@pytest.mark.parametrize(("asked", "lasts"), [((), 25.0), (("--duration", "5"), 5.0)])
def test_a_file_is_played_to_its_end(
    asked: tuple[str, ...], lasts: float, file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A run without a length of its own lasts 20 s: one that has one is as long, but for the last of its samples."""
    t = 3.0 + np.arange(251) / 10
    q = 0.1 * (1 - np.cos(2 * np.pi * (t - t[0]) / 5))
    np.savetxt(tmp_path / "long.csv", np.stack([t, q, q], axis=1), delimiter=",", header="t,qr1,qr2", comments="")
    words = ("--trajectory", "played", "--set", f"file={tmp_path / 'long.csv'}", *asked)
    assert command("simulate", file, "--out", tmp_path / "a.csv", *words, capsys=capsys).status == 0
    made = csv.read(tmp_path / "a.csv").columns
    assert made["t"][-1] == pytest.approx(lasts - 1e-3)
    assert f"duration: {lasts:g}" in (tmp_path / "a.yaml").read_text()


def test_positions_are_written_as_the_controller_counts_them(
    file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """With an offset of its encoders a robot makes the same true motion, and counts it from elsewhere."""
    offset = np.radians([[70], [-40]])
    path, words = tmp_path / "two_links.yaml", ("--evaluations", "256", "--rate", "100")
    path.write_text(file.read_text() + "signals: {position_offset: [70 deg, -40 deg]}\n")
    plain, shifted = tmp_path / "plain", tmp_path / "shifted"
    for robot, out in ((file, plain), (path, shifted)):
        assert command("excite", robot, "--out", out, *words, capsys=capsys).status == 0
    series, same = (json.loads((out / "excitation.json").read_text())["series"] for out in (plain, shifted))
    assert series == same
    true, counted = (csv.read(out / "trajectory.csv").columns for out in (plain, shifted))
    for k in (1, 2):
        assert counted[f"qr{k}"] == pytest.approx(true[f"qr{k}"] - offset[k - 1], abs=1e-9)
        assert counted[f"qd{k}"] == pytest.approx(true[f"qd{k}"], abs=1e-9)
    assert "position_offset" in (shifted / "trajectory.yaml").read_text()
    settings = Settings(
        trajectory="played",
        trajectory_settings={"file": str(shifted / "trajectory.csv")},
        duration=5.0,
        rate=500.0,
        further=("qr",),
    )
    with compiled(read(path)) as made:
        log = simulate(made, settings).columns
    logged = np.linalg.solve(N, np.stack([log["qm1"], log["qm2"]])) + offset
    count = len(log["t"][::5])
    for k, name in enumerate(("qr1", "qr2")):
        assert log[name][::5] == pytest.approx(counted[name][:count], abs=1e-6)
        assert logged[k][::5] == pytest.approx(true[name][:count], abs=0.02)


def test_a_robot_without_drives_or_limits(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "pendulum.yaml").write_text(PENDULUM)
    words = ("--parameters", "light", "--evaluations", "600", "--noise", "0.5", "--out", tmp_path / "out")
    done = command("excite", tmp_path / "pendulum.yaml", *words, capsys=capsys)
    assert done.status == 0
    assert "torque limits    none in the robot file" in done.out.splitlines()
    expected = json.loads((tmp_path / "out" / "excitation.json").read_text())["expected"]
    assert all(0 < one["relative_std_percent"] < 50 for one in expected.values())


def test_a_search_in_few_directions_ends() -> None:
    """Their axes learn fast: ten generations summed would make variances negative."""

    def costs(x: Array) -> Array:
        rough = np.sum(np.abs(x - 0.3) ** np.linspace(0.5, 4.0, x.shape[1]), axis=1)
        return np.asarray(rough + 0.1 * np.abs(np.sin(9 * x)).sum(axis=1))

    start = np.ones(12)
    cost, best = improved(start, costs, 20000, np.random.default_rng(0))
    assert cost == costs(best[None])[0] < 0.1 * costs(start[None])[0]
