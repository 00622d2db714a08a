"""The generated Python module of a robot, by each compiler."""

from __future__ import annotations

import importlib.util
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from benchmarks.compiling import compilers
from generator.generation import emitted
from generator.python_library import build_library
from generator.symbolic.model import Model
from generator.writing import replace


def modules(model: Model, build: Path) -> dict[str, Any]:
    """The module by the name of the compiler that made its library, in folders of ``build``."""
    files = emitted(model)
    found = {}
    for compiler in compilers():
        folder = build / compiler.name / model.robot.name
        folder.parent.mkdir(parents=True, exist_ok=True)
        replace(folder, files)
        with _compiler(compiler.c):
            build_library(folder, model.robot.name)
        found[compiler.name] = loaded(folder, model.robot.name)
    return found


def loaded(folder: Path, name: str) -> Any:
    """The module of a folder whose library is built."""
    specification = importlib.util.spec_from_file_location(name, folder / "python" / f"{name}.py")
    assert specification is not None
    assert specification.loader is not None
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    return module


@contextmanager
def _compiler(command: str) -> Iterator[None]:
    """The generator's compiler, by its environment variable."""
    before = os.environ.get("CC")
    os.environ["CC"] = command
    try:
        yield
    finally:
        del os.environ["CC"]
        if before is not None:
            os.environ["CC"] = before
