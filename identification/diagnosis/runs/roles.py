"""Which runs are fitted, which hold the fit to account, and which only test."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from generator.errors import InputError
from generator.words import listed
from identification.dataset import Run
from identification.diagnosis.runs.periods import period_of
from identification.diagnosis.runs.prepared import SHORTEST
from identification.diagnosis.runs.told_files import told_files
from identification.run_source import part_of
from identification.shared_samples import unshared

#: Part of a run's time that tests, where there are too few runs, and how long it must be [s] to tell anything.
_TESTED, _ENOUGH = 0.25, 5.0
#: Time between parts of a run [s] and, of a short one, the part of its time.
_GAP, _SHORT = 0.5, 0.02
#: Runs from which one tests by itself.
_APART = 3
#: Blocks that a run is split into at most, and their least length [s].
_BLOCKS, _LEAST = 4, SHORTEST + 0.05


@dataclass(frozen=True)
class Roles:
    """Sources of runs by role, each a path or ``PATH@FROM:TO``; ``notes`` tell what was split and how.

    Without any that validate each of ``train`` is held against what the others predict. ``searched`` are all but
    those that test, whole where parts of them have a role: what a last fit is made of.
    """

    train: tuple[str, ...]
    validate: tuple[str, ...]
    test: tuple[str, ...]
    searched: tuple[str, ...]
    notes: tuple[str, ...] = ()

    @property
    def untouched(self) -> bool:
        """Whether nothing is fitted to what tests."""
        return not set(self.test) & set(self.searched)

    @property
    def tested(self) -> str:
        """The runs that test, in words, by whether anything looked at them before."""
        return "untouched runs" if self.untouched else "runs that were fitted"


def roles(
    data: Sequence[Run],
    validate: Sequence[Run],
    test: Sequence[Run],
    tested: bool = True,
    kinds: Sequence[int] = (),
) -> Roles:
    """Roles for the runs ``data``: the last of three or more tests where none does, else the end of each one
    that is long enough.

    Where none validates every run is held against what the others predict, or every block of time of a single one.
    Where nothing is ``tested`` no run is spent on it. ``kinds`` (n) are those of the joints, as in ``repeating``.
    Raises InputError for runs that have samples in common, and for one too short to be split.
    """
    unshared({"fit": data, "validate": validate, "test": test})
    fit, validating, last = (tuple(run.name for run in runs) for runs in (data, validate, test))
    notes: list[str] = []
    fitted: list[Run] = list(data)
    ends: dict[str, float] = {}
    if tested and not test and len(fit) >= _APART:
        last = (fit[-1],)
        notes.append(f"{data[-1].file}, the last run, tests: nothing is fitted to it or chosen by it")
        del fitted[-1]
    elif tested and not test:
        long = [run for run in data if _TESTED * _recorded(run) >= _ENOUGH]
        ends = {run.name: run.start + (1 - _TESTED) * run.length - _gap(run) for run in long}
        last = tuple(_tail(run) for run in long) or fit
        notes.append(f"{_what_tests(data, long)}; runs apart are stronger evidence")
    notes += [
        f"{run.file} tests for {_recorded(run):.2g} s, which tells little: {_ENOUGH:g} s or more are better"
        for run in (*data, *test)
        if tested and run.name in last and fit != last and _recorded(run) < _ENOUGH
    ]
    whole = tuple(part_of(run.name, run.start, ends[run.name]) if run.name in ends else run.name for run in fitted)
    train = whole
    if not validate and len(fitted) == 1:
        (run,) = fitted
        end = ends.get(run.name, run.start + run.length)
        train = tuple(part_of(run.name, *block) for block in _blocks(run, end, kinds))
        notes.append(f"{len(train)} blocks of its time are each held against what the others predict")
    elif not validate:
        notes.append("each run is held against what the others predict")
    return Roles(train, validating, last, (*whole, *validating), tuple(notes))


def _what_tests(data: Sequence[Run], long: Sequence[Run]) -> str:
    """In words, which of the runs ``data`` test: the ends of those that are ``long``."""
    if not long:
        return "the runs are short and test too, which tells nothing new"
    which = "every run" if len(long) == len(data) else listed(told_files(long))
    rest = "" if len(long) == len(data) else ", and what is shorter is fitted as a whole"
    return f"the last {100 * _TESTED:.0f} % of {which} test{rest}"


def _tail(run: Run) -> str:
    """The end of a run that tests."""
    return part_of(run.name, run.start + (1 - _TESTED) * run.length, run.start + run.length)


def _gap(run: Run) -> float:
    """Time between parts of a run [s]."""
    return min(_GAP, _SHORT * run.length)


def _recorded(run: Run) -> float:
    """Time that the samples stand for [s], to a microsecond: 20 s at 1 kHz are 20000 samples, whatever the clock."""
    return round(run.duration, 6)


def _blocks(run: Run, end: float, kinds: Sequence[int]) -> list[tuple[float, float]]:
    """Equal blocks of time [s] until ``end``; where the motion repeats, each with two periods if two can have them."""
    length, gap = end - run.start, _gap(run)

    def count(least: float, most: int) -> int:
        return min(int((length + gap) / (least + gap)), most)

    repeated = run.period * period_of(run.q, run.period, kinds)
    blocks = max(count(max(_LEAST, 2 * repeated), _BLOCKS), count(_LEAST, 2))
    if blocks < 2:
        raise InputError(
            run.place, f"a run of {length:.3g} s", f"{2 * _LEAST + gap:.3g} s at least, to be split in time"
        )
    each = (length - (blocks - 1) * gap) / blocks
    starts = [run.start + k * (each + gap) for k in range(blocks)]
    return [(start, start + each) for start in starts]
