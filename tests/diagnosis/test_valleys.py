"""A balancer's shape is found where the best of the tried shapes lies in the valley of a worse end."""

from __future__ import annotations

from collections.abc import Mapping
from math import cos, pi, sin

import pytest

from identification.diagnosis.columns.hypothesis import ShapeRange
from identification.diagnosis.search.valleys import Valleys, _neighbours
from identification.diagnosis.search.weighing import Weighing
from tests.diagnosis.drawn_data import TRAIN, VALIDATE, Data, search
from tests.matrices import Array, bank, hypothesis, run, whitened

#: Angles that are tried, once around, and two lengths; what is true, beside one of them, and what seems best of them.
ANGLES = ShapeRange("phi", "rad", -pi, 5 * pi / 6, count=12, log=False)
LENGTHS = ShapeRange("d22", "m", 0.1, 0.4, count=3)
TRUE, SEEMING = -1.45, 2 * pi / 3


@pytest.mark.parametrize("effect", ["gas_balancer", "spring_balancer"])
def test_the_search_begins_in_each_valley(effect: str) -> None:
    """At the angle that seems best of the tried ones, no nearby one is better."""
    data = Data(3)
    true, other = data.column(), data.column()

    def column(r: int, shape: Mapping[str, float]) -> Array:
        off = min(4 * abs(shape["phi"] - TRUE), 0.4 + 0.3 * abs(shape["phi"] - SEEMING), pi / 2)
        return cos(off) * true[r] + sin(off) * other[r]

    offered = hypothesis(effect, column, shapes=[ANGLES])
    bank_ = data.bank(3.0 * true, [offered])
    begun = Valleys(Weighing(bank_, TRAIN, VALIDATE, None))._begun(bank_.variants[0], [])
    assert [round(one.shape["phi"], 3) for one in begun] == [round(x, 3) for x in (SEEMING, -pi / 2)]
    (found,) = search(data.bank(3.0 * true, [offered]))
    assert found.evidence.variant.shape["phi"] == pytest.approx(TRUE, abs=0.01)


@pytest.mark.parametrize(
    ("one", "other", "near"),
    [
        ((-pi, 0.1), (5 * pi / 6, 0.1), True),
        ((-pi, 0.1), (-5 * pi / 6, 0.1), True),
        ((-pi, 0.1), (-2 * pi / 3, 0.1), False),
        ((-pi, 0.1), (-5 * pi / 6, 0.2), False),
        ((-pi, 0.1), (-pi, 0.2), True),
        ((-pi, 0.1), (-pi, 0.4), False),
    ],
)
def test_angles_go_around_and_lengths_do_not(one: tuple[float, float], other: tuple[float, float], near: bool) -> None:
    grids = {shape.name: shape for shape in (ANGLES, LENGTHS)}
    tried = hypothesis("gas_balancer", lambda r, shape: Data(1).base[r, 0], shapes=[ANGLES, LENGTHS])
    kept = whitened(bank([run(W, W[0]) for W in Data(1).base]))
    made = {tuple(round(x, 6) for x in shape.values()): kept.add(tried, shape) for shape in tried.variants}
    pair = [made[tuple(round(x, 6) for x in values)] for values in (one, other)]
    assert all(each is not None for each in pair)
    assert _neighbours(*[each for each in pair if each is not None], grids) == near
