"""Compiling the generated C, in both precisions, and running its self-test."""

from __future__ import annotations

import re
import tempfile
from dataclasses import dataclass
from pathlib import Path

from generator.compiler import compiler, run
from generator.errors import InputError, Place

#: The generated C is clean under all of these.
WARNINGS = ("-Wall", "-Wextra", "-Wshadow", "-Wconversion", "-Wdouble-promotion", "-pedantic", "-Werror")
_FLAGS = ("-std=c99", "-O1", *WARNINGS)

_TALLY = re.compile(r"(\d+) passed, (\d+) failed\s*\Z")


class SelfTestFailure(Exception):
    """The generated C does not compute what it should: a defect of the generator."""


@dataclass(frozen=True)
class Precision:
    """A floating-point type of the generated C, and the macro's ending that selects it ("" is the default)."""

    name: str
    macro: str = ""


PRECISIONS = (Precision("double"), Precision("float", "USE_FLOAT"))


def run_self_test(folder: Path, name: str, precision: Precision) -> int:
    """Compiles ``<name>.c`` and its self-test in ``folder`` and runs it; returns the number of comparisons that passed.

    Raises SelfTestFailure with the test's own words, and InputError where the compiler does not compile it.
    """
    define = [f"-D{name.upper()}_{precision.macro}"] if precision.macro else []
    sources = [str(folder / f"{name}.c"), str(folder / f"{name}_selftest.c")]
    with tempfile.TemporaryDirectory() as build:
        program = str(Path(build, "selftest"))
        done = run([*compiler(), *_FLAGS, *define, *sources, "-o", program, "-lm"])
        if done.status != 0:
            problem = f"its C cannot be compiled in {precision.name} ({done.reason})"
            raise InputError(Place(str(folder)), problem, f"a C99 compiler that takes {' '.join(_FLAGS)}; set CC")
        done = run([program])
    tally = _TALLY.search(done.output)
    if done.status != 0 or tally is None or int(tally[1]) == 0 or int(tally[2]) != 0:
        what = f"the self-test of {name} in {precision.name} ends with status {done.status}"
        raise SelfTestFailure(f"{what} and says:\n{done.output}")
    return int(tally[1])
