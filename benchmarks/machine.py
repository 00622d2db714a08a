"""The machine that a study ran on, as far as it matters for times; no name, path or date."""

from __future__ import annotations

import os
import platform
import shutil
from collections.abc import Iterator
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from benchmarks import compiling

#: Tools that rows depend on, and packages whose versions count.
TOOLS = ("gcc", "g++", "clang", "clang++", "valgrind")
PACKAGES = ("libpinocchio", "mujoco", "casadi", "numpy")


def machine() -> dict[str, str]:
    """What stands beside the results."""
    return {
        "processor": _processor(),
        "cores": str(os.cpu_count()),
        "system": f"{platform.system()} {platform.machine()}, {' '.join(platform.libc_ver()) or 'unknown C library'}",
        **{name: compiling.version(name) for name in ("gcc", "clang") if shutil.which(name)},
        "flags": " ".join(compiling.FLAGS),
        **{name: found for name in PACKAGES if (found := _package(name))},
    }


def missing() -> Iterator[str]:
    """Tools and packages that this machine lacks."""
    yield from (name for name in TOOLS if not shutil.which(name))
    yield from (f"Python package {name}" for name in PACKAGES if not _package(name))


def _package(name: str) -> str | None:
    try:
        return version(name)
    except PackageNotFoundError:
        return None


def _processor() -> str:
    """The processor's name and, as names on virtual machines say little, its family and model."""
    told = Path("/proc/cpuinfo")
    lines = told.read_text().splitlines() if told.exists() else []
    facts = {key.strip(): value.strip() for key, _, value in (line.partition(":") for line in lines)}
    name = facts.get("model name") or platform.processor() or "unknown"
    if "cpu family" in facts:
        return f"{name}, family {facts['cpu family']} model {facts['model']}"
    return name
