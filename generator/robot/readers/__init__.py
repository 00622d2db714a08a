"""Robot files in their formats: one module each, found by the ending of the file's name."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from types import ModuleType

from generator.discovery import modules
from generator.errors import InputError, Place
from generator.robot.content import robot_from
from generator.robot.description import Robot
from generator.robot.document import Node

#: Bytes that no honest robot file reaches.
_MAX_BYTES = 4_000_000


def read(path: Path | str) -> Robot:
    """The robot that a file describes.

    Raises InputError, with the line and column, for a file that cannot be read and for everything in it that is not as
    ``docs/robot_file.md`` says.
    """
    path = Path(path)
    file = str(path)
    reader = _readers().get(path.suffix.lower())
    if reader is None:
        _check_file(path, file, "a robot file")
        raise InputError(Place(file), f"a file ending in {path.suffix!r}", " or ".join(endings()))
    return robot_from(reader.read(text_of(path, file), file))


def endings() -> tuple[str, ...]:
    """The endings of robot files' names, small letters after the dot."""
    return tuple(_readers())


def _readers() -> dict[str, ModuleType]:
    return {ending: module for module in modules(sys.modules[__name__]) for ending in module.EXTENSIONS}


def document(path: Path, expected: str) -> Node:
    """The tree of a file in YAML that is not a robot's; JSON is read as the YAML that it is.

    Raises InputError, saying what was ``expected``, for what cannot be read as such a file.
    """
    from generator.robot.readers import yaml

    return yaml.read(text_of(path, str(path), expected), str(path), expected)


def text_of(path: Path, file: str, expected: str = "a robot file") -> str:
    """The text of a file in UTF-8, its line ends made single; ``file`` is its name in messages.

    Raises InputError, saying what was ``expected``, for what cannot be read as such a text.
    """
    _check_file(path, file, expected)
    try:
        if (size := path.stat().st_size) > _MAX_BYTES:
            raise InputError(Place(file), f"the file has {size} bytes", f"at most {_MAX_BYTES}")
        content = path.read_bytes()
    except OSError as error:
        raise InputError(Place(file), f"cannot read the file ({error.strerror})", expected) from None
    try:
        return with_single_ends(content.decode("utf-8-sig"))
    except UnicodeDecodeError as error:
        raise undecodable(file, error, "a text file in UTF-8") from None


def undecodable(file: str, error: UnicodeDecodeError, expected: str) -> InputError:
    """That a file holds a byte of no text, with its place, by the ``error`` of decoding all that it holds."""
    before = with_single_ends(error.object[: error.start].decode(error.encoding, "ignore"))
    place = Place(file, before.count("\n") + 1, len(before) - before.rfind("\n"))
    problem = f"byte 0x{error.object[error.start]:02x} is not {error.encoding.upper()}"
    return InputError(place, problem, expected)


def _check_file(path: Path, file: str, expected: str) -> None:
    """What there is at ``path`` is a file."""
    if os.path.isdir(path):
        raise InputError(Place(file), "this is a folder", expected)
    if os.path.exists(path) and not os.path.isfile(path):
        raise InputError(Place(file), "this is not a regular file", expected)


def with_single_ends(text: str) -> str:
    """A text whose lines end in one character, whichever system wrote it."""
    return text.replace("\r\n", "\n").replace("\r", "\n")
