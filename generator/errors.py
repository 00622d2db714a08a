"""The one error that a user can cause, with the place where it was caused."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Place:
    """A position in a file that the user wrote; line and column count from 1."""

    file: str
    line: int = 1
    column: int = 1

    def __str__(self) -> str:
        return f"{self.file}:{self.line}:{self.column}"


#: The place of what no file says.
NOWHERE = Place("")


class InputError(Exception):
    """Bad input: one line that says where, what is wrong and what was expected.

    ``str(error)`` is ``FILE:LINE:COL: what is wrong, expected ...``; the command line puts ``error: `` in front
    and exits with status 2.
    """

    def __init__(self, place: Place, problem: str, expected: str) -> None:
        # A name in the message may have several lines; the message is one.
        super().__init__(" ".join(f"{place}: {problem}, expected {expected}".splitlines()))
        self.place = place
        self.problem = problem
        self.expected = expected

    def __reduce__(self) -> tuple[Any, ...]:
        """As it is, from another process too; by default an exception is made anew of its message alone."""
        return _again, (type(self), str(self), self.__dict__)


def _again(kind: type[InputError], line: str, told: Mapping[str, Any]) -> InputError:
    error = kind.__new__(kind, line)
    error.__dict__.update(told)
    return error
