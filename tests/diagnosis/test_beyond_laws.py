"""What no law of another effect lacks, however much that explains."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from identification.diagnosis.search.beyond_laws import BeyondLaws
from identification.outcome import Value
from tests.diagnosis.drawn_data import Data, fixed, names
from tests.diagnosis.drawn_data import search as searched
from tests.diagnosis.laws import variant


@pytest.mark.parametrize(("beside", "found"), [(0.0, {"large", "small"}), (2.0, {"large"})])
def test_what_leaves_nothing_is_no_part_of_what_a_law_lacks(beside: float, found: set[str]) -> None:
    """Though it is less than a thousandth of what that law explains; a part of what is left may be."""
    data = Data(17)
    large, small, other = data.column(), data.column(), data.column()
    effect = 100.0 * large + 2.0 * small + beside * other
    assert names(searched(data.bank(effect, [fixed("large", large), fixed("small", small)]))) == found


def explains(one: Any, beside: Any, falls: tuple[float, ...], left: float = 2000.0) -> bool:
    """Of a sum of squares that ``falls`` so on two joints, each of which keeps ``left`` beyond the noise."""
    one.columns, beside.columns = (1,), (0,)
    rows = 1000

    def left_over(k: int, values: dict[int, float], runs: Any) -> tuple[float, int]:
        return rows + left - (falls[k] if 1 in values else 0.0), rows

    normal = SimpleNamespace(by_number=lambda columns: dict.fromkeys(columns, 0.0))
    laws = BeyondLaws(SimpleNamespace(left_over=left_over), normal, (0,))  # type: ignore[arg-type]
    return laws.explains(one, sum(falls), [beside], [1e6])


@pytest.mark.parametrize(
    ("told", "right"),
    [
        (None, True),
        # To a part of 0.001 of its squares at least, and to one of 0.006; it explains 1e6, and the 2000 left all go.
        (Value(0.018, 0.0001, "s"), True),
        (Value(0.004, 0.0001, "s"), False),
    ],
)
def test_what_the_value_of_another_fit_leaves_is_none_of_another_law(told: Value | None, right: bool) -> None:
    delay = variant("torque_delay", (0,), "frequency", {} if told is None else {"torque_delay1": told})
    assert explains(variant("dahl_friction", (0,), "q by direction"), delay, (2000.0,), 2000.0) is right
    assert not explains(variant("dahl_friction", (0,), "q by direction"), delay, (900.0,), 900.0) or told is None


@pytest.mark.parametrize(("falls", "right"), [((0.0, 400.0), True), ((300.0, 100.0), False)])
def test_what_is_explained_where_a_law_does_not_act_is_no_part_of_it(falls: tuple[float, ...], right: bool) -> None:
    balancer, everywhere = (variant("gas_balancer", joints, "q") for joints in ((0,), (0, 1)))
    assert explains(variant("position_offset", (0, 1), "q"), balancer, falls) is right
    assert not explains(variant("position_offset", (0, 1), "q"), everywhere, falls)


@pytest.mark.parametrize(
    ("effect", "variable", "whole", "left", "right"),
    [
        ("load_friction", "frequency", False, 410.0, True),
        ("load_friction", "frequency", False, 500.0, False),
        ("load_friction", "frequency", False, 190.0, False),
        ("load_friction", "load", False, 410.0, False),
        ("motor_ripple", "motor phase", True, 410.0, True),
        ("spring_balancer", "q", True, 410.0, False),
    ],
)
def test_what_leaves_nothing_shows_elsewhere_or_at_a_whole_order(
    effect: str, variable: str, whole: bool, left: float, right: bool
) -> None:
    """Of what is left beside a balancer, it explains 400; a second balancer may be what the first one's law lacks."""
    one = variant(effect, (0,), variable)
    one.hypothesis.shapes = (SimpleNamespace(whole=whole),)
    assert explains(one, variant("gas_balancer", (0,), "q", joint=2), (400.0, 0.0), left) is right


def test_what_asks_for_another_effect_is_not_beside_others_alone() -> None:
    """A delay of one joint is told beyond that of all."""
    delay = variant("torque_delay", (0,), "frequency")
    assert explains(delay, variant("gas_balancer", (0,), "q", joint=2), (400.0, 0.0), 410.0)
    delay.hypothesis.beyond = ("torque_delay",)
    assert not explains(delay, variant("gas_balancer", (0,), "q", joint=2), (400.0, 0.0), 410.0)
