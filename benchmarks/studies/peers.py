"""The generated C beside other libraries: times of a call in one process, everything compared to 1e-9.

All libraries model bodies and rotors alone; the rows of the whole robot, with its friction, offsets and balancer, are
for scale. ``python -m benchmarks.studies.peers`` prints the table.
"""

from __future__ import annotations

import sys
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from types import ModuleType

import numpy as np

import benchmarks.peers
from benchmarks.compiling import Missing
from benchmarks.peers import casadi_pinocchio, casadi_recursion, mujoco, ours, pinocchio
from benchmarks.peers.library import Library
from benchmarks.peers.measuring import Timed, disagreement, measure
from benchmarks.peers.subject import FUNCTIONS, WHOLE_FUNCTIONS, Chain
from benchmarks.study import VOID, alone
from generator.discovery import modules

TITLE = "Beside other libraries"

ROBOTS = ("kr500", "kr270", "lbr_iiwa14")
#: Largest difference of two results, relative to the largest entry, in a row that counts.
TOLERANCE = 1e-9
#: States at which the whole robot is compared with the independent implementation, which is slow.
_CHECKED = 3

_OURS = (ours.NAME, ours.WITH_LIBM)
_CASADI = (casadi_recursion.NAME, casadi_pinocchio.NAME)
_ORDER = (*_OURS, pinocchio.NAME, mujoco.NAME, *_CASADI)

Row = dict[str, object]


def run(build: Path) -> dict[str, object]:
    """A row for each robot and function: times of a call [ns], of the fastest build of each library."""
    rows: list[Row] = []
    absent: dict[str, str] = {}
    best: list[Timed] = []
    errors: dict[str, float] = defaultdict(float)
    for robot in ROBOTS:
        subject = Chain(robot)
        timed = _measured(subject, build / robot, absent)
        for title, group in _groups(timed):
            found = [_error(subject, group[0], one) for one in group]
            for one, error in zip(group, found, strict=True):
                errors[one.library.peer] = max(errors[one.library.peer], error)
            fastest = _fastest(group)
            best += fastest.values()
            rows.append({"robot": robot, "function": title, **_cells(fastest, max(found) <= TOLERANCE)})
    return {"rows": rows, "notes": list(_notes(best, errors, absent))}


def _measured(subject: Chain, folder: Path, absent: dict[str, str]) -> list[Timed]:
    """Every peer's libraries, ours first; ``absent`` takes up what is missing."""
    folder.mkdir(parents=True, exist_ok=True)

    def built(peer: ModuleType) -> list[Library]:
        try:
            return list(peer.build(subject, folder))
        except Missing as missing:
            absent[peer.NAME] = f"{missing} is missing"
        except RuntimeError as error:
            print(error, file=sys.stderr)
            absent[peer.NAME] = "its build fails here"
        return []

    peers = sorted(_peers(), key=lambda peer: peer is not ours)
    with ThreadPoolExecutor(max_workers=2) as pool:
        libraries = [library for some in pool.map(built, peers) for library in some]
    return measure(subject, libraries, folder)


def _peers() -> list[ModuleType]:
    return [module for module in modules(benchmarks.peers) if hasattr(module, "build")]


def _groups(timed: Sequence[Timed]) -> Iterable[tuple[str, list[Timed]]]:
    """What stands in one row, with the row's title."""
    for whole, functions in ((False, FUNCTIONS), (True, WHOLE_FUNCTIONS)):
        for function in functions:
            title = f"{function}, whole robot" if whole else function
            yield title, [one for one in timed if one.function == function and one.library.whole == whole]


def _error(subject: Chain, first: Timed, one: Timed) -> float:
    """Of the whole robot against the independent implementation, else against the row's first library."""
    if not one.library.whole:
        return disagreement(subject, first, one)
    expected = np.array([subject.expected(one.function, state) for state in range(_CHECKED)])
    difference = np.abs(one.results[:_CHECKED] - expected).max(axis=1) / np.abs(expected).max(axis=1)
    return float(np.nan_to_num(difference, nan=np.inf).max())


def _fastest(group: Sequence[Timed]) -> dict[str, Timed]:
    """The fastest build of each library, in the order of the columns."""
    best: dict[str, Timed] = {}
    for one in sorted(group, key=lambda one: one.time):
        best.setdefault(one.library.peer, one)
    return dict(sorted(best.items(), key=lambda item: _ORDER.index(item[0]) if item[0] in _ORDER else len(_ORDER)))


def _cells(fastest: Mapping[str, Timed], agree: bool) -> Row:
    if not agree:
        return dict.fromkeys(fastest, VOID)
    cells: Row = {peer: round(one.time, 1) for peer, one in fastest.items()}
    own = next(fastest[name].time for name in _OURS if name in fastest)
    for title, peers in (("Pinocchio / ours", (pinocchio.NAME,)), ("best CasADi / ours", _CASADI)):
        times = [fastest[peer].time for peer in peers if peer in fastest]
        if times:
            cells[title] = round(min(times) / own, 2)
    return cells


def _notes(best: Sequence[Timed], errors: Mapping[str, float], absent: Mapping[str, str]) -> Iterator[str]:
    spread = max((one.quartiles[1] - one.quartiles[0]) / one.time for one in best)
    yield f"Times of a call in ns, medians of interleaved rounds; quartiles at most {100 * spread:.0f} % apart."
    chosen: dict[str, set[str]] = defaultdict(set)
    for one in best:
        chosen[one.library.peer].add(one.library.built)
    builds = (f"{peer} {' and '.join(sorted(built))}" for peer, built in chosen.items())
    yield f"Builds that were the faster ones: {'; '.join(builds)}."
    yield f"Largest difference of two results, relative to the largest entry: {max(errors.values()):.1g}."
    yield from (f"{peer}: not measured: {reason}" for peer, reason in absent.items())


if __name__ == "__main__":
    import benchmarks.studies.peers as study

    alone(__file__, study)
