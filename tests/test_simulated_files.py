"""Simulated runs as files: read back, beside what they were made of, and as the robot's own signals would log them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from generator.robot.readers import read
from identification import readers, sidecar
from identification.dataset import Run, load
from identification.simulation.machine import Machine, compiled
from identification.simulation.run_file import save
from identification.simulation.simulate import simulate
from tests.commands import command
from tests.recorded import Array
from tests.simulated_runs import SHORT


def test_files_are_read_back_as_they_were(machine: Machine, tmp_path: Path) -> None:
    run = simulate(machine, replace(SHORT, noise=(0.1,), largest=(5.0,)))
    path, _ = save(run, "two_links", machine.robot.digest, tmp_path / "a.csv")
    again = readers.read(path).columns
    assert list(again) == list(run.columns)
    for name, values in run.columns.items():
        assert again[name] == pytest.approx(values, rel=1e-11, abs=1e-300)


def test_the_sidecar_tells_any_file_that_was_played(machine: Machine, tmp_path: Path) -> None:
    played = tmp_path / "a: [b] #.csv"
    played.write_text("t,qr1,qr2\n0,0,0\n0.1,0,0\n0.2,0,0\n0.3,0,0\n")
    run = simulate(machine, replace(SHORT, trajectory="played", trajectory_settings={"file": str(played)}))
    path, beside = save(run, "two_links", machine.robot.digest, tmp_path / "c.csv")
    assert sidecar.read(path).robot == "two_links"
    assert str(played) in beside.read_text()


def test_the_sidecar_tells_which_motors_have_a_limit(machine: Machine, tmp_path: Path) -> None:
    for largest, told in (((np.inf, 5.0), "[none, 5]"), ((np.inf,), "[none]"), ((5.0,), "[5]")):
        run = simulate(machine, replace(SHORT, largest=largest))
        path, beside = save(run, "two_links", machine.robot.digest, tmp_path / "a.csv")
        assert f"\n  largest: {told}\n" in beside.read_text()
        assert sidecar.read(path).robot == "two_links"


def test_what_is_read_is_not_written_over(file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    robot, run = tmp_path / "trajectory.yaml", tmp_path / "run.csv"
    robot.write_text(file.read_text())
    run.write_text("t,qr1,qr2\n0,0,0\n0.1,0,0\n")
    before = robot.read_bytes(), run.read_bytes()
    for words in (
        ("simulate", robot, "--out", tmp_path / "trajectory.csv"),
        ("excite", robot, "--out", tmp_path),
        ("simulate", robot, "--trajectory", "played", "--set", f"file={run}", "--out", run),
    ):
        done = command(*words, capsys=capsys)
        assert done.status == 2
        assert "it would be written over" in done.err.splitlines()[-1]
        assert (robot.read_bytes(), run.read_bytes()) == before


#: What of the log changes with a section of signals.
CHANGED = {
    "position_offset: [2 deg, -1 deg]": "qm1",
    "torque_gain: [1.2, 0.9]": "i1",
    "torque_delay: [4 ms, -2.5 ms]": "i1",
    "link_delay: [3 ms, 1 ms]": "qs1",
    "warm_up_time: [3 s, 5 s]": "i1",
}


@pytest.mark.parametrize("signals", CHANGED)
def test_what_the_file_says_of_its_signals_is_in_the_log(
    signals: str, machine: Machine, file: Path, tmp_path: Path
) -> None:
    """Read with the same robot file, it is what the robot without that section logs."""
    path = tmp_path / "two_links.yaml"
    text = file.read_text().replace("parameters:", f"signals: {{{signals}}}\nparameters:", 1)
    if "warm" in signals:
        text = text.replace("drives:\n", "drives:\n  torque_drift: [-0.2, 0.1]\n")
    path.write_text(text)
    with compiled(read(path)) as made:
        run = simulate(made, SHORT)
    other = simulate(machine, SHORT)
    assert np.abs(run.columns[CHANGED[signals]] - other.columns[CHANGED[signals]]).max() > 0
    logged, expected = (
        load(str(save(one, "two_links", "", tmp_path / f"{k}.csv")[0]), robot)
        for k, (one, robot) in enumerate(((run, read(path)), (other, machine.robot)))
    )
    count = logged.samples
    first = round((logged.start - expected.start) / expected.period)
    inner = slice(20, count - 20)
    for mine, its in ((logged.q, expected.q), (logged.tau, expected.tau), (links(logged), links(expected))):
        its = its[:, first : first + count]
        assert mine[:, inner] == pytest.approx(its[:, inner], abs=2e-3 * np.ptp(its))


def links(run: Run) -> Array:
    return np.stack([run.others["qs1"], run.others["qs2"]])
