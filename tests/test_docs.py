"""The documents: their sessions run as printed, their references exist, their tables are complete."""

from __future__ import annotations

import ast
import importlib
import json
import os
import re
import subprocess
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from difflib import unified_diff
from fnmatch import fnmatch
from functools import cache, reduce
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import pytest

from generator.resources import robots
from tests.at_hand import RECORDINGS, TRANSCRIBED, Folder
from tests.documents import ROOT, SESSIONS, Workshop, agree, blocks

DOCUMENTS = ["README.md", *sorted(str(path.relative_to(ROOT)) for path in (ROOT / "docs").glob("*.md"))]
FOLDERS = (
    "benchmarks", "docs", "generated", "generator", "identification", "recipes", "robots", "templates", "tests"
)  # fmt: skip
#: Longer sessions, whose commands and programs other tests run; what is printed is held by make test-long.
FURTHER = ("docs/batch.md", "docs/output_error.md")

_LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")
_CODE = re.compile(r"`([^`]+)`")


def text(name: str) -> str:
    return (ROOT / name).read_text(encoding="utf-8")


def section(name: str, heading: str) -> str:
    """What stands under a heading of the second level."""
    found = re.search(rf"^## {re.escape(heading)}\n(.*?)(?=^## |\Z)", text(name), re.MULTILINE | re.DOTALL)
    assert found, f"{name} has no section {heading!r}"
    return found[1]


def rows(markdown: str) -> list[list[str]]:
    """The cells of all rows of the tables, heads and rules left out."""
    tables = re.findall(r"(?:^\|.*\|\n)+", markdown, re.MULTILINE)
    lines = [line for table in tables for line in table.splitlines()[2:]]
    return [[cell.strip() for cell in line.strip("|").split(" | ")] for line in lines]


@dataclass(frozen=True)
class Played:
    """A document with what its commands print, and the folder that they leave behind."""

    text: str
    folder: Path


@pytest.fixture(scope="session")
def play(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Played]:
    """Plays a document, once."""

    @cache
    def played(name: str) -> Played:
        folder = tmp_path_factory.mktemp("played")
        return Played(Workshop(folder, SESSIONS[name]).played(text(name)), folder)

    return played


@pytest.fixture(scope="session")
def manifest() -> dict[str, Any]:
    """That of the README's first generation, as it is committed."""
    contents: dict[str, Any] = json.loads((ROOT / "generated" / "kr500" / "manifest.json").read_text(encoding="utf-8"))
    return contents


# -- sessions ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=pytest.mark.long) if name in FURTHER else name for name in SESSIONS]
)
def test_sessions_print_what_is_printed(name: str, play: Callable[[str], Played]) -> None:
    written, printed = text(name), play(name).text
    told = "\n".join(unified_diff(written.splitlines(), printed.splitlines(), "written", "printed", "", "", 1, ""))
    assert printed == written, f"{told}\n`python -m tests.documents` rewrites the documents"


def test_every_document_with_a_session_is_played() -> None:
    with_sessions = {name for name in DOCUMENTS if any(block.language == "console" for block in blocks(text(name)))}
    assert with_sessions == set(SESSIONS)


def test_numbers_are_compared_and_lines_elided() -> None:
    assert agree(["a 1.0000000001", "b", "c"], ["a 1", "...", "c"])
    assert agree(["a"], ["...", "a", "..."])
    assert not agree(["a 1.00000001"], ["a 1"])
    assert not agree(["a", "b"], ["a"])
    assert not agree(["a"], ["a", "b"])
    assert not agree(["a", "c"], ["...", "b", "..."])


def test_a_wrong_output_is_rewritten_and_a_failing_command_is_told(tmp_path: Path) -> None:
    workshop = Workshop(tmp_path)
    assert workshop.played("```console\n$ echo 1; \\\n    echo b\n1\nc\n```") == (
        "```console\n$ echo 1; \\\n    echo b\n1\nb\n```"
    )
    assert workshop.played("```console\n$ seq 12 16\n12\n...\n99\n```") == "```console\n$ seq 12 16\n12\n...\n16\n```"
    with pytest.raises(AssertionError, match="no such thing"):
        workshop.played("```console\n$ echo no such thing; false\n```")


# -- the README -------------------------------------------------------------------------------------------------------


def test_the_first_program_is_short_and_strictly_compiled() -> None:
    readme = text("README.md")
    (program,) = (block.text for block in blocks(readme) if block.name == "main.c")
    assert len(program.splitlines()) <= 25
    assert "-std=c99 -O2 -ffp-contract=fast -Wall -Wextra -pedantic -Werror" in readme


def test_what_comes_out_is_all_that_comes_out(manifest: dict[str, Any]) -> None:
    told = [name for row in rows(section("README.md", "What comes out")) for name in _CODE.findall(row[0])]
    files = [*manifest["files"], "manifest.json"]
    for pattern in told:
        assert any(fnmatch(file, pattern) for file in files), pattern
    assert [file for file in files if not any(fnmatch(file, pattern) for pattern in told)] == []


def test_every_robot_is_listed() -> None:
    told = [name for row in rows(section("README.md", "A robot of your own")) for name in _CODE.findall(row[0])]
    assert Counter(told) == Counter(path.stem for path in robots())


def test_every_target_that_is_named_exists() -> None:
    targets = set(re.findall(r"^([a-z-]+):", text("Makefile"), re.MULTILINE))
    named = {word for name in DOCUMENTS for word in re.findall(r"(?:`|^)make ([a-z][a-z-]*)\b(?!=)", text(name), re.M)}
    assert {"test", "help"} <= named <= targets


@pytest.mark.parametrize(
    ("out", "into"),
    [([], "generated"), (["out="], f"{ROOT}/generated"), (["out=a b/c"], "{here}/a b/c"), (["out=/d /e"], "/d /e")],
)
def test_a_folder_that_make_is_given_is_the_callers(out: list[str], into: str, tmp_path: Path) -> None:
    shown = """shown: ; @$(INTO); echo "$$into\""""
    inherited = {name: value for name, value in os.environ.items() if not name.startswith(("MAKE", "MFLAGS", "out"))}
    words = ["make", "-s", "--no-print-directory", "-C", str(ROOT), "--eval", shown, *out, "shown"]
    done = subprocess.run(words, cwd=tmp_path, env=inherited | {"PWD": str(tmp_path)}, capture_output=True, text=True)
    assert done.stdout.strip() == into.format(here=tmp_path), done.stderr


def test_every_document_is_listed() -> None:
    linked = set(_LINK.findall(section("README.md", "Documentation")))
    assert linked == {name for name in DOCUMENTS if name != "README.md"}


# -- references -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", DOCUMENTS)
def test_links_lead_somewhere(name: str) -> None:
    for target in _LINK.findall(text(name)):
        if target.startswith("https://"):
            continue
        path, _, anchor = target.partition("#")
        file = ((ROOT / name).parent / path).resolve() if path else ROOT / name
        assert file.exists(), target
        assert file.is_relative_to(ROOT), target
        assert not anchor or anchor in anchors(file), target


def test_every_image_is_shown() -> None:
    linked = {Path(target).name for name in DOCUMENTS for target in _LINK.findall(text(name))}
    assert {path.name for path in (ROOT / "docs" / "images").iterdir()} <= linked


def anchors(document: Path) -> set[str]:
    """The anchors that a page of this repository gives the headings."""
    headings = re.findall(r"^#+ (.*)$", document.read_text(encoding="utf-8"), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading).lower().replace(" ", "-") for heading in headings}


@pytest.mark.parametrize("name", DOCUMENTS)
def test_files_that_are_named_exist(name: str) -> None:
    made = {block.name.removeprefix("./") for block in blocks(text(name))}
    for word in _CODE.findall(text(name)):
        if re.fullmatch(rf"(?:{'|'.join(FOLDERS)})/[\w./]+\.\w+", word) and "NAME" not in word and word not in made:
            assert (ROOT / word).is_file(), word


def test_modules_that_are_run_exist() -> None:
    named = {word for name in DOCUMENTS for word in re.findall(r"python3? -m ([\w.]+)", text(name))}
    assert len(named) > 10
    assert [one for one in sorted(named) if not _found(one)] == []


def _found(module: str) -> bool:
    """Whether there is a module; none where a package around it is missing."""
    try:
        return find_spec(module) is not None
    except ModuleNotFoundError:
        return False


@pytest.mark.parametrize("name", DOCUMENTS)
def test_nothing_leads_outside_of_the_repository(name: str) -> None:
    assert not re.search(r"(?<![\w.$])/(?:work|tmp|home|root|usr)/", text(name))


def test_what_report_md_refers_to_exists() -> None:
    references = {word for word in _CODE.findall(text("docs/report.md")) if re.fullmatch(r"[\w.]+:[\w.]+", word)}
    assert len(references) > 80
    assert sorted(word for word in references if not _exists(*word.split(":"))) == []


def _exists(module: str, name: str) -> bool:
    """Whether a test of ``tests/`` is declared, or a module of the packages has an object."""
    if module.startswith("test_"):
        return name in _declared(module)
    for package in ("generator", "identification"):
        try:
            reduce(getattr, name.split("."), importlib.import_module(f"{package}.{module}"))
        except (ImportError, AttributeError):
            continue
        return True
    return False


@cache
def _declared(module: str) -> set[str]:
    """The functions of a test file, read and not run; none where there is no such file."""
    path = ROOT / "tests" / f"{module}.py"
    body = ast.parse(path.read_text(encoding="utf-8")).body if path.is_file() else []
    return {node.name for node in body if isinstance(node, ast.FunctionDef)}


def test_report_md_has_a_test_and_a_place_in_the_code_for_each_row() -> None:
    for number, _, code, tests in (row for row in rows(text("docs/report.md")) if len(row) == 4):
        assert _CODE.findall(code), number
        assert all(name.startswith("test_") for name in _CODE.findall(tests)), number
        assert _CODE.findall(tests), number


@pytest.mark.parametrize(
    ("numbers", "count"),
    [
        (r"^\| ([\d, -]+) \|.*`test_|^Not there yet.*?: eq\. ([\d, -]+)\.$", 79),
        (r"^\| ([\d, -]+) \|.*`robots/|^\| (6) \|.*crank:SHAPES|^Tables ([\d, ]+) compare", 16),
    ],
    ids=["equations", "tables"],
)
def test_report_md_accounts_for_each_number_once(numbers: str, count: int) -> None:
    report = text("docs/report.md")
    tables = report.index("\n## Tables\n")
    part = report[:tables] if count == 79 else report[tables:]
    told: Counter[int] = Counter()
    for match in re.finditer(numbers, part, re.MULTILINE):
        for item in next(group for group in match.groups() if group).split(", "):
            first, _, last = item.partition("-")
            told.update(range(int(first), int(last or first) + 1))
    assert told == Counter(range(1, count + 1))


# -- folders that are not part of the repository ----------------------------------------------------------------------


@pytest.mark.parametrize(
    ("folder", "document"), [(RECORDINGS, "docs/identification.md"), (TRANSCRIBED, "docs/parameter_sets.md")]
)
def test_where_files_are_looked_for_is_told_where_they_are_missed(folder: Folder, document: str) -> None:
    assert f"`{folder.variable}`" in text(document)
    assert folder.variable in folder.needed.kwargs["reason"]


# -- the quantities ---------------------------------------------------------------------------------------------------


def test_quantities_md_lists_every_function_with_its_signals(manifest: dict[str, Any]) -> None:
    listed = {row[0].strip("`"): row[1:] for row in rows(text("docs/quantities.md"))}
    assert listed == {name: _told(function) for name, function in manifest["functions"].items()}


def _told(function: dict[str, Any]) -> list[str]:
    return [", ".join(map(_signal, function[kind])) for kind in ("inputs", "outputs")] + [function["summary"]]


def _signal(signal: dict[str, Any]) -> str:
    return " ".join(filter(None, (f"`{signal['name']}`", "×".join(map(str, signal["shape"])))))
