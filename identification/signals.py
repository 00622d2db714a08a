"""Which columns of a recording are positions and efforts, and what they are on the joint side."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from generator.errors import InputError
from generator.robot.description import Robot
from generator.words import listed, plural
from identification.arrays import Array
from identification.drive_train import constants, coupling
from identification.recording import Recording

#: Stems of the columns by what they hold; the first that a file has is taken.
POSITIONS = ("q", "qm")
EFFORTS = ("tau", "taum", "i")
#: What a run may hold beside, one column a joint.
FURTHER = ("qs", "qd", "qr", "temp")
#: All stems.
STEMS = (*POSITIONS, *EFFORTS, *FURTHER)
WRENCH = ("fx", "fy", "fz", "mx", "my", "mz")
#: All names of columns that mean something, as a person reads them.
NAMES = ", ".join(["t", *(f"{stem}1.." for stem in STEMS), *WRENCH])

_NUMBERED = re.compile(r"([A-Za-z]+)(0|[1-9]\d*)\Z")


def meant(name: str) -> bool:
    """Whether a column of this name means something, on a robot with joints enough."""
    match = _NUMBERED.match(name)
    return name in ("t", *WRENCH) or (match is not None and match[1] in STEMS)


def sound(recording: Recording) -> Recording:
    """The recording; raises InputError where a column whose name means something does not hold numbers alone."""
    for name, fault in recording.faults.items():
        if meant(name) and name not in recording.columns:
            raise fault
    return recording


def numbered(recording: Recording, robot: Robot) -> Recording:
    """The recording with the positions and efforts of a robot's only joint under its number, where they have none."""
    if len(robot.numbers) != 1:
        return recording
    columns = recording.columns
    (number,) = robot.numbers
    plain = {f"{stem}{number}": columns[stem] for stem in (*POSITIONS, *EFFORTS) if stem in columns}
    return replace(recording, columns={**plain, **columns})


def overlooked(recording: Recording, robot: Robot) -> Iterator[str]:
    """Columns whose names are nearly those of what a run may hold beside, and does not: they are not used."""
    # Nothing reads speeds.
    numbered_names = (f"{stem}{number}" for stem in FURTHER if stem != "qd" for number in robot.numbers)
    missing = {_plain(name): name for name in (*numbered_names, *WRENCH) if name not in recording.columns}
    for name in recording.columns:
        if not meant(name) and (wanted := missing.get(_plain(name))):
            yield f"{recording.where(None, name)}: column {name} is not known, perhaps {wanted} is meant"


def _plain(name: str) -> str:
    return name.replace("_", "").lower()


class NoColumns(InputError):
    """A recording has no column of any kind that would do."""


@dataclass(frozen=True)
class Measured:
    """Raw columns of one kind (n x N) and their names, in the joints' order."""

    stem: str
    names: tuple[str, ...]
    values: Array


def measured(recording: Recording, stems: Sequence[str], robot: Robot, what: str) -> Measured:
    """The columns of the first stem that the recording has.

    Raises NoColumns where the recording has none of the stems, InputError where a joint's column is missing and where
    there are columns for more joints than there are.
    """
    numbers = robot.numbers
    for stem in stems:
        present = [int(match[2]) for name in recording.columns if (match := _NUMBERED.match(name)) and match[1] == stem]
        if not present:
            continue
        wanted = [f"{stem}{number}" for number in numbers]
        for number, name in zip(numbers, wanted, strict=True):
            if number not in present:
                near = difflib.get_close_matches(name, set(recording.columns) - set(wanted), n=1, cutoff=0.6)
                expected = _from_to(wanted) + (f"; perhaps {near[0]} is meant" if near else "")
                expected += recording.why_lacking([name])
                raise InputError(recording.where(None, wanted[0]), f"there is no column {name}", expected)
        for number in sorted(present):
            if number not in numbers:
                name = f"{stem}{number}"
                problem = f"column {name}, but {robot.name} has {plural(len(numbers), 'moving joint')}"
                raise InputError(recording.where(None, name), problem, f"{what} of this robot alone")
        return Measured(stem, tuple(wanted), np.stack([recording.columns[name] for name in wanted]))
    choices = " or ".join(_from_to([f"{stem}{number}" for number in numbers]) for stem in stems)
    first = {f"{stem}{numbers[0]}" for stem in stems}
    close = next((column for column in recording.columns if column.replace("_", "").lower() in first), "")
    hint = f"; perhaps {close} is meant, which a sidecar's columns can say" if close else ""
    hint += recording.why_lacking(one for stem in stems for one in (stem, *(f"{stem}{number}" for number in numbers)))
    raise NoColumns(recording.where(None, close), f"there are no columns of {what}", choices + hint)


def _from_to(names: Sequence[str]) -> str:
    if len(names) == 1:
        return names[0]
    numbers = [int(match[2]) for name in names if (match := _NUMBERED.match(name))]
    even = numbers == [*range(numbers[0], numbers[0] + len(names))]
    return f"{names[0]} to {names[-1]}" if even else listed(names)


def joint_positions(found: Measured, robot: Robot, recording: Recording) -> Array:
    """Joint positions (n x N) [rad, m]: themselves, or N^-1 times the motors' (report eq. 14)."""
    if found.stem != "qm":
        return found.values
    return np.asarray(np.linalg.solve(_coupling(robot, found, recording), found.values), dtype=float)


def joint_torques(found: Measured, robot: Robot, recording: Recording) -> Array:
    """Joint torques (n x N) [N m, N]: themselves, or N^T times the motors' (report eq. 18), those from currents [A]."""
    if found.stem == "tau":
        return found.values
    N = _coupling(robot, found, recording)
    if found.stem == "taum":
        return N.T @ found.values
    if robot.drives is None or not robot.drives.torque_constants:
        where = recording.where(None, found.names[0])
        raise InputError(where, f"{found.names[0]} is a current", f"torque constants in the drives of {robot.name}")
    return N.T @ (constants(robot)[:, None] * found.values)


def _coupling(robot: Robot, found: Measured, recording: Recording) -> Array:
    """N (n x n): motor speeds from joint speeds; raises InputError where no drives tell it."""
    if robot.drives is None:
        where = recording.where(None, found.names[0])
        raise InputError(where, f"{found.names[0]} is on the motor side", f"drives in the file of {robot.name}")
    return coupling(robot)
