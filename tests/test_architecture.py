"""The house rules that a command can check: floors, style, types, sizes, names."""

from __future__ import annotations

import re
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from itertools import chain
from pathlib import Path

import pytest

from generator.resources import robots
from tests.commands import ROOT

PACKAGES = ("generator", "identification")
CODE = [path for folder in (*PACKAGES, "tests", "benchmarks") for path in sorted((ROOT / folder).rglob("*.py"))]
TEMPLATES = [path for path in sorted((ROOT / "templates").rglob("*")) if path.is_file()]

#: Makers' and models' names; what holds for one robot must hold for its whole structure.
ROBOT_NAMES = {"kuka", "kr270", "kr300", "kr500", "iiwa", "panda", "puma", "scara", "stanford", "staubli", "tx40"}


def run(*words: str) -> None:
    """Runs a checker of the environment in the checkout; fails with what it printed."""
    done = subprocess.run(
        [sys.executable, *words], cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False
    )
    assert done.returncode == 0, done.stdout


def test_nothing_imports_upward() -> None:
    call = "import sys; from importlinter.cli import lint_imports; sys.exit(lint_imports(no_cache=True))"
    run("-c", f"import sys; sys.path.insert(0, '.'); {call}")


def test_style() -> None:
    run("-m", "ruff", "check", "--no-cache", "--output-format", "concise", ".")


def test_layout() -> None:
    run("-m", "ruff", "format", "--no-cache", "--check", ".")


def test_types() -> None:
    run("-m", "mypy")


@pytest.mark.parametrize("path", [*CODE, *TEMPLATES], ids=lambda path: str(path.relative_to(ROOT)))
def test_no_file_over_400_lines(path: Path) -> None:
    assert len(path.read_text().splitlines()) <= 400


def words_of(folder: Path) -> Iterator[tuple[Path, str]]:
    for path in sorted(folder.rglob("*")):
        if path.is_file() and path.suffix in (".py", ".jinja", ".css"):
            for word in re.findall(r"\w+", re.sub(r"(?<=[A-Za-z])[ -](?=\d)", "", path.read_text().lower())):
                yield path, word


@pytest.mark.parametrize("folder", [*PACKAGES, "templates"])
def test_no_module_or_template_names_a_robot(folder: str) -> None:
    known = ROBOT_NAMES | {path.stem for path in robots()}
    found = {
        f"{path.relative_to(ROOT)}: {word}"
        for path, word in words_of(ROOT / folder)
        if any(word == name or word.startswith(f"{name}_") for name in known)
    }
    assert not found


def test_every_dependency_is_locked_and_explained() -> None:
    pyproject = tomllib.loads((ROOT / "pyproject.toml").read_text())
    groups = pyproject["dependency-groups"]
    runtime = pyproject["project"]["dependencies"] + groups["build"]
    extras = chain.from_iterable(pyproject["project"]["optional-dependencies"].values())
    testing = [*runtime, *extras, *chain.from_iterable(groups[name] for name in groups if name != "bench")]
    wanted = {
        "requirements.lock": runtime,
        "requirements-test.lock": testing,
        "requirements-bench.lock": [*testing, *groups["bench"]],
    }
    explained = (ROOT / "docs" / "dependencies.md").read_text().lower()
    for lock, requirements in wanted.items():
        locked = set(re.findall(r"^([a-z0-9-]+)==", (ROOT / lock).read_text(), re.MULTILINE))
        for requirement in requirements:
            name = re.split(r"[<>=!; ]", requirement)[0].lower()
            assert name.replace(".", "-") in locked, f"{name} is not in {lock}; run make lock"
            assert name in explained, f"docs/dependencies.md does not say what {name} is for"
