"""Formulas of the review: reading order, three notations, decimals, and the effects' laws read back as numbers."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from fractions import Fraction
from math import pi
from pathlib import Path

import numpy as np
import pytest
import sympy

from generator.effects.library import effects_of
from generator.review import laws
from generator.review.decimals import decimal, rounded, scientific
from generator.review.formula import (
    Name,
    formula,
    natural,
)
from generator.review.mathml import math
from generator.review.plain import plain
from generator.review.tex import tex
from generator.review.trigonometry import without_half_angles
from generator.robot.readers import read
from tests.reviewed import value
from tests.subject import Subject

x, d2, d3, d10, rl4, phi, q2, fc = sympy.symbols("x d2 d3 d10 rl4 phi q2 Fc2", real=True)
TAN = sympy.tan(x / 2)
#: What is left of irrational numbers, carried to sixty digits, that are one together.
NOTHING = sympy.Rational(37, 10**59)
ROOT = sympy.sqrt(d2**2 + d3**2 + 2 * d2 * d3 * sympy.cos(phi + q2))


@pytest.mark.parametrize(
    ("expression", "text", "latex"),
    [
        (rl4**2 - d3**2, "rl4^2 - d3^2", r"\mathit{rl}_{4}^{2} - d_{3}^{2}"),
        (-(d3**2) + rl4**2 - d2, "rl4^2 - d3^2 - d2", r"\mathit{rl}_{4}^{2} - d_{3}^{2} - d_{2}"),
        (d10 + d2, "d2 + d10", r"d_{2} + d_{10}"),
        (q2 - sympy.pi / 2, "q2 - pi/2", r"q_{2} - \frac{\pi}{2}"),
        (-sympy.pi / 2, "-pi/2", r"-\frac{\pi}{2}"),
        (2 * rl4, "2 rl4", r"2 \, \mathit{rl}_{4}"),
        (sympy.Rational(43, 100) * d2, "0.43 d2", r"0.43 \, d_{2}"),
        (sympy.sqrt(2) * d2 / 2, "sqrt(2) d2/2", r"\frac{\sqrt{2} \, d_{2}}{2}"),
        (
            -fc * d2 * sympy.sin(phi + q2) / ROOT,
            "-Fc2 d2 sin(phi + q2)/sqrt(d2^2 + d3^2 + 2 d2 d3 cos(phi + q2))",
            r"-\frac{\mathit{Fc}_{2} \, d_{2} \, \sin\left(\phi + q_{2}\right)}"
            r"{\sqrt{d_{2}^{2} + d_{3}^{2} + 2 \, d_{2} \, d_{3} \, \cos\left(\phi + q_{2}\right)}}",
        ),
        (sympy.sign(q2) * fc, "Fc2 sign(q2)", r"\mathit{Fc}_{2} \, \operatorname{sign}\left(q_{2}\right)"),
        ((d2 / d3) ** sympy.Rational(13, 10), "(d2/d3)^1.3", r"\left(\frac{d_{2}}{d_{3}}\right)^{1.3}"),
        ((d2 + d3) ** 2, "(d2 + d3)^2", r"\left(d_{2} + d_{3}\right)^{2}"),
        (sympy.Integer(0), "0", "0"),
        ((1 + NOTHING) * d2 + d3 / 2, "d2 + d3/2", r"d_{2} + \frac{d_{3}}{2}"),
        (d2 - (1 - NOTHING) * d3, "d2 - d3", "d_{2} - d_{3}"),
        (1 + NOTHING, "1", "1"),
    ],
)
def test_a_formula_reads_as_on_paper(expression: sympy.Expr, text: str, latex: str) -> None:
    tree = formula(expression)
    assert plain(tree) == text
    assert tex(tree) == latex
    assert ElementTree.fromstring(math(tree)).attrib["alttext"] == text
    at = {symbol.name: 0.3 + 0.21 * k for k, symbol in enumerate(sorted(expression.free_symbols, key=str))}
    exact = float(expression.subs({symbol: at[symbol.name] for symbol in expression.free_symbols}))
    assert value(tree, {"pi": pi, **at}) == pytest.approx(exact, rel=1e-12)


def test_mathml_has_indices_powers_and_dots() -> None:
    markup = str(math(formula(sympy.Symbol("qdd_j") * d2**2)))
    assert "<msubsup><mi>d</mi><mn>2</mn><mn>2</mn></msubsup>" in markup
    assert '<msub><mi class="word">q\u0308</mi><mi>j</mi></msub>' in markup


def test_names_sort_by_their_numbers() -> None:
    assert sorted(["d10", "d2", "a3", "d2a"], key=natural) == ["a3", "d2", "d2a", "d10"]


@pytest.mark.parametrize(
    ("number", "text"),
    [
        (Fraction(1943025, 1000000), "1.943025"),
        (Fraction(2, 3), "0.6666667"),
        (Fraction(-1045, 1000), "-1.045"),
        (Fraction(1, 8), "0.125"),
        (Fraction(1, 10**9), "0.000000001"),
        (Fraction(7), "7"),
    ],
)
def test_decimals_are_exact_where_they_end(number: Fraction, text: str) -> None:
    assert decimal(number) == text


def test_rounding_is_half_to_even_and_without_trailing_zeros() -> None:
    assert rounded(Fraction(105365, 100000), 5) == "1.0536"
    assert rounded(Fraction(105375, 100000), 5) == "1.0538"
    assert rounded(Fraction(1685, 1000), 7) == "1.685"


@pytest.mark.parametrize(
    ("number", "text"), [(6.21e6, "6.21e6"), (0.0, "0"), (-37.5, "-37.5"), (4.5e-5, "4.5e-5"), (24500.0, "24500")]
)
def test_values_turn_to_powers_of_ten_only_where_long(number: float, text: str) -> None:
    assert scientific(number) == text


@pytest.mark.parametrize("squares", [(1, 0, 0), (0, 0, 1), (1, 1, 1), (2, 3, 5), (0, 2, 0)])
def test_half_angles_become_sines_and_cosines(squares: tuple[int, int, int]) -> None:
    a, b, c = squares
    t = sympy.tan(x / 2)
    cosine, sine = (1 - t**2) / (1 + t**2), 2 * t / (1 + t**2)
    expression = sympy.together(a * cosine**2 + b * d2 * cosine * sine + c * sine**2)
    result = without_half_angles(expression)
    assert not result.has(sympy.tan)
    assert result.free_symbols <= {x, d2}
    for at in (0.3, 1.1, -2.0):
        numbers = {x: at, d2: 0.7}
        assert float(result.subs(numbers)) == pytest.approx(float(expression.subs(numbers)), abs=1e-12)


@pytest.mark.parametrize(
    ("written", "read"),
    [
        (-2 * TAN / (TAN**2 - 1), sympy.tan(x)),
        (d2 / TAN - d2 * TAN, 2 * d2 * sympy.cos(x) / sympy.sin(x)),
        ((1 + TAN**2) / (1 - TAN**2), 1 / sympy.cos(x)),
        (4 * d2 * TAN**2 / (1 - TAN**2) ** 2, d2 * sympy.tan(x) ** 2),
    ],
)
def test_half_angles_below_a_line_become_tangents_too(written: sympy.Expr, read: sympy.Expr) -> None:
    assert without_half_angles(written) == read
    assert float(written.subs({x: 0.37, d2: 0.7})) == pytest.approx(float(read.subs({x: 0.37, d2: 0.7})), rel=1e-12)


def test_joints_with_one_law_have_the_same_numbers_in_it(tmp_path: Path) -> None:
    """An exponent, another joint or a rotor of nothing stands in a law as it is."""
    (tmp_path / "arm.yaml").write_text(
        "name: arm\ngravity: [0 m/s2, 0 m/s2, -9.81 m/s2]\njoints:\n"
        "  - {j: 1, sigma: 0, alpha: 0, d: 0, theta: q1, r: 0}\n"
        "  - {j: 2, sigma: 0, alpha: pi/2, d: 0, theta: q2, r: 0}\n"
        "  - {j: 3, sigma: 0, alpha: 0, d: 0.4 m, theta: q3, r: 0}\n"
        "effects:\n"
        "  - {effect: power_friction, joints: [1, 3], values: {v: 1 rad/s, exponent: 2}}\n"
        "  - {effect: power_friction, joint: 2, values: {v: 2 rad/s, exponent: 3}}\n"
        "  - {effect: load_friction, joint: 1}\n"
        "  - {effect: load_friction, joint: 2, values: {rotor: 3 kg m2}}\n"
        "  - {effect: load_friction, joint: 3, values: {rotor: 4 kg m2}}\n"
    )
    groups = laws.alike(effects_of(read(tmp_path / "arm.yaml")))
    joints = [(group[0].effect.id, [one.joint.number for one in group]) for group in groups]
    assert sorted(joints) == [
        ("load_friction", [1]),
        ("load_friction", [2, 3]),
        ("power_friction", [1, 3]),
        ("power_friction", [2]),
    ]


def test_a_motor_that_two_joints_turn_shows_on_both(tmp_path: Path) -> None:
    """Motor speed = N joint speed with N = [[10, 0], [-5, 10]]; motors 1 and 3 turn with their own joints alone."""
    (tmp_path / "wrist.yaml").write_text(
        "name: wrist\ngravity: [0 m/s2, 0 m/s2, -9.81 m/s2]\njoints:\n"
        + "".join(f"  - {{j: {j}, sigma: 0, alpha: pi/2, d: 0, theta: q{j}, r: 0}}\n" for j in (1, 2, 3))
        + "drives: {gear_ratios: [10, 10, 10], coupling: {N21: 1/2}}\n"
        "effects:\n  - {effect: motor_ripple, joints: all}\n"
    )
    groups = laws.alike(effects_of(read(tmp_path / "wrist.yaml")))
    assert [[one.joint.number for one in group] for group in groups] == [[1, 3], [2]]
    at = dict.fromkeys(("Rms2", "Rm2c2", "Rm2s2", "q2"), 0.0) | {"Rmc2": 1, "q1": 0.3, "order": 1, "N21": -5, "N22": 10}
    found = {plain(one.left): value(one.right, at) for one in laws.torque(groups[1][0], "2")}
    assert found == pytest.approx({"tau1": -0.5 * np.cos(-1.5), "tau2": np.cos(-1.5)})


def test_laws_mean_what_the_effects_do(arm: Subject) -> None:
    """The printed torque of each effect, read back as a number, is its column times its parameters."""
    for instance in arm.model.effects:
        number = str(instance.joint.number)
        at = {f"{stem}{j.number}": 0.1 * j.number for j in arm.robot.moving for stem in ("q", "qd", "qdd")} | {"pi": pi}
        at |= {f"q{number}": 0.4, f"qd{number}": -0.7, f"qdd{number}": 1.3}
        at |= {f"load{number}": -8.5, f"warmth{number}": 0.3}
        at |= {f"{state.stem}{number}": 0.45 for state in instance.effect.states}
        at |= {f"N{number}{j}": float(ratio) for j, ratio in instance.site.ratios.items()}
        at[f"N{number}"] = float(instance.site.ratios.get(instance.joint.number, 0))
        at |= {name: float(v) for name, v in instance.site.values.items()}
        at |= {name: 2.0 + k for k, name in enumerate(instance.names)}
        symbols = {sympy.Symbol(name, real=True): v for name, v in at.items()}
        torques = dict.fromkeys(sorted({j for column in instance.columns() for j in column}), 0.0)
        for name, column in zip(instance.names, instance.columns(), strict=True):
            for j, per_unit in column.items():
                torques[j] += at[name] * float(sympy.sympify(per_unit).subs(symbols))
        printed = {equation.left: value(equation.right, at) for equation in laws.torque(instance, number)}
        assert printed == pytest.approx({Name(f"tau{j}"): one for j, one in torques.items()}, rel=1e-12)
        exact = torques[instance.joint.number]
        told = dict(at)
        for equation in laws.observables(instance):
            assert isinstance(equation.left, Name)
            told[equation.left.text] = value(equation.right, told)
            told.setdefault("length(0)", value(equation.right, told | {f"q{number}": 0.0}))
        assert told.get("torque", exact) == pytest.approx(exact, rel=1e-12)
