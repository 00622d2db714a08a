"""Simulated runs with a payload and with drives that warm up: what is logged and what is read back."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from generator.robot.readers import read
from identification.corrections import TooWarm
from identification.dataset import load
from identification.inverse_model import Options, identify
from identification.observation import Regressors
from identification.recipes import Recipe
from identification.sidecar import Payload
from identification.simulation.machine import Machine, compiled
from identification.simulation.run_file import save
from identification.simulation.settings import Settings
from identification.simulation.simulate import simulate
from tests.commands import command
from tests.recorded import TRUTH
from tests.simulated_runs import columns, motors

SHORT = Settings(duration=4.0)


@pytest.mark.parametrize("flexible", [False, True])
def test_a_payload_weighs_what_it_weighs(machine: Machine, flexible: bool) -> None:
    """By hand: 5 kg, their centre 0.06 m beyond the tool, on links of 0.5 m and 0.4 m in a vertical plane."""
    pose = (0.3, 0.5)
    loaded = replace(SHORT, flexible=flexible, pose=pose, payload=Payload("L", {"M": 5.0, "MX": 0.3}), duration=1.0)
    still = replace(loaded, trajectory="point_to_point", trajectory_settings={"pause": 10.0}, duration=8.0)
    torque = [motors(simulate(machine, one))[1][-1] for one in (still, replace(still, payload=None))]
    first, both = np.cos(0.3), np.cos(0.3 + 0.5)
    wanted = 9.81 * 5.0 * np.array([0.5 * first + 0.46 * both, 0.46 * both])
    # The motors stand within their dry friction, and the links hang on springs of 4e4 and 1.5e4 N m/rad.
    assert torque[0] - torque[1] == pytest.approx(wanted, rel=0.02 if flexible else 1e-6)


def test_identification_reads_the_payload_from_the_sidecar(machine: Machine, tmp_path: Path) -> None:
    payload = Payload("L", {"M": 5.0, "MX": 0.3, "XX": 0.085, "YY": 0.025, "ZZ": 0.1})
    run = simulate(machine, replace(SHORT, duration=20.0, rate=500.0, noise=(0.05, 0.08), payload=payload))
    path, beside = save(run, "two_links", machine.robot.digest, tmp_path / "a.csv")
    for line in ("payload:", "  name: L", "  M: 5 kg", "  MX: 0.3 kg m", "  XZ: 0 kg m2", "  ZZ: 0.1 kg m2"):
        assert line in beside.read_text().splitlines()
    assert "    ZZ2: 1.3" in beside.read_text().splitlines()
    found = identify(machine.robot, [str(path)], [], Options(recipe=Recipe()), Regressors(machine.robot)).full
    errors = [(found.solution.values[name] - TRUTH[name]) / found.solution.std(name) for name in TRUTH]
    assert np.abs(errors).max() < 4.5
    assert np.sqrt(np.mean(np.square(errors))) < 1.8


def test_temperatures_tell_the_warmth(machine: Machine, tmp_path: Path) -> None:
    warming = replace(SHORT, further=("temp",), warm_up=1.5, temperature=300.0, rise=20.0)
    cold = simulate(machine, SHORT)
    warm = simulate(machine, replace(warming, constant_drift=-0.2))
    path, _ = save(warm, "two_links", machine.robot.digest, tmp_path / "a.csv")
    others = load(str(path), machine.robot).others
    warmth = (others["temp1"] - 300.0) / 20.0
    assert warmth == pytest.approx(1 - np.exp(-warm.columns["t"] / 1.5), abs=1e-9)
    assert (others["temp2"] == others["temp1"]).all()
    assert columns(warm, "i") * (1 - 0.2 * warmth)[:, None] == pytest.approx(columns(cold, "i"), abs=1e-8)
    even = simulate(machine, replace(warming, warm_up=None)).columns
    assert even["temp1"] == pytest.approx(300.0 + 20.0 * even["t"] / 4.0)


def test_the_warmth_that_drove_a_run_is_the_one_that_is_read(file: Path, machine: Machine, tmp_path: Path) -> None:
    """A robot file with the drift of the torque constants takes it out again, by the temperatures."""
    text = file.read_text().replace(
        "use: warm, warm: [0.5, 0.4]}", "use: warm, warm: [0.5, 0.4]}\n  torque_drift: [-1/5, -1/5]"
    )
    drifting = tmp_path / "drifting.yaml"
    drifting.write_text(text + "signals: {warm_rise: 20 K}\n")
    settings = replace(SHORT, further=("temp",), warm_up=1.5, rise=20.0)
    runs = []
    for name, drift in (("cold", 0.0), ("warm", -0.2)):
        made = simulate(machine, replace(settings, constant_drift=drift))
        runs.append(save(made, "two_links", machine.robot.digest, tmp_path / f"{name}.csv")[0])
    assert load(str(runs[1]), read(drifting)).tau == pytest.approx(load(str(runs[0]), machine.robot).tau, abs=1e-7)


def drifting_by_heat(file: Path, folder: Path, usual: float) -> Path:
    """The robot whose torque constants are a fifth lower after the motors' ``usual`` torque, in parts of a high one."""
    text = file.read_text().replace(
        "use: warm, warm: [0.5, 0.4]}", "use: warm, warm: [0.5, 0.4]}\n  torque_drift: [-1/5, -1/5]"
    )
    drifting = folder / "drifting.yaml"
    warm = f"warm_torque: [{1.5 * usual} N m, {0.4 * usual} N m]"
    drifting.write_text(f"{text}signals: {{warm_up_time: 1.5 s, {warm}}}\n")
    return drifting


@pytest.mark.parametrize(
    ("beside", "usual", "warmest"),
    [
        pytest.param(0.0, 1.0, 1.0, marks=pytest.mark.long),
        (-0.2, 1.0, 1.0),
        pytest.param(0.0, 0.87, 2.2, marks=pytest.mark.long),
    ],
)
def test_a_drift_by_the_motors_heat_is_taken_out_as_it_was_recorded(
    beside: float, usual: float, warmest: float, machine: Machine, file: Path, tmp_path: Path
) -> None:
    """Another drift ``beside`` it, of which the file knows nothing, stays in the torques."""
    settings = replace(SHORT, warm_up=1.5)
    taus = []
    with compiled(read(drifting_by_heat(file, tmp_path, usual))) as drifting:
        for of, constant in ((machine, 0.0), (drifting, beside)):
            made = simulate(of, replace(settings, constant_drift=constant))
            path, _ = save(made, "two_links", of.robot.digest, tmp_path / f"{len(taus)}.csv")
            run = load(str(path), of.robot)
            taus.append(run.tau)
    assert run.warmth is not None
    assert run.warmth.max() > warmest
    known = 1 + beside * (1 - np.exp(-run.elapsed / 1.5))
    assert taus[1] * known == pytest.approx(taus[0], abs=1e-7)


def test_motors_that_heat_until_they_have_no_torque_constant_are_refused(file: Path, tmp_path: Path) -> None:
    drifting = drifting_by_heat(file, tmp_path, 0.3)
    with (
        compiled(read(drifting)) as of,
        pytest.raises(TooWarm, match=r"drifting\.yaml:1:1: the drive of joint 1 comes"),
    ):
        simulate(of, replace(SHORT, warm_up=1.5))


REFUSED = {
    ("--payload", "M=-1"): "--payload:1:1: M=-1, expected a number that is not negative",
    ("--payload", "M=1e-300", "MX=1e10"): "--payload:1:1: a mass of 1e-300 kg, expected one that its first moments do",
    ("--payload", "M=0"): "--payload:1:1: a mass of 0 kg, expected M=MASS above 0 in kg",
    ("--payload", "MX=1"): "--payload:1:1: a mass of 0 kg, expected M=MASS above 0 in kg",
    ("--payload", "weight=3"): "--payload:1:1: payload value 'weight=3', expected NAME=VALUE with one of ",
    ("--payload", "M=2", "MX=1", "YY=0.1"): "--payload:1:1: inertias that are too small for its moments, ",
    ("--payload", "M=2", "XX=3", "YY=1", "ZZ=1"): "--payload:1:1: inertias that are too small for its moments, ",
    ("--warm-up", "0"): "--warm-up:1:1: 0, expected a number above 1e-09",
    ("--temperature", "-5"): "--temperature:1:1: -5, expected a number above 0",
    ("--temperature-rise", "nan"): "--temperature-rise:1:1: nan, expected a number that is not negative",
}


@pytest.mark.parametrize("words", REFUSED, ids=" ".join)
def test_bad_conditions_are_refused(
    words: tuple[str, ...], file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    done = command("simulate", file, "--out", tmp_path / "a.csv", *words, capsys=capsys)
    assert done.status == 2
    assert done.err.splitlines()[-1].startswith(f"error: {REFUSED[words]}")
    assert not list(tmp_path.iterdir())


LINES = {
    "t,q1,q2,i1,i2,temp1\n0,0,0,1,2,300\n0.1,0,0,1,3,warm\n": "a.csv:3:13: temp1 is 'warm', expected a number",
    "t,q1,q2,i1,i2,temp1\n0,0,0,1,2,300\n0.1,0,0,1,3,nan\n0.2,0,0,1,3,300\n": "a.csv:3:13: temp1 is nan",
}


@pytest.mark.parametrize("text", LINES)
def test_a_temperature_that_is_none_is_refused(
    text: str, file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    run = tmp_path / "a.csv"
    run.write_text(text)
    done = command("identify", file, "--data", run, "--out", tmp_path / "out", capsys=capsys)
    assert done.status == 2
    assert LINES[text] in done.err.splitlines()[-1]
    assert not (tmp_path / "out").exists()
