"""The folder that receives what an identification found."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

from generator.robot.description import Robot
from generator.writing import spare, writable
from identification import sidecar
from identification.run_source import RunSource


def destination(out: Path | None, name: str, robot: Robot, files: Sequence[Path | None], runs: Sequence[str]) -> Path:
    """``out``, or ``identified/NAME``; raises InputError as ``spare_inputs`` does.

    Ask before the computing, which can take long.
    """
    folder = out or Path("identified") / name
    spare_inputs(folder, robot, files, runs)
    return folder


def spare_inputs(folder: Path, robot: Robot, files: Sequence[Path | None], runs: Sequence[str]) -> None:
    """Raises InputError where the new robot file in ``folder`` would be written over one of ``files`` or over the
    sidecar of one of ``runs``, a path or ``PATH@FROM:TO`` each, and where ``folder`` cannot be made and written.
    """
    writable(folder)
    beside = [sidecar.path_of(RunSource.of(run).path) for run in runs]
    for source in (*files, *beside):
        if source is not None and os.path.exists(source):
            spare(source, [folder / f"{robot.name}.yaml"])
