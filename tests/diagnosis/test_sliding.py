"""What slides before it slips replaces no more Coulomb friction than there is."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from identification.diagnosis.columns.bank import Variant
from identification.diagnosis.columns.hypothesis import SINCE_REVERSAL, Coefficient
from identification.diagnosis.search.sliding import replaces
from tests.matrices import variant


def sliding(variable: str) -> Variant:
    """On joint 2."""
    return variant("lugre_friction", Coefficient("Fz2", "N m", 0.0), 3, joint=2, variable=variable)


@pytest.mark.parametrize(
    ("coulomb", "variable", "base", "possible"),
    [
        (-36.0, SINCE_REVERSAL, ("ZZ1", "Fc1", "Fc2"), False),
        (-1.0, SINCE_REVERSAL, ("ZZ1", "Fc1", "Fc2"), True),
        (4.0, SINCE_REVERSAL, ("ZZ1", "Fc1", "Fc2"), True),
        (-36.0, "qd", ("ZZ1", "Fc1", "Fc2"), True),
        (-36.0, SINCE_REVERSAL, ("ZZ1", "Fc1", "Fv2"), True),
    ],
)
def test_of_two_frictions_that_are_nearly_the_same_none_is_far_below_zero(
    coulomb: float, variable: str, base: tuple[str, ...], possible: bool
) -> None:
    """44 N m of the one and -36 N m of the other make up a Stribeck friction of 4 N m."""
    fitted = (np.array([1.0, 8.0, coulomb, 44.0]), np.zeros((4, 4)))
    weighing: Any = SimpleNamespace(bank=SimpleNamespace(base=base), fitted=lambda variants: fitted)
    assert replaces(weighing, sliding(variable), []) == possible
