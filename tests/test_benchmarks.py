"""The comparison with other libraries: it notices what differs, and the documents say what was measured."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from types import ModuleType
from xml.etree import ElementTree

import numpy as np
import pytest

import benchmarks.studies
from benchmarks.bench import main
from benchmarks.chart import Group, chart
from benchmarks.compiling import Missing
from benchmarks.documents import README, RESULTS, documented
from benchmarks.example_diagnosis import PAGE
from benchmarks.peers import casadi_recursion, ours
from benchmarks.peers.measuring import disagreement, measure
from benchmarks.peers.subject import FUNCTIONS, WHOLE_FUNCTIONS, Chain, write
from benchmarks.study import VOID, measured, shown, status
from benchmarks.summary import bars, summary
from benchmarks.table import table
from generator.discovery import modules
from tests.commands import ROOT

ROW = {
    "robot": "arm",
    "function": "inverse_dynamics",
    "Counterpoise": 50.0,
    "Counterpoise, libm": 80.0,
    "Other": 400.0,
    "Other / ours": 8.0,
}


# -- what the documents say -------------------------------------------------------------------------------------------


def test_documents_and_pictures_say_what_was_measured() -> None:
    results = json.loads(RESULTS.read_text(encoding="utf-8"))
    wrong = [str(path) for path, text in documented(results).items() if (ROOT / path).read_text("utf-8") != text]
    assert not wrong, "`python -m benchmarks.documents` writes them anew"


def test_pages_with_the_worked_example_print_the_same() -> None:
    pages = [(ROOT / name).read_text("utf-8") for name in (README, PAGE)]
    first, second = (
        page.split("<!-- example output -->")[1].split("<!-- end of example output -->")[0] for page in pages
    )
    assert first == second, "`python -m benchmarks.example_diagnosis` writes them anew"


def test_results_hold_every_study_and_nothing_of_the_place() -> None:
    told = RESULTS.read_text(encoding="utf-8")
    assert set(json.loads(told)["studies"]) == {study.__name__.rpartition(".")[2] for study in _studies()}
    assert not any(place in told for place in ("/tmp", "/home", "/work", "/root", "/usr"))


def test_every_study_has_a_title_and_a_run_and_runs_alone() -> None:
    for study in _studies():
        assert isinstance(study.TITLE, str)
        assert callable(study.run)
        path, name = Path(study.__file__ or ""), study.__name__
        wanted = f'\n\nif __name__ == "__main__":\n    import {name} as study\n\n    alone(__file__, study)\n'
        assert path.read_text(encoding="utf-8").endswith(wanted), name


def _studies() -> list[ModuleType]:
    return list(modules(benchmarks.studies))


# -- tables and pictures ----------------------------------------------------------------------------------------------


def test_a_table_has_every_column_and_a_dash_where_a_row_has_none() -> None:
    assert table([{"a": 1.25, "b": "x"}, {"c": True}]).splitlines() == [
        "| a | b | c |",
        "| ---: | --- | --- |",
        "| 1.25 | x | - |",
        "| - | - | yes |",
    ]
    assert table([]) == ""


def test_the_summary_takes_our_first_column_and_the_first_robot() -> None:
    others = {**ROW, "robot": "leg", "Other": 1.0}
    ours_alone = {"robot": "arm", "function": "more", "Counterpoise": 60.0}
    void = {**ROW, **dict.fromkeys(list(ROW)[2:], VOID)}
    rows = [ROW, others, ours_alone, void]
    assert summary(rows) == [{"arm": "inverse_dynamics", "ns a call": 50.0, "Other": "8.0 ×"}]
    assert bars(rows) == [Group("inverse dynamics", {"Other": 8.0})]


def test_the_picture_is_well_formed_and_its_bars_are_to_scale() -> None:
    drawing = ElementTree.fromstring(chart("times", [Group("a", {"x": 2.0, "y": 4.0}), Group("b", {"y": 1.0})], "one"))
    space = "{http://www.w3.org/2000/svg}"
    lengths = {
        bar.findtext(f"{space}title"): float(bar.attrib["width"])
        for bar in drawing.iter(f"{space}rect")
        if bar.find(f"{space}title") is not None
    }
    assert list(lengths) == ["a: x 2.0", "a: y 4.0", "b: y 1.0"]
    x, y, z = lengths.values()
    assert (x / z, y / z) == pytest.approx((2.0, 4.0), rel=1e-2)


# -- the command ------------------------------------------------------------------------------------------------------


class Broken:
    """A study that raises."""

    TITLE = "broken"

    def __init__(self, error: Exception) -> None:
        self._error = error

    def run(self, build: Path) -> Mapping[str, object]:
        raise self._error


def test_a_study_that_breaks_or_lacks_a_tool_has_a_note(capsys: pytest.CaptureFixture[str]) -> None:
    lacking, broken = measured("_", Broken(Missing("a wheel"))), measured("_", Broken(ValueError("no\nway")))
    assert lacking["notes"] == ["not measured: a wheel is missing"]
    assert broken["notes"] == ["not measured: no"]
    assert shown(lacking) == "- not measured: a wheel is missing"
    assert status([lacking]) == 0
    assert status([lacking, broken]) == 1
    assert "study _" in capsys.readouterr().err


def test_a_void_row_is_a_failure() -> None:
    assert status([{"rows": [ROW]}]) == 0
    assert status([{"rows": [ROW, {**ROW, "Other": VOID}]}]) == 1


def test_an_unknown_study_is_one_line(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["only=peer"]) == 2
    assert capsys.readouterr().err.startswith(
        "error: benchmarks/studies:1:1: there is no study 'peer', expected one of"
    )


# -- the comparison ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("robot", ["stanford", pytest.param("kr270", marks=pytest.mark.long)])
def test_libraries_agree_and_other_parameters_do_not(robot: str, tmp_path: Path) -> None:
    subject = Chain(robot)
    libraries = [*ours.build(subject, tmp_path / "a"), *casadi_recursion.build(subject, tmp_path / "a")]
    reduced = [library for library in libraries if not library.whole]
    changed = write(1.001 * subject.parameters(subject.model), tmp_path / "changed.bin")
    timed = measure(subject, reduced, tmp_path / "a", rounds=1)
    others = measure(subject, [replace(library, data=changed) for library in reduced], tmp_path / "a", rounds=0)
    for function in FUNCTIONS:
        first, *rest = (one for one in timed if one.function == function)
        assert first.time > 0
        assert rest
        assert max(disagreement(subject, first, one) for one in rest) < 1e-12
        differing = [disagreement(subject, first, one) for one in others if one.function == function]
        assert function == "regressor" or min(differing) > 1e-5


def test_the_whole_robot_is_that_of_the_independent_implementation(tmp_path: Path) -> None:
    subject = Chain("kr500")
    whole = [library for library in ours.build(subject, tmp_path / "a") if library.whole]
    for one in measure(subject, whole, tmp_path / "a", rounds=0):
        assert one.function in WHOLE_FUNCTIONS
        np.testing.assert_allclose(one.results[0], subject.expected(one.function, 0), rtol=1e-9)
