"""Designed motions of robots whose torques remember: states inside effects, and drives that warm up."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from generator.robot.readers import read
from identification.inverse_model import Options, identify
from identification.observation import Regressors
from identification.readers import csv
from identification.recipes import Recipe
from tests.commands import command
from tests.scattering import squares

Array = NDArray[np.float64]

#: A wheel whose dry friction is nearly all that its motor may supply.
WHEEL = """\
name: wheel
gravity: [0 m/s2, 0 m/s2, 0 m/s2]
joints:
  - {j: 1, sigma: 0, alpha: 0, d: 0, theta: q1, r: 0, limits: [-2 rad, 2 rad], torque_limit: 100 N m,
     speed_limit: 2 rad/s, acceleration_limit: 20 rad/s2}
effects:
  - {effect: viscous_friction, joints: all}
  - {effect: dahl_friction, joint: 1, values: {xs: 0.001 rad}}
"""
WARM = "  - {effect: warm_friction, joint: 1}\n"
SIGNALS = {
    "time": "signals: {warm_up_time: 20 s}\n",
    "heat": "signals: {warm_up_time: 20 s, warm_torque: 90 N m}\n",
}
CASES = [one if one == "heat" else pytest.param(one, marks=pytest.mark.long) for one in SIGNALS]
COLD = {"ZZ1": 5.0, "Fv1": 3.0, "Fd1": 85.0}
DRIFT = {"Fvw1": 2.0, "Fcw1": 10.0}
UNITS = {"ZZ1": "kg m2", "Fv1": "N m s/rad", "Fd1": "N m", "Fvw1": "N m s/rad", "Fcw1": "N m"}
NOISE = 2.0
WORDS = ("--evaluations", "400", "--periods", "3", "--noise", f"{NOISE:g}")


def designed(
    folder: Path, text: str, values: dict[str, float], rate: float, capsys: pytest.CaptureFixture[str]
) -> Path:
    path = folder / "wheel.yaml"
    stated = ", ".join(f"{name}: {value} {UNITS[name]}" for name, value in values.items())
    path.write_text(f"{text}parameters:\n  s: {{values: {{{stated}}}}}\n")
    words = (*WORDS, "--rate", f"{rate:g}")
    done = command("excite", path, "--parameters", "s", "--out", folder / "out", *words, capsys=capsys)
    assert (done.status, "identifiable" in done.out) == (0, False), done.err
    return path


def torques(folder: Path, values: dict[str, float], heats: bool) -> tuple[Array, Array, Array]:
    """Times, positions and torques of the run in a folder, one sample after the other."""
    columns = csv.read(folder / "out" / "trajectory.csv").columns
    t, q, qd = columns["t"], columns["qr1"], columns["qd1"]
    qdd, tau = np.gradient(qd, t), np.zeros(len(t))
    part = 1 - np.exp(-(t[1] - t[0]) / 20)
    z = w = 0.0
    for k in range(len(t)):
        if k:
            way = np.sign(q[k] - q[k - 1])
            z = way + (z - way) * np.exp(-abs(q[k] - q[k - 1]) / 0.001)
            w += part * (((tau[k - 1] / 90) ** 2 if heats else 1.0) - w)
        warm = (values.get("Fvw1", 0.0) * qd[k] + values.get("Fcw1", 0.0) * np.sign(qd[k])) * w
        tau[k] = values["ZZ1"] * qdd[k] + values["Fv1"] * qd[k] + values["Fd1"] * z + warm
    return t, q, tau


@pytest.mark.parametrize("warmed", [pytest.param("", marks=pytest.mark.long), *CASES])
def test_torques_with_their_past_are_within_the_limit(
    warmed: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text, values = (WHEEL + WARM + SIGNALS[warmed], COLD | DRIFT) if warmed else (WHEEL, COLD)
    designed(tmp_path, text, values, 200.0, capsys)
    _, _, tau = torques(tmp_path, values, warmed == "heat")
    load = json.loads((tmp_path / "out" / "excitation.json").read_text())["largest_load"]
    assert load == pytest.approx(np.abs(tau).max() / 100, rel=2e-3)
    assert 0.99 < load <= 1.0


@pytest.mark.parametrize("warmed", CASES)
def test_what_is_expected_of_torques_with_a_past_is_what_repeated_runs_show(
    warmed: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """As for torques without one: squared errors in units of the expected std are chi-squared numbers.

    At 40 Hz a row stands for few samples, so that its noise is the same at the ends of the run, where filters have no
    neighbours.
    """
    values, count = COLD | DRIFT, 25
    slow = WHEEL.replace("acceleration_limit: 20", "acceleration_limit: 2")
    path = designed(tmp_path, slow + WARM + SIGNALS[warmed], values, 40.0, capsys)
    t, q, tau = torques(tmp_path, values, warmed == "heat")
    robot, draw, errors = read(path), np.random.default_rng(3), []
    regressors = Regressors(robot)
    for seed in range(count):
        run = tmp_path / f"{seed}.csv"
        rows = np.column_stack([t, q, tau + draw.normal(0.0, NOISE, len(t))])
        np.savetxt(run, rows, delimiter=",", header="t,q1,tau1", comments="")
        found = identify(robot, [str(run)], [], Options(recipe=Recipe()), regressors).full.solution
        errors.append([found.values[name] - value for name, value in values.items()])
    expected = json.loads((tmp_path / "out" / "excitation.json").read_text())["expected"]
    std = np.array([expected[name]["std"] for name in values])
    squares(errors, std)


def test_a_warmth_that_nothing_tells_beforehand(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "wheel.yaml"
    stated = ", ".join(f"{name}: {value} {UNITS[name]}" for name, value in (COLD | DRIFT).items())
    path.write_text(f"{WHEEL}{WARM}signals: {{warm_rise: 30 K}}\nparameters:\n  s: {{values: {{{stated}}}}}\n")
    done = command("excite", path, "--parameters", "s", "--out", tmp_path / "out", *WORDS, capsys=capsys)
    told = "nothing says how warm the drive of joint 1 gets in a motion, on which torques depend"
    wanted = "expected warm_up_time in section signals of the robot file"
    assert (done.status, done.err.splitlines()[-1]) == (2, f"error: {path}:1:1: {told}, {wanted}")
