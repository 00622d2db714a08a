"""The generated C under other compilers than the user's own, under valgrind, and for a controller's processor."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from generator.backends import c
from generator.c_selftest import WARNINGS
from generator.derivation import derive
from generator.resources import find_robot
from generator.robot.readers import read
from tests.compiled import run, write
from tests.extra.tools import tool

#: Robots that are compiled each time, and those of make test-long alone.
ALWAYS, FURTHER = ("kr500", "scara"), ("kr270", "tree_two_arms")
PRECISIONS = ("double", "float")

#: What the library may ask of the target's C library: mathematics, nothing else.
MATHEMATICS = {"sin", "cos", "sqrt", "log", "exp", "tanh", "pow", "fabs"}


@pytest.fixture(scope="module", params=[*ALWAYS, *(pytest.param(name, marks=pytest.mark.long) for name in FURTHER)])
def library(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a robot's generated C, named after the robot."""
    folder = tmp_path_factory.mktemp("c") / request.param
    return write(folder, c.emit(derive(read(find_robot(request.param)))))


def sources(library: Path, precision: str) -> list[str | Path]:
    """The self-test's sources and the macro of the precision."""
    name = library.name
    macro = [f"-D{name.upper()}_USE_FLOAT"] if precision == "float" else []
    return [*macro, library / f"{name}.c", library / f"{name}_selftest.c"]


def passed(output: str) -> int:
    """How many comparisons a self-test passed; fails if any failed."""
    tally = re.search(r"^(\d+) passed, 0 failed$", output, re.MULTILINE)
    assert tally, output
    return int(tally[1])


@pytest.mark.parametrize("precision", PRECISIONS)
def test_clang_warns_of_nothing_and_computes_the_same(library: Path, precision: str, tmp_path: Path) -> None:
    program = tmp_path / "selftest"
    warnings = (*WARNINGS, "-Wimplicit-float-conversion", "-Wconditional-uninitialized", "-Wmissing-prototypes")
    run([tool("clang"), "-std=c99", "-O2", *warnings, *sources(library, precision), "-o", program, "-lm"])
    assert passed(run([program])) > 50


@pytest.mark.parametrize("precision", ["double", pytest.param("float", marks=pytest.mark.long)])
def test_valgrind_finds_no_bad_access_and_no_undefined_value(library: Path, precision: str, tmp_path: Path) -> None:
    valgrind, program = tool("valgrind"), tmp_path / "selftest"
    run(["gcc", "-std=c99", "-g", "-O1", *sources(library, precision), "-o", program, "-lm"])
    watched = [valgrind, "--error-exitcode=9", "--leak-check=full", "--errors-for-leak-kinds=all", program]
    assert passed(run(watched)) > 50


@pytest.mark.parametrize(
    ("precision", "unit"),
    [("float", "fpv4-sp-d16"), ("float", "fpv5-d16"), ("double", "fpv5-d16")],
)
def test_a_controllers_compiler_takes_it_and_needs_mathematics_alone(
    library: Path, precision: str, unit: str, tmp_path: Path
) -> None:
    compiler, symbols = tool("arm-none-eabi-gcc"), tool("arm-none-eabi-nm")
    core = "cortex-m4" if unit.startswith("fpv4") else "cortex-m7"
    target = ("-mthumb", f"-mcpu={core}", "-mfloat-abi=hard", f"-mfpu={unit}")
    macro, source = sources(library, precision)[:-2], library / f"{library.name}.c"
    compiled = tmp_path / "library.o"
    run([compiler, "-std=c99", "-O2", *WARNINGS, *target, *macro, "-c", source, "-o", compiled])
    wanted = {line.split()[-1] for line in run([symbols, "--undefined-only", compiled]).splitlines()}
    endings = {f"{name}f" for name in MATHEMATICS} if precision == "float" else MATHEMATICS
    assert wanted <= endings | {"memset", "memcpy", "__errno"}
    assert any(name in wanted for name in ("sin", "sinf"))
