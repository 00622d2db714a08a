"""Half-angle tangents written as the sines and cosines that a reader expects."""

from __future__ import annotations

import sympy


def without_half_angles(expression: sympy.Expr) -> sympy.Expr:
    """The expression with each tan(x) written in sin(2 x) and cos(2 x), as short as cos^2 + sin^2 = 1 makes it.

    What is no polynomial of the sine and cosine stays as it is.
    """
    for tangent in sorted(expression.atoms(sympy.tan), key=str):
        expression = _rewritten(expression, tangent)
    return expression


def _rewritten(expression: sympy.Expr, tangent: sympy.Expr) -> sympy.Expr:
    angle = 2 * tangent.args[0]
    t, c, s = sympy.symbols("t c s")
    in_t = expression.subs(
        {tangent: t, sympy.sin(angle): 2 * t / (1 + t**2), sympy.cos(angle): (1 - t**2) / (1 + t**2)}
    )
    above, below = sympy.fraction(sympy.cancel(in_t))
    power, rest = 0, sympy.Poly(below, t)
    unit = sympy.Poly(1 + t**2, t)
    while rest.degree() > 0 and rest.rem(unit).is_zero:
        power, rest = power + 1, rest.quo(unit)
    terms = sympy.Poly(above, t)
    if rest.degree() > 0 or terms.degree() > 2 * power:
        return expression
    # t = s / (1 + c) = (1 - c) / s and 1 + t^2 = 2 / (1 + c), so t^m / (1 + t^2)^k is a polynomial for every m <= 2 k.
    total = sympy.Integer(0)
    for (m,), coefficient in terms.terms():
        low = s**m * (1 + c) ** (power - m) if m <= power else s ** (2 * power - m) * (1 - c) ** (m - power)
        total += coefficient * low / 2**power
    total = total / rest.as_expr()
    circle = c**2 + s**2 - 1
    forms = [sympy.expand(sympy.rem(sympy.expand(total), circle, letter)) for letter in (s, c)]
    shortest = min(forms, key=lambda form: len(sympy.Add.make_args(form)))
    return shortest.subs({c: sympy.cos(angle), s: sympy.sin(angle)})
