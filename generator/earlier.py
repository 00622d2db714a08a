"""What an earlier generation left in a folder, by its manifest: all else there is somebody's own."""

from __future__ import annotations

import json
from pathlib import Path, PurePosixPath

MANIFEST = "manifest.json"


def library_of(name: str) -> str:
    """Path of the Python module's library, which is compiled beside the generated files of ``name``."""
    return f"python/lib{name}.so"


def left_in(folder: Path) -> set[str]:
    """Paths, relative to ``folder``, of what was generated into it; none where its manifest is not of a generation."""
    try:
        found = json.loads((folder / MANIFEST).read_bytes())
    except (OSError, ValueError):
        return set()
    files = found.get("files") if isinstance(found, dict) and "generator" in found else None
    if not isinstance(files, list):
        return set()
    # A manifest that was changed by hand names nothing outside of its folder.
    inside = {one for one in files if isinstance(one, str) and _inside(PurePosixPath(one))}
    return {MANIFEST, library_of(folder.name), *inside}


def _inside(path: PurePosixPath) -> bool:
    return bool(path.parts) and not path.is_absolute() and ".." not in path.parts
