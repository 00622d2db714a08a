"""Values that runs tell twice, by the size of a torque and by its form, or that another fit tells beside the torque."""

from __future__ import annotations

from collections.abc import Mapping
from math import hypot
from typing import Any

import numpy as np
import pytest

from identification.diagnosis.columns.hypothesis import ELASTIC, Coefficient, Hypothesis, ShapeRange
from identification.diagnosis.verdict.finding import Finding, Told
from identification.diagnosis.verdict.shape_uncertainty import apart, variances
from identification.outcome import Value

#: What the model of a swing is not sure of.
LINEAR = 0.01
#: Deviation of a damping ratio of 0.1 that the noise alone would let be known to a tenth.
DAMPING = pytest.approx(hypot(0.01, LINEAR * 0.1))


def told(
    value: float, twice: Mapping[str, tuple[str, int]], vague: float = 1.0
) -> tuple[dict[str, Value], dict[str, float]]:
    """Of a compliance of ``value`` and a stiffness of 1000, both known to a part in a thousand by the noise alone, or
    the stiffness to ``vague``.
    """
    values = {"compliance1": Value(value, 1e-3 * value, "rad/(N m)")}
    return apart(_hypothesis(twice), values, {"k": 1000.0, "damping": 0.1}, {"k": vague, "damping": 0.01})


def _hypothesis(twice: Mapping[str, tuple[str, int]]) -> Hypothesis:
    compliance = Coefficient("compliance1", "rad/(N m)")
    return Hypothesis("x", "x", 1, (compliance,), lambda *_: np.zeros((1, 1, 1)), twice=twice, kind=ELASTIC)


def test_what_is_told_twice_is_as_uncertain_as_it_is_apart() -> None:
    values, shape = told(1.02e-3, {"compliance1": ("k", -1)})
    assert values["compliance1"].value == 1.02e-3
    assert values["compliance1"].std == pytest.approx(0.02 * 1.02e-3, rel=0.02)
    assert shape == {"k": pytest.approx(20.0, rel=0.02), "damping": DAMPING}


def test_where_both_agree_the_noise_decides() -> None:
    values, shape = told(1.0001e-3, {"compliance1": ("k", -1)})
    assert values["compliance1"].std == pytest.approx(hypot(1.0001e-6, LINEAR * 1.0001e-3))
    assert shape == {"k": pytest.approx(hypot(1.0, LINEAR * 1000.0)), "damping": DAMPING}


def test_what_is_known_well_stays_beside_what_is_not() -> None:
    for vague in (30.0, np.inf):
        values, shape = told(1.02e-3, {"compliance1": ("k", -1)}, vague)
        assert values["compliance1"].std == pytest.approx(hypot(1.02e-6, LINEAR * 1.02e-3))
        assert shape["k"] == pytest.approx(hypot(vague, LINEAR * 1000.0))


@pytest.mark.parametrize(("value", "twice"), [(1.02e-3, {}), (0.0, {"compliance1": ("k", -1)})])
def test_what_is_told_once_or_at_its_bound_stays(value: float, twice: Mapping[str, tuple[str, int]]) -> None:
    values, shape = told(value, twice)
    model = LINEAR if twice else 0.0
    assert values["compliance1"].std == pytest.approx(hypot(1e-3, model) * value)
    assert shape == {"k": pytest.approx(hypot(1.0, LINEAR * 1000.0)), "damping": DAMPING}


@pytest.mark.parametrize(
    ("value", "vague", "stiffness"), [(1.02e-3, 1.0, 1000.0), (1.02e-3, 30.0, 1 / 1.02e-3), (0.0, 30.0, 1000.0)]
)
def test_a_file_takes_the_stiffness_of_the_swing_unless_the_swing_hardly_shows(
    value: float, vague: float, stiffness: float
) -> None:
    twice = {"compliance1": ("k", -1)}
    values, std = told(value, twice, vague)
    unsaid: Any = None
    one = Finding(
        hypothesis=_hypothesis(twice),
        joints=(1,),
        shape={"k": 1000.0, "damping": 0.1},
        parameters=values,
        evidence=unsaid,
        alternatives=(),
        amplitude={},
        shape_std=std,
    )
    assert one.told_shape == {"k": pytest.approx(stiffness), "damping": 0.1}


def test_what_another_fit_tells_is_as_sure_as_that_and_its_error_is_in_the_others() -> None:
    """By many draws of the noise and of what is held."""
    draw = np.random.default_rng(2)
    W = draw.normal(size=(40, 3))
    W[:, 2] = 0.8 * W[:, 1] + 0.6 * W[:, 2]
    noise, errors = draw.normal(size=(40, 20000)), 0.3 * draw.normal(size=20000)
    spread = np.var(np.linalg.pinv(W[:, :2]) @ (noise - W[:, 2:] * errors), axis=1)
    told = variances(W.T @ W, {2: 0.09})
    assert told[:2] == pytest.approx(spread, rel=0.04)
    assert told[2] == 0.09
    assert told[1] > 2 * variances((W.T @ W)[:2, :2], {})[1]


def test_what_no_row_shows_has_no_variance() -> None:
    W = np.array([[1.0, 0.0, 1.0, 1.0], [0.0, 0.0, 1.0, 2.0], [2.0, 0.0, 3.0, 0.0]])
    W = np.column_stack([W, W[:, 0] + W[:, 2]])
    assert np.isinf(variances(W.T @ W, {3: 1.0})).tolist() == [True, True, True, False, True]


def test_a_shape_at_the_end_of_its_range_is_told_so() -> None:
    range_of = ShapeRange("damping", "1", 0.01, 0.4, step=0.25)
    assert [range_of.ends_at(x) for x in (0.01, 0.010005, 0.011, 0.39, 0.4)] == [True, True, False, False, True]
    assert Told("damping", 0.01, 1e-3, "1", at_bound=True).text("") == "0.01 +- 0.001 (at its bound)"
