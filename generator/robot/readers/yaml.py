"""Robot files in YAML.

The text is taken apart by ruamel's parser; the tree is built here, without types, tags or anchors, so that nothing in
a file can be code, grow by aliases or be read as another type than it was written.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from ruamel.yaml import YAML
from ruamel.yaml.error import MarkedYAMLError, YAMLError
from ruamel.yaml.reader import ReaderError

from generator.errors import InputError, Place
from generator.robot.document import Entry, Items, Node, Table, Text

EXTENSIONS = (".yaml", ".yml")

#: Bounds that no honest robot file meets; they keep the time to refuse any file short.
_MAX_CHARACTERS = 2_000_000
_MAX_DEPTH = 16
_MAX_NODES = 20_000
_MAX_WORD = 4096

#: Unicode's space separators, such as the no-break space of web pages and word processors: YAML takes them for letters.
_SPACES = "\u00a0\u1680\u202f\u205f\u3000" + "".join(map(chr, range(0x2000, 0x200B)))
_BLANKS = str.maketrans(_SPACES, " " * len(_SPACES))
#: All that is a blank.
BLANKS = " " + _SPACES
#: A character without width where a word begins.
_UNSEEN = re.compile(r"(?:^|[-:]) *([\u00ad\u200b-\u200f\u2060-\u2064\ufeff])")

_OVERLONG = re.compile(rf"[^\s\[\]{{}},]{{{_MAX_WORD + 1}}}")


def read(text: str, file: str, of: str = "a robot file") -> Node:
    """The tree that ``text`` says; ``file`` is its name in messages, ``of`` what it should be.

    Any space of Unicode is a blank. Raises InputError, at its line and column, for anything but one YAML document of
    plain tables, lists and scalars with no key given twice.
    """
    expected = f"{of} in YAML"
    _check_size(text, file, expected)
    try:
        return _Builder(file, text.translate(_BLANKS), of).document()
    except MarkedYAMLError as error:
        unclosed = "end of stream" in (error.problem or "")
        mark = (error.context_mark if unclosed else None) or error.problem_mark or error.context_mark
        place = Place(file, mark.line + 1, mark.column + 1) if mark else Place(file)
        _check_unseen(text.translate(_BLANKS), place)
        raise InputError(place, f"not YAML: {_one_line(error.problem or error.context)}", expected) from None
    except ReaderError as error:
        line = text.count("\n", 0, error.position) + 1
        column = error.position - text.rfind("\n", 0, error.position)
        raise InputError(Place(file, line, column), f"not YAML: character {error.character!r}", expected) from None
    except (YAMLError, ValueError) as error:
        raise InputError(Place(file), f"not YAML: {_one_line(str(error))}", expected) from None


def composed(text: str) -> Any:
    """The root of ruamel's nodes, whose marks are places in ``text``; for a text that ``read`` takes."""
    return YAML(typ="safe", pure=True).compose(text.translate(_BLANKS))


def _check_unseen(text: str, place: Place) -> None:
    """That no character without width, outside a comment, keeps what stands on the line of ``place``, or on the one
    before, from being YAML.
    """
    lines = text.split("\n")
    for line in range(place.line, max(place.line - 2, 0), -1):
        if match := _UNSEEN.search(lines[line - 1].partition("#")[0]):
            problem = f"not YAML: U+{ord(match[1]):04X}, a character without width"
            raise InputError(Place(place.file, line, match.start(1) + 1), problem, "a blank, or nothing")


def _check_size(text: str, file: str, expected: str) -> None:
    if len(text) > _MAX_CHARACTERS:
        raise InputError(Place(file), f"the file has {len(text)} characters", f"at most {_MAX_CHARACTERS}")
    if match := _OVERLONG.search(text):
        start = match.start()
        place = Place(file, text.count("\n", 0, start) + 1, start - text.rfind("\n", 0, start))
        raise InputError(place, f"a word of more than {_MAX_WORD} characters", expected)


def _one_line(text: str | None) -> str:
    return " ".join((text or "unreadable").split())


class _Builder:
    """The tree from the parser's events."""

    def __init__(self, file: str, text: str, of: str) -> None:
        self._file = file
        self._of = of
        self._events: Iterator[Any] = YAML(typ="safe", pure=True).parse(text)
        self._nodes = 0

    def document(self) -> Node:
        next(self._events)
        start = next(self._events)
        if _kind(start) == "StreamEnd":
            raise InputError(Place(self._file), "the file is empty", self._of)
        root = self._node(next(self._events), 0)
        if isinstance(root, Text) and not root.content:
            raise InputError(root.place, "the file is empty", self._of)
        next(self._events)
        following = next(self._events)
        if _kind(following) != "StreamEnd":
            raise InputError(self._place(following.start_mark), "a second document", "one document in a file")
        return root

    def _node(self, event: Any, depth: int) -> Node:
        place = self._place(event.start_mark)
        self._check(event, place, depth)
        kind = _kind(event)
        if kind == "SequenceStart":
            return self._items(place, depth)
        if kind == "MappingStart":
            return self._table(place, depth)
        return self._text(event, place)

    def _check(self, event: Any, place: Place, depth: int) -> None:
        self._nodes += 1
        if _kind(event) == "Alias":
            raise InputError(place, f"alias '*{event.anchor}'", "the value itself")
        if event.anchor is not None:
            raise InputError(place, f"anchor '&{event.anchor}'", "the value alone")
        if event.tag is not None:
            raise InputError(place, f"tag {str(event.tag)!r}", "the value alone")
        if depth > _MAX_DEPTH:
            raise InputError(place, "the file is nested too deeply", f"at most {_MAX_DEPTH} levels")
        if self._nodes > _MAX_NODES:
            raise InputError(place, "the file says too much", f"at most {_MAX_NODES} values")

    def _items(self, place: Place, depth: int) -> Items:
        items = []
        while _kind(event := next(self._events)) != "SequenceEnd":
            items.append(self._node(event, depth + 1))
        return Items(tuple(items), place)

    def _table(self, place: Place, depth: int) -> Table:
        entries: dict[str, Entry] = {}
        while _kind(event := next(self._events)) != "MappingEnd":
            key = self._node(event, depth + 1)
            if not isinstance(key, Text):
                raise InputError(key.place, "a list or table as a key", "a word")
            if key.content in entries:
                first = entries[key.content].key
                raise InputError(key.place, f"key {key.content!r} is given twice", f"it once (line {first.line})")
            value = self._node(next(self._events), depth + 1)
            if isinstance(value, Text) and not value.content and not value.quoted:
                value = replace(value, place=key.place)
            entries[key.content] = Entry(key.place, value)
        return Table(entries, place)

    def _text(self, event: Any, place: Place) -> Text:
        quoted = event.style is not None
        start, end = event.start_mark, event.end_mark
        width = end.column - start.column - (2 if quoted else 0)
        if any("\ud800" <= character <= "\udfff" for character in event.value):
            raise InputError(place, "half of a surrogate pair", "a character of Unicode")
        literal = start.line == end.line and width == len(event.value) and event.style in (None, "'", '"')
        inside = Place(self._file, place.line, place.column + quoted) if literal else None
        return Text(event.value, place, quoted, inside)

    def _place(self, mark: Any) -> Place:
        return Place(self._file, mark.line + 1, mark.column + 1)


def _kind(event: Any) -> str:
    return type(event).__name__.removesuffix("Event")
