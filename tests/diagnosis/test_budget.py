"""What a diagnosis of six axes costs: four runs of 40 s at 500 Hz in two minutes of a processor and 3 GB."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.commands import ROOT
from tests.plant.effect import Effect
from tests.plant.robot_file import robot_file
from tests.plant.robots import ROBOTS
from tests.plant.run import write_csv
from tests.plant.simulate import make_run, own_effects
from tests.plant.trajectories.fourier import fourier

#: What depends on the torque is looked for several times.
ROBOT, HIDDEN = ROBOTS["kr500_like"], Effect("torque_gain", 2)
#: Processor time and memory that it may take, on a machine that needs as long for the reference.
SECONDS, BYTES, REFERENCE = 120.0, 3e9, 0.55
#: A command beside the processor time [s] and the largest memory [bytes] of itself and what it starts; the reference is
#: the mean time of some linear algebra and of a loop, before it and after.
_MEASURED = """
import json, resource, sys, time
import numpy
from generator.cli.main import main
def reference():
    a, start = numpy.random.default_rng(0).normal(size=(400, 400)), time.process_time()
    for _ in range(40):
        numpy.linalg.qr(a)
    sum(k * k for k in range(4_000_000))
    return time.process_time() - start
before = reference()
status = main(sys.argv[1:])
both = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
seconds = sum(one.ru_utime + one.ru_stime for one in both)
print(json.dumps([status or 0, seconds, 1024 * max(one.ru_maxrss for one in both), (before + reference()) / 2]))
"""


@pytest.mark.long
def test_six_axes_take_two_minutes_and_three_gigabytes(tmp_path: Path) -> None:
    (tmp_path / "robot.yaml").write_text(robot_file(ROBOT))
    runs = []
    for seed in range(4):
        run = make_run(ROBOT, fourier(seed, period=10.0, periods=4), [HIDDEN], seed=seed, own=own_effects(ROBOT))
        assert (run.rate, len(run.t)) == (500.0, 20000)
        runs.append(tmp_path / f"run{seed}.csv")
        write_csv(run, runs[-1])
    done = subprocess.run(
        [sys.executable, "-c", _MEASURED, "diagnose", tmp_path / "robot.yaml", *runs, "--out", tmp_path / "out"],
        cwd=ROOT,
        env={**os.environ, "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"},
        capture_output=True,
        text=True,
        check=True,
    )
    status, seconds, most, reference = json.loads(done.stdout.splitlines()[-1])
    assert status == 0, done.stderr
    assert seconds - reference < SECONDS * max(reference / REFERENCE, 1.0)
    assert most < BYTES
