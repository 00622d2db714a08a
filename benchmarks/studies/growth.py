"""How generation grows with the number of joints, on random chains; and one of the report's robots as a whole.

Every model is derived and emitted with all functions and all backends, the self-tests' independent values included.
"""

from __future__ import annotations

import math
import time
from pathlib import Path
from random import Random
from typing import Any

from benchmarks.growth_picture import CURVES, ENDING
from benchmarks.study import alone
from generator.derivation import derive
from generator.generation import emitted, uncollected
from generator.resources import find_robot
from generator.robot.description import Robot
from generator.robot.readers import read
from tests.chains import random_chain

TITLE = "Generation time"
JOINTS = (3, 6, 12, 24, 48)


def run(build: Path) -> dict[str, Any]:
    """Rows by chain."""
    report = read(find_robot("kr500"))
    _measured(report)
    rows = [{"chain": "kr500", **_measured(report)}]
    grown = [{"chain": f"{count}{ENDING}", **_measured(random_chain(Random(count), count))} for count in JOINTS]
    notes = [_growth(name, [row[column] for row in grown]) for name, column in CURVES.items()]
    return {"rows": rows + grown, "notes": notes}


def _measured(robot: Robot) -> dict[str, Any]:
    """Seconds to derive with the grouping's check, and for everything, one process, imports done."""
    with uncollected():
        start = time.perf_counter()
        model = derive(robot)
        derived = time.perf_counter() - start
        files = emitted(model)
        everything = time.perf_counter() - start
    return {
        "derive [s]": round(derived, 2),
        "all [s]": round(everything, 2),
        "files [MB]": round(sum(map(len, files.values())) / 1e6, 1),
        "inverse dynamics [operations]": model.functions["inverse_dynamics"].count.total,
    }


def _growth(name: str, seconds: list[float]) -> str:
    """The exponent p of seconds ~ joints^p between the three longest chains."""
    power = math.log(seconds[-1] / seconds[-3]) / math.log(JOINTS[-1] / JOINTS[-3])
    return f"{name}: joints^{power:.1f} from {JOINTS[-3]} to {JOINTS[-1]} joints"


if __name__ == "__main__":
    import benchmarks.studies.growth as study

    alone(__file__, study)
