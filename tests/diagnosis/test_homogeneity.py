"""Whether runs agree on the amplitude of what was found, on matrices."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from identification.diagnosis.search.loop import Search
from identification.diagnosis.search.selection import Choice
from identification.diagnosis.search.weighing import Weighing
from identification.diagnosis.verdict.homogeneity import ALONG, BETWEEN, disagreements
from tests.matrices import bank, hypothesis, run, whitened

Array = NDArray[np.float64]

RUNS, PERIODS, ROWS = 3, 3, 400


def found(amplitudes: Array, repeats: bool = True) -> Search:
    """A search that took one effect, of these amplitudes by run and period, beside three base columns and noise."""
    draw = np.random.default_rng(5)
    W, column = (np.tile(draw.normal(size=(RUNS, k, ROWS)), PERIODS) for k in (3, 1))
    tau = np.array([3.0, -1.0, 0.5]) @ W + np.repeat(amplitudes, ROWS, axis=-1) * column[:, 0]
    tau += draw.normal(size=tau.shape)
    one = bank([run(w, y, period=ROWS if repeats else 0) for w, y in zip(W, tau, strict=True)])
    variant = one.add(hypothesis("right", lambda r, shape: column[r, 0]), {})
    weighing = Weighing(whitened(one), range(RUNS), (), None)
    assert variant is not None
    train = tuple(range(RUNS))
    return Search(one, weighing, (Choice(weighing.of(variant, [])),), {}, np.zeros((0, 0)), (), train, (), ())


SAME = np.full((RUNS, PERIODS), 0.5)


def test_one_amplitude_is_one() -> None:
    assert disagreements(found(SAME)) == {}


def test_laws_may_wander() -> None:
    assert disagreements(found(SAME * [0.9, 1.0, 1.1])) == {}


def test_runs_that_disagree_are_told() -> None:
    assert disagreements(found(SAME * [[1.8], [0.2], [1.0]])) == {("right", 1): BETWEEN}


def test_what_grows_in_every_run_is_told() -> None:
    assert disagreements(found(SAME * [0.4, 1.0, 1.6])) == {("right", 1): ALONG}


def test_a_beginning_and_an_end_that_differ_are_told_where_neither_is_far_from_the_mean() -> None:
    assert disagreements(found(0.36 * SAME * [0.3, 1.0, 1.7])) == {("right", 1): ALONG}


def test_where_nothing_repeats_only_runs_are_compared() -> None:
    assert disagreements(found(SAME * [0.4, 1.0, 1.6], repeats=False)) == {}


@pytest.mark.parametrize("amplitude", [0.02, 0.0])
def test_what_is_within_the_noise_tells_nothing(amplitude: float) -> None:
    assert disagreements(found(SAME * amplitude * np.array([0.0, 1.0, 2.0]))) == {}
