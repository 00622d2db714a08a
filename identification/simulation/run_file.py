"""A simulated run as a file, with a sidecar that tells what was simulated."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from generator.errors import InputError, Place
from generator.version import VERSION
from generator.writing import replace
from identification import sidecar
from identification.sidecar import UNITS, Payload
from identification.simulation.payload import whole
from identification.simulation.simulate import Simulated

#: Digits of a number in the file.
_DIGITS = 12


def files_of(path: Path) -> tuple[Path, Path]:
    """The files of a run that is saved as ``path``: itself and its sidecar."""
    return path, sidecar.path_of(path)


def free(path: Path) -> tuple[Path, Path]:
    """The files of a run that is saved as ``path``; raises InputError where one of them is a folder."""
    for file in files_of(path):
        if os.path.isdir(file):
            raise InputError(Place(str(file)), "it is a folder", "a file that can be written")
    return files_of(path)


def save(run: Simulated, robot: str, digest: str, path: Path) -> tuple[Path, Path]:
    """Writes the run's columns to ``path`` and the sidecar beside it, both or none; returns both paths.

    Raises InputError where they cannot be written.
    """
    files = free(path)
    values = np.stack(list(run.columns.values()), axis=1)
    row = ",".join([f"%.{_DIGITS}g"] * values.shape[1])
    rows = [",".join(run.columns), *(row % tuple(one) for one in values.tolist())]
    texts = ("\n".join(rows) + "\n", _sidecar(run, robot, digest))
    replace(path.parent, {file.name: text.encode() for file, text in zip(files, texts, strict=True)})
    return files


def _sidecar(run: Simulated, robot: str, digest: str) -> str:
    settings = run.settings
    about = {
        "generator": f"counterpoise {VERSION}",
        "description": digest,
        "model": "flexible" if settings.flexible else "rigid",
        "parameters": settings.set_name,
        "trajectory": settings.trajectory,
        **{f"trajectory_{name}": value for name, value in run.trajectory.items()},
        "pose": run.pose.tolist(),
        "duration": settings.lasts,
        "seed": settings.seed,
        "noise_seed": settings.seed if settings.noise_seed is None else settings.noise_seed,
        "rate": settings.rate,
        "log_rate": settings.log_rate or settings.rate,
        "bandwidth": settings.bandwidth,
        "largest": ["none" if one == np.inf else one for one in settings.largest],
        "resolution": settings.resolution,
        "noise": settings.noise,
        "wrench_noise": settings.wrench_noise,
        "delay": settings.delay,
        "link_delay": settings.link_delay,
        "friction_drift": settings.friction_drift,
        "torque_constant_drift": settings.constant_drift,
        "warm_up": "even" if settings.warm_up is None else settings.warm_up,
        "temperature": settings.temperature,
        "temperature_rise": settings.rise,
    }
    head = [f"robot: {robot}", "notes: simulated, not measured", *_payload(settings.payload)]
    lines = [*head, "simulated:", *_table(about), "  values:"]
    lines += [f"    {name}: {value:.9g}" for name, value in run.parameters.items()]
    return "\n".join(lines) + "\n"


def _payload(payload: Payload | None) -> list[str]:
    if payload is None:
        return []
    values = (f"  {stem}: {value:.12g} {UNITS[stem]}" for stem, value in whole(payload).known.items())
    return ["payload:", f"  name: {payload.name}", *values]


def _table(about: Mapping[str, object]) -> list[str]:
    return [f"  {name}: {_text(value)}" for name, value in about.items()]


def _text(value: object) -> str:
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(_text, value))}]"
    if isinstance(value, float):
        return f"{value:.9g}"
    # Quoted as JSON, which YAML reads, where a plain word would be more than one.
    plain = not isinstance(value, str) or re.fullmatch(r"[\w./-]+", value, re.ASCII)
    return str(value) if plain else json.dumps(value, ensure_ascii=False)
