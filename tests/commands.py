"""Running the command line as a user does, in this process or in one of its own."""

from __future__ import annotations

import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest

from generator.cli.main import main

ROOT = Path(__file__).resolve().parent.parent

#: One link on a horizontal axis: joint torque ZZ1 qdd + Fv1 qd + Fc1 sign(qd) + 9.81 (MX1 cos q - MY1 sin q).
PENDULUM = """\
name: pendulum
description: one link on a horizontal axis
gravity: [0 m/s2, 0 m/s2, -9.81 m/s2]
joints:
  - {j: 1, sigma: 0, alpha: pi/2, d: 0, theta: q1, r: 0}
effects:
  - {effect: viscous_friction, joints: all}
  - {effect: coulomb_friction, joints: all}
parameters:
  light:
    description: small round numbers
    values:
      ZZ1: 2 kg m2
      MX1: 3 kg m
      MY1: 0.5 kg m
      Fv1: 0.25 N m s/rad
      Fc1: 0.125 N m
"""


@dataclass(frozen=True)
class Done:
    """What a command left behind."""

    status: int
    out: str
    err: str


def command(*arguments: str | Path, capsys: pytest.CaptureFixture[str]) -> Done:
    """Runs ``counterpoise`` in this process."""
    capsys.readouterr()
    status = main([str(argument) for argument in arguments])
    captured = capsys.readouterr()
    return Done(status, captured.out, captured.err)


def process(*arguments: str | Path, cwd: Path = ROOT, **environment: str) -> Done:
    """Runs ``counterpoise`` from this checkout in a process of its own."""
    done = subprocess.run(
        [sys.executable, "-m", "generator", *map(str, arguments)],
        cwd=cwd,
        env={**os.environ, "PYTHONPATH": str(ROOT), **environment},
        capture_output=True,
        text=True,
        check=False,
    )
    return Done(done.returncode, done.stdout, done.stderr)


def tree(folder: Path) -> dict[str, bytes]:
    """Every file under ``folder`` by its relative path."""
    return {str(path.relative_to(folder)): path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}
