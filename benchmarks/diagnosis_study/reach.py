"""The Python files that modules of a tree need, through all that they import."""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator
from pathlib import Path


def reached(root: Path, modules: Iterable[str]) -> set[Path]:
    """Files below ``root`` of ``modules`` and of what they import, inside functions too.

    Of a package that is imported itself the modules directly inside count: discovery finds them by their folder.
    """
    files: set[Path] = set()
    missing = list(modules)
    while missing:
        for file in _files(root, missing.pop()) - files:
            files.add(file)
            missing += _imported(root, file)
    return files


def _files(root: Path, module: str) -> set[Path]:
    """A module's file, or a package's direct modules, and what runs when they are imported; none of other projects."""
    path = root.joinpath(*module.split("."))
    own = set(path.glob("*.py")) if path.is_dir() else {path.with_suffix(".py")}
    around = {parent / "__init__.py" for parent in path.relative_to(root).parents}
    return {file for file in own | {root / one for one in around} if file.is_file()}


def _imported(root: Path, file: Path) -> Iterator[str]:
    for node in ast.walk(ast.parse(file.read_bytes())):
        if isinstance(node, ast.Import):
            yield from (one.name for one in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module:
            inside = [f"{node.module}.{one.name}" for one in node.names]
            yield from (one if _is_module(root, one) else node.module for one in inside)


def _is_module(root: Path, module: str) -> bool:
    """Whether a dotted name is of a module or a package, and not of something that a module defines."""
    path = root.joinpath(*module.split("."))
    return path.is_dir() or path.with_suffix(".py").is_file()
