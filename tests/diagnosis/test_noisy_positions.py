"""What noise of positions takes of fitted values and of the noise that is measured is given back."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from generator.robot.description import ParameterSet, ParameterValue
from identification.diagnosis.candidates import elasticity
from identification.diagnosis.columns.bank import Bank
from identification.diagnosis.columns.normal_equations import Prior
from identification.diagnosis.noise.errors_in_variables import Redrawn, redrawn
from identification.diagnosis.noise.measured import colours
from identification.diagnosis.runs import stated_elasticity
from identification.diagnosis.runs.scene import Scene
from identification.diagnosis.search.weighing import Weighing
from tests.diagnosis.diagnosed import with_robot
from tests.diagnosis.diagnosed_arm import TRUTH, ready
from tests.diagnosis.sensed_arm import RATE, STEP, noisy, sensed

Array = NDArray[np.float64]

NOISE = 0.4


def held(rows: int) -> Callable[[Array], Array]:
    """A sensor that is read more slowly than the log is written."""
    return lambda q: np.repeat(q[::rows], rows)[: len(q)]


def banks(
    folder: Path,
    sensor: Callable[[Array], Array],
    slowest: float,
    stiffness: float | None = None,
    torques: float = NOISE,
) -> tuple[Bank, dict[int, Redrawn]]:
    """Two runs of the arm, beside the true model, whose file may call its drive train elastic, not yet white."""
    regressors, sources = sensed(folder, 2, torques, sensor, slowest)
    runs = [ready(source, regressors) for source in sources]
    scenes = [Scene(run.sampled, regressors, TRUTH) for run in runs]
    if stiffness is not None:
        robot = regressors.model.robot
        stiff = ParameterSet("stiff", "", "", {"k1": ParameterValue(stiffness, "N m/rad")})
        robot = replace(robot, flexible=(1,), parameter_sets={**robot.parameter_sets, "stiff": stiff})
        scenes = [with_robot(scene, robot) for scene in scenes]
    return Bank(runs, scenes), redrawn(runs, scenes)


def fitted(one: Bank, noise: dict[int, Redrawn]) -> tuple[dict[str, float], dict[str, float]]:
    """Values of the base columns by name, and their standard deviations."""
    one.whiten(colours(one, redrawn=noise))
    more = stated_elasticity.names(one.scenes[0].robot)
    p = len(one.base) - len(more)
    prior = Prior(np.zeros(p), np.zeros((p, p))).beside(list(map(stated_elasticity.precision, more)))
    values, covariance = Weighing(one, (0, 1), (), prior, noise).fitted([])
    return tuple(dict(zip(one.base, x.tolist(), strict=True)) for x in (values, np.sqrt(np.diag(covariance))))


def test_an_inertia_is_not_too_small_by_noise_of_accelerations(tmp_path: Path) -> None:
    one, noise = banks(tmp_path, noisy(STEP / 2), 0.04)
    plain, std = fitted(one, {})
    given_back, _ = fitted(one, noise)
    assert TRUTH["ZZ1"] - plain["ZZ1"] > 10 * std["ZZ1"]
    assert abs(TRUTH["ZZ1"] - given_back["ZZ1"]) < 0.3 * (TRUTH["ZZ1"] - plain["ZZ1"])


@pytest.mark.parametrize("rows", [2, 5, 8])
def test_positions_that_are_held_have_no_noise(rows: int, tmp_path: Path) -> None:
    one, noise = banks(tmp_path, held(rows), 0.2)
    plain, _ = fitted(one, {})
    given_back, _ = fitted(one, noise)
    assert given_back == pytest.approx(plain, rel=1e-3)


def test_noise_that_is_not_there_moves_no_value_far(tmp_path: Path) -> None:
    """A wrong estimate takes no more than the noise that there is."""
    one, _ = banks(tmp_path, noisy(STEP / 4), 0.2)
    wrong = {
        r: Redrawn(run, scene, np.array([1e-2]), r)
        for r, (run, scene) in enumerate(zip(one.runs, one.scenes, strict=True))
    }
    plain = colours(one)
    one.whiten(colours(one, redrawn=wrong))
    assert one.colours[0][0].deviations[-1] < 3 * plain[0][0].deviations[-1]
    moved, _ = Weighing(one, (0, 1), (), None, wrong).fitted([])
    assert dict(zip(one.base, moved, strict=True))["ZZ1"] == pytest.approx(TRUTH["ZZ1"], rel=0.1)


def test_positions_far_noisier_than_torques_leave_their_noise(tmp_path: Path) -> None:
    """A hundred times what the torques have; an elastic drive train would explain nearly all of it."""
    one, noise = banks(tmp_path, noisy(STEP), 0.2, torques=NOISE / 100)
    (hypothesis,) = elasticity.hypotheses(one.scenes)
    for shape in hypothesis.variants:
        one.add(hypothesis, shape)
    one.whiten(colours(one, redrawn=noise))
    white = one.colours[0][0].white(noise[0].torque, one.runs[0].kept[0])
    assert white.std() == pytest.approx(1.0, rel=0.3)


def test_a_stated_drive_train_is_not_elastic_by_noise(tmp_path: Path) -> None:
    one, noise = banks(tmp_path, noisy(STEP / 4), 0.2, stiffness=2e4)
    plain, std = fitted(one, {})
    given_back, _ = fitted(one, noise)
    together = stated_elasticity.TOGETHER
    assert plain[together] > 10 * std[together]
    assert abs(given_back[together]) < 0.2 * plain[together]


@pytest.mark.parametrize("stiffness", [8e3, 2e4])
def test_a_stated_drive_train_stays_elastic_beside_noise(stiffness: float, tmp_path: Path) -> None:
    true, _ = banks(tmp_path, noisy(0.0), 0.2, stiffness)
    one, _ = banks(tmp_path, noisy(STEP / 2), 0.2, stiffness)
    at = one.base.index(stated_elasticity.TOGETHER)
    runs, scenes = [], []
    for r, (run, scene) in enumerate(zip(one.runs, one.scenes, strict=True)):
        elastic = Scene(run.sampled, scene.regressors, {**TRUTH, stated_elasticity.TOGETHER: 1.0})
        runs.append(replace(run, tau=run.tau + true.columns(r, 0, [at])))
        scenes.append(with_robot(elastic, scene.robot))
    values, std = fitted(Bank(runs, scenes), redrawn(runs, scenes))
    assert values[stated_elasticity.TOGETHER] == pytest.approx(1.0, abs=max(0.15, 4 * std[stated_elasticity.TOGETHER]))


def test_columns_that_hold_the_noise_of_positions_leave_it_in_the_noise(tmp_path: Path) -> None:
    one, noise = banks(tmp_path, noisy(STEP / 4), 0.07)
    exact, _ = banks(tmp_path, noisy(0.0), 0.07)
    for bank in (one, exact):
        (hypothesis,) = elasticity.hypotheses(bank.scenes)
        for shape in hypothesis.variants:
            bank.add(hypothesis, shape)
    taken, left, less = (
        bank_colours[0][0].spectrum(np.array([20.0]), RATE / 10)[0]
        for bank_colours in (colours(one), colours(one, redrawn=noise), colours(exact))
    )
    assert taken < 0.7 * left
    assert less < left
