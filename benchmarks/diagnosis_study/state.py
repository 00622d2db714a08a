"""The state of the code that an answer came from, as one number: what another state answered is another study."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from hashlib import sha256
from pathlib import Path

from benchmarks.diagnosis_study.reach import reached

ROOT = Path(__file__).parents[2]
#: What makes a case, asks the command, and holds its answer against the truth; the command itself.
MODULES = (
    *(f"benchmarks.diagnosis_study.{name}" for name in ("making", "asking", "scoring", "baselines")),
    "identification.cli.diagnose",
)
#: Where they read files that are no modules.
_READ = ("templates", "tests/plant", "benchmarks/diagnosis_study")
_DOCUMENTED = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)


def state(root: Path = ROOT) -> str:
    """Sixteen digits, the same as long as nothing changes that a case or an answer depends on: other commands do not
    count, nor do comments, docstrings and the layout of Python files.

    They belong to one version of Python, whose syntax trees these are.
    """
    digest = sha256()
    for file in sorted({*reached(root, MODULES), *_read(root)}):
        text = file.read_bytes()
        digest.update(_meant(text) if file.suffix == ".py" else text)
    return digest.hexdigest()[:16]


def _read(root: Path) -> Iterator[Path]:
    for folder in _READ:
        for file in (root / folder).rglob("*"):
            if file.is_file() and file.suffix not in (".py", ".pyc"):
                yield file


def _meant(text: bytes) -> bytes:
    """A Python file's syntax tree without docstrings."""
    tree = ast.parse(text)
    for node in ast.walk(tree):
        if isinstance(node, _DOCUMENTED) and ast.get_docstring(node, clean=False) is not None:
            del node.body[0]
    return ast.dump(tree).encode()
