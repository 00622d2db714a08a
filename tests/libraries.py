"""Libraries of robots that tests simulate or diagnose, compiled once for all tests of a run."""

from __future__ import annotations

import os
import re
import shutil
from collections.abc import Callable
from hashlib import sha256
from pathlib import Path

from generator.earlier import library_of
from generator.python_library import build_library


def built_once(kept: Path) -> Callable[[Path, str], Path]:
    """Does what ``build_library`` does, and keeps in ``kept`` what a compiler makes of the same sources."""

    def built(folder: Path, name: str) -> Path:
        sources = sorted(path for path in folder.rglob("*") if path.suffix in (".c", ".h"))
        # Their comments tell the digest of the robot file, which no code depends on.
        texts = [(path.name, re.sub(r"/\*.*?\*/", "", path.read_text(), flags=re.DOTALL)) for path in sources]
        key = repr([os.environ.get("CC"), name, *texts])
        known, library = kept / f"{sha256(key.encode()).hexdigest()}.so", folder / library_of(name)
        if known.exists():
            # One that is loaded stays as it is.
            library.unlink(missing_ok=True)
            shutil.copy(known, library)
        else:
            build_library(folder, name)
            # Another process that tests may be at the same one.
            own = shutil.copy(library, known.with_suffix(f".{os.getpid()}"))
            Path(own).replace(known)
        return library

    return built
