"""All that may act on a joint: the rows that are taken away to see its noise."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from identification.arrays import Array
from identification.diagnosis.columns.bank import Bank
from identification.diagnosis.noise.errors_in_variables import Redrawn

#: Rows that a column may use up: with more columns only the strongest directions are taken away. Rows for each column
#: of the model from which they are taken away all the same.
_ROWS, _FEWEST = 8, 6


@dataclass(frozen=True)
class Rows:
    """Column ``numbers``, ``columns`` (k x N), torque ``tau`` (N) and ``kept`` rows (N) of a joint along a run.

    Numbers are those of the bank; below 0 they are of what may act beside the model and all hypotheses. ``noise``
    (k + 1 x N) is what as much noise of the positions once more makes of the columns and of the model's torque.
    """

    numbers: list[int]
    columns: Array
    tau: Array
    kept: NDArray[np.bool_]
    noise: Array | None = None


def without_record(bank: Bank, run: int, joint: int) -> Rows:
    """Raw rows of a joint without columns that hold the record's own noise."""
    noisy = {number for one in bank.variants if one.hypothesis.recorded for number in one.columns}
    numbers, columns, tau, kept = bank.raw(run, joint)
    quiet = [i for i, number in enumerate(numbers) if number not in noisy]
    return Rows([numbers[i] for i in quiet], columns[quiet], tau, kept)


def with_noise(parts: Sequence[Rows], bank: Bank, joint: int, redrawn: Mapping[int, Redrawn]) -> list[Rows]:
    """With what noise of the positions makes of the rows of a joint in each run."""
    acting = [one for one in bank.variants if joint in one.coordinates]
    result = []
    for r, part in enumerate(parts):
        noise = np.zeros((len(part.numbers) + 1, len(part.tau)))
        if r in redrawn:
            place = {number: i for i, number in enumerate(part.numbers)}
            numbers, change = redrawn[r].base(bank, r, joint)
            noise[[place[number] for number in numbers]] = change
            for variant in acting:
                if place.keys() >= {*variant.columns}:
                    noise[[place[number] for number in variant.columns]] = redrawn[r].of(variant, bank, r, joint)
            noise[-1] = redrawn[r].torque[joint]
        result.append(replace(part, noise=noise))
    return result


def with_maps(parts: Sequence[Rows], bank: Bank, joint: int, maps: Sequence[Array]) -> list[Rows]:
    """Rows of a joint in each run with ``maps`` (m x N each) and with the model's columns once more for each run by
    itself, which may be another one there, where there are rows enough.
    """
    if not maps or not have_room(bank, maps, joint):
        return list(parts)
    p, more = len(bank.base), len(maps[0])
    count, model = bank.counts(joint)
    apart = enough(count, model + more + model * len(parts))
    result = []
    for r, (part, rows) in enumerate(zip(parts, maps, strict=True)):
        own = [i for i, number in enumerate(part.numbers) if number < p and apart]
        numbers = [*range(-more, 0), *(part.numbers[i] - more - (r + 1) * p for i in own), *part.numbers]
        columns = np.concatenate([rows, part.columns[own], part.columns])
        noise = part.noise
        if noise is not None:
            noise = np.concatenate([np.zeros_like(rows), noise[own], noise])
        result.append(Rows(numbers, columns, part.tau, part.kept, noise))
    return result


def maps_taken(bank: Bank, maps: Sequence[Sequence[Array]], joint: int) -> bool:
    """Whether rows of a joint are enough for its maps to be taken out of its noise."""
    return have_room(bank, maps[joint], joint)


def have_room(bank: Bank, maps: Sequence[Array], joint: int) -> bool:
    """The same of the maps of that joint, by run (m x N each)."""
    rows, model = bank.counts(joint)
    return enough(rows, model + len(maps[0]))


def known_to_act(parts: Sequence[Rows], bank: Bank) -> list[int]:
    """Numbers of the columns of a joint's rows in each run that are taken away whatever is missing: maps and the
    model's, where there are rows enough for them.
    """
    numbers = sorted({number for part in parts for number in part.numbers if number < len(bank.base)})
    rows = sum(int(part.kept.sum()) for part in parts)
    model = sum(number >= 0 for number in numbers)
    return numbers if rows > _FEWEST * model else []


def enough(rows: int, columns: int) -> bool:
    """Whether rows are more than so many columns may use up."""
    return allowed(rows) > columns


def allowed(rows: int) -> int:
    """Columns that may use up rows."""
    return max(rows // _ROWS, 1)
