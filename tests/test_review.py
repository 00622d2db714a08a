"""The review: its formulas against the groupings, the report's lists, the model's structure, and the page as a document."""

from __future__ import annotations

import os
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction
from functools import cache
from math import cos, degrees, floor, log, log10, pi, sin, sqrt
from pathlib import Path

import numpy as np
import pytest
import sympy

import generator.review.sections
from generator.backends import review
from generator.derivation import derive
from generator.resources import find_robot
from generator.review import laws
from generator.review.counts import ladder
from generator.review.decimals import decimal, rounded, scientific
from generator.review.formula import (
    Call,
    Equation,
    Formula,
    Name,
    Negative,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    formula,
    natural,
)
from generator.review.groupings import equations
from generator.review.markup import Markup, element
from generator.review.mathml import math
from generator.review.page import sections
from generator.review.picture.arm import draw
from generator.review.picture.skeleton import place, skeleton
from generator.review.plain import plain
from generator.review.plot import Curve, plot
from generator.review.tex import escape, tex
from generator.review.trigonometry import without_half_angles
from generator.robot.description import PRISMATIC
from generator.robot.readers import read
from generator.symbolic.bodies import INERTIAL
from generator.symbolic.interpret import evaluate
from generator.symbolic.model import Model
from tests.subject import Subject, Vector, close

XHTML = "{http://www.w3.org/1999/xhtml}"
SVG = "{http://www.w3.org/2000/svg}"

#: The lists of report sections 5.1 and 6.1, as printed.
REPORT = {
    "kr270_calibrated": """
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
    """,
    "kr500": """
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
    """,
}

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


@cache
def model(name: str) -> Model:
    return derive(read(find_robot(name)))


@cache
def files(of: Model) -> dict[str, str]:
    return {path: str(text) for path, text in review.emit(of).items()}


def listed(text: str) -> list[str]:
    return [line.strip() for line in text.strip().splitlines()]


def block(markdown: str, heading: str) -> list[str]:
    """The lines of the fenced block under a heading."""
    return markdown.split(f"\n## {heading}\n", 1)[1].split("```text\n", 1)[1].split("\n```", 1)[0].splitlines()


@cache
def page(of: Model) -> ElementTree.Element:
    return ElementTree.fromstring(files(of)["review.html"].removeprefix("<!DOCTYPE html>\n"))


def value(of: Formula, at: Mapping[str, float]) -> float:
    """The number of a formula; ``at`` holds its names, and "f(0)" for functions of nothing but numbers."""
    if isinstance(of, Number):
        return float(of.value)
    if isinstance(of, Name):
        return at[of.text]
    if isinstance(of, Negative):
        return -value(of.body, at)
    if isinstance(of, Power):
        return float(value(of.base, at) ** value(of.exponent, at))
    if isinstance(of, Quotient):
        return value(of.above, at) / value(of.below, at)
    if isinstance(of, Product):
        return float(np.prod([value(factor, at) for factor in of.factors]))
    if isinstance(of, Sum):
        return sum(value(term, at) for term in of.terms)
    assert isinstance(of, Call)
    if plain(of) in at:
        return at[plain(of)]
    known = {"sin": sin, "cos": cos, "sqrt": sqrt, "log": log, "sign": np.sign, "abs": abs}
    return float(known[of.function](value(of.argument, at)))


# -- formulas ---------------------------------------------------------------------------------------------------------

x, d2, d3, d10, rl4, phi, q2, fc = sympy.symbols("x d2 d3 d10 rl4 phi q2 Fc2", real=True)
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


# -- groupings --------------------------------------------------------------------------------------------------------


def parsed(line: str) -> tuple[str, list[tuple[str, float]]]:
    left, right = line.split(" = ")
    terms = re.findall(r"(?:^|([+-]) )(?:([\d.]+) )?([A-Z]\w*)", right)
    return left, [(name, (-1.0 if sign == "-" else 1.0) * float(size or 1)) for sign, size, name in terms]


@pytest.mark.parametrize("name", REPORT)
def test_numeric_groupings_are_those_of_the_report(name: str) -> None:
    lines = block(files(model(name))["groupings.md"], "Numeric")
    printed = listed(REPORT[name])
    assert len(lines) == len(printed) == 17
    for line, expected in zip(lines, printed, strict=True):
        left, terms = parsed(line)
        expected_left, expected_terms = parsed(expected)
        assert left == expected_left
        assert [term for term, _ in terms] == [term for term, _ in expected_terms]
        for (_, ours), (_, theirs) in zip(terms, expected_terms, strict=True):
            # Five digits are printed; 1.05365 is printed rounded both ways.
            last_digit = 10.0 ** (floor(log10(abs(theirs))) - 4)
            assert abs(ours - theirs) <= 0.5 * last_digit * (1 + 1e-9), line


@pytest.mark.parametrize("name", ["kr500", "kr270", "kr270_calibrated"])
def test_symbolic_groupings_of_both_robots(name: str) -> None:
    assert block(files(model(name))["groupings.md"], "Symbolic") == listed(SYMBOLIC)


def test_groupings_mean_what_they_say(arm: Subject) -> None:
    """Both equations, read back as numbers, give the base parameters of the model."""
    lengths = {length.name: float(length.value) for length in arm.robot.lengths}
    rng = np.random.default_rng(5)
    standard = {p.name: float(rng.normal()) for p in arm.model.standard_parameters}
    numbers = arm.model.grouping.numeric()
    for parameter, symbolic, numeric in equations(arm.model.grouping):
        exact = sum(c * standard[name] for name, c in numbers[parameter.name].items())
        assert symbolic.left == numeric.left == Name(parameter.name)
        assert value(symbolic.right, lengths | standard | {"pi": pi}) == pytest.approx(exact, rel=1e-11, abs=1e-11)
        assert value(numeric.right, standard) == pytest.approx(exact, rel=1e-5, abs=1e-5)


def test_every_standard_parameter_is_accounted_for_once(arm: Subject) -> None:
    markdown = files(arm.model)["groupings.md"]
    grouped = [parsed(line)[1][0][0] for line in block(markdown, "Numeric") if line]
    alone = [name for line in block(markdown, "Parameters that stand alone") if line for name in line.split()[2:]]
    left = re.findall(r"^\| (\w+) \|", markdown.split("## Why each parameter left")[1].split("## Geometry")[0], re.M)
    assert sorted(grouped + alone + left[1:]) == sorted(p.name for p in arm.model.standard_parameters)


def test_the_parameter_vector_is_listed_in_its_order(arm: Subject) -> None:
    table = files(arm.model)["groupings.md"].split("## Parameter vector")[1]
    rows = [line.split(" | ") for line in table.splitlines() if line.startswith("| ")][1:]
    assert [(row[0].removeprefix("| "), row[1]) for row in rows] == [(p.name, p.unit) for p in arm.model.parameters]


@pytest.mark.parametrize(
    ("name", "totals"),
    [("kr500", [36, 40, 58, 59]), ("kr270", [36, 40, 58, 60]), ("kr500_table5", [72, 82]), ("kr270_table5", [72, 82])],
)
def test_counts_of_the_report(name: str, totals: list[int]) -> None:
    assert [stage.total for stage in ladder(model(name))] == totals


def test_counts_are_ranks_of_the_regressor(arm: Subject) -> None:
    stages = ladder(arm.model)
    assert stages[-1].total == len(arm.model.base_parameters)
    rows = np.concatenate([arm.generated("regressor_standard", state(arm, seed))["W"] for seed in range(40)])
    bodies = {f"{stem}{body.number}" for body in arm.robot.bodies for stem in INERTIAL}
    inertial = [k for k, parameter in enumerate(arm.model.standard_parameters) if parameter.name in bodies]
    columns = rows[:, inertial]
    size = np.linalg.norm(columns, axis=0)
    assert stages[0].total == np.linalg.matrix_rank(columns[:, size > 1e-9] / size[size > 1e-9], tol=1e-8)


def state(arm: Subject, seed: int) -> dict[str, Vector]:
    return dict(zip(("q", "qd", "qdd"), arm.state(seed), strict=True))


# -- LaTeX ------------------------------------------------------------------------------------------------------------


def test_latex_is_balanced_and_complete(arm: Subject) -> None:
    text = files(arm.model)["groupings.tex"]
    bare = re.sub(r"\\[{}]", "", text)
    depth = 0
    for character in bare:
        depth += {"{": 1, "}": -1}.get(character, 0)
        assert depth >= 0
    assert depth == 0
    assert text.count(r"\left(") == text.count(r"\right)")
    assert re.findall(r"\\begin\{(\w+)\}", text).count("align") == re.findall(r"\\end\{(\w+)\}", text).count("align")
    assert text.count("$") % 2 == 0
    aligned = re.findall(r"\\begin\{align\}\n(.*?)\n\\end\{align\}", text, re.S)
    for block_ in aligned:
        lines = block_.split(" \\\\\n")
        assert all(line.count("&") == 1 for line in lines)
        starts = [line for line in lines if "&=" in line]
        assert len(starts) == len(equations(arm.model.grouping))


def test_latex_takes_text_literally() -> None:
    assert escape(r"50 % of a_b & {c} \d ~^#$") == (
        r"50 \% of a\_b \& \{c\} \textbackslash{}d \textasciitilde{}\textasciicircum{}\#\$"
    )


# -- the page ---------------------------------------------------------------------------------------------------------


def test_the_page_is_well_formed_and_fetches_nothing(arm: Subject) -> None:
    text = files(arm.model)["review.html"]
    root = ElementTree.fromstring(text.removeprefix("<!DOCTYPE html>\n"))
    anchors = {node.attrib["id"] for node in root.iter() if "id" in node.attrib}
    assert len(anchors) == len([node for node in root.iter() if "id" in node.attrib])
    for node in root.iter():
        assert node.tag not in {f"{XHTML}{tag}" for tag in ("script", "link", "img", "iframe", "object", "embed")}
        for name, content in node.attrib.items():
            assert not name.startswith("on")
            if name.rpartition("}")[2] in ("href", "src", "srcset", "data", "action", "poster"):
                assert content.startswith("#")
                assert content[1:] in anchors
    style = root.find(f"{XHTML}head/{XHTML}style")
    assert style is not None
    assert style.text is not None
    assert not re.search(r"url\(|@import|https?:", style.text)


def test_every_picture_has_a_title_and_a_description(arm: Subject) -> None:
    pictures = list(page(arm.model).iter(f"{SVG}svg"))
    assert len(pictures) >= 3
    for picture in pictures:
        assert picture.attrib["role"] == "img"
        assert (picture.findtext(f"{SVG}title") or "").strip()
        assert (picture.findtext(f"{SVG}desc") or "").strip()


def test_words_of_the_robot_file_are_text_not_markup() -> None:
    robot = replace(read(find_robot("scara")), description='<script>alert("1")</script> & 50 % {{x}}')
    made = files(derive(robot, ("regressor",)))
    root = ElementTree.fromstring(made["review.html"].removeprefix("<!DOCTYPE html>\n"))
    assert root.findtext(f"{XHTML}body/{XHTML}header/{XHTML}p") == robot.description
    assert "<script" not in made["review.html"]


def test_elements_escape_text_and_keep_markup() -> None:
    assert element("p", "a < b & c", element("b", "d"), None, ["e", 2], title='"') == (
        '<p title="&quot;">a &lt; b &amp; c<b>d</b>e2</p>'
    )
    assert element("path", d="M 0 0", stroke_width="2") == '<path d="M 0 0" stroke-width="2" />'


def test_a_new_file_is_a_new_section(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "zz_told_by_a_file.py").write_text(
        "from generator.review.markup import element\nTITLE = 'Told by a file'\nORDER = 55\n"
        "def render(model):\n    return element('p', model.robot.name)\n"
    )
    monkeypatch.setattr(generator.review.sections, "__path__", [*generator.review.sections.__path__, str(tmp_path)])
    try:
        found = sections(model("scara"))
    finally:
        sys.modules.pop("generator.review.sections.zz_told_by_a_file", None)
    told = next(section for section in found if section.title == "Told by a file")
    assert (told.anchor, told.body) == ("zz-told-by-a-file", Markup("<p>scara</p>"))
    titles = [section.title for section in found]
    assert titles.index("Groupings") < titles.index("Told by a file") < titles.index("Structure of the regressor")


def test_the_bytes_do_not_depend_on_the_hash_seed() -> None:
    code = (
        "import hashlib; from generator.backends import review; from generator.derivation import derive;"
        "from generator.resources import find_robot; from generator.robot.readers import read;"
        "files = review.emit(derive(read(find_robot('kr500'))));"
        "print({name: hashlib.sha256(text.encode()).hexdigest() for name, text in files.items()})"
    )
    seen = {
        subprocess.run(
            [sys.executable, "-c", code],
            env=os.environ | {"PYTHONHASHSEED": seed},
            capture_output=True,
            check=True,
            text=True,
        ).stdout
        for seed in ("1", "2")
    }
    assert len(seen) == 1


def test_no_path_and_no_date_is_written() -> None:
    for text in files(model("kr500")).values():
        assert str(Path(__file__).parent.parent) not in text
        assert not re.search(r"\b20\d\d-\d\d-\d\d\b", text)


# -- structure, operations, effects -----------------------------------------------------------------------------------


def test_the_grid_shows_the_regressors_structure(arm: Subject) -> None:
    picture = next(p for p in page(arm.model).iter(f"{SVG}svg") if p.attrib.get("class") == "regressor")
    shown = {
        (cell.findtext(f"{SVG}title") or "").split(" [")[0]
        for cell in picture.iter(f"{SVG}rect")
        if "cell" in cell.attrib["class"]
    }
    sparsity = arm.model.functions["regressor_packed"].sparsity
    assert sparsity is not None
    joints = [joint.number for joint in arm.robot.moving]
    names = [p.name for p in arm.model.base_parameters]
    packed = {f"τ{joints[i]}, {names[k]}" for i, k in zip(sparsity.rows, sparsity.columns, strict=True)}
    assert shown == packed
    samples = [arm.generated("regressor", state(arm, seed))["W"] for seed in range(6)]
    seen = np.any([abs(sample) > 1e-9 for sample in samples], axis=0)
    assert {f"τ{joints[i]}, {names[k]}" for i, k in np.argwhere(seen)} <= shown


def test_cells_lie_in_the_row_and_column_they_name() -> None:
    of = model("kr500")
    picture = next(p for p in page(of).iter(f"{SVG}svg") if p.attrib.get("class") == "regressor")
    cells = {
        (cell.findtext(f"{SVG}title") or "").split(" [")[0]: (float(cell.attrib["x"]), float(cell.attrib["y"]))
        for cell in picture.iter(f"{SVG}rect")
        if "cell" in cell.attrib["class"]
    }
    order = [p.name for p in of.base_parameters]
    for name, (across, down) in cells.items():
        torque, parameter = name.split(", ")
        step = (cells["τ6, Off6"][0] - cells["τ1, ZZ1R"][0]) / (len(order) - 1)
        assert across == pytest.approx(cells["τ1, ZZ1R"][0] + step * order.index(parameter), abs=0.2)
        assert down == pytest.approx(cells["τ1, ZZ1R"][1] + step * (int(torque[1:]) - 1), abs=0.2)


def test_operation_counts_are_those_of_the_functions(arm: Subject) -> None:
    section = next(s for s in page(arm.model).iter(f"{XHTML}section") if s.attrib["id"] == "operations")
    rows = {}
    for row in list(section.iter(f"{XHTML}tr"))[1:]:
        name, *cells = ("".join(cell.itertext()) for cell in row)
        rows[name] = [0 if cell == "·" else int(cell) for cell in cells[:7]]
    assert list(rows) == list(arm.model.functions)
    for name, function in arm.model.functions.items():
        count = function.count
        assert rows[name][:6] == [count.mul, count.add, count.div, count.trig, count.other, count.total]
        assert (rows[name][6] > 0) == any(
            node.parameter_only and node.operation not in ("constant", "input", "neg") for node in function.nodes
        )


def test_laws_mean_what_the_effects_do(arm: Subject) -> None:
    """The printed torque of each effect, read back as a number, is its column times its parameters."""
    for instance in arm.model.effects:
        number = str(instance.joint.number)
        at = {f"q{number}": 0.4, f"qd{number}": -0.7, f"qdd{number}": 1.3, "pi": pi}
        at |= {name: float(v) for name, v in instance.site.values.items()}
        at |= {name: 2.0 + k for k, name in enumerate(instance.names)}
        symbols = {sympy.Symbol(name, real=True): v for name, v in at.items()}
        (equation,) = laws.torque(instance, number)
        exact = sum(
            at[name] * float(sympy.sympify(column[instance.joint.number]).subs(symbols))
            for name, column in zip(instance.names, instance.columns(), strict=True)
        )
        assert equation.left == Name(f"tau{number}")
        assert value(equation.right, at) == pytest.approx(exact, rel=1e-12)
        told = dict(at)
        for equation in laws.observables(instance):
            assert isinstance(equation.left, Name)
            told[equation.left.text] = value(equation.right, told)
            told.setdefault("length(0)", value(equation.right, told | {f"q{number}": 0.0}))
        assert told.get("torque", exact) == pytest.approx(exact, rel=1e-12)


# -- balancer and plots -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("name", "angle"), [("kr500", -pi + 1.6293), ("kr270", -pi + 1.6148)])
def test_the_dead_centre_stands_where_the_lever_arm_ends(name: str, angle: float) -> None:
    plots = [p for p in page(model(name)).iter(f"{SVG}svg") if p.attrib.get("class") == "plot"]
    assert len(plots) == 3
    joint = model(name).robot.joints[1]
    assert joint.lower is not None
    assert joint.upper is not None
    low, high = degrees(float(joint.lower)), degrees(float(joint.upper))
    for picture in plots:
        (curve, *_) = (line for line in picture.iter(f"{SVG}polyline") if "curve" in line.attrib["class"])
        track = [tuple(map(float, pair.split(","))) for pair in curve.attrib["points"].split()]
        left, right = track[0][0], track[-1][0]
        (marker,) = (line for line in picture.iter(f"{SVG}path") if line.attrib["class"] == "marker")
        at = float(marker.attrib["d"].split()[1])
        assert low + (at - left) / (right - left) * (high - low) == pytest.approx(degrees(angle), abs=0.05)


@pytest.mark.parametrize("name", ["kr500", "kr270"])
def test_balancer_curves_are_the_generated_functions_values(name: str) -> None:
    of = model(name)
    pictures = [p for p in page(of).iter(f"{SVG}svg") if p.attrib.get("class") == "plot"]
    sets = [one for one in of.robot.parameter_sets.values() if {"F02", "Kr2"} & set(one.values)]
    assert sets
    joint = of.robot.joints[1]
    q = np.zeros((2, of.dof))
    assert joint.lower is not None
    assert joint.upper is not None
    q[:, 1] = float(joint.lower), float(joint.upper)
    parameters = of.default_parameters()
    for k, parameter in enumerate(of.parameters):
        if parameter.name in sets[0].values:
            parameters[k] = sets[0].values[parameter.name].value
    ends = evaluate(of.functions["balancer"], {"q": q, "parameters": parameters})
    for picture, (quantity, (first, last)) in zip(pictures, ends.items(), strict=True):
        assert quantity in (picture.findtext(f"{SVG}title") or "")
        ticks = [
            (float(label.attrib["y"]) - 4, float((label.text or "").replace("−", "-")))
            for label in picture.iter(f"{SVG}text")
            if label.attrib["class"] == "tick" and label.attrib["text-anchor"] == "end" and label.text != "dead centre"
        ]
        slope, zero = np.polyfit(*zip(*ticks, strict=True), 1)
        curve = next(line for line in picture.iter(f"{SVG}polyline") if "curve-0" in line.attrib["class"])
        track = [tuple(map(float, pair.split(","))) for pair in curve.attrib["points"].split()]
        assert slope * track[0][1] + zero == pytest.approx(first, abs=abs(0.2 * slope))
        assert slope * track[-1][1] + zero == pytest.approx(last, abs=abs(0.2 * slope))


def test_a_plot_stays_in_its_frame() -> None:
    across = [float(k) for k in range(11)]
    picture = ElementTree.fromstring(plot("t", "x [m]", "y [N]", across, [Curve("square", [k * k for k in across])]))
    _, _, width, height = map(float, picture.attrib["viewBox"].split())
    curve = picture.find(f".//{SVG}polyline")
    assert curve is not None
    track = [tuple(map(float, pair.split(","))) for pair in curve.attrib["points"].split()]
    assert all(0 < a < width and 0 < b < height for a, b in track)
    assert all(b > a for (a, _), (b, _) in zip(track, track[1:], strict=False))
    assert all(d < c for (_, c), (_, d) in zip(track, track[1:], strict=False))
    flat = plot("t", "x", "y", across, [Curve("flat", [2.0] * 11)])
    assert ElementTree.fromstring(flat).find(f".//{SVG}polyline") is not None


# -- the arm ----------------------------------------------------------------------------------------------------------


def test_the_drawn_frames_are_the_models(arm: Subject) -> None:
    q, _, _ = arm.state(3)
    robot = replace(
        arm.robot,
        lengths=tuple(
            replace(length, value=sympy.Float(arm.values[length.name])) if length.symbolic else length
            for length in arm.robot.lengths
        ),
    )
    placement = place(skeleton(robot), q)
    assert close(placement.frames[1:], arm.generated("transforms", {"q": q})["T"])
    for link, corners in zip(skeleton(robot).links, placement.corners, strict=True):
        assert close(corners[0], placement.frames[link.joint.antecedent, :3, 3])
        assert close(corners[3], placement.frames[link.joint.number, :3, 3])


def test_the_arm_is_drawn_within_its_limits(arm: Subject) -> None:
    drawing = draw(arm.robot)
    for joint, position in zip(arm.robot.moving, drawing.q, strict=True):
        assert joint.lower is None or position >= float(joint.lower) - 1e-9
        assert joint.upper is None or position <= float(joint.upper) + 1e-9


def test_the_arm_shows_its_joints_lengths_and_frames(robot_arm: Subject) -> None:
    drawing = draw(robot_arm.robot)
    texts = []
    for _, markup in drawing.views:
        picture = ElementTree.fromstring(markup)
        _, _, width, height = map(float, picture.attrib["viewBox"].split())
        for label in picture.iter(f"{SVG}text"):
            assert 0 < float(label.attrib["x"]) < width
            assert 0 < float(label.attrib["y"]) < height
            texts += "".join(label.itertext()).replace("\u200b", "").split(", ")
        symbols = [title.text or "" for title in picture.iter(f"{SVG}title")]
        for joint in robot_arm.robot.moving:
            kind = "prismatic" if joint.sigma == PRISMATIC else "revolute"
            assert f"joint {joint.number}, {kind}" in symbols
    assert {f"q{joint.number}" for joint in robot_arm.robot.moving} <= set(texts)
    for number in range(len(robot_arm.robot.joints) + 1):
        assert {f"x{number}", f"z{number}"} <= set(texts)
    written = {
        plain(formula(expression))
        for joint in robot_arm.robot.joints
        for expression in (joint.b, joint.d, joint.r)
        if expression != 0 and joint.variable not in expression.free_symbols
    }
    assert written <= set(texts)


def test_equations_have_their_sides() -> None:
    assert plain(Equation(Name("a"), Sum((Name("b"), Negative(Name("c")))))) == "a = b - c"
