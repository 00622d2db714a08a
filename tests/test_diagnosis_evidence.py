"""What speaks for a hypothesis, where a part of the data or the end of a shape would speak for another."""

from __future__ import annotations

import numpy as np
import pytest

from identification.diagnosis.evidence import Weighing
from identification.diagnosis.hypothesis import ShapeRange
from tests.matrices import hypothesis
from tests.test_diagnosis_selection import RUNS, TRAIN, VALIDATE, Data, fixed, names, search


@pytest.mark.parametrize(("true", "found"), [(0.1, set()), (1.0, {"shaped"})])
def test_what_has_vanished_is_another_effect(true: float, found: set[str]) -> None:
    """Though the search goes on anywhere in the range."""
    data = Data(12)
    x = data.column()
    shape = ShapeRange("v", "1", 0.4, 3.2, 4, step=0.3, vanishing=True)
    law = np.stack([2.0 * np.exp(-((x[r] - np.log(true)) ** 2) / 8) for r in range(RUNS)])
    hidden = hypothesis("shaped", lambda r, given: np.exp(-((x[r] - np.log(given["v"])) ** 2) / 8), [shape])
    assert names(search(data.bank(law, [hidden]))) == found


def test_nothing_is_gained_by_what_single_runs_hardly_show() -> None:
    """What the model all but takes up is taken as unseen: in all runs together, or in none of them."""
    data = Data(13)
    rest = data.column()
    steep = np.array([0.0096, 0.0096, 0.0125])[:, None] * rest
    column = data.base[:, 0] + steep
    effect = 60.0 * column
    one = data.bank(effect, [fixed("steep", column)])
    weighing = Weighing(one, TRAIN, VALIDATE, None)
    gain = weighing.gain(one.variants[0], [])
    assert gain == pytest.approx(60.0**2 * float(np.sum(steep[2] ** 2)), rel=0.3)


def test_a_joint_has_one_balancer() -> None:
    """Though two together would do better: no robot file has them."""
    data = Data(14)
    first, second = data.column(), data.column()
    offered = [fixed("gas_balancer", first), fixed("spring_balancer", second)]
    assert names(search(data.bank(3.0 * first + 2.8 * second, offered))) == {"gas_balancer"}
