"""What no law of another effect lacks, however much that explains."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from identification.diagnosis.search.beyond_laws import BeyondLaws
from tests.diagnosis.drawn_data import Data, fixed
from tests.diagnosis.drawn_data import search as searched
from tests.diagnosis.test_imperfect_laws import variant
from tests.diagnosis.test_selection import names


@pytest.mark.parametrize(("beside", "found"), [(0.0, {"large", "small"}), (2.0, {"large"})])
def test_what_leaves_nothing_is_no_part_of_what_a_law_lacks(beside: float, found: set[str]) -> None:
    """Though it is less than a thousandth of what that law explains; a part of what is left may be."""
    data = Data(17)
    large, small, other = data.column(), data.column(), data.column()
    effect = 100.0 * large + 2.0 * small + beside * other
    assert names(searched(data.bank(effect, [fixed("large", large), fixed("small", small)]))) == found


@pytest.mark.parametrize(
    ("falls", "explains"),
    [((0.0, 400.0), True), ((300.0, 100.0), False)],
)
def test_what_is_explained_where_a_law_does_not_act_is_no_part_of_it(falls: tuple[float, ...], explains: bool) -> None:
    """Of a sum of squares that falls by 400 on two joints, beside a balancer on the first one."""
    offset, balancer = variant("position_offset", (0, 1), "q"), variant("gas_balancer", (0,), "q")
    offset.columns, balancer.columns = (1,), (0,)
    rows, left = 1000, 2000.0

    def left_over(k: int, values: dict[int, float], runs: Any) -> tuple[float, int]:
        return rows + left - (falls[k] if 1 in values else 0.0), rows

    normal = SimpleNamespace(base=0, solution=lambda columns: (np.zeros(len(columns)), None))
    beyond = BeyondLaws(SimpleNamespace(left_over=left_over), normal, (0,))  # type: ignore[arg-type]
    assert beyond.explains(offset, sum(falls), [balancer], [1e6]) is explains
    assert not beyond.explains(offset, sum(falls), [variant_at_last(balancer)], [1e6])


def variant_at_last(one: Any) -> Any:
    """The same on the last joint as well: nothing is elsewhere."""
    other = variant(one.hypothesis.effect, (0, 1), "q")
    other.columns = one.columns
    return other
