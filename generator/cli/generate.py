"""Generate everything from a robot file: C, batch functions, simulation, CasADi, NumPy, Python, reviews, manifest.json.

The files go to OUT/<robot's name>/. They replace those of an older generation all at once, and leave all other files
there as they are; on bad input nothing is written.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from generator.cli.shared_arguments import takes_out, takes_robot
from generator.progress import stage
from generator.resources import find_robot
from generator.symbolic.counts import HEADS


def configure(parser: argparse.ArgumentParser) -> None:
    """ROBOT, --out, --plain, --build-in, --self-test and --library."""
    takes_robot(parser)
    takes_out(parser, "where the files go (default: generated)", default=Path("generated"))
    parser.add_argument(
        "--plain",
        action="store_true",
        help="write the textbook recursion with SYMORO's names; longer, for reading beside a paper",
    )
    parser.add_argument(
        "--build-in",
        metavar="SET",
        help="write the values of a parameter set into the code as numbers, into OUT/<robot>_<SET>/",
    )
    parser.add_argument(
        "--self-test",
        action="store_true",
        help="compile the C in double and float (compiler: CC or cc) and run its test",
    )
    parser.add_argument(
        "--library",
        action="store_true",
        help="compile the library of the Python module (compiler: CC or cc)",
    )


def run(arguments: argparse.Namespace) -> None:
    """Generates, tests if asked to, prints a summary."""
    from generator.c_selftest import PRECISIONS, run_self_test
    from generator.generation import generate
    from generator.python_library import build_library

    folder, manifest = generate(find_robot(arguments.robot), arguments.out, stage, arguments.plain, arguments.build_in)
    passed: dict[str, int] = {}
    if arguments.self_test:
        for precision in PRECISIONS:
            with stage(f"compiling the C in {precision.name} and running its self-test"):
                passed[precision.name] = run_self_test(folder / "c", folder.name, precision)
    if arguments.library:
        with stage("compiling the library of the Python module"):
            build_library(folder, folder.name)
    print(_summary(folder, manifest, passed))


def _summary(folder: Path, manifest: dict[str, Any], passed: dict[str, int]) -> str:
    from generator.backends.printing.signals import headline

    robot, base = manifest["robot"], manifest["base_parameters"]
    lines = [headline(robot["name"], robot["description"]), f"base parameters  {len(base)}"]
    lines += [f"effect           {_effect(effect)}" for effect in manifest["effects"]]
    if manifest["flexible"]:
        lines.append(f"elastic joints   {', '.join(map(str, manifest['flexible']))}")
    lines += _operations(manifest["functions"])
    lines += [f"self-test        {count} comparisons passed in {name}" for name, count in passed.items()]
    lines.append(
        f"files            {len(manifest['files']) + 1} in {folder}/: {_files(manifest['files'])}, manifest.json"
    )
    return "\n".join(lines)


def _effect(effect: dict[str, Any]) -> str:
    return f"{effect['title']} on {', '.join(map(str, effect['joints']))}: {' '.join(effect['parameters'])}"


def _operations(functions: dict[str, Any]) -> list[str]:
    width = max(map(len, functions))
    rows = [("operations", HEADS), *((name, one["operations"].values()) for name, one in functions.items())]
    return [" ".join([name.ljust(width), *(str(cell).rjust(7) for cell in cells)]) for name, cells in rows]


def _files(paths: list[str]) -> str:
    """``c (4), casadi (2)``: the number of files in each backend's folder."""
    folders = [path.partition("/")[0] for path in paths]
    return ", ".join(f"{name} ({folders.count(name)})" for name in dict.fromkeys(folders))
