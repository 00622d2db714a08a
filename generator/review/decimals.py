"""Numbers for readers: decimals from exact values, without passing through the machine's rounding where it matters."""

from __future__ import annotations

from decimal import ROUND_HALF_EVEN, Context, Decimal
from fractions import Fraction

#: Digits that keep products of two lengths given to the millimetre exact in print.
DIGITS = 7

#: Digits, at most, of the shortest text that gives a number of the machine back.
MACHINE = 17


def decimal(value: Fraction, digits: int = DIGITS) -> str:
    """A fraction in decimal notation: all its digits if it ends within twelve, else ``digits`` significant ones."""
    if value.denominator == 1:
        return str(value.numerator)
    keep = 12 if terminates(value) and len(str(value.numerator)) <= 12 else digits
    return _positional(_round(value, keep))


def rounded(value: Fraction, digits: int = DIGITS) -> str:
    """A fraction to ``digits`` significant digits, half to even, without trailing zeros or an exponent."""
    return _positional(_round(value, digits))


def scientific(value: float | Fraction, digits: int = 4) -> str:
    """A measured value: plain notation between 1e-3 and 1e5, powers of ten outside."""
    if value == 0:
        return "0"
    exact = _round(Fraction(value), digits)
    exponent = exact.adjusted()
    if -3 <= exponent < 5:
        return _positional(exact)
    mantissa = exact.scaleb(-exponent)
    return f"{_positional(mantissa)}e{exponent}"


def terminates(value: Fraction) -> bool:
    """Whether the decimal expansion of a fraction ends."""
    below = value.denominator
    for prime in (2, 5):
        while below % prime == 0:
            below //= prime
    return below == 1


def _round(value: Fraction, digits: int) -> Decimal:
    context = Context(prec=digits, rounding=ROUND_HALF_EVEN)
    return context.divide(Decimal(value.numerator), Decimal(value.denominator))


def _positional(value: Decimal) -> str:
    text = format(value, "f")
    return (text.rstrip("0").rstrip(".") if "." in text else text) or "0"
