"""Expressions, quantities and units: exact values, and exact refusals of everything else."""

from __future__ import annotations

import re
from collections.abc import Callable
from fractions import Fraction

import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st

from generator.errors import InputError, Place
from generator.expressions import parse, parse_number, parse_quantity, vanishes
from generator.units import parse_unit

HERE = Place("arm.yaml", 3, 10)
D2, Q3 = sympy.Symbol("d2", real=True), sympy.Symbol("q3", real=True)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1.300", sympy.Rational(13, 10)),
        ("0.1", sympy.Rational(1, 10)),
        (".5", sympy.Rational(1, 2)),
        ("5.", sympy.Integer(5)),
        ("1e3", sympy.Integer(1000)),
        ("6.58e-3", sympy.Rational(658, 100000)),
        ("-2**2", sympy.Integer(-4)),
        ("2**-1", sympy.Rational(1, 2)),
        ("2^3^2", sympy.Integer(512)),
        ("-+-2", sympy.Integer(2)),
        ("8/4/2", sympy.Integer(1)),
        ("2 - 3 - 4", sympy.Integer(-5)),
        ("76725/152", sympy.Rational(76725, 152)),
        ("(1 + 2)*3", sympy.Integer(9)),
        ("pi/2", sympy.pi / 2),
        ("q3 + pi/2", Q3 + sympy.pi / 2),
        ("-d2", -D2),
        ("2*d2/3 - d2^2", 2 * D2 / 3 - D2**2),
        ("0^0", sympy.Integer(1)),
    ],
)
def test_exact_values(text: str, value: sympy.Expr) -> None:
    assert parse(text, HERE) == value
    assert not parse(text, HERE).atoms(sympy.Float)


def test_names_are_real_symbols_and_never_sympy_functions() -> None:
    for name in ("E", "I", "S", "gamma", "beta", "lambda", "N", "zoo"):
        assert parse(name, HERE) == sympy.Symbol(name, real=True)


GRAMMAR = "expected numbers, pi, names and + - * / ^ ( )"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("__import__('os').system('true')", f"10: a call of '__import__', {GRAMMAR}"),
        ("1 + sin(2)", f"14: a call of 'sin', {GRAMMAR}"),
        ("pi (2)", f"10: a call of 'pi', {GRAMMAR}"),
        ("d2.real", f"12: unexpected '.', {GRAMMAR}"),
        ("'d2'", f'10: unexpected "\'", {GRAMMAR}'),
        ("[1]", f"10: unexpected '[', {GRAMMAR}"),
        ("{1}", f"10: unexpected '{{', {GRAMMAR}"),
        ("1; 2", f"11: unexpected ';', {GRAMMAR}"),
        ("1 if 2 else 3", "12: unexpected 'if', expected an operator or the end"),
        ("2 // 3", "13: unexpected '/', expected a number, pi, a name or ("),
        ("2 3", "12: unexpected '3', expected an operator or the end"),
        ("2(3)", "11: unexpected '(', expected an operator or the end"),
        ("0x10", "11: unexpected 'x10', expected an operator or the end"),
        ("1_000", "11: unexpected '_000', expected an operator or the end"),
        ("(1", "10: unclosed parenthesis, expected as many ) as ("),
        ("1)", "11: unexpected ')', expected an operator or the end"),
        (
            "q2 - 90 deg",
            "18: unexpected 'deg', expected an operator or the end; a unit stands behind a number alone: "
            "write pi/2, or give it a name in geometry",
        ),
        ("1 +", "13: the expression ends too early, expected a number, pi, a name or ("),
        ("", "10: the expression ends too early, expected a number, pi, a name or ("),
        ("inf", "10: 'inf' is not a finite number, expected a finite number"),
        ("-.NaN", "11: '.NaN' is not a finite number, expected a finite number"),
        ("1e999", "10: '1e999' is not a finite number, expected a size from 1e-300 to 1e300"),
        ("1e99999999", "10: '1e99999999' is not a finite number, expected a size from 1e-300 to 1e300"),
        ("1/0", "11: division by zero, expected a divisor that is not zero"),
        ("0^-1", "11: division by zero, expected a divisor that is not zero"),
        ("1/(d2 - d2)", "11: division by zero, expected a divisor that is not zero"),
        ("1/((d2 + 1)^2 - d2^2 - 2*d2 - 1)", "11: division by zero, expected a divisor that is not zero"),
        ("1/((1 + pi)^2 - 1 - 2*pi - pi^2)", "11: division by zero, expected a divisor that is not zero"),
        ("2^0.5", "11: the exponent is 1/2, expected an integer"),
        ("2^d2", "11: the exponent is d2, expected an integer"),
        ("2^65", "11: the power grows too large, expected exponents up to 64 altogether"),
        ("(2^64)^64^64", "16: the power grows too large, expected exponents up to 64 altogether"),
        ("((pi^8)^8)^8", "20: the power grows too large, expected exponents up to 64 altogether"),
        ("*".join(["(9*9*9*9)^64"] * 20), "74: the exact fraction grows too large, expected at most 4096 bits"),
        (
            "(a + b + c + d)^20/(a + b + c + d)^19",
            "25: the expression grows too large, expected at most 1000 terms when it is written out",
        ),
        (
            "(a + b)^9*(c + d)^9*(a + d)^9/(a + b)^26",
            "39: the expression grows too large, expected at most 1000 terms when it is written out",
        ),
        ("(" * 33 + "1" + ")" * 33, "42: the expression is nested too deeply, expected at most 32 levels"),
        ("2" + "^1" * 100, "75: the expression is nested too deeply, expected at most 32 levels"),
        ("x" * 501, "10: an expression of 501 characters, expected at most 500"),
    ],
)
def test_bad_expressions_are_refused_with_their_place(text: str, message: str) -> None:
    with pytest.raises(InputError) as refused:
        parse(text, HERE)
    assert str(refused.value) == f"arm.yaml:3:{message}"


def test_numbers_have_no_names() -> None:
    assert parse_number("3*pi/2", HERE) == 3 * sympy.pi / 2
    assert parse_number("(pi + 1)*(pi - 1) - pi^2 + 1", HERE) == 0
    with pytest.raises(InputError) as refused:
        parse_number("2*d2", HERE)
    assert str(refused.value) == "arm.yaml:3:12: 'd2' is not a number, expected numbers, pi and + - * / ^ ( )"
    with pytest.raises(InputError) as refused:
        parse_number("1e300*1e300", HERE)
    assert str(refused.value) == "arm.yaml:3:10: the number is too large, expected a finite number"


@pytest.mark.parametrize(
    ("text", "unit", "value", "si"),
    [
        ("1.300 m", "m", sympy.Rational(13, 10), "m"),
        ("250 mm", "m", sympy.Rational(1, 4), "m"),
        ("18cm", "m", sympy.Rational(18, 100), "m"),
        ("-90 deg", "rad", -sympy.pi / 2, "rad"),
        ("pi/2 rad", "rad", sympy.pi / 2, "rad"),
        ("5 mrad", "rad", sympy.Rational(5, 1000), "rad"),
        ("-9.81 m/s2", "m/s2", sympy.Rational(-981, 100), "m/s2"),
        ("1.36 N.m/A", "N m/A", sympy.Rational(34, 25), "N m/A"),
        ("2 kN", None, sympy.Integer(2000), "N"),
        ("3 kg mm2", None, sympy.Rational(3, 10**6), "kg m2"),
        ("3 kg*m^2", None, sympy.Integer(3), "kg m2"),
        ("3 kg m2 s-2", None, sympy.Integer(3), "N m"),
        ("4 kg/s", None, sympy.Integer(4), "N s/m"),
        ("7 N m s / rad", None, sympy.Integer(7), "N m s/rad"),
        ("pi N m/deg", None, sympy.Integer(180), "N m/rad"),
        ("20 ms", None, sympy.Rational(1, 50), "s"),
        ("2 m3", None, sympy.Integer(2), "m3"),
        ("1", "1", sympy.Integer(1), "1"),
        ("1.4", None, sympy.Rational(7, 5), "1"),
    ],
)
def test_quantities_become_si_exactly(text: str, unit: str | None, value: sympy.Expr, si: str) -> None:
    quantity = parse_quantity(text, unit, HERE)
    assert (quantity.value, quantity.unit, quantity.place) == (value, si, HERE)


@pytest.mark.parametrize(
    ("text", "unit", "message"),
    [
        ("1.3", "m", "10: no unit after '1.3', expected m, cm or mm"),
        ("1.3 kg", "m", "14: 'kg' is the wrong unit, expected m, cm or mm"),
        ("1.3 ", "rad", "10: no unit after '1.3', expected rad, mrad or deg"),
        ("1.3 m", "rad", "14: 'm' is the wrong unit, expected rad, mrad or deg"),
        ("1.3 furlong", "m", "14: unknown unit 'furlong', expected m, cm or mm"),
        ("1.3 N m/A s", None, "14: unknown unit 'N m/A s', expected a unit such as m, rad, kg m2, N m or N m s/rad"),
        ("1.3 m/s/s", None, "14: unknown unit 'm/s/s', expected a unit such as m, rad, kg m2, N m or N m s/rad"),
        ("2 m", "1", "12: 'm' is the wrong unit, expected 1"),
        ("m", "m", "10: no number before 'm', expected a number in m, cm or mm"),
        ("", "m", "10: the value is empty, expected a number in m, cm or mm"),
        ("nan m", "m", "10: 'nan' is not a finite number, expected a finite number"),
        ("1e300 kN^9", None, "10: the number is too large, expected a finite number"),
        ("exec('1') m", "m", f"10: a call of 'exec', {GRAMMAR}"),
    ],
)
def test_refused_quantities(text: str, unit: str | None, message: str) -> None:
    with pytest.raises(InputError) as refused:
        parse_quantity(text, unit, HERE)
    assert str(refused.value) == f"arm.yaml:3:{message}"


def test_every_customary_unit_names_itself() -> None:
    for text in (
        "1",
        "kg",
        "kg m",
        "kg m2",
        "m",
        "rad",
        "m/s2",
        "N",
        "N m",
        "N/m",
        "N m/rad",
        "N s/m",
        "N m s/rad",
        "N m/A",
    ):
        unit = parse_unit(text, HERE)
        assert (unit.si, unit.factor) == (text, 1)


def test_vanishing() -> None:
    assert vanishes((D2 + Q3) ** 2 - D2**2 - 2 * D2 * Q3 - Q3**2)
    assert not vanishes(D2 - Q3)
    assert not vanishes(sympy.pi - sympy.Rational(355, 113))


_READERS: tuple[Callable[[str], sympy.Expr], ...] = (
    lambda text: parse(text, HERE),
    lambda text: parse_number(text, HERE),
    lambda text: parse_quantity(text, None, HERE).value,
    lambda text: parse_quantity(text, "m", HERE).value,
)


@settings(max_examples=500, deadline=None)
@given(st.one_of(st.text(max_size=30), st.text(alphabet="0123456789.eE+-*/^() piqd_'[", max_size=30)))
def test_any_text_is_an_exact_expression_or_refused(text: str) -> None:
    for read in _READERS:
        try:
            value = read(text)
        except InputError as refused:
            problem = str(refused)
        else:
            assert isinstance(value, sympy.Expr)
            assert not value.has(sympy.zoo, sympy.nan, sympy.oo, sympy.Float)
            continue
        assert re.match(r"arm\.yaml:3:\d+: \S", problem)


_LITERALS = st.one_of(
    st.integers(0, 999).map(str),
    st.decimals(0, 99, places=3, allow_nan=False, allow_infinity=False).map(lambda d: format(d, "f")),
)
_SUMS = st.recursive(
    _LITERALS,
    lambda inner: st.one_of(
        st.tuples(inner, st.sampled_from(["+", "-", "*", "/", " - ", " + "]), inner).map("".join),
        inner.map(lambda text: f"({text})"),
        inner.map(lambda text: f"-{text}"),
        st.tuples(inner, st.integers(-3, 3)).map(lambda pair: f"({pair[0]})**{pair[1]}"),
    ),
    max_leaves=10,
)


@settings(max_examples=500, deadline=None)
@given(_SUMS)
def test_arithmetic_is_that_of_fractions(text: str) -> None:
    """Python's own parser over Fraction is the reference, so precedence and associativity must agree."""
    # an exponent must stay an int for Fraction to remain exact
    reference = re.sub(r"\*\*-?\d+|(\d+(?:\.\d+)?)", lambda m: f"Fraction('{m[1]}')" if m[1] else m[0], text)
    try:
        expected = eval(reference, {"Fraction": Fraction})
    except ZeroDivisionError:
        with pytest.raises(InputError, match="division by zero"):
            parse(text, HERE)
        return
    value = parse(text, HERE)
    assert Fraction(int(value.p), int(value.q)) == expected


@pytest.mark.parametrize("text", ["0.05 1", "1/20 1", "(1/20) 1", "0.05"])
def test_a_pure_number_may_have_its_unit(text: str) -> None:
    for unit in ("1", None):
        quantity = parse_quantity(text, unit, HERE)
        assert (quantity.value, quantity.unit) == (sympy.Rational(1, 20), "1")
    with pytest.raises(InputError):
        parse_quantity(text, "m", HERE)


@pytest.mark.parametrize("text", ["0,375", "0,375 m", "1,5"])
def test_a_decimal_comma_is_told(text: str) -> None:
    with pytest.raises(InputError, match=r"unexpected ',', expected numbers, .*; decimals stand after a point"):
        parse_quantity(text, "m", HERE)
