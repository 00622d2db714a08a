"""The groupings of base parameters as the report prints them, which the tests compare as numbers and as text."""

from __future__ import annotations

import re
from decimal import Decimal

import sympy
from sympy.parsing.sympy_parser import convert_xor, implicit_multiplication, parse_expr, standard_transformations

#: Report section 5.1, KR270-2F.
SECTION_5_1 = """
ZZ1R = ZZ1 + Ia1 + YY2 + 0.12241 M2 + YY3 + 1.685 M3 + 1.6881 M4 + 1.6881 M5 + 1.6881 M6
XX2R = XX2 - YY2 - 1.5626 M3 - 1.5626 M4 - 1.5626 M5 - 1.5626 M6
XZ2R = XZ2 - 1.25 MZ3
ZZ2R = ZZ2 + Ia2 + 1.5626 M3 + 1.5626 M4 + 1.5626 M5 + 1.5626 M6
MX2R = MX2 + 1.25 M3 + 1.25 M4 + 1.25 M5 + 1.25 M6
XX3R = XX3 - YY3 + YY4 - 2.2 MZ4 + 1.207 M4 + 1.207 M5 + 1.207 M6
XY3R = XY3 - 0.055187 MZ4 + 0.060706 M4 + 0.060706 M5 + 0.060706 M6
ZZ3R = ZZ3 + YY4 - 2.2 MZ4 + 1.213 M4 + 1.213 M5 + 1.213 M6
MX3R = MX3 + 0.055187 M4 + 0.055187 M5 + 0.055187 M6
MY3R = MY3 + MZ4 - 1.1 M4 - 1.1 M5 - 1.1 M6
XX4R = XX4 - YY4 + YY5
ZZ4R = ZZ4 + YY5
MY4R = MY4 - MZ5
XX5R = XX5 - YY5 + YY6 - 0.46 MZ6 + 0.0529 M6
ZZ5R = ZZ5 + YY6 - 0.46 MZ6 + 0.0529 M6
MY5R = MY5 + MZ6 - 0.23 M6
XX6R = XX6 - YY6
"""

#: Report section 6.1, KR500-2MT; ZZ3R's one coefficient 1.05365 is printed there rounded both ways.
SECTION_6_1 = """
ZZ1R = ZZ1 + Ia1 + YY2 + 0.25 M2 + YY3 + 1.94 M3 + 1.943 M4 + 1.943 M5 + 1.943 M6
XX2R = XX2 - YY2 - 1.69 M3 - 1.69 M4 - 1.69 M5 - 1.69 M6
XZ2R = XZ2 - 1.3 MZ3
ZZ2R = ZZ2 + Ia2 + 1.69 M3 + 1.69 M4 + 1.69 M5 + 1.69 M6
MX2R = MX2 + 1.3 M3 + 1.3 M4 + 1.3 M5 + 1.3 M6
XX3R = XX3 - YY3 + YY4 - 2.05 MZ4 + 1.0476 M4 + 1.0476 M5 + 1.0476 M6
XY3R = XY3 + 0.055 MZ4 - 0.056375 M4 - 0.056375 M5 - 0.056375 M6
ZZ3R = ZZ3 + YY4 - 2.05 MZ4 + 1.0536 M4 + 1.0536 M5 + 1.0537 M6
MX3R = MX3 - 0.055 M4 - 0.055 M5 - 0.055 M6
MY3R = MY3 + MZ4 - 1.025 M4 - 1.025 M5 - 1.025 M6
XX4R = XX4 - YY4 + YY5
ZZ4R = ZZ4 + YY5
MY4R = MY4 - MZ5
XX5R = XX5 - YY5 + YY6 - 0.58 MZ6 + 0.0841 M6
ZZ5R = ZZ5 + YY6 - 0.58 MZ6 + 0.0841 M6
MY5R = MY5 + MZ6 - 0.29 M6
XX6R = XX6 - YY6
"""

#: The same 17 groupings in the lengths of Table 4.
SYMBOLIC = """
ZZ1R = ZZ1 + Ia1 + YY2 + d2^2 M2 + YY3 + (d2^2 + d3^2) M3 + (d2^2 + d3^2 + d4^2) (M4 + M5 + M6)
XX2R = XX2 - YY2 - d3^2 (M3 + M4 + M5 + M6)
XZ2R = XZ2 - d3 MZ3
ZZ2R = ZZ2 + Ia2 + d3^2 (M3 + M4 + M5 + M6)
MX2R = MX2 + d3 (M3 + M4 + M5 + M6)
XX3R = XX3 - YY3 + YY4 + 2 rl4 MZ4 + (rl4^2 - d4^2) (M4 + M5 + M6)
XY3R = XY3 - d4 MZ4 - d4 rl4 (M4 + M5 + M6)
ZZ3R = ZZ3 + YY4 + 2 rl4 MZ4 + (d4^2 + rl4^2) (M4 + M5 + M6)
MX3R = MX3 + d4 (M4 + M5 + M6)
MY3R = MY3 + MZ4 + rl4 (M4 + M5 + M6)
XX4R = XX4 - YY4 + YY5
ZZ4R = ZZ4 + YY5
MY4R = MY4 - MZ5
XX5R = XX5 - YY5 + YY6 + 2 rl6 MZ6 + rl6^2 M6
ZZ5R = ZZ5 + YY6 + 2 rl6 MZ6 + rl6^2 M6
MY5R = MY5 + MZ6 + rl6 M6
XX6R = XX6 - YY6
"""

_TERM = re.compile(r"([+-]) (?:(\d[\d.]*) )?([A-Za-z]+\d)")
_ROUNDED_BOTH_WAYS = dict.fromkeys((Decimal("1.0536"), Decimal("1.0537")), Decimal("1.05365"))
_LENGTHS = ("d2", "d3", "d4", "rl4", "rl6")


def printed(text: str) -> dict[str, dict[str, Decimal]]:
    """Groupings that are printed in numbers: {name: {standard parameter: coefficient}}."""
    result = {}
    for line in text.strip().splitlines():
        name, terms = line.split(" = ")
        found = {one[2]: Decimal(one[0] + (one[1] or "1")) for one in _TERM.findall(f"+ {terms}")}
        result[name] = {term: _ROUNDED_BOTH_WAYS.get(value, value) for term, value in found.items()}
    return result


def in_symbols(text: str) -> dict[str, dict[str, str]]:
    """Groupings that are printed in symbols, without the first term of each, whose coefficient is one."""
    result = {}
    for line in text.strip().splitlines():
        name, terms = line.split(" = ")
        sum_ = sympy.expand(
            parse_expr(terms, transformations=(*standard_transformations, convert_xor, implicit_multiplication))
        )
        standard = {str(one): sum_.coeff(one) for one in sum_.free_symbols if str(one) not in _LENGTHS}
        assert standard.pop(name.removesuffix("R")) == 1
        result[name] = {term: str(coefficient) for term, coefficient in standard.items()}
    return result
