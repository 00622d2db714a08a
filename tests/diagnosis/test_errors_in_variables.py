"""Noise of positions makes an elastic drive train appear that is not there: as much of it as is told."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import cast

import numpy as np
import pytest
from numpy.typing import NDArray

from identification.diagnosis.candidates import elasticity
from identification.diagnosis.columns.bank import Bank
from identification.diagnosis.columns.hypothesis import Coefficient, Hypothesis
from identification.diagnosis.columns.normal_equations import directions
from identification.diagnosis.command import Request
from identification.diagnosis.diagnosis import NOTHING
from identification.diagnosis.noise.clear_directions import clear
from identification.diagnosis.noise.errors_in_variables import Pretence, Redrawn, redrawn
from identification.diagnosis.noise.measured import colours
from identification.diagnosis.runs.scene import Scene
from identification.diagnosis.search.weighing import Weighing
from identification.resolution import steps
from tests.diagnosis.diagnosed_arm import TRUTH, answered, ready
from tests.diagnosis.sensed_arm import FINE, STEP, noisy, rounded, sensed
from tests.matrices import WHITE

Array = NDArray[np.float64]


def test_steps_are_found_where_the_smallest_difference_is_of_several() -> None:
    number = np.cumsum(np.random.default_rng(2).integers(3, 40, 2000))
    assert steps(STEP * number[None]) == pytest.approx([STEP], rel=1e-9)


def alone(folder: Path, step: float, count: int = 1) -> Bank:
    """Runs without noise, beside the true model."""
    regressors, sources = sensed(folder, count, 0.0, rounded(step))
    runs = [ready(source, regressors) for source in sources]
    return Bank(runs, [Scene(run.sampled, regressors, TRUTH) for run in runs])


def pretence_of(bank: Bank) -> Pretence:
    """What rounding pretends along all runs, beside the model's columns."""
    p = len(bank.base)
    products = np.sum([bank.grams[r] for r in range(len(bank.runs))], axis=0)[:p, :p]
    return Pretence(bank, redrawn(bank.runs, bank.scenes), products)


def test_the_products_that_rounding_makes_are_as_large_as_told(tmp_path: Path) -> None:
    (hypothesis,) = elasticity.hypotheses(alone(tmp_path, FINE).scenes)
    several = alone(tmp_path, 4 * STEP, 4)
    variants = [each for shape in hypothesis.variants if (each := several.add(hypothesis, shape)) is not None]
    several.whiten([[WHITE]] * 4)
    pretence = pretence_of(several)
    true = {several.base.index(name): value for name, value in TRUTH.items()}
    assert variants
    for variant in variants:
        product = 0.0
        for r in range(4):
            numbers, rows = several.white(r, 0)
            product += float(rows[numbers.index(variant.columns[0])] @ several.residual(r, 0, true))
        assert pretence.of(variant)[0] == pytest.approx(product, rel=0.3)


def test_what_the_model_explains_of_a_column_pretends_nothing(tmp_path: Path) -> None:
    """The model's columns are of the same rounded positions."""

    def columns(scene: Scene, shape: Mapping[str, float]) -> Array:
        return scene.torque_of(TRUTH, scene.motion)[None]

    one = alone(tmp_path, 4 * STEP)
    variant = one.add(Hypothesis("gain", "gain", 1, (Coefficient("c", "1"),), columns), {})
    assert variant is not None
    one.whiten([[WHITE]])
    weighing = Weighing(one, (0,), (), None, redrawn(one.runs, one.scenes))
    assert abs(pretence_of(one).of(variant)[0]) > 400
    assert abs(weighing.pretended(variant, [])[0]) < 1


def test_rounding_tells_nothing_along_directions_that_are_rounding_themselves() -> None:
    """Of one column a thousandth part is noise, of the other there is more noise than anything."""
    rows = np.random.default_rng(1).normal(size=(2, 4000)) / np.sqrt(4000)
    noise = np.sqrt([[0.001], [2.0]]) * rows
    np.testing.assert_array_equal(clear(np.eye(2), [(np.array([0, 1]), noise)]), [[1.0], [0.0]])


class Drowned:
    """Noise of positions that makes more of one combination of the model's columns than the motion does, and as much
    of the torque as it has noise.
    """

    def __init__(self, bank: Bank, deviation: float) -> None:
        numbers, columns, tau, kept = bank.raw(0, 0)
        base = [i for i, number in enumerate(numbers) if number < len(bank.base)]
        rows = columns[base] * kept
        products = rows @ rows.T
        noise = deviation * np.random.default_rng(3).normal(size=len(tau))
        self.torque = noise[None]
        self._base = [numbers[i] for i in base], np.outer(products @ directions(products)[:, 0], noise)

    def base(self, *about: object) -> tuple[list[int], Array]:
        return self._base

    def of(self, *about: object) -> Array:
        raise AssertionError("no variant is in the bank")


def test_what_drowns_a_direction_does_not_swell_the_noise(tmp_path: Path) -> None:
    noise = 0.4
    regressors, (source,) = sensed(tmp_path, 1, noise, rounded(FINE))
    run = ready(source, regressors)
    bank = Bank([run], [Scene(run.sampled, regressors, TRUTH)])
    ((exact,),) = colours(bank)
    drowned = cast("Mapping[int, Redrawn]", {0: Drowned(bank, exact.deviations[0])})
    ((told,),) = colours(bank, redrawn=drowned)
    assert told.deviations[0] == pytest.approx(exact.deviations[0], rel=0.1)


@pytest.mark.parametrize(("deviation", "told"), [(0.01, True), (1.0, False)])
def test_what_drowns_a_direction_pretends_no_parameter(deviation: float, told: bool, tmp_path: Path) -> None:
    regressors, (source,) = sensed(tmp_path, 1, 0.4, rounded(FINE))
    run = ready(source, regressors)
    bank = Bank([run], [Scene(run.sampled, regressors, TRUTH)])
    bank.whiten([[WHITE]])
    p = len(bank.base)
    drowned = cast("Mapping[int, Redrawn]", {0: Drowned(bank, deviation)})
    pretended = Pretence(bank, drowned, bank.grams[0][:p, :p]).base
    assert (np.linalg.norm(pretended) > 1e-6) == told


def test_fine_positions_pretend_nothing(tmp_path: Path) -> None:
    one = alone(tmp_path, FINE)
    (hypothesis,) = elasticity.hypotheses(one.scenes)
    variant = one.add(hypothesis, hypothesis.variants[0])
    assert variant is not None
    one.whiten([[WHITE]])
    assert not pretence_of(one).of(variant).any()


@pytest.mark.parametrize(
    ("sensor", "noise", "slowest"),
    [
        (rounded(STEP), 0.4, 0.2),
        pytest.param(rounded(2 * STEP), 1.0, 0.2, marks=pytest.mark.long),
        pytest.param(noisy(STEP / 4), 0.4, 0.2, marks=pytest.mark.long),
        pytest.param(noisy(STEP / 4), 0.4, 0.07, marks=pytest.mark.long),
        pytest.param(noisy(STEP / 2), 0.4, 0.07, marks=pytest.mark.long),
    ],
)
def test_an_arm_with_an_ordinary_encoder_is_not_called_elastic(
    sensor: Callable[[Array], Array], noise: float, slowest: float, tmp_path: Path
) -> None:
    _, sources = sensed(tmp_path, 3, noise, sensor, slowest)
    path = tmp_path / "arm.yaml"
    found, _ = answered(path, Request(sources), tmp_path / "out")
    assert (found.verdict, found.findings) == (NOTHING, ())
