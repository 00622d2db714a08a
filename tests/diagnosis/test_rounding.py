"""Recorded positions in steps: what rounding makes of torques is noise, also where every period has it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from generator.errors import Place
from generator.resources import find_robot
from generator.robot.readers import read
from identification import recipes
from identification.dataset import Run, load
from identification.diagnosis.noise.measured import colours
from identification.diagnosis.noise.rounding import deviations, rounding
from identification.diagnosis.runs.prepared import prepared
from identification.diagnosis.runs.scene import Scene
from identification.diagnosis.verdict.lack_of_fit import lack_of_fit
from identification.drive_train import coupling
from identification.observation import Regressors
from identification.resolution import steps
from tests.diagnosis.diagnosed import known
from tests.matrices import bank, run
from tests.plant.measurement import Sensors
from tests.plant.robots import ROBOTS
from tests.plant.run import write_csv
from tests.plant.simulate import make_run
from tests.plant.trajectories.fourier import fourier

ARM, STEP = "three_axis", 1e-4


def test_steps_are_found_where_there_are_any() -> None:
    t = np.linspace(0, 10, 5000)
    smooth = np.sin(t)
    ratio = np.pi / 1234.5
    q = np.stack([smooth, STEP * np.round(smooth / STEP), ratio * np.round(smooth / ratio), np.zeros_like(t)])
    assert steps(q) == pytest.approx([0.0, STEP, ratio, 0.0], rel=1e-6)


def test_steps_are_found_where_all_samples_that_follow_each_other_are_many_apart() -> None:
    """Of a motor that turns back at once."""
    step, t = 2 * np.pi / 32768, np.arange(0, 30, 0.004)
    q = 40 * np.abs(t % 2 - 1) + 0.5 * np.sin(1.7 * t)
    rounded = step * np.round(q / step)
    assert np.abs(np.diff(rounded)).min() > 100 * step
    assert steps(np.stack([q, rounded, np.round(q, 3)])) == pytest.approx([0.0, step, 1e-3], rel=1e-6)


def test_no_steps_are_found_in_what_samples_far_from_zero_are_told_to() -> None:
    """Sorted ones are closer than their arithmetic."""
    noise = np.random.default_rng(0).random(200000)
    assert steps((1e6 + 3e-4 * noise)[None]).tolist() == [0.0]


@pytest.mark.parametrize("name", ["kr500", "tx40"])
def test_motors_take_the_steps_that_coupled_joints_do_not(name: str) -> None:
    """A wrist's joint is a sum of rounded positions, each with steps of its own."""
    robot = read(find_robot(name))
    t = np.arange(0, 10, 0.004)
    q = np.stack([np.sin(0.7 * t + k) + 0.3 * np.sin(1.9 * t) for k in range(6)])
    N = coupling(robot)
    step = 2 * np.pi / 4096
    rounded = np.linalg.solve(N, step * np.round(N @ q / step))
    said = deviations(Run(name, Place(name), 0.0, 0.004, rounded, np.zeros_like(q)), robot)
    assert steps(rounded)[5] < 0.1 * said[5]
    np.testing.assert_allclose(said, np.std(rounded - q, axis=1), rtol=0.05)
    assert not deviations(Run(name, Place(name), 0.0, 0.004, q, np.zeros_like(q)), robot).any()
    logged = Run(name, Place(name), 0.0, 0.004, np.round(q, 4), np.zeros_like(q))
    np.testing.assert_allclose(deviations(logged, robot), np.std(logged.q - q, axis=1), rtol=0.05)


def rounded_run(folder: Path, decimals: int, periods: int) -> tuple[Any, Scene]:
    """A run of the arm without any noise whose positions are rounded, and the scene of the true model."""
    robot = known(ROBOTS[ARM], folder)
    one = make_run(ROBOTS[ARM], fourier(3, period=5.0, periods=periods), sensors=Sensors(noise=0.0, quantised=False))
    path = folder / f"{decimals}.csv"
    write_csv(one, path, position="q", effort="tau")
    head = path.read_text().splitlines()[0]
    values = np.loadtxt(path, delimiter=",", skiprows=1)
    values[:, 1:4] = np.round(values[:, 1:4], decimals)
    np.savetxt(path, values, fmt="%.12g", delimiter=",", header=head, comments="")
    recipe = recipes.recipe_of(ARM)
    description = read(folder / f"{ARM}.yaml")
    ready = prepared(load(str(path), description, recipe.columns), recipe, Regressors(description))
    return ready, Scene(ready.sampled, robot.regressors, robot.values)


def test_rounding_of_the_log_is_as_large_as_it_says(tmp_path: Path) -> None:
    fine, true = rounded_run(tmp_path, 10, 3)
    coarse, scene = rounded_run(tmp_path, 4, 3)
    said = rounding(coarse, scene)
    made = coarse.decimated(scene.model_torque) - fine.decimated(true.model_torque)
    for k in range(3):
        assert np.std(said[k]) == pytest.approx(np.sqrt(2) * np.std(made[k]), rel=0.25)
    assert np.max(np.abs(rounding(fine, true))) < 1e-3 * np.max(np.abs(said))


def test_nothing_repeats_in_a_run_of_one_period(tmp_path: Path) -> None:
    ready, scene = rounded_run(tmp_path, 4, 1)
    assert not rounding(ready, scene).any()


def test_what_periods_have_in_common_by_rounding_is_noise_and_lacks_nothing() -> None:
    draw = np.random.default_rng(3)
    period, times = 500, 6
    base = np.ones((1, period * times))
    same = np.tile(2.0 * draw.normal(size=period), times)
    tau = base[0] + same + draw.normal(size=period * times)
    ready = [run(base, tau, period=period)]
    ready[0].unsettled = np.zeros_like(ready[0].kept)
    # As noise that the periods do not have in common would be.
    drawn = np.sqrt(times) * 2.0 * draw.normal(size=(1, period * times))
    (plain,), (known_,) = colours(bank(ready)), colours(bank(ready), [drawn])
    power = 1.0 + 4.0 * times
    assert plain[0].deviations[0] == pytest.approx(1.0, rel=0.1)
    assert known_[0].deviations[0] == pytest.approx(np.sqrt(power), rel=0.1)
    left = [known_[0].white((tau - base[0])[None], ready[0].kept[0])[0]]
    assert lack_of_fit(ready, left, 0, 1).size == pytest.approx(2.0, rel=0.15)
    assert lack_of_fit(ready, left, 0, 1, rounded=(power - 1) / power).size < 0.2
