"""Instructions of the generated functions, counted by callgrind: never times."""

from __future__ import annotations

import json
import platform
from pathlib import Path

import pytest

from benchmarks.documents import RESULTS
from benchmarks.instructions import FLAGS, instructions
from benchmarks.studies.instructions import LIMITS, ROTORS, Limit
from benchmarks.variants import variant
from tests.compiled import run
from tests.extra.tools import tool

#: Over the limits, and over what was counted last, which another release of the compiler may use up.
_SLACK = 1.03
#: Instructions of KR500's functions as `make bench` counted them last, by function and what the robot has.
COUNTED = {
    (row["function"], row["effects"]): row["own sine"]
    for row in json.loads(RESULTS.read_text(encoding="utf-8"))["studies"]["instructions"]["rows"]
}


def _is_gcc_12() -> bool:
    return platform.machine() == "x86_64" and run([tool("gcc"), "-dumpversion"]).split(".")[0].strip() == "12"


@pytest.mark.parametrize(
    ("name", "limit"),
    # The limit of the complete function is that of one robot.
    [(name, limit) for name in ("kr500", "kr270") for limit in LIMITS if limit.effects is not None or name == "kr500"],
    ids=lambda one: one if isinstance(one, str) else f"{one.function}-{one.most}",
)
def test_no_function_takes_more_than_its_limit(name: str, limit: Limit, tmp_path: Path) -> None:
    tool("valgrind")
    if not _is_gcc_12():
        pytest.skip("the limits are those of gcc 12 on x86-64")
    counted = instructions(limit.robot(name), [limit.function], tmp_path)
    least = limit.most if name == "kr270" else min(limit.most, COUNTED[limit.function, limit.of])
    assert counted[limit.function] <= _SLACK * least


@pytest.mark.skipif(platform.machine() != "x86_64", reason="the flags are those of x86-64")
def test_own_sine_and_cosine_take_fewer_instructions_than_the_librarys(tmp_path: Path) -> None:
    tool("valgrind")
    robot, function = variant("kr500", ROTORS), "inverse_dynamics"
    own = instructions(robot, [function], tmp_path)[function]
    library = instructions(robot, [function], tmp_path, flags=(*FLAGS, "-DKR500_USE_LIBM"))[function]
    assert own < 0.8 * library
