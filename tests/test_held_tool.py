"""Simulated runs with a held tool and a noisy wrench: statics of their own say what must come."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from generator.resources import find_robot
from generator.robot.readers import read
from identification.force_steps import force_steps
from identification.signals import WRENCH
from identification.simulation.machine import Machine, compiled
from identification.simulation.run_file import save
from identification.simulation.settings import Settings
from identification.simulation.simulate import Simulated, noisy, simulate
from tests.newton_euler import Arm

SETTINGS = Settings(
    trajectory="force_steps",
    trajectory_settings={"steps": 3.0, "force": 4000.0},
    flexible=True,
    pose=(0.1, -1.3, 1.1, 1.2, 1.1, 0.3),
    duration=20.0,
    log_rate=200.0,
    further=("qs",),
    resolution=(1e-4,),
)


@pytest.fixture(scope="module")
def pressed() -> Iterator[tuple[Machine, Simulated]]:
    with compiled(read(find_robot("kr500"))) as made:
        yield made, simulate(made, SETTINGS)


def columns(run: Simulated, stem: str) -> np.ndarray:
    return np.stack([run.columns[f"{stem}{j}"] for j in range(1, 7)], axis=1)


def test_the_wrench_balances_the_arm_and_leaves_the_wrist_free(pressed: tuple[Machine, Simulated]) -> None:
    """Torques of the wrench by the tests' Newton-Euler: what the drive trains gained, nothing on axes 4 to 6."""
    machine, run = pressed
    drives = machine.robot.drives
    assert drives is not None
    coupling = np.array([[float(x) for x in row] for row in drives.coupling])
    q, links = columns(run, "qm") @ np.linalg.inv(coupling).T, columns(run, "qs")
    assert np.ptp(links[:, :3], axis=0).max() < 1e-12
    k = np.array([run.parameters[f"k{j}"] for j in (1, 2, 3)])
    arm, still = Arm(machine.robot, {}), np.zeros(6)
    peak = int(np.argmax(run.columns["fz"]))
    wrench = tuple(float(run.columns[name][peak]) for name in WRENCH)
    assert wrench[2] == pytest.approx(4000.0, rel=0.05)
    torques = arm.torques(links[peak], still, still, weight=False, wrench=wrench)
    gained = k * (q[peak] - q[0])[:3]
    assert torques[:3] == pytest.approx(gained, abs=0.02 * np.abs(gained).max())
    assert np.abs(torques[3:]).max() < 1e-6 * np.abs(gained).max()


def test_the_wrist_turns_against_the_arms_twist(pressed: tuple[Machine, Simulated]) -> None:
    """Report section 4.2, for a wrist that is turned: the tool, as the motors have it, keeps its orientation."""
    machine, run = pressed
    drives = machine.robot.drives
    assert drives is not None
    coupling = np.array([[float(x) for x in row] for row in drives.coupling])
    q = columns(run, "qm") @ np.linalg.inv(coupling).T
    model = machine.module.Robot("twin_flexible")
    peak = int(np.argmax(run.columns["fz"]))
    assert np.abs(q[peak] - q[0]).max() > 3e-4
    turn = model.tool_transform(q[peak])[:3, :3] @ model.tool_transform(q[0])[:3, :3].T
    assert np.abs(turn - np.eye(3)).max() < 0.05 * np.abs(q[peak] - q[0]).max()


def test_stiffness_and_torque_constants_come_back(pressed: tuple[Machine, Simulated], tmp_path: Path) -> None:
    machine, run = pressed
    wanted = {name: value for name, value in run.parameters.items() if name[:-1] in ("k", "kt")}
    made = noisy(run, (0.5,), (50.0, 15.0), seed=3)
    path, _ = save(made, machine.robot.name, machine.robot.digest, tmp_path / "a.csv")
    found = force_steps(machine.robot, [str(path)], run.parameters)
    assert {"k1", "k2", "k3"} <= set(found.stiffness)
    assert {"kt1", "kt2", "kt3"} <= set(found.constants)
    for name, one in {**found.stiffness, **found.constants}.items():
        if name[-1] in "123":
            assert one.value == pytest.approx(wanted[name], abs=4 * one.std, rel=5e-3), name
            assert one.std < 0.1 * wanted[name]
        else:
            assert one.value is None, name


def test_noise_added_later_is_the_noise_of_a_simulation(pressed: tuple[Machine, Simulated]) -> None:
    machine, _ = pressed
    short = replace(SETTINGS, duration=1.0)
    wanted = simulate(machine, replace(short, noise=(0.5,), wrench_noise=(50.0, 15.0), noise_seed=3))
    found = noisy(simulate(machine, short), (0.5,), (50.0, 15.0), seed=3)
    assert list(found.columns) == list(wanted.columns)
    for name, values in wanted.columns.items():
        np.testing.assert_array_equal(found.columns[name], values)
    assert found.settings == wanted.settings
    quiet = simulate(machine, short).columns
    rms = {name: float(np.std(found.columns[name] - quiet[name])) for name in ("i2", "fx", "mz")}
    assert rms == pytest.approx({"i2": 0.5, "fx": 50.0, "mz": 15.0}, rel=0.25)
    with pytest.raises(ValueError, match="has its noise already"):
        noisy(found, (0.5,))
