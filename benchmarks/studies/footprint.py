"""Code size and stack use of each function on a Cortex-M7: compiled for it, not run."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Mapping
from pathlib import Path

from benchmarks.study import alone
from generator.backends import c
from generator.derivation import derive
from generator.resources import find_robot
from generator.robot.readers import read
from tests.compiled import write

TITLE = "Code size and stack use on a Cortex-M7"

ROBOT = "kr500"
COMPILER = "arm-none-eabi-gcc"
TARGET = ("-mthumb", "-mcpu=cortex-m7", "-mfpu=fpv5-d16", "-mfloat-abi=hard")
FLAGS = ("-std=c99", "-O2", "-ffp-contract=fast", "-ffunction-sections", "-fstack-usage")
PRECISIONS: Mapping[str, tuple[str, ...]] = {"double": (), "float": (f"-D{ROBOT.upper()}_USE_FLOAT",)}


def run(build: Path) -> dict[str, object]:
    """A row for each function: bytes of code and of stack, in both precisions; last the totals."""
    write(build, c.library(derive(read(find_robot(ROBOT)), check=False), ()))
    measured = {precision: _measured(build, precision) for precision in PRECISIONS}
    rows: list[dict[str, object]] = []
    for function in measured["double"]:
        row: dict[str, object] = {"function": function.removeprefix(f"{ROBOT}_")}
        for precision, functions in measured.items():
            code, stack = functions[function]
            row |= {f"code, {precision} [B]": code, f"stack, {precision} [B]": stack}
        rows.append(row)
    total: dict[str, object] = {"function": "all: text and constants; deepest stack"}
    for precision, functions in measured.items():
        total |= {f"code, {precision} [B]": _text(build, precision)}
        total |= {f"stack, {precision} [B]": max(stack for _, stack in functions.values())}
    notes = [f"{COMPILER} {' '.join(TARGET + FLAGS)}", "stack without that of functions called"]
    return {"rows": [*rows, total], "notes": notes}


def _measured(build: Path, precision: str) -> dict[str, tuple[int, int]]:
    """Bytes of code and of stack by function."""
    library = build / f"{precision}.o"
    source = [str(build / f"{ROBOT}.c"), "-o", str(library)]
    _output(COMPILER, *TARGET, *FLAGS, *PRECISIONS[precision], "-c", *source)
    used = re.findall(r":(\w+)\t(\d+)\t", library.with_suffix(".su").read_text())
    stacks = {function: int(size) for function, size in used}
    symbols = _output("arm-none-eabi-nm", "--print-size", str(library))
    sizes = re.findall(r"^\S+ (\S+) [tT] (\w+)$", symbols, re.MULTILINE)
    return {name: (int(size, 16), stacks[name]) for size, name in sizes if name in stacks}


def _text(build: Path, precision: str) -> int:
    """Bytes of all code and constants."""
    return int(_output("arm-none-eabi-size", str(build / f"{precision}.o")).splitlines()[1].split()[0])


def _output(*command: str) -> str:
    return subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True).stdout


if __name__ == "__main__":
    import benchmarks.studies.footprint as study

    alone(__file__, study)
