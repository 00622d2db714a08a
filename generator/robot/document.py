"""What a robot file says before anything is made of it: texts, lists and tables, each with its place.

Readers of any format produce this tree; the sections understand it. All values are still text, so that a number is
as exact as it was written.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, TypeAlias

from generator.errors import Place


@dataclass(frozen=True)
class Text:
    """A scalar. Its ``content`` starts at ``inside``; None if columns in it are not those of the file."""

    content: str
    place: Place
    quoted: bool = False
    inside: Place | None = None


@dataclass(frozen=True)
class Items:
    """A list."""

    items: tuple[Node, ...]
    place: Place


@dataclass(frozen=True)
class Entry:
    """A key's place and its value."""

    key: Place
    value: Node


@dataclass(frozen=True)
class Table:
    """Keys with their values, in the order of the file."""

    entries: Mapping[str, Entry]
    place: Place


Node: TypeAlias = Text | Items | Table


def digest(node: Node) -> str:
    """SHA-256 of what the tree says, whatever the layout, the comments, the quotes and the order of keys."""
    canonical = json.dumps(_plain(node), sort_keys=True, ensure_ascii=True, separators=(",", ":"))
    return hashlib.sha256(canonical.encode("ascii")).hexdigest()


def _plain(node: Node) -> Any:
    if isinstance(node, Text):
        return " ".join(node.content.split())
    if isinstance(node, Items):
        return [_plain(item) for item in node.items]
    return {key: _plain(entry.value) for key, entry in node.entries.items()}
