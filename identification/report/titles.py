"""Runs as they are called on a page."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from pathlib import Path


def titles(sources: Sequence[str]) -> list[str]:
    """Files' names without their folders; with them, where two are called alike."""
    names = [Path(source).name for source in sources]
    times = Counter(names)
    return [name if times[name] == 1 else source for name, source in zip(names, sources, strict=True)]
