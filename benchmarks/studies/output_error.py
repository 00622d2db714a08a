"""Output error of a simulated robot: Gauss-Newton from the inverse model's estimate, the report's simplex beside it.

Both start from the same estimate on the same run, 10 s between the filters' ends at 1 kHz, all base parameters sought.
The simplex is stopped after the time that Gauss-Newton is allowed.
"""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

from benchmarks.study import alone
from generator.resources import find_robot
from generator.robot.readers import read
from identification.dataset import load
from identification.inverse_model import Options, identify
from identification.output_error.estimate import Estimate, estimate
from identification.output_error.search import Settings
from identification.recipes import Recipe
from identification.simulation.machine import compiled
from identification.simulation.run_file import save
from identification.simulation.settings import Settings as Simulation
from identification.simulation.simulate import simulate

TITLE = "Output error"

ROBOT, SET = "kr500", "twin"
#: Seconds that a search may take, of the run, and noise of the currents [A].
ALLOWED, DURATION, NOISE = 20.0, 11.0, 3.0


def run(build: Path) -> dict[str, Any]:
    """A row for each method: time, simulations, and how far positions and parameters are off."""
    robot = read(find_robot(ROBOT))
    rows = []
    with compiled(robot) as machine:
        made = simulate(machine, Simulation(duration=DURATION, parameters=SET, noise=[NOISE]))
        path = build / "run.csv"
        save(made, robot.name, robot.digest, path)
        first = identify(robot, [path], options=Options(Recipe())).full.solution
        std = {name: first.std(name) for name in first.values}
        data = [load(str(path), robot)]
        for method in ("gauss-newton", "nelder-mead"):
            begin = time.perf_counter()
            found = estimate(machine, data, first.values, std, Settings(method=method, seconds=ALLOWED))
            seconds = time.perf_counter() - begin
            rows.append(_row(method, found, seconds, made.parameters))
    notes = [
        f"{ROBOT}, {SET}, {len(found.names)} parameters, run of {DURATION:g} s at 1 kHz, noise {NOISE:g} A",
        f"a search may take {ALLOWED:g} s; parameters within 2 std of the true ones are counted for Gauss-Newton alone",
    ]
    return {"rows": rows, "notes": notes}


def _row(method: str, found: Estimate, seconds: float, true: Any) -> dict[str, object]:
    inside = sum(abs(found.values[name] - true[name]) < 2 * found.std(name) for name in found.names)
    return {
        "method": method,
        "seconds": round(seconds, 1),
        "iterations": found.iterations,
        "simulations": found.simulations,
        "position error, % of the spread": round(found.train.total.relative_to_mean, 3),
        "within 2 std": f"{inside} of {len(found.names)}" if method == "gauss-newton" else "-",
    }


if __name__ == "__main__":
    import benchmarks.studies.output_error as study

    alone(__file__, study)
