"""Edits of a robot file's text: a value, a key, an item of a list; comments and layout of all the rest stay."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from functools import lru_cache
from typing import Any

from generator.robot.content import robot_from
from generator.robot.description import Robot
from generator.robot.readers import yaml

#: Sections in the order in which a new one finds its place.
_SECTIONS = (
    "name", "description", "source", "gravity", "base", "geometry", "joints", "drives", "effects", "flexible",
    "signals", "parameters",
)  # fmt: skip

#: Steps to a value: keys of tables, numbers of items.
Path = Sequence[str | int]


def robot_of(text: str, file: str) -> Robot:
    """The robot that the text of a robot file describes; ``file`` is its name in messages.

    Raises InputError as reading a file does.
    """
    return robot_from(yaml.read(text, file))


def value_of(text: str, path: Path) -> str:
    """What stands at ``path``, as it is written but for quotes; raises KeyError where nothing does."""
    node = _find(text, path)
    if node is None:
        raise KeyError("/".join(map(str, path)))
    if isinstance(node.value, str):
        return node.value
    return text[node.start_mark.index : _end(text, node)]


def keys_of(text: str, path: Path) -> tuple[str, ...]:
    """The keys of the table at ``path``; none where there is none."""
    node = _find(text, path)
    return () if node is None else tuple(key.value for key, _ in node.value)


def with_value(text: str, path: Path, value: str) -> str:
    """``text`` with ``value``, written in YAML on one line, at ``path``; a key that is missing is the last one after.

    Raises KeyError where nothing is above it.
    """
    above, last = path[:-1], path[-1]
    if not above and _find(text, path) is None:
        return _with_section(text, str(last), f" {value}", value)
    node = _find(text, path)
    if node is not None:
        head = text[: node.start_mark.index]
        # The dashes of a list may stand below its key; what is on one line may not.
        apart = " " if isinstance(node.value, list) and not node.flow_style else ""
        return f"{head}{apart}{value}{text[_end(text, node) :]}"
    table = _find(text, above)
    if table is None and len(above) == 1:
        return _with_section(text, str(above[0]), f"\n  {last}: {value}", f"{{{last}: {value}}}")
    if table is None or not isinstance(table.value, list):
        raise KeyError(f"{'/'.join(map(str, path))} has nothing above it")
    return _appended(text, table, f"{last}: {value}", "")


def with_entries(text: str, path: Path, entries: Mapping[int, str], otherwise: Sequence[str]) -> str:
    """``text`` with ``entries`` by number in the list at ``path``; the others stay as they are written. One value for
    all becomes a list; one that is missing has ``otherwise`` for the others.
    """
    node = _find(text, path)
    if node is not None and isinstance(node.value, list):
        for k, entry in entries.items():
            text = with_value(text, (*path, k), entry)
        return text
    every = otherwise if node is None else [value_of(text, path)] * len(otherwise)
    return with_value(text, path, f"[{', '.join(entries.get(k, old) for k, old in enumerate(every))}]")


def with_item(text: str, section: str, item: str, comment: str = "") -> str:
    """``text`` with ``item``, written in YAML on one line, as the last of the list ``section``.

    ``comment`` stands above it, where the list has a line for each item.
    """
    node = _find(text, (section,))
    above = f"  # {comment}\n" if comment else ""
    if node is None:
        return _with_section(text, section, f"\n{above}  - {item}", f"[{item}]")
    if not node.value:
        start, end, root = node.start_mark.index, _end(text, node), _find(text, ())
        if root.flow_style:
            return text[:start] + f"[{item}]" + text[end:]
        return text[:start].rstrip() + _indented(f"\n{above}  - {item}", root) + text[end:]
    return _appended(text, node, item if node.flow_style else f"- {item}", comment)


def _appended(text: str, node: Any, entry: str, comment: str) -> str:
    """One more entry of a list or table."""
    if not node.value:
        inside = node.start_mark.index + 1
        return text[:inside] + entry + text[inside:]
    last = node.value[-1][1] if isinstance(node.value[-1], tuple) else node.value[-1]
    end = _end(text, last)
    if node.flow_style:
        return text[:end] + f", {entry}" + text[end:]
    indent = " " * node.start_mark.column
    line = text.find("\n", end)
    line = len(text) if line < 0 else line
    above = f"{indent}# {comment}\n" if comment else ""
    return text[:line] + f"\n{above}{indent}{entry}" + text[line:]


def _with_section(text: str, name: str, block: str, flow: str) -> str:
    """A section of its own after those that come before it, in a file of braces the last one, its content ``flow``."""
    root = _find(text, ())
    if root.flow_style:
        return _appended(text, root, f"{name}: {flow}", "")
    before = _SECTIONS[: _SECTIONS.index(name)]
    ends = [_end(text, node) for one in before if (node := _find(text, (one,))) is not None]
    line = text.find("\n", max(ends))
    head, tail = (text, "") if line < 0 else (text[:line], text[line + 1 :])
    return head + _indented(f"\n\n{name}:{block}\n", root) + tail


def _indented(lines: str, root: Any) -> str:
    """Lines of the whole file as far to the right as the others are."""
    return re.sub(r"\n(?=[^\n])", "\n" + " " * root.start_mark.column, lines)


def _find(text: str, path: Path) -> Any:
    """The node at ``path``; None without one."""
    node = _root(text)
    for step in path:
        if isinstance(step, int):
            node = node.value[step]
            continue
        node = next((value for key, value in node.value if key.value == step), None)
        if node is None:
            return None
    return node


@lru_cache(maxsize=1)
def _root(text: str) -> Any:
    """The whole file; of the text that was asked for last it is kept."""
    return yaml.composed(text)


def _end(text: str, node: Any) -> int:
    """Where a node's text ends, blank lines and comments after it left aside."""
    if isinstance(node.value, str) or node.flow_style or not node.value:
        end: int = node.end_mark.index
        return len(re.sub(r"\s+\Z", "", text[:end])) if isinstance(node.value, str) else end
    last = node.value[-1]
    return _end(text, last[1] if isinstance(last, tuple) else last)
