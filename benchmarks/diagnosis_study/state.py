"""The state of the code that an answer came from, as one number: what another state answered is another study."""

from __future__ import annotations

import ast
from hashlib import sha256
from pathlib import Path

ROOT = Path(__file__).parents[2]
#: What an answer depends on, and what in it does not matter.
_SOURCES = ("generator", "identification", "templates", "tests/plant", "benchmarks/diagnosis_study")
_WITHOUT = {"__pycache__", "pages"}
_DOCUMENTED = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)


def state(root: Path = ROOT) -> str:
    """Sixteen digits, the same as long as only comments, docstrings and the layout of Python files change.

    They belong to one version of Python, whose syntax trees these are.
    """
    digest = sha256()
    for source in _SOURCES:
        for file in sorted((root / source).rglob("*")):
            if file.is_file() and _WITHOUT.isdisjoint(file.parts):
                text = file.read_bytes()
                digest.update(_meant(text) if file.suffix == ".py" else text)
    return digest.hexdigest()[:16]


def _meant(text: bytes) -> bytes:
    """A Python file's syntax tree without docstrings."""
    tree = ast.parse(text)
    for node in ast.walk(tree):
        if isinstance(node, _DOCUMENTED) and ast.get_docstring(node, clean=False) is not None:
            del node.body[0]
    return ast.dump(tree).encode()
