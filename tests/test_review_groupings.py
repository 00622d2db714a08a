"""The review's groupings against the report's lists and against the model, as text and in LaTeX."""

from __future__ import annotations

import re
from dataclasses import replace
from math import floor, log10, pi

import numpy as np
import pytest

from generator.review.counts import ladder
from generator.review.formula import (
    Name,
)
from generator.review.groupings import equations
from generator.review.tex import escape
from generator.robot.description import REVOLUTE
from generator.robot.parameters import INERTIAL_STEMS
from generator.symbolic.model import Model
from tests.chains import joint, robot
from tests.printed_groupings import SECTION_5_1, SECTION_6_1, SYMBOLIC
from tests.reviewed import block, files, listed, parsed, state, value
from tests.subject import Subject, bare

#: The lists of report sections 5.1 and 6.1, as printed.
REPORT = {"kr270_calibrated": SECTION_5_1, "kr500": SECTION_6_1}


@pytest.mark.parametrize("name", REPORT)
def test_numeric_groupings_are_those_of_the_report(name: str) -> None:
    lines = block(files(bare(name))["groupings.md"], "Numeric")
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


@pytest.mark.parametrize("name", ["kr500", "kr270", pytest.param("kr270_calibrated", marks=pytest.mark.long)])
def test_symbolic_groupings_of_both_robots(name: str) -> None:
    assert block(files(bare(name))["groupings.md"], "Symbolic") == listed(SYMBOLIC)


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
    grouped = [parsed(line)[1][0][0] for line in block(markdown, "Numeric")]
    alone = [name for line in block(markdown, "Parameters that stand alone") for name in line.split()[2:]]
    left = re.findall(r"^\| (\w+) \|", markdown.split("## Why each parameter left")[1].split("## Geometry")[0], re.M)
    assert sorted(grouped + alone + left[1:]) == sorted(p.name for p in arm.model.standard_parameters)


def test_the_parameter_vector_is_listed_in_its_order(arm: Subject) -> None:
    table = files(arm.model)["groupings.md"].split("## Parameter vector")[1]
    rows = [line.split(" | ") for line in table.splitlines() if line.startswith("| ")][1:]
    assert [(row[0].removeprefix("| "), row[1]) for row in rows] == [(p.name, p.unit) for p in arm.model.parameters]


@pytest.mark.parametrize(
    ("name", "totals"),
    [
        ("kr500", [36, 40, 58, 59]),
        ("kr270", [36, 40, 58, 60]),
        ("kr500_table5", [72, 82, 88]),
        pytest.param("kr270_table5", [72, 82, 88], marks=pytest.mark.long),
    ],
)
def test_counts_of_the_report(name: str, totals: list[int]) -> None:
    assert [stage.total for stage in ladder(bare(name))] == totals


def test_counts_are_ranks_of_the_regressor(arm: Subject) -> None:
    stages = ladder(arm.model)
    assert stages[-1].total == len(arm.model.base_parameters)
    rows = np.concatenate([arm.generated("regressor_standard", state(arm, seed))["W"] for seed in range(40)])
    bodies = {f"{stem}{body.number}" for body in arm.robot.bodies for stem in INERTIAL_STEMS}
    inertial = [k for k, parameter in enumerate(arm.model.standard_parameters) if parameter.name in bodies]
    columns = rows[:, inertial]
    size = np.linalg.norm(columns, axis=0)
    assert stages[0].total == np.linalg.matrix_rank(columns[:, size > 1e-9] / size[size > 1e-9], tol=1e-8)


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


def test_labels_are_text_in_latex() -> None:
    named = robot("labelled", (replace(joint(1, REVOLUTE), label="a_b"),))
    assert r"1 (a\_b) &" in files(Model(named))["groupings.tex"]


def test_latex_takes_text_literally() -> None:
    assert escape(r"50 % of a_b & {c} \d ~^#$") == (
        r"50 \% of a\_b \& \{c\} \textbackslash{}d \textasciitilde{}\textasciicircum{}\#\$"
    )
