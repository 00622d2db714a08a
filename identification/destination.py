"""The folder that receives what an identification found."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from generator.robot.description import Robot
from generator.writing import spare
from identification.dataset import sidecar_of


def destination(out: Path | None, name: str, robot: Robot, files: Sequence[Path | None], runs: Sequence[str]) -> Path:
    """``out``, or ``identified/NAME``.

    Raises InputError where the new robot file would be written over one of ``files`` or over the sidecar of one of
    ``runs``, a path or ``PATH@FROM:TO`` each. Ask before the computing, which can take long.
    """
    folder = out or Path("identified") / name
    for source in (*files, *map(sidecar_of, runs)):
        if source is not None and source.exists():
            spare(source, [folder / f"{robot.name}.yaml"])
    return folder
