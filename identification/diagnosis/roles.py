"""Which runs are fitted, which hold the fit to account, and which nobody touches before the report."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from generator.errors import InputError
from identification.dataset import Run
from identification.diagnosis.prepared import SHORTEST

#: Parts of a run's time that are fitted and that validate, where there are too few runs; the rest tests.
_FITTED, _VALIDATED = 0.55, 0.2
#: Time between such parts [s] and, in a short run, its part of the time.
_GAP, _SHORT = 0.5, 0.02
#: Time [s] of each run that must be left to test.
_ENOUGH = 5.0
#: Places that are tried for the validating block, and the least part of a run that is worth fitting.
_PLACES, _LEAST = 7, 0.2


@dataclass(frozen=True)
class Roles:
    """Sources of runs by role, each a path or ``PATH@FROM:TO``; ``notes`` tell what was split and how.

    ``known`` are all but those that test, whole where parts of them have a role: what a last fit is made of.
    """

    train: tuple[str, ...]
    validate: tuple[str, ...]
    test: tuple[str, ...]
    known: tuple[str, ...]
    notes: tuple[str, ...] = ()


def roles(data: Sequence[Run], validate: Sequence[str], test: Sequence[str]) -> Roles:
    """Roles for the runs ``data``: the last ones test and validate where others do not, else parts of each run do."""
    names = [run.name for run in data]
    missing = (not test) + (not validate)
    if len(names) >= 2 + missing:
        rest = list(names)
        chosen_test = tuple(test) or (rest.pop(),)
        chosen_validate = tuple(validate) or (rest.pop(),)
        notes = []
        if not validate:
            notes.append(f"{chosen_validate[0]} validates: it is not fitted")
        if not test:
            notes.append(f"{chosen_test[0]} tests: it is touched by nothing before the report")
        return Roles(tuple(rest), chosen_validate, chosen_test, (*rest, *chosen_validate), tuple(notes))
    if not missing:
        return Roles(tuple(names), tuple(validate), tuple(test), (*names, *validate))
    return _split(data, validate, test)


def _split(data: Sequence[Run], validate: Sequence[str], test: Sequence[str]) -> Roles:
    """Blocks of time of every run, with gaps between them: the last one tests, the liveliest other validates.

    Raises InputError for a run too short to be split.
    """
    share = 0.0 if validate else _VALIDATED
    rest = 1 - _FITTED - _VALIDATED
    shortest = min((run.samples * run.period for run in data), default=0.0)
    tested = 0.0 if test or (not validate and rest * shortest < _ENOUGH) else rest
    train: list[str] = []
    held: list[str] = []
    last: list[str] = []
    known = list(validate)
    for run in data:
        start, length = run.start, _length(run)
        gap = min(_GAP, _SHORT * length)
        end = start + length - (_block(run, tested) + gap if tested else 0.0)
        least = _block(run, _LEAST) + (0.0 if validate else _block(run, share) + gap)
        if end - start < least:
            expected = f"{least + start + length - end:.2g} s at least, to be split in time"
            raise InputError(run.place, f"a run of {length:.3g} s", expected)
        if tested:
            last.append(_part(run.name, end + gap, start + length))
        known.append(_part(run.name, start, end) if tested else run.name)
        around = [(start, end)]
        if not validate:
            first, final = _liveliest(run, end, _block(run, share), gap)
            held.append(_part(run.name, first, final))
            around = [(start, first - gap), (final + gap, end)]
        train += [_part(run.name, a, b) for a, b in around if b - a > _block(run, _LEAST)]
    parts = [text for text, wanted in (("validates", not validate), ("tests", not test)) if wanted]
    if not test and not tested:
        parts = ["validates and, since the runs are short, tests too"]
    note = (
        f"of every run {100 * (1 - share - tested):.0f} % of the time are fitted, the rest {' and '.join(parts)}; "
        "runs apart are stronger evidence"
    )
    return Roles(
        tuple(train), tuple(validate) or tuple(held), tuple(test) or tuple(last) or tuple(held), tuple(known), (note,)
    )


def _length(run: Run) -> float:
    """From the first sample to the last [s]."""
    return (run.samples - 1) * run.period


def _block(run: Run, share: float) -> float:
    """A ``share`` of the run [s], or what is long enough to tell something: two samples more, as ends lie between."""
    return max(share * _length(run), SHORTEST + 2 * run.period)


def _liveliest(run: Run, end: float, length: float, gap: float) -> tuple[float, float]:
    """The block of ``length`` [s] before ``end``, from when to when, that leaves every joint's motion to both sides.

    A joint's motion is its squared speed; parts too short to be fitted are lost.
    """
    power = np.gradient(run.q, run.period, axis=-1) ** 2
    total = np.concatenate([np.zeros((len(power), 1)), np.cumsum(power, axis=-1)], axis=-1)
    moves = total[:, -1] > 1e-9 * total[:, -1].max()
    whole, count = int((end - run.start) / run.period), int(length / run.period)
    least, between = _block(run, _LEAST) / run.period, int(gap / run.period)
    part = count / whole

    def least_share(first: int, last: int) -> float:
        """Of all joints, the least part of its motion that lies between two samples."""
        return float(((total[:, last] - total[:, first]) / total[:, whole].clip(1e-300))[moves].min())

    def goodness(k: int) -> float:
        around = [(0, max(k - between, 0)), (min(k + count + between, whole), whole)]
        kept = sum(least_share(a, b) for a, b in around if b - a > least)
        return min(least_share(k, k + count) / part, kept / (1 - part))

    places = np.unique(np.linspace(0, whole - count, _PLACES).astype(int))
    first = float(run.start + max(places.tolist(), key=goodness) * run.period)
    return first, first + length


def _part(name: str, start: float, end: float) -> str:
    """A part of a run, or of a part of one."""
    path, at, rest = name.rpartition("@")
    plain = path if at and ":" in rest else name
    return f"{plain}@{start:.9g}:{end:.9g}"
