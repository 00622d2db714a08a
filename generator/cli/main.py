"""The command ``counterpoise``: finds the commands, runs one, turns what the user can mend into one line.

Exit status 0 is done; 2 is bad input, with ``error: FILE:LINE:COL: what is wrong, expected ...`` on standard error;
1 is a defect of this program, with its traceback.
"""

from __future__ import annotations

import argparse
import atexit
import gc
import importlib
import os
import sys
import tomllib
from collections.abc import Sequence
from importlib import metadata
from io import TextIOWrapper
from itertools import takewhile
from pathlib import Path
from typing import NoReturn, Protocol, cast

from generator.command_line import command_line
from generator.errors import InputError
from generator.version import VERSION

GROUP = "counterpoise.commands"

#: Where a checkout that is not installed names its commands.
_PROJECT = Path(__file__).resolve().parents[2] / "pyproject.toml"

DONE, BAD_INPUT, INTERRUPTED = 0, 2, 130

#: Matrices here are small or narrow: more threads of NumPy's BLAS gain nothing, and on a busy machine they wait for
#: each other. It is read when NumPy is imported, by the command.
_THREADS = "OPENBLAS_NUM_THREADS"


class Command(Protocol):
    """What a module in the entry-point group ``counterpoise.commands`` offers; its docstring is the help text."""

    __doc__: str | None

    def configure(self, parser: argparse.ArgumentParser) -> None:
        """Adds the command's arguments."""

    def run(self, arguments: argparse.Namespace) -> None:
        """Does the work; raises InputError for bad input."""


class _Parser(argparse.ArgumentParser):
    """Reports a mistake on the command line as bad input, in the same form as a mistake in a file."""

    def error(self, message: str) -> NoReturn:
        raise InputError(command_line(self.prog), message, f"what {self.prog} --help tells")


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the command that ``argv`` names (the process's own arguments, if None); returns the exit status."""
    os.environ.setdefault(_THREADS, "1")
    if isinstance(sys.stdout, TextIOWrapper):
        # A robot file may have letters that the terminal has not.
        sys.stdout.reconfigure(errors="backslashreplace")
    if argv is None:
        # What a command leaves goes with its process; Python's last collection would walk all of it first.
        atexit.register(gc.freeze)
    try:
        words = sys.argv[1:] if argv is None else argv
        arguments, unknown = _parser(commands()).parse_known_args(words)
        if unknown:
            arguments.parser.error(f"unrecognized arguments: {' '.join(unknown)}")
        _check_once(words, arguments.parser.prog)
        arguments.command.run(arguments)
        if sys.stdout is not None:
            sys.stdout.flush()
    except InputError as error:
        print(f"error: {error}", file=sys.stderr)
        return BAD_INPUT
    except BrokenPipeError:
        # The reader has seen enough.
        _write_no_more()
    except OSError as error:
        if sys.stdout is None or not _is_stuck():
            raise
        _write_no_more()
        print(f"error: standard output:1:1: {error.strerror}, expected a place for what is printed", file=sys.stderr)
        return BAD_INPUT
    except KeyboardInterrupt:
        return INTERRUPTED
    return DONE


def _is_stuck() -> bool:
    """Whether standard output does not take a line either."""
    try:
        print(flush=True)
    except OSError:
        return True
    return False


def _write_no_more() -> None:
    """Nothing more is written to standard output, not even when Python closes it."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _check_once(words: Sequence[str], command: str) -> None:
    """Raises InputError for an option that is given twice, of which argparse would take the last alone."""
    seen = set()
    for word in takewhile(lambda word: word != "--", words):
        name = word.partition("=")[0]
        if name.startswith("--") and name in seen:
            raise InputError(command_line(f"{command} {name}"), "the option is given twice", "it once")
        seen.add(name)


def commands() -> dict[str, Command]:
    """The commands by name, sorted: every installed distribution can register its own in the entry-point group."""
    registered = {entry.name: entry.load() for entry in metadata.entry_points(group=GROUP)}
    found = registered or {name: importlib.import_module(module) for name, module in _of_checkout().items()}
    return {name: cast(Command, found[name]) for name in sorted(found)}


def _of_checkout() -> dict[str, str]:
    """The modules of the commands by name, from the project's file."""
    project = tomllib.loads(_PROJECT.read_text(encoding="utf-8"))["project"]
    modules: dict[str, str] = project["entry-points"][GROUP]
    return modules


def _parser(known: dict[str, Command]) -> argparse.ArgumentParser:
    parser = _Parser(prog="counterpoise", description="Dynamic models of robots, from one file to reviewed code.")
    parser.add_argument("--version", action="version", version=f"counterpoise {VERSION}")
    choices = parser.add_subparsers(metavar="COMMAND", required=True, parser_class=_Parser)
    for name, command in known.items():
        text = (command.__doc__ or "").strip()
        chosen = choices.add_parser(
            name,
            help=text.partition("\n")[0],
            description=text,
            formatter_class=argparse.RawDescriptionHelpFormatter,
            allow_abbrev=False,
        )
        chosen.set_defaults(command=command, parser=chosen)
        command.configure(chosen)
    return parser
