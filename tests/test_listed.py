"""What is found by being in a folder, and what files hold, is listed in its page."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import fields
from typing import Any

import pytest

import identification.executors
import identification.readers
from generator.discovery import modules
from generator.robot.readers import read
from identification.consistent_fit import consistent_fit
from identification.excitation import results as excitation_results
from identification.excitation.excite import excite
from identification.excitation.request import Request
from identification.inverse_model import identify
from identification.output_error.methods import methods
from identification.recipes import Recipe
from identification.results import document
from identification.sensitivity import Variation
from identification.trajectories import trajectories
from identification.trajectory import Setting
from tests.recorded import TRUTH, recorded, twin_text, two_links
from tests.test_docs import rows, section

_CODE = re.compile(r"`([^`]+)`")
#: A key of a record, not the name of a parameter or the number of a joint.
_KEY = re.compile(r"[a-z_0-9]*[a-z_]")
#: Rows of tables of keys that tell of their values in words.
IN_WORDS = {"method", "data", "notes"}


def codes(cell: str) -> list[str]:
    return _CODE.findall(cell)


# -- modules ----------------------------------------------------------------------------------------------------------


def test_every_trajectory_is_listed_with_its_settings() -> None:
    table = {first: settings for first, settings, _ in rows(section("docs/simulate.md", "Trajectories"))}
    assert set(table) == {f"`{name}`" for name in trajectories()}
    for name, one in trajectories().items():
        told = dict(code.split("=") for code in codes(table[f"`{name}`"]) if "=" in code)
        assert set(told) == set(one.settings), name
        for key, setting in one.settings.items():
            assert setting.file or _value(told[key], setting) == setting.default, f"{name} {key}"


def _value(told: str, setting: Setting) -> float | str:
    return told if isinstance(setting.default, str) else float(told)


def test_every_method_of_output_error_is_listed() -> None:
    told = [codes(first) for first, _ in rows(section("docs/output_error.md", "Methods"))]
    assert sorted(told) == [[name] for name in sorted(methods())]


def test_every_format_of_runs_is_listed() -> None:
    told = [code for code in codes(section("docs/identification.md", "Runs")) if re.fullmatch(r"\.[a-z]+", code)]
    # The others are those of sidecars.
    assert set(told) - {".yaml", ".yml"} == {e for one in modules(identification.readers) for e in one.EXTENSIONS}


def test_every_place_where_starts_run_is_listed() -> None:
    options = {one.OPTION for one in modules(identification.executors) if one.OPTION}
    assert options
    told = codes(section("docs/output_error.md", "Several starts"))
    assert options <= {code.split()[0] for code in told}


# -- keys -------------------------------------------------------------------------------------------------------------


def test_every_key_of_a_recipe_is_listed_with_its_default() -> None:
    head = "| key of a recipe |"
    told = head + section("docs/identification.md", "Filters").split(head)[1].split("\n\n")[0] + "\n"
    table = {name: row[1] for row in rows(told) for name in codes(row[0])}
    keys = {one.name: one.default for one in fields(Recipe)}
    assert set(table) == {*keys, "description"}
    for name, default in keys.items():
        if isinstance(default, int | float | str):
            assert table[name].strip("`") == (default if isinstance(default, str) else f"{default:g}")


@pytest.fixture(scope="module")
def documents(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """The files by the pages and headings that tell what is in them."""
    folder = tmp_path_factory.mktemp("listed")
    links = two_links(folder)
    runs = [str(recorded(links, TRUTH, seed=k, noise=0.02).save(folder / f"{name}.csv")) for k, name in enumerate("AB")]
    (folder / "B.yaml").write_text("payload: {name: L, M: 0.001 kg}\n")
    found = identify(links.model.robot, runs, regressors=links)
    consistent = consistent_fit(found, None, 0.03)
    path = folder / "arm.yaml"
    path.write_text(twin_text())
    return {
        "docs/identification.md": document(found, consistent, [Variation("cutoff", 1.0, "Fv1", 0.1)]),
        "docs/excite.md": excitation_results.document(excite(read(path), Request(evaluations=256, parameters="twin"))),
    }


@pytest.mark.parametrize(
    ("page", "heading"), [("docs/identification.md", "results.json"), ("docs/excite.md", "excitation.json")]
)
def test_every_key_of_a_file_is_listed(page: str, heading: str, documents: dict[str, Any]) -> None:
    found = documents[page]
    table = [(codes(first), codes(rest)) for first, rest in rows(section(page, heading))]
    assert sorted(key for keys, _ in table for key in keys) == sorted(found)
    known = {key for keys, inside in table for key in (*keys, *inside)}
    for keys, inside in table:
        there = {each for key in keys for each in _keys(found[key])}
        for one in inside:
            assert one in there or one.startswith("-"), f"{keys} {one}"
        if not IN_WORDS.intersection(keys):
            assert there <= known, f"{keys} {there - known}"


def _keys(value: object) -> Iterator[str]:
    """Keys of records at any depth."""
    if isinstance(value, Mapping):
        yield from (key for key in value if _KEY.fullmatch(key))
        value = list(value.values())
    if isinstance(value, list):
        for one in value:
            yield from _keys(one)
