"""From expressions to statements: each part of an expression is lowered once."""

from __future__ import annotations

from typing import Any

import pytest
import sympy

from generator.symbolic import lowering
from generator.symbolic.statements import Program

DEPTH = 14


def test_nested_products_cost_what_they_hold(monkeypatch: pytest.MonkeyPatch) -> None:
    x = sympy.Symbol("x", real=True)
    expression = x
    for k in range(DEPTH):
        expression = (k + 2) * sympy.sin(expression)
    made, plain = [], lowering._Lowering._made

    def counted(self: Any, part: Any) -> Any:
        made.append(part)
        return plain(self, part)

    monkeypatch.setattr(lowering._Lowering, "_made", counted)
    program = Program()
    lowering.lower(program, expression, {x: program.input("q", 0)})
    assert DEPTH < len(made) <= 4 * DEPTH
