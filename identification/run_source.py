"""Names of runs: a run is a file, or a part of it; ``A.csv@2:8`` is that from 2 s to 8 s by the file's own times."""

from __future__ import annotations

import os
import re
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from generator.errors import InputError, Place
from identification.recording import Recording

#: Time [s] to which parts of runs are told.
_CLOSE = 1e-6
_PART = re.compile(r"(?P<path>.+)@(?P<start>[^@:/]*):(?P<end>[^@:/]*)\Z")
_NUMBER = re.compile(r"[-+.\deE]*")
#: Part of a file's time by which a part of it may be asked for beyond its ends.
_BEYOND = 0.01


@dataclass(frozen=True)
class RunSource:
    """What ``name`` says: a file's ``path`` and the times from ``start`` to ``end`` [s], infinite where it is whole."""

    name: str
    path: Path
    start: float = -np.inf
    end: float = np.inf

    @classmethod
    def of(cls, name: str) -> RunSource:
        """A path, or ``PATH@FROM:TO`` with times in s, either of which may be left out.

        Raises InputError where one of the times of a file that is there is no number, and where the end is before the
        start.
        """
        match = None if os.path.exists(name) else _PART.match(name)
        if match is None:
            return cls(name, Path(name))
        times = match["start"], match["end"]
        if not all(map(_NUMBER.fullmatch, times)) and not os.path.exists(match["path"]):
            return cls(name, Path(name))
        try:
            start, end = (float(text or whole) for text, whole in zip(times, ("-inf", "inf"), strict=True))
        except ValueError:
            start = end = np.nan
        if np.isnan(start) or np.isnan(end):
            expected = "FILE@FROM:TO with times in s, decimals after a point"
            raise InputError(Place(name), "this is no part of a run", expected)
        if start > end:
            problem = f"the part would end at {end:g} s, before it begins at {start:g} s"
            raise InputError(Place(name), problem, "FILE@FROM:TO with times in s, FROM before TO")
        return cls(name, Path(match["path"]), start, end)

    @property
    def is_part(self) -> bool:
        """Whether it is a part of the file alone."""
        return bool(np.isfinite(self.start) or np.isfinite(self.end))

    def rows_of(self, recording: Recording) -> Recording:
        """The rows of the file's ``recording`` that belong to the run; raises InputError where there are none."""
        start, end = self.start, self.end
        if not self.is_part or "t" not in recording.columns:
            return recording
        t = recording.columns["t"]
        inside = np.flatnonzero((t >= start - _CLOSE) & (t <= end + _CLOSE))
        if not inside.size:
            problem = f"no sample from {start:g} s to {end:g} s"
            raise InputError(Place(self.name), problem, f"times from {t[0]:g} to {t[-1]:g}")
        part = recording.part(int(inside[0]), int(inside[-1]) + 1)
        allowed = _BEYOND * (t[-1] - t[0])
        if (np.isfinite(start) and start < t[0] - allowed) or (np.isfinite(end) and end > t[-1] + allowed):
            told = f"{self.name}: the file's times go from {t[0]:g} s to {t[-1]:g} s, what is asked for goes beyond"
            part = replace(part, notes=(*part.notes, told))
        return part


def part_of(name: str, start: float, end: float) -> str:
    """The name of a part of the run ``name``, which may be a part itself, from ``start`` to ``end`` [s] of the file."""
    return f"{RunSource.of(name).path}@{_seconds(start)}:{_seconds(end)}"


def _seconds(t: float) -> str:
    """To a microsecond, whatever the clock counts from."""
    return f"{round(t, 6):.16g}"
