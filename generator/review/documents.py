"""What the text documents of the review say, in plain rows that their templates arrange."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

from generator.review import stated
from generator.review import tex as latex
from generator.review.counts import Stage, ladder
from generator.review.formula import Equation, Name, Sum
from generator.review.geometry import length_value, limits, rows
from generator.review.groupings import alone, equations, without_effect
from generator.review.plain import plain
from generator.robot.description import Robot
from generator.symbolic.model import Model

#: Characters of a formula, commands not counted, after which LaTeX goes on in a new line.
_LINE = 62


@dataclass(frozen=True)
class Document:
    """Everything in the groupings' documents; tables have their head first.

    ``built_in`` is None where the functions have a parameter vector.
    """

    robot: Robot
    lengths: tuple[str, ...]
    stages: tuple[Stage, ...]
    symbolic: tuple[str, ...]
    numeric: tuple[str, ...]
    alone: tuple[str, ...]
    without_effect: tuple[str, ...]
    eliminated: tuple[tuple[str, str, str], ...]
    geometry: stated.Table
    gravity: str
    base: tuple[str, ...]
    effects: stated.Table
    elastic: str
    drives: stated.Table
    signals: stated.Table
    parameters: tuple[tuple[str, str, str], ...]
    base_count: int
    built_in: tuple[tuple[str, str, str], ...] | None


def markdown(model: Model) -> Document:
    """The groupings as text: one grouping a line."""
    grouped = equations(model.grouping)
    joints = {parameter.name: parameter.joint for parameter in model.standard_parameters}
    return Document(
        model.robot,
        tuple(f"{length.name} = {length_value(length)}" for length in model.robot.lengths),
        tuple(ladder(model)),
        tuple(plain(symbolic) for _, symbolic, _ in grouped),
        tuple(plain(numeric) for _, _, numeric in grouped),
        _by_joint(alone(model.grouping), joints),
        _by_joint(without_effect(model.grouping), joints),
        tuple(
            (gone.name, gone.rule, ", ".join(gone.into) or "nothing: no effect") for gone in model.grouping.eliminated
        ),
        geometry(model.robot),
        stated.gravity(model.robot),
        stated.base(model.robot),
        stated.effects(model),
        stated.elastic(model),
        stated.drives(model.robot),
        stated.signals(model.robot),
        tuple((parameter.name, parameter.unit, parameter.meaning) for parameter in model.parameters),
        len(model.base_parameters),
        tuple((p.name, value, p.unit) for p, value in stated.built_in(model)) if model.constants else None,
    )


def tex(model: Model, texts: Document) -> Document:
    """The same as ``texts`` with its formulas in LaTeX's mathematics, long ones broken between terms."""
    grouped = equations(model.grouping)
    return replace(
        texts,
        lengths=tuple(
            f"{latex.tex(Name(length.name))} = {_value(length_value(length))}" for length in model.robot.lengths
        ),
        symbolic=tuple(_aligned(symbolic) for _, symbolic, _ in grouped),
        numeric=tuple(_aligned(numeric) for _, _, numeric in grouped),
        alone=tuple(latex.tex(Name(name)) for name in alone(model.grouping)),
        without_effect=tuple(latex.tex(Name(name)) for name in without_effect(model.grouping)),
        geometry=tuple(
            (
                latex.escape(row.label),
                str(row.joint.antecedent),
                str(row.joint.sigma),
                *(latex.tex(cell) for _, cell in row.cells),
            )
            for row in rows(model.robot)
        ),
    )


def _by_joint(names: Iterable[str], joints: dict[str, int]) -> tuple[str, ...]:
    """``joint 1: XX1 XY1``, one joint a line."""
    lines: dict[int, list[str]] = {}
    for name in names:
        lines.setdefault(joints[name], []).append(name)
    return tuple(f"joint {joint}: {' '.join(listed)}" for joint, listed in lines.items())


def geometry(robot: Robot) -> stated.Table:
    """The Denavit-Hartenberg table with the limits of the joints; empty without joints."""
    table = rows(robot)
    head = ("j", "a(j)", "sigma", *(name for name, _ in table[0].cells), "limits") if table else ()
    body = (
        (
            row.label,
            str(row.joint.antecedent),
            str(row.joint.sigma),
            *(plain(c) for _, c in row.cells),
            limits(row.joint),
        )
        for row in table
    )
    return (head, *body) if table else ()


def _aligned(equation: Equation) -> str:
    """One line of an ``align``, broken before the term that no longer fits."""
    lines = [f"{latex.tex(equation.left)} &= "]
    used = 0
    for piece, shown in zip(latex.terms(equation.right), _plain_terms(equation), strict=True):
        if used and used + len(shown) > _LINE:
            lines.append(r"&\quad ")
            used = 0
        lines[-1] += piece if used or len(lines) == 1 else piece.lstrip()
        used += len(shown)
    return " \\notag \\\\\n".join(lines)


def _plain_terms(equation: Equation) -> list[str]:
    return (
        [plain(term) for term in equation.right.terms] if isinstance(equation.right, Sum) else [plain(equation.right)]
    )


def _value(text: str) -> str:
    number, unit = text.split(" ", 1)
    return rf"{number}\,\mathrm{{{latex.escape(unit)}}}"
