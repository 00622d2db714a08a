"""What was chosen is challenged with all its coefficients, and by what a free fit believes."""

from __future__ import annotations

import numpy as np
import pytest

from identification.diagnosis.columns.hypothesis import Coefficient
from identification.diagnosis.columns.normal_equations import Prior
from identification.diagnosis.search.weighing import Weighing
from tests.diagnosis.drawn_data import TRAIN, VALIDATE, Data, fixed, search
from tests.matrices import several


@pytest.mark.parametrize("refines", [False, True])
def test_a_coefficient_that_another_effect_kept_at_its_bound_returns_with_it(refines: bool) -> None:
    data = Data(5)
    first, second, third = data.column(), data.column(), data.column()
    other = third - 0.6 * second
    size = 0.5 if refines else 1.0
    coefficients = [Coefficient("c", "1", 0.0), Coefficient("c2", "1", 0.0, refines=refines)]
    offered = [several("two", coefficients, [first, second]), fixed("other", other)]
    found = {
        one.evidence.variant.hypothesis.effect: one.evidence.coefficients
        for one in search(data.bank(3 * first + size * second + 2 * other, offered))
    }
    assert found["two"] == pytest.approx([3.0, size], abs=0.15)
    assert found["other"] == pytest.approx([2.0], abs=0.15)


def test_what_a_file_states_of_drive_trains_is_no_prior_of_the_model() -> None:
    """A gain that a free fit makes too large is not believed, whatever stiffness the file states."""
    data = Data(3)
    column = data.column()
    gain = several("torque_gain", [Coefficient("g", "1", -0.65, 1.9, believed=0.6)], [column])
    one = data.bank(1.5 * column, [gain])
    stated = Prior(np.zeros(3), np.zeros((3, 3)))
    for prior, free, believed in ((None, False, False), (stated, True, False), (None, True, False)):
        assert Weighing(one, TRAIN, VALIDATE, prior, None, free).of(one.variants[0], []).believed == believed
