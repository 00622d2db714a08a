"""What the tests of the review share: a robot's review as text and as a tree, and a reader of its formulas."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ElementTree
from collections.abc import Callable, Mapping
from functools import cache
from math import cos, exp, log, sin, sqrt, tan, tanh

import numpy as np

from generator.backends import review
from generator.review.formula import (
    Call,
    Formula,
    Name,
    Negative,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
)
from generator.review.plain import plain
from generator.symbolic.model import Model
from tests.conftest import derived
from tests.subject import Subject, Vector

XHTML = "{http://www.w3.org/1999/xhtml}"
SVG = "{http://www.w3.org/2000/svg}"


def model(name: str) -> Model:
    return derived(name).model


@cache
def files(of: Model) -> dict[str, str]:
    return {path: str(text) for path, text in review.emit(of).items()}


def listed(text: str) -> list[str]:
    return [line.strip() for line in text.strip().splitlines()]


def block(markdown: str, heading: str) -> list[str]:
    """The lines of the fenced block under a heading; "none" stands for no line."""
    lines = markdown.split(f"\n## {heading}\n", 1)[1].split("```text\n", 1)[1].split("\n```", 1)[0].splitlines()
    return [] if lines == ["none"] else lines


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
    known: dict[str, Callable[[float], float]] = {
        "sin": sin,
        "cos": cos,
        "tan": tan,
        "sqrt": sqrt,
        "log": log,
        "exp": exp,
        "tanh": tanh,
        "sign": np.sign,
        "abs": abs,
    }
    return float(known[of.function](value(of.argument, at)))


def parsed(line: str) -> tuple[str, list[tuple[str, float]]]:
    left, right = line.split(" = ")
    terms = re.findall(r"(?:^|([+-]) )(?:([\d.]+) )?([A-Za-z]\w*)", right)
    return left, [(name, (-1.0 if sign == "-" else 1.0) * float(size or 1)) for sign, size, name in terms]


def state(arm: Subject, seed: int) -> dict[str, Vector]:
    return dict(zip(("q", "qd", "qdd"), arm.state(seed), strict=True))
