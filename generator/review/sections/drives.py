"""Gear ratios, torque constants and the coupling of the drives."""

from __future__ import annotations

from fractions import Fraction

import sympy

from generator.constants import exact_constant
from generator.review.decimals import decimal, rounded
from generator.review.formula import Call, Equation, Formula, Name, Negative, Number, Power, Product, Quotient, formula
from generator.review.markup import Content, Markup, element, join, table
from generator.review.mathml import math, mathml, matrix
from generator.review.stated import torque_constant_heads
from generator.robot.description import Drives
from generator.symbolic.model import Model
from generator.words import minus, unit

TITLE = "Drives"
ORDER = 100


def render(model: Model) -> Markup | None:
    drives = model.robot.drives
    if drives is None:
        return None
    transposed = Power(Name("N"), Name("T"))
    laws = [
        Equation(Name("qd_r"), Product((Name("N"), Name("qd")))),
        Equation(Name("tau"), Product((transposed, Name("tau_r")))),
    ]
    if drives.torque_constants:
        laws.append(Equation(Name("tau"), Product((transposed, Call("diag", Name("kt")), Name("I")))))
    drift = ", ".join(str(_shown(part, 4)) for part in drives.torque_drift)
    return join(
        element("p", "Motor speeds, torques and currents; index r is the rotor's side."),
        element("p", [[math(law), " "] for law in laws], class_="laws"),
        _table(model, drives),
        element("p", f"Relative change of the torque constants at warmth 1, motor by motor: {drift}.")
        if drift
        else None,
        element("h3", "Coupling matrix"),
        _coupling("=", [[exact(entry) for entry in row] for row in drives.coupling]),
        _coupling("≈", [[_rounded(exact_constant(entry)) for entry in row] for row in drives.coupling]),
    )


def _coupling(relation: str, entries: list[list[Formula]]) -> Markup:
    inside = element("mrow", mathml(Name("N")), element("mo", relation), matrix(entries))
    return element("div", element("math", inside), class_="wide law")


def _table(model: Model, drives: Drives) -> Markup:
    heads = ["joint", "gear ratio", "≈", *torque_constant_heads(drives)]
    if drives.torque_constants:
        heads.append("drive gain")
    rows: list[list[Content]] = []
    for k, joint in enumerate(model.robot.moving):
        ratio = drives.ratios[k]
        in_unit = "" if joint.ratio_unit == "1" else f"\u00a0{joint.ratio_unit}"
        size = exact_constant(ratio)
        row: list[Content] = [str(joint.number), [math(exact(ratio)), in_unit], _shown(size, 6) + in_unit]
        row += [_shown(constants[k], 6) for constants in drives.torque_constants.values()]
        if drives.torque_constants:
            gain = _shown(size * drives.torque_constants[drives.torque_constant][k], 6)
            row.append(f"{gain}\u00a0{unit(joint.gain_unit)}")
        rows.append(row)
    return table(heads, rows, class_="numbers")


def exact(value: sympy.Expr) -> Formula:
    """A rational number as a fraction, any other as it is."""
    if not value.is_Rational:
        return formula(value)
    size = abs(exact_constant(value))
    body: Formula = Number(size)
    if size.denominator != 1:
        body = Quotient(Number(Fraction(size.numerator)), Number(Fraction(size.denominator)))
    return Negative(body) if value < 0 else body


def _rounded(value: Fraction) -> Formula:
    size = Number(Fraction(rounded(abs(value), 6)))
    return Negative(size) if value < 0 else size


def _shown(value: Fraction, digits: int) -> str:
    return minus(rounded(value, digits) if value.denominator != 1 else decimal(value))
