"""Rows and products that columns join are what they are when all are there from the beginning."""

from __future__ import annotations

import numpy as np
import pytest

from identification.diagnosis.columns import growing
from identification.diagnosis.columns.growing import Products, Rows


@pytest.mark.parametrize("room", [0, 2, 100])
def test_columns_may_come_one_after_the_other(room: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(growing, "_ROOM", room)
    columns, torque = np.random.default_rng(1).normal(size=(9, 40)), np.linspace(-1.0, 1.0, 40)
    whole = np.vstack([columns, torque])
    rows, products = Rows(whole[[0, 1, -1]]), Products(whole[[0, 1, -1]] @ whole[[0, 1, -1]].T)
    count = 2
    for more in (1, 3, 0, 2, 1):
        new = columns[count : count + more]
        rows.join(new)
        gram = products.join(more)
        assert not gram[count : count + more].any()
        assert not gram[:, count : count + more].any()
        gram[count : count + more] = new @ rows.array.T
        gram[:, count : count + more] = gram[count : count + more].T
        count += more
    np.testing.assert_array_equal(rows.array, whole)
    np.testing.assert_allclose(products.array, whole @ whole.T, rtol=1e-12)
