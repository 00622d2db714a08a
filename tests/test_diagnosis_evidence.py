"""What speaks for a hypothesis, where a part of the data or the end of a shape would speak for another."""

from __future__ import annotations

import numpy as np
import pytest

from identification.diagnosis.evidence import Weighing
from identification.diagnosis.hypothesis import ShapeRange
from identification.diagnosis.selection import Selection
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


def test_what_is_at_its_bounds_hides_none_of_the_others() -> None:
    """Evidence beside two, one of them without a column, is that beside the other."""
    data = Data(15)
    first, second, none = data.column(), data.column(), data.column()
    one = data.bank(3.0 * first, [fixed("first", first), fixed("second", second), fixed("none", none)])
    weighing = Weighing(one, TRAIN, VALIDATE, None)
    a, b, c = one.variants
    alone = weighing.of(b, [a])
    beside = weighing.of(b, [a, c.only([])])
    assert beside.drop == pytest.approx(alone.drop)
    assert beside.why_not == alone.why_not


@pytest.mark.parametrize(("more", "found"), [(0.02, {"viscous_friction", "coulomb_friction"}), (2.0, {"rare"})])
def test_two_common_effects_stand_in_the_place_of_a_rare_one(more: float, found: set[str]) -> None:
    """That explains by itself what they do together, and hardly more."""
    data = Data(16)
    viscous, coulomb, law = data.column(), data.column(), data.column()
    rare = viscous + coulomb + more * law
    common = [fixed("viscous_friction", viscous), fixed("coulomb_friction", coulomb)]
    one = data.bank(3.0 * rare, [*common, fixed("rare", rare)])
    weighing = Weighing(one, TRAIN, VALIDATE, None)
    chosen = Selection(weighing).search([one.variants[2]])
    assert names(chosen) == found
