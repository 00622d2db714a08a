"""A study of many tasks whose results are kept as they come, so that one that was interrupted goes on where it was."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Callable, Collection, Mapping
from pathlib import Path
from typing import Any

from generator.errors import InputError, Place
from generator.writing import replace
from identification.executors import Executor

#: Digits of a study's key in the name of its folder.
_DIGITS = 16

#: Told the number of tasks that are done, and of all.
Counted = Callable[[int, int], None]


def key_of(document: Mapping[str, Any]) -> str:
    """The key of a study: a hash of all that its results depend on, as JSON."""
    text = json.dumps(document, sort_keys=True, allow_nan=True)
    return hashlib.sha256(text.encode()).hexdigest()[:_DIGITS]


def done_before(folder: Path, tasks: Mapping[str, Any], keys: Collection[str] = ()) -> dict[str, Any]:
    """Results (JSON values) that an earlier run of the study left in its ``folder``, each with these ``keys``.

    Raises InputError for a file there that is none.
    """
    result = {}
    for name in tasks:
        path = folder / f"{name}.json"
        if not os.path.isfile(path):
            continue
        try:
            result[name] = json.loads(path.read_text(encoding="utf-8"))
            if not all(key in result[name] for key in keys):
                raise ValueError("keys are missing")
        except (OSError, TypeError, ValueError):
            raise InputError(Place(str(path)), "this is no result of a study", "a file that a study wrote") from None
    return result


def study(
    function: Callable[[Any], Any],
    tasks: Mapping[str, Any],
    executor: Executor,
    folder: Path | None = None,
    counted: Counted = lambda done, total: None,
    keys: Collection[str] = (),
) -> dict[str, Any]:
    """``function`` of every task, by name, in their order; the results are JSON values, with ``keys`` if any are given.

    Each result is written into ``folder`` as it comes, whole or not at all; tasks whose result is there are not run
    again. The folder's name should hold the study's key, as nothing else tells whose results they are.
    """
    found = {} if folder is None else done_before(folder, tasks, keys)
    counted(len(found), len(tasks))
    left = {name: task for name, task in tasks.items() if name not in found}
    for name, result in executor.map(function, left) if left else ():
        text = json.dumps(result)
        # Read back, so that a result is the same whether it was just made or kept.
        found[name] = json.loads(text)
        if folder is not None:
            replace(folder, {f"{name}.json": text.encode()})
        counted(len(found), len(tasks))
    return {name: found[name] for name in tasks}
