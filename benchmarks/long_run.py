"""Time and memory of an identification from ten minutes at 1 kHz: ``python -m benchmarks.long_run [ROBOT]``.

The run is made of the robot's twin, or of unit parameters where the file has none: sums of sines within the limits,
2 % of noise, encoder steps of a microradian. Then what parts of the work take: the regressor by NumPy, its decimation,
and the same regressor by the compiled library with the time to make it.
"""

from __future__ import annotations

import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from generator.resources import find_robot
from generator.robot.readers import read
from generator.symbolic.parameter_sets import resolved_sets
from identification.filtering import Stage
from identification.observation import Motion, Regressors
from identification.simulation.machine import compiled

_RATE, _DURATION, _NOISE, _STEP = 1000.0, 600.0, 0.02, 1e-6
_PART = 1 << 16
#: Samples that the parts of the work are timed on, and the decimation's first stage.
_SHORT, _STAGE = 1 << 15, Stage(10)


def main(robot: str = "kr500") -> None:
    """Writes the run, identifies from it in a process of its own, prints what that took."""
    with tempfile.TemporaryDirectory() as folder:
        run = Path(folder, "run.csv")
        _write(robot, run)
        start = time.perf_counter()
        command = [sys.executable, "-m", "generator", "identify", robot, "--data", str(run), "--out", folder]
        done = subprocess.run(command, capture_output=True, text=True, check=True)
        seconds = time.perf_counter() - start
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    print(done.stdout.splitlines()[-4])
    print(
        f"{seconds:.1f} s, {used.ru_utime + used.ru_stime:.1f} s of processors, {used.ru_maxrss / 1e6:.2f} GB at most"
    )


def parts(robot: str = "kr500") -> None:
    """Prints processor seconds of the parts of the work, for the same number of samples."""
    description = read(find_robot(robot))
    regressors = Regressors(description)
    motion = _motion(regressors, np.arange(_SHORT) / _RATE, np.random.default_rng(1))
    times = _RATE * _DURATION / _SHORT
    regressors.base(motion.part(0, 8))
    columns, numerical = _timed(lambda: regressors.base(motion))
    _, filtering = _timed(lambda: [_STAGE.filtered(one) for one in columns])
    print(f"regressor by NumPy {times * numerical:.2f} s, first stage of the decimation {times * filtering:.2f} s")
    start = time.perf_counter()
    with compiled(description) as machine:
        made = time.perf_counter() - start
        model = machine.module.Robot()
        signals = [np.ascontiguousarray(one.T) for one in motion.signals]
        model.observation_matrix(*signals, layout="columns")
        _, written = _timed(lambda: model.observation_matrix(*signals, layout="columns"))
    print(f"regressor by the compiled library {times * written:.2f} s, to make the library {made:.1f} s")


def _timed(work: Callable[[], Any]) -> tuple[Any, float]:
    """What the work returns, and the processor time [s] that it took."""
    start = time.process_time()
    return work(), time.process_time() - start


def _write(name: str, path: Path) -> None:
    regressors = Regressors(read(find_robot(name)))
    sets = resolved_sets(regressors.model)
    truth = sets.get("twin", dict.fromkeys(regressors.names, 1.0))
    draw = np.random.default_rng(1)
    t = np.arange(round(_DURATION * _RATE)) / _RATE
    motion = _motion(regressors, t, draw)
    tau = np.concatenate(
        [regressors.torques(truth, motion.part(k, k + _PART)) for k in range(0, len(t), _PART)], axis=1
    )
    tau += _NOISE * tau.std(axis=1)[:, None] * draw.normal(size=tau.shape)
    q = np.round(motion.q / _STEP) * _STEP
    numbers = regressors.model.robot.numbers
    header = ",".join(["t", *(f"q{j}" for j in numbers), *(f"tau{j}" for j in numbers)])
    np.savetxt(path, np.column_stack([t, q.T, tau.T]), delimiter=",", header=header, comments="", fmt="%.9g")


def _motion(regressors: Regressors, t: NDArray[np.float64], draw: np.random.Generator) -> Motion:
    n = regressors.model.dof
    q, qd, qdd = (np.zeros((n, len(t))) for _ in range(3))
    for k, joint in enumerate(regressors.model.robot.moving):
        lower, upper = (float(x) if x is not None else s for x, s in ((joint.lower, -1.0), (joint.upper, 1.0)))
        q[k] += (lower + upper) / 2
        for frequency in (0.1, 0.2, 0.3, 0.4, 0.5):
            a, phase, w = draw.uniform(0.02, 0.08) * (upper - lower), draw.uniform(0, 2 * np.pi), 2 * np.pi * frequency
            q[k] += a * np.sin(w * t + phase)
            qd[k] += a * w * np.cos(w * t + phase)
            qdd[k] -= a * w * w * np.sin(w * t + phase)
    return Motion(q, qd, qdd)


if __name__ == "__main__":
    main(*sys.argv[1:])
    parts(*sys.argv[1:])
