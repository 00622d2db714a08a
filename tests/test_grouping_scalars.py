"""Exact numbers of a robot's groupings."""

from __future__ import annotations

import sympy

from generator.grouping.scalars import Numbers
from generator.resources import find_robot
from generator.robot.readers import read


def test_products_and_quotients_are_exact() -> None:
    numbers = Numbers(read(find_robot("kr500")))
    d2, d3 = (numbers.length(sympy.Symbol(name, real=True)) for name in ("d2", "d3"))
    one, two = numbers.one, numbers.integer(2)
    assert d2 * one is d2
    assert one * d2 is d2
    assert d2 / one is d2
    product = two * d2 * d3 / two
    assert (product.symbol, product.value) == (d2.symbol * d3.symbol, d2.value * d3.value)
    assert not (d2 - d2) * d3
    assert (numbers.integer(0), numbers.integer(1)) == (numbers.zero, one)
