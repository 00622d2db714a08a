"""Decimal arithmetic: more digits than a double holds, and the same ones on every machine.

Binary floating point leaves the last bits to the processor and its libraries, so that values printed in full would
differ between machines. Arrays are numpy arrays of dtype object that hold Decimal; int zeros and ones mix in freely.
"""

from __future__ import annotations

from decimal import Context, Decimal
from typing import Any

import numpy as np
import sympy
from numpy.typing import NDArray

Array = NDArray[Any]

#: Working precision: twice a double's digits, and some for what a sum of large terms may lose.
CONTEXT = Context(prec=40)

_PI = Decimal("3.14159265358979323846264338327950288419716939937510582097494459230781640628620899862803482534211706798")


def exact(expression: sympy.Expr) -> Decimal:
    """The value of a constant expression; raises TypeError where a symbol is left in it."""
    if expression.is_Rational:
        return Decimal(int(expression.p)) / Decimal(int(expression.q))
    if expression.free_symbols:
        raise TypeError(f"{expression} is not a number")
    return Decimal(str(sympy.N(expression, CONTEXT.prec + 10)))


def decimals(values: object) -> Array:
    """Numbers, nested or not, as an array of Decimals, digit for digit."""
    given: Array = np.asarray(values, dtype=object)
    result = np.empty(given.shape, dtype=object)
    for index in np.ndindex(given.shape):
        value: Any = given[index]
        result[index] = Decimal(value)
    return result


def floats(values: object) -> NDArray[np.float64]:
    """The nearest doubles."""
    return np.asarray(values, dtype=np.float64)


def zeros(*shape: int) -> Array:
    """Decimal zeros in an array of that shape."""
    return np.full(shape, Decimal(0), dtype=object)


def sign(x: Decimal) -> Decimal:
    """-1, 0 or 1 as ``x`` is; 0 at 0."""
    return Decimal((x > 0) - (x < 0))


def smooth_signs(speeds: Array, widths: Array) -> Array:
    """x / sqrt(x^2 + width^2) of each speed x."""
    return np.array([x / (x * x + w * w).sqrt() for x, w in zip(speeds, widths, strict=True)], dtype=object)


def sine(x: Decimal) -> Decimal:
    """The sine of x, by its series after reduction to [-pi, pi]."""
    angle = x.remainder_near(2 * _PI, CONTEXT)
    return _alternating(angle, angle, 1)


def cosine(x: Decimal) -> Decimal:
    """The cosine of x, by its series after reduction to [-pi, pi]."""
    return _alternating(x.remainder_near(2 * _PI, CONTEXT), Decimal(1), 0)


def _alternating(angle: Decimal, term: Decimal, order: int) -> Decimal:
    """The series with first term ``term`` of that order, each next term -angle^2 / ((k + 1)(k + 2)) times the last."""
    square, value = angle * angle, Decimal(0)
    while value + term != value:
        value += term
        term = -term * square / ((order + 1) * (order + 2))
        order += 2
    return value


def solve(matrix: Array, right: Array) -> Array:
    """The solution x of A x = b (n x n, n) by Gauss-Jordan elimination with row pivoting.

    Raises ZeroDivisionError if A is singular.
    """
    size = len(right)
    rows = np.hstack([matrix, right.reshape(size, 1)]).astype(object)
    for k in range(size):
        pivot = max(range(k, size), key=lambda i: abs(rows[i, k]))
        if rows[pivot, k] == 0:
            raise ZeroDivisionError("the matrix is singular")
        rows[[k, pivot]] = rows[[pivot, k]]
        rows[k] = rows[k] / rows[k, k]
        for i in range(size):
            if i != k:
                rows[i] = rows[i] - rows[i, k] * rows[k]
    return rows[:, size]
