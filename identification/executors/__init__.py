"""Where the tasks of a study run: one module each, found by being in this folder.

A module has ``OPTION`` (of the command line; None for the one that is taken without any), ``METAVAR``, ``HELP`` and
``opened(text)``, a context manager that gives an Executor for the option's value.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import AbstractContextManager
from types import ModuleType
from typing import Any, Protocol

from generator.command_line import command_line
from generator.discovery import modules
from generator.errors import InputError


class Executor(Protocol):
    """Runs a function on tasks; what a worker that dies had not finished runs again on another."""

    def map(self, function: Callable[[Any], Any], tasks: Mapping[str, Any]) -> Iterator[tuple[str, Any]]:
        """(name, ``function(task)``) of each task as it is done, in any order.

        The function, tasks and results can be pickled. What the function raises is raised here.
        """


def configure(parser: argparse._ActionsContainer) -> None:
    """The options of all executors."""
    for module in _modules():
        if module.OPTION is not None:
            parser.add_argument(module.OPTION, metavar=module.METAVAR, help=module.HELP)


def opened(arguments: argparse.Namespace) -> AbstractContextManager[Executor]:
    """The executor that the command line asks for; raises InputError where it asks for more than one."""
    asked = [
        (module, value)
        for module in _modules()
        if module.OPTION is not None
        and (value := getattr(arguments, module.OPTION.lstrip("-").replace("-", "_"))) is not None
    ]
    if len(asked) > 1:
        raise InputError(command_line(asked[1][0].OPTION), f"{asked[0][0].OPTION} is given as well", "one of them")
    module, value = asked[0] if asked else (next(one for one in _modules() if one.OPTION is None), "")
    result: AbstractContextManager[Executor] = module.opened(value)
    return result


def _modules() -> list[ModuleType]:
    return modules(sys.modules[__name__])
