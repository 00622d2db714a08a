"""From a robot file to the folder of everything that is generated from it."""

from __future__ import annotations

import gc
import json
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from pathlib import Path
from typing import Any

import generator.backends
from generator.derivation import derive
from generator.discovery import modules
from generator.earlier import MANIFEST
from generator.manifest import manifest
from generator.robot.readers import read
from generator.symbolic.model import Model
from generator.writing import replace, writable

#: A context that announces a stage of the work while it lasts.
Stage = Callable[[str], AbstractContextManager[None]]


def silent(text: str) -> AbstractContextManager[None]:
    """A stage that announces nothing."""
    return nullcontext()


def generate(
    robot_file: Path, out: Path, stage: Stage = silent, plain: bool = False, parameter_set: str | None = None
) -> tuple[Path, dict[str, Any]]:
    """Generates every backend's files for a robot file into ``out/<robot's name>``; returns that folder, the manifest.

    A ``plain`` generation writes the textbook recursion. With a ``parameter_set`` its values stand in the code as
    numbers, and the folder is ``out/<robot's name>_<set>``. Nothing is written before everything has been derived.
    Raises InputError for a bad robot file, a set that it lacks or a folder that cannot be written.
    """
    with uncollected():
        with stage(f"reading {robot_file.name}"):
            robot = read(robot_file)
            writable(out if parameter_set else out / robot.name)
        with stage(f"deriving the model of {robot.name}"):
            model = derive(robot, plain=plain, parameter_set=parameter_set)
        with stage("emitting the files"):
            files = emitted(model)
    contents = manifest(model, sorted(files))
    files[MANIFEST] = (json.dumps(contents, indent=1, ensure_ascii=False) + "\n").encode()
    folder = out / model.robot.name
    replace(folder, files)
    return folder, contents


@contextmanager
def uncollected() -> Iterator[None]:
    """Python's collector walks a model's nodes again and again and frees none: all live until the files are written."""
    before = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if before:
            # To the old at once: the next collection of the young would walk all that has been made.
            if not gc.get_freeze_count():
                gc.freeze()
                gc.unfreeze()
            gc.enable()


def emitted(model: Model) -> dict[str, bytes]:
    """The files of every backend, relative path -> content."""
    files: dict[str, bytes] = {}
    for backend in modules(generator.backends):
        for name, content in backend.emit(model).items():
            files[f"{backend.NAME}/{name}"] = content.encode() if isinstance(content, str) else content
    return files
