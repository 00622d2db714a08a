"""Which runs are fitted, which hold the fit to account, and which nobody touches before the report."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from identification.dataset import Run

#: Parts of a run's time that are fitted and that validate, where there are too few runs; the rest tests.
_FITTED, _VALIDATED = 0.55, 0.2
#: Time between such parts [s] and, in a short run, its part of the time.
_GAP, _SHORT = 0.5, 0.02


@dataclass(frozen=True)
class Roles:
    """Sources of runs by role, each a path or ``PATH@FROM:TO``; ``notes`` tell what was split and how."""

    train: tuple[str, ...]
    validate: tuple[str, ...]
    test: tuple[str, ...]
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
        return Roles(tuple(rest), chosen_validate, chosen_test, tuple(notes))
    if not missing:
        return Roles(tuple(names), tuple(validate), tuple(test))
    return _split(data, validate, test)


def _split(data: Sequence[Run], validate: Sequence[str], test: Sequence[str]) -> Roles:
    """Blocks of time of every run, with gaps between them."""
    share = 0.0 if validate else _VALIDATED
    tested = 0.0 if test else 1 - _FITTED - _VALIDATED
    train, held, last = [], [], []
    for run in data:
        start, length = run.start, (run.samples - 1) * run.period
        gap = min(_GAP, _SHORT * length)
        first = start + length * (1 - share - tested)
        second = first + length * share
        train.append(_part(run.name, start, first))
        if not validate:
            held.append(_part(run.name, first + gap, second))
        if not test:
            last.append(_part(run.name, second + gap, start + length))
    parts = [text for text, wanted in (("validates", not validate), ("tests", not test)) if wanted]
    fitted = 100 * (1 - share - tested)
    note = (
        f"of every run the first {fitted:.0f} % of the time are fitted, the rest {' and '.join(parts)}; "
        "runs apart are stronger evidence"
    )
    return Roles(tuple(train), tuple(validate) or tuple(held), tuple(test) or tuple(last), (note,))


def _part(name: str, start: float, end: float) -> str:
    """A part of a run, or of a part of one."""
    path, at, rest = name.rpartition("@")
    plain = path if at and ":" in rest else name
    return f"{plain}@{start:.9g}:{end:.9g}"
