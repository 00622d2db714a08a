"""From an exact sympy expression to the straight-line program, once."""

from __future__ import annotations

from collections.abc import Mapping

import sympy

from generator.constants import exact_constant
from generator.symbolic.statements import Node, Program

_FUNCTIONS = {
    sympy.sin: "sin",
    sympy.cos: "cos",
    sympy.log: "log",
    sympy.exp: "exp",
    sympy.tanh: "tanh",
    sympy.Abs: "abs",
    sympy.sign: "sign",
}


def lower(program: Program, expression: sympy.Expr, values: Mapping[sympy.Symbol, Node]) -> Node:
    """The node of ``expression`` with each of its symbols replaced by its node in ``values``.

    Raises KeyError for a symbol without a node and ValueError for a function that no backend prints.
    """
    return _Lowering(program, values).of(expression)


class _Lowering:
    """Nodes of a program by expression, each made once."""

    def __init__(self, program: Program, values: Mapping[sympy.Symbol, Node]) -> None:
        self._program = program
        self._known: dict[sympy.Expr, Node] = {}
        self._values = values

    def of(self, expression: sympy.Expr) -> Node:
        """The node of an expression."""
        if isinstance(expression, sympy.Symbol):
            return self._values[expression]
        if expression not in self._known:
            self._known[expression] = self._made(expression)
        return self._known[expression]

    def _made(self, expression: sympy.Expr) -> Node:
        program = self._program
        if not expression.free_symbols:
            return program.constant(exact_constant(expression))
        arguments = [self.of(argument) for argument in expression.args]
        if isinstance(expression, sympy.Add):
            total = program.zero
            for argument in arguments:
                total = total + argument
            return total
        if isinstance(expression, sympy.Mul):
            return self._quotient(expression)
        if isinstance(expression, sympy.Pow):
            exponent = expression.exp
            if exponent.free_symbols:
                raise ValueError(f"only constant powers are emitted, got {expression}")
            return program.power(arguments[0], exact_constant(exponent))
        if expression.func is sympy.tan:
            return program.function("sin", arguments[0]) / program.function("cos", arguments[0])
        name = _FUNCTIONS.get(expression.func)
        if name is None:
            raise ValueError(f"no backend prints {expression.func.__name__}")
        return program.function(name, arguments[0])

    def _quotient(self, product: sympy.Mul) -> Node:
        """A product with its negative powers gathered in one divisor, so that it costs one division."""
        above, below = self._program.one, self._program.one
        for factor in product.args:
            base, exponent = factor.as_base_exp()
            if factor.free_symbols and exponent.is_Rational and exponent < 0:
                below = below * self.of(base**-exponent)
            else:
                above = above * self.of(factor)
        return above / below
