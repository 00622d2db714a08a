"""Nodes to text: parentheses, literals, names, and the order of rounding."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from generator.backends.printing.identifiers import C_RESERVED, PYTHON_RESERVED, Identifiers
from generator.backends.printing.language import LINE, Language
from generator.backends.printing.prepared import index, signal_of
from generator.backends.printing.straight_line import Block, straight_line
from generator.resources import templates
from generator.symbolic.statements import FUNCTIONS, Node, Program
from tests.toy import OPERATIONS, VALUES, interpreted, programs

PLAIN = Language(
    calls={name: name for name in (*FUNCTIONS, "pow")},
    statement="{name} = {value}",
    literal="{value}",
    reserved=PYTHON_RESERVED | set(FUNCTIONS) | {"pow"},
)


def printed(program: Program, roots: list[Node], language: Language = PLAIN) -> Block:
    """The code of ``roots`` with input k of signal s written s[k]."""
    nodes = program.reachable(roots)
    leaves = {node: f"{signal_of(node)}[{index(node)}]" for node in nodes if node.operation == "input"}
    names = Identifiers(language.reserved | {"q", "wrench", "parameters"})
    return straight_line(nodes, roots, leaves, language, names)


def abc(program: Program) -> tuple[Node, Node, Node, Node]:
    a, b, c, d = (program.input(letter, 0) for letter in "abcd")
    return a, b, c, d


@pytest.mark.parametrize(
    ("build", "text"),
    [
        (lambda p, a, b, c, d: a + b + c, "c + (a + b)"),
        (lambda p, a, b, c, d: a + (b + c), "a + (b + c)"),
        (lambda p, a, b, c, d: a - (b + c), "a - (b + c)"),
        (lambda p, a, b, c, d: a - (b - c), "a - (b - c)"),
        (lambda p, a, b, c, d: a - b - c, "a - b - c"),
        (lambda p, a, b, c, d: a * (b * c), "a*(b*c)"),
        (lambda p, a, b, c, d: a * b * c, "c*(a*b)"),
        (lambda p, a, b, c, d: (a + b) * c, "c*(a + b)"),
        (lambda p, a, b, c, d: (a + b) * (c + d), "(a + b)*(c + d)"),
        (lambda p, a, b, c, d: a / (b * c), "a/(b*c)"),
        (lambda p, a, b, c, d: a / b / c, "a/b/c"),
        (lambda p, a, b, c, d: a / (b / c), "a/(b/c)"),
        (lambda p, a, b, c, d: a / b * c, "c*(a/b)"),
        (lambda p, a, b, c, d: a * b / c, "a*b/c"),
        (lambda p, a, b, c, d: (a - b) / (c + d), "(a - b)/(c + d)"),
        (lambda p, a, b, c, d: -(a + b), "-(a + b)"),
        (lambda p, a, b, c, d: -(a - b), "b - a"),
        (lambda p, a, b, c, d: -(a - b * c), "b*c - a"),
        (lambda p, a, b, c, d: -(a + b - (c + d)), "c + d - (a + b)"),
        (lambda p, a, b, c, d: -a * b, "-a*b"),
        (lambda p, a, b, c, d: -a / b, "-a/b"),
        (lambda p, a, b, c, d: -a, "-a"),
        (lambda p, a, b, c, d: a + -b, "a - b"),
        (lambda p, a, b, c, d: a * -2, "-2.0*a"),
        (lambda p, a, b, c, d: a - Fraction(1, 3), "a - 0.3333333333333333"),
        (lambda p, a, b, c, d: p.constant(-2), "-2.0"),
        (lambda p, a, b, c, d: p.constant(0), "0.0"),
        (lambda p, a, b, c, d: p.function("log", -a), "log(-a)"),
        (lambda p, a, b, c, d: p.function("sqrt", a + b) * c, "c*sqrt(a + b)"),
        (lambda p, a, b, c, d: p.power(a + b, Fraction(2, 3)), "pow(a + b, 0.6666666666666666)"),
    ],
)
def test_parentheses(build: Callable[..., Node], text: str) -> None:
    program = Program()
    a, b, c, d = abc(program)
    block = printed(program, [build(program, a, b, c, d)])
    assert (block.statements, block.results[0].replace("[0]", "")) == ((), text)


@given(programs())
def test_rounds_like_the_nodes(built: tuple[Program, list[Node]]) -> None:
    program, roots = built
    block = printed(program, roots)
    scope: dict[str, object] = {**VALUES, **OPERATIONS}
    exec("\n".join(block.statements), scope)
    expected = interpreted(roots, VALUES)
    assert [eval(result, scope) for result in block.results] == [expected[root] for root in roots]


@given(programs())
def test_computes_every_node_once(built: tuple[Program, list[Node]]) -> None:
    program, roots = built
    block = printed(program, roots)
    text = " ".join([*block.statements, *block.results])
    count = Counter(node.operation for node in program.reachable(roots))
    # The language has no function for what is directed: it is a product with a sign.
    count["sign"], count["mul"] = count["sign"] + count["directed"], count["mul"] + count["directed"]
    for name in FUNCTIONS:
        assert len(re.findall(rf"\b{name}\(", text)) == count[name]
    assert text.count("*") == count["mul"]


@given(programs(steps=60))
def test_lines_fit(built: tuple[Program, list[Node]]) -> None:
    program, roots = built
    assert all(len(line) <= LINE for line in printed(program, roots).statements)


def test_cuts_a_long_sum() -> None:
    program = Program()
    total = program.zero
    for place in range(200):
        total = total + program.input("q", place) * program.input("wrench", place)
    block = printed(program, [-total])
    assert 20 < len(block.statements) < 60
    assert max(map(len, (*block.statements, *block.results))) <= LINE


@given(st.floats(0, allow_nan=False, allow_infinity=False))
def test_literals_read_back(value: float) -> None:
    literal = PLAIN.number(Fraction(value))
    assert float(literal) == value
    assert literal == repr(value)


def test_a_constant_beyond_double_precision_is_refused() -> None:
    with pytest.raises(OverflowError):
        PLAIN.number(Fraction(10) ** 400)


def test_names_of_nodes_are_kept_and_temporaries_numbered() -> None:
    program = Program()
    a, b, c, d = abc(program)
    named, shared = a + b, c * d
    named.name = "W3_2"
    block = printed(program, [named * shared, named - shared])
    assert block.statements == ("t1 = c[0]*d[0]", "W3_2 = a[0] + b[0]")
    assert block.results == ("W3_2*t1", "W3_2 - t1")


def test_of_two_nodes_with_one_name_the_whole_has_it() -> None:
    program = Program()
    a, b, c, d = abc(program)
    part = a * b
    whole = part + c * d
    part.name = whole.name = "WP2_1"
    block = printed(program, [whole, part])
    assert block.statements == ("t1 = a[0]*b[0]", "WP2_1 = t1 + c[0]*d[0]")


def test_taken_names_are_not_given_twice() -> None:
    names = Identifiers({"q", "double"})
    assert [names.claim(wish) for wish in ("q", "q", "q", "double", "2x", "a-b", "a b")] == [
        "q_",
        "q_v2",
        "q_v3",
        "double_",
        "_2x",
        "a_b",
        "a_b_",
    ]
    names.claim("t2")
    assert [names.temporary() for _ in range(3)] == ["t1", "t3", "t4"]


@pytest.mark.parametrize(
    "word", ["double", "restrict", "class", "template", "y0", "I", "linux", "static_assert", "typeof_unqual"]
)
def test_words_of_c_and_cpp_are_reserved(word: str) -> None:
    assert word in C_RESERVED


@pytest.mark.parametrize("word", ["lambda", "None", "is", "tuple"])
def test_words_of_python_are_reserved(word: str) -> None:
    assert word in PYTHON_RESERVED


def test_macros_of_the_templates_are_reserved() -> None:
    """A parameter's name becomes that of a field, which a macro of the same name would replace."""
    texts = [path.read_text() for folder in ("c", "batch", "simulation") for path in (templates() / folder).iterdir()]
    macros = {name for text in texts for name in re.findall(r"^ *# *define +([A-Za-z_]+)(?![A-Za-z_{])", text, re.M)}
    assert "WIDTH" in macros
    assert macros <= C_RESERVED
