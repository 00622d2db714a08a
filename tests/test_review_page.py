"""The review page as a document, and what its tables and its grid say about the model."""

from __future__ import annotations

import re
import sys
import xml.etree.ElementTree as ElementTree
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import generator.review.sections
from generator.backends import batch, c, simulation
from generator.derivation import derive
from generator.resources import find_robot
from generator.review.markup import Markup, element
from generator.review.page import sections
from generator.robot.readers import read
from tests.reviewed import SVG, XHTML, files, model, page, state
from tests.subject import Subject


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


def test_a_robot_without_a_description_has_no_empty_words() -> None:
    model = derive(replace(read(find_robot("scara")), description=""))
    review = files(model)
    assert review["groupings.md"].startswith("# Groupings of scara\n\nInertial parameters of body j")
    root = ElementTree.fromstring(review["review.html"].removeprefix("<!DOCTYPE html>\n"))
    assert root.find(f"{XHTML}body/{XHTML}header/{XHTML}p") is None
    sources = c.library(model, ()) | batch.emit(model) | simulation.emit(model)
    titles = {name: str(text).splitlines()[1] for name, text in sources.items() if name.endswith(".h")}
    assert titles == {
        "scara.h": " * scara",
        "scara_batch.h": " * scara",
        "scara_simulation.h": " * scara: simulation.",
    }


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
        found = sections(generator.review.sections, model("scara"))
    finally:
        sys.modules.pop("generator.review.sections.zz_told_by_a_file", None)
    told = next(section for section in found if section.title == "Told by a file")
    assert (told.anchor, told.body) == ("zz-told-by-a-file", Markup("<p>scara</p>"))
    titles = [section.title for section in found]
    assert titles.index("Groupings") < titles.index("Told by a file") < titles.index("Structure of the regressor")


def test_no_path_and_no_date_is_written() -> None:
    for text in files(model("kr500")).values():
        assert str(Path(__file__).parent.parent) not in text
        assert not re.search(r"\b20\d\d-\d\d-\d\d\b", text)


def test_the_grid_shows_the_regressors_structure(arm: Subject) -> None:
    picture = next(p for p in page(arm.model).iter(f"{SVG}svg") if p.attrib.get("class") == "regressor")
    shown = {
        (cell.findtext(f"{SVG}title") or "").split(" [")[0]
        for cell in picture.iter(f"{SVG}rect")
        if "cell" in cell.attrib["class"]
    }
    sparsity = arm.model.functions["regressor_packed"].sparsity
    assert sparsity is not None
    joints = arm.robot.numbers
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
    assert cells
    order = [p.name for p in of.base_parameters]
    for name, (across, down) in cells.items():
        torque, parameter = name.split(", ")
        step = (cells["τ6, Off6"][0] - cells["τ1, ZZ1R"][0]) / (len(order) - 1)
        assert across == pytest.approx(cells["τ1, ZZ1R"][0] + step * order.index(parameter), abs=0.2)
        assert down == pytest.approx(cells["τ1, ZZ1R"][1] + step * (int(torque[1:]) - 1), abs=0.2)


def test_operation_counts_are_those_of_the_functions(arm: Subject) -> None:
    section = next(s for s in page(arm.model).iter(f"{XHTML}section") if s.attrib["id"] == "operations")
    table = next(section.iter(f"{XHTML}table"))
    rows = {}
    for row in list(table.iter(f"{XHTML}tr"))[1:]:
        name, *cells = ("".join(cell.itertext()) for cell in row)
        rows[name] = [0 if cell == "·" else int(cell) for cell in cells[:7]]
    assert list(rows) == list(arm.model.functions)
    for name, function in arm.model.functions.items():
        count = function.count
        assert rows[name][:6] == [count.mul, count.add, count.div, count.trig, count.other, count.total]
        assert (rows[name][6] > 0) == any(
            node.parameter_only and node.operation not in ("constant", "input", "neg") for node in function.nodes
        )
