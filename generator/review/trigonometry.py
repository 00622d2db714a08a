"""Half-angle tangents written as the sines and cosines that a reader expects."""

from __future__ import annotations

import sympy


def without_half_angles(expression: sympy.Expr) -> sympy.Expr:
    """The expression with each tan(x) written in functions of 2 x, as short as cos^2 + sin^2 = 1 makes it.

    What is no polynomial of the sine and cosine over powers of them stays as it is.
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
    circles, rest = _divided(sympy.Poly(below, t), sympy.Poly(1 + t**2, t))
    cosines, rest = _divided(rest, sympy.Poly(1 - t**2, t))
    sines, rest = _divided(rest, sympy.Poly(t, t))
    # 1 - t^2 = c (1 + t^2) and 2 t = s (1 + t^2).
    power, terms = circles + cosines + sines, sympy.Poly(above, t)
    if rest.degree() > 0 or terms.degree() > 2 * power:
        return expression
    # t = s / (1 + c) = (1 - c) / s and 1 + t^2 = 2 / (1 + c), so t^m / (1 + t^2)^k is a polynomial for every m <= 2 k.
    total = sympy.Integer(0)
    for (m,), coefficient in terms.terms():
        low = s**m * (1 + c) ** (power - m) if m <= power else s ** (2 * power - m) * (1 - c) ** (m - power)
        total += coefficient * low / 2**power
    total = total * 2**sines / rest.as_expr()
    circle = c**2 + s**2 - 1
    forms = [
        sympy.expand(sympy.cancel(sympy.rem(sympy.expand(total), circle, letter) / (c**cosines * s**sines)))
        for letter in (s, c)
    ]
    shortest = min(forms, key=lambda form: len(sympy.Add.make_args(form)))
    written = sympy.Add(*(_with_tangent(term, s, c, angle) for term in sympy.Add.make_args(shortest)))
    return written.subs({c: sympy.cos(angle), s: sympy.sin(angle)})


def _divided(polynomial: sympy.Poly, factor: sympy.Poly) -> tuple[int, sympy.Poly]:
    """How often a polynomial has a factor, and what is left without it."""
    times = 0
    while polynomial.degree() > 0 and polynomial.rem(factor).is_zero:
        times, polynomial = times + 1, polynomial.quo(factor)
    return times, polynomial


def _with_tangent(term: sympy.Expr, s: sympy.Symbol, c: sympy.Symbol, angle: sympy.Expr) -> sympy.Expr:
    """A product with as many s/c as it has written as tangents of the angle."""
    powers = term.as_powers_dict()
    common = min(powers[s], -powers[c])
    return term * (sympy.tan(angle) * c / s) ** common if common > 0 else term
