"""What the compiler's flags do to the generated code: instructions and time of one call."""

from __future__ import annotations

import subprocess
from pathlib import Path

from benchmarks.instructions import instructions
from benchmarks.studies.instructions import ROTORS
from benchmarks.study import alone
from benchmarks.variants import variant

TITLE = "Compiler flags"

FUNCTIONS = ("inverse_dynamics", "regressor")
_BASE = ("-O2", "-march=haswell")
CHOICES: dict[str, tuple[str, ...]] = {
    "-std=c99 -O2": ("-std=c99", "-O2"),
    "-std=gnu99 -O2": ("-std=gnu99", "-O2"),
    "-std=c99 -O2 -march=haswell": ("-std=c99", *_BASE),
    "-std=gnu99 -O2 -march=haswell": ("-std=gnu99", *_BASE),
    "-std=c99 -O2 -ffp-contract=fast -march=haswell": ("-std=c99", "-ffp-contract=fast", *_BASE),
    "-std=c99 -O3 -ffp-contract=fast -march=haswell": ("-std=c99", "-ffp-contract=fast", "-O3", "-march=haswell"),
    "-std=c99 -O2 -ffast-math -march=haswell": ("-std=c99", "-ffast-math", *_BASE),
    "-std=c99 -O2 -ffp-contract=fast -march=haswell, libm": (
        "-std=c99",
        "-ffp-contract=fast",
        *_BASE,
        "-DKR500_USE_LIBM",
    ),
}
_ROUNDS = 15
_CALLS = 20000
_TIMER = """
#include <stdio.h>
#include <time.h>
#include "kr500.h"
static kr500_params params;
static kr500_prepared prepared;
static double state[3][6], result[240];
int main(void)
{
    struct timespec from, to;
    for (int i = 0; i < KR500_NPARAMETERS; ++i) {
        params.value[i] = 1.0 + 0.1 * i;
    }
    kr500_prepare(&params, &prepared);
    timespec_get(&from, TIME_UTC);
    for (int k = 0; k < CALLS; ++k) {
        for (int i = 0; i < 6; ++i) {
            state[0][i] = 0.1 * i + 1e-5 * k;
        }
        FUNCTION(&prepared, state[0], state[1], state[2], result);
    }
    timespec_get(&to, TIME_UTC);
    printf("%.1f", ((double)(to.tv_sec - from.tv_sec) * 1e9 + (double)(to.tv_nsec - from.tv_nsec)) / CALLS);
    return 0;
}
"""


def run(build: Path) -> dict[str, object]:
    """A row for each choice of flags: instructions, and the least time of one call over interleaved rounds."""
    robot = variant("kr500", ROTORS)
    rows: list[dict[str, object]] = []
    programs: dict[tuple[int, str], Path] = {}
    for number, (name, flags) in enumerate(CHOICES.items()):
        folder = build / str(number)
        counts = instructions(robot, FUNCTIONS, folder, flags=flags)
        rows.append({"gcc": name} | {f"{function} [instructions]": counts[function] for function in FUNCTIONS})
        (folder / "timer.c").write_text(_TIMER)
        for function in FUNCTIONS:
            programs[number, function] = folder / f"timer_{function}"
            macros = [f"-DFUNCTION=kr500_{function}", f"-DCALLS={_CALLS}"]
            files = [folder / "timer.c", folder / "library.o", "-o", programs[number, function], "-lm"]
            subprocess.run(["gcc", "-std=c11", "-O2", *macros, *map(str, files)], check=True)
    times: dict[tuple[int, str], float] = {}
    for _ in range(_ROUNDS):
        for key, program in programs.items():
            told = subprocess.run([str(program)], stdout=subprocess.PIPE, text=True, check=True).stdout
            times[key] = min(float(told), times.get(key, float("inf")))
    for number, row in enumerate(rows):
        row |= {f"{function} [ns]": times[number, function] for function in FUNCTIONS}
    return {"rows": rows, "notes": [f"least of {_ROUNDS} interleaved rounds of {_CALLS} calls"]}


if __name__ == "__main__":
    import benchmarks.studies.flags as study

    alone(__file__, study)
