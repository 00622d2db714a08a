"""Which way of writing a chain's equations is shortest: tried on the chain itself, counted, chosen.

The textbook recursion is always among the candidates, so that no chain gets longer equations than it gives.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Generic, TypeVar

from generator.symbolic import inertia, lean_gravity, lean_inertia, lean_newton_euler, newton_euler
from generator.symbolic.bodies import Body
from generator.symbolic.frames import Chain, Frame
from generator.symbolic.gauge import Gauge, is_last, slid_origins
from generator.symbolic.lean_gravity import GravityStrategy
from generator.symbolic.lean_inertia import InertiaStrategy
from generator.symbolic.lean_newton_euler import Strategy
from generator.symbolic.segments import segments
from generator.symbolic.vectors import Array, Nodes

_Way = TypeVar("_Way")

#: Frames tried as the place where screws and wrenches meet, from the base, where the shortest place of a chain is.
_MEETINGS = 8


@dataclass(frozen=True)
class Choice:
    """What was chosen for one kind of equation, in words, with its operations and those of the textbook recursion."""

    way: str
    operations: int
    textbook: int

    @property
    def saved(self) -> float:
        """Share of the textbook recursion's operations that are not needed."""
        return 1 - self.operations / self.textbook if self.textbook else 0.0


@dataclass(frozen=True)
class Strategies:
    """The chosen ways for torques, for gravity alone and for the inertia matrix; None is the textbook recursion."""

    torque: Strategy | None = None
    gravity: GravityStrategy | None = None
    inertia: InertiaStrategy | None = None
    choices: Mapping[str, Choice] | None = None


TEXTBOOK = Strategies()


def torques(chain: Chain, matter: Mapping[int, Body], qd: Nodes, qdd: Nodes, way: Strategy | None) -> Array:
    """Joint torques of the bodies, written in the given way."""
    if way is None:
        return newton_euler.inverse_dynamics(chain, newton_euler.motions(chain, qd, qdd), matter)
    return lean_newton_euler.inverse_dynamics(chain, matter, qd, qdd, way)


def gravity(chain: Chain, matter: Mapping[int, Body], way: GravityStrategy | None) -> Array:
    """Torques of the bodies' weight, written in the given way."""
    if way is None:
        still = [chain.program.zero] * chain.dof
        return newton_euler.inverse_dynamics(chain, newton_euler.motions(chain, still, still), matter)
    return lean_gravity.gravity(chain, matter, way)


def inertia_matrix(chain: Chain, matter: Mapping[int, Body], way: InertiaStrategy | None) -> Array:
    """Inertia matrix of the bodies, written in the given way."""
    return inertia.inertia_matrix(chain, matter) if way is None else lean_inertia.inertia_matrix(chain, matter, way)


def choose(chain: Chain, matter: Mapping[int, Body], qd: Nodes, qdd: Nodes) -> Strategies:
    """The shortest ways for a chain."""
    torque = _Search(chain, lambda way: torques(chain, matter, qd, qdd, way))
    torque.among(Strategy(bodies, Gauge(slide)) for bodies in _unspun_candidates(chain) for slide in _slides(chain))
    if torque.best is not None:
        torque.among(_balanced(chain, torque.best))
        torque.among(_slid_otherwise(chain, torque.best))
        torque.among(replace(torque.best, gauge=gauge) for gauge in _in_units(chain, torque.best.gauge))
    weight = _Search(chain, lambda way: gravity(chain, matter, way))
    weight.among(GravityStrategy(Gauge(slide)) for slide in _slides(chain))
    matrix = _Search(chain, lambda way: inertia_matrix(chain, matter, way))
    matrix.among(InertiaStrategy(gauge=Gauge(slide)) for slide in _slides(chain))
    slide = matrix.best.gauge if matrix.best is not None else Gauge()
    matrix.among(InertiaStrategy(j, unspun, slide) for j in _meetings(chain) for unspun in (False, True))
    if matrix.best is not None:
        matrix.among(replace(matrix.best, gauge=gauge) for gauge in _in_units(chain, matrix.best.gauge))
    choices = {"torques": torque.choice, "gravity": weight.choice, "inertia matrix": matrix.choice}
    return Strategies(torque.best, weight.best, matrix.best, choices)


class _Search(Generic[_Way]):
    """The shortest of the ways tried so far; the textbook recursion is the first."""

    def __init__(self, chain: Chain, write: Callable[[_Way | None], Array]) -> None:
        self._chain = chain
        self._write = write
        self._textbook = self._least = operations(chain, write(None))
        self._tried: set[_Way] = set()
        self.best: _Way | None = None

    def among(self, ways: Iterable[_Way]) -> None:
        for way in ways:
            if way in self._tried:
                continue
            self._tried.add(way)
            count = operations(self._chain, self._write(way))
            if count < self._least:
                self.best, self._least = way, count

    @property
    def choice(self) -> Choice:
        return Choice("textbook recursion" if self.best is None else str(self.best), self._least, self._textbook)


def operations(chain: Chain, results: Array) -> int:
    """Multiplications, additions and divisions per call of some results."""
    nodes = chain.program.reachable(results.ravel())
    return chain.program.count(node for node in nodes if not node.parameter_only).total


def _unspun_candidates(chain: Chain) -> list[frozenset[int]]:
    """Bodies that may gain from unspun axes: those inside a segment, on a first frame, at the tips, unions, none."""
    spun = segments(chain)
    carriers = {frame.parent.number for frame in chain.frames if frame.parent is not None and frame.has_body()}
    inside = frozenset(
        frame.parent.number for frame in chain.frames if spun[frame.number].continues and frame.parent is not None
    )
    tips = frozenset(frame.number for frame in chain.frames if frame.revolute and frame.number not in carriers)
    second = frozenset(frame.number for frame in chain.frames if lean_newton_euler.is_second(frame))
    return list(dict.fromkeys(near | far for far in (tips, frozenset()) for near in (frozenset(), inside, second)))


def _slides(chain: Chain) -> list[frozenset[int]]:
    """Frames to slide: none, those at the tips, all that can."""
    able = _able_to_slide(chain)
    tips = frozenset(j for j in able if is_last(chain, chain.frames[j - 1]))
    return list(dict.fromkeys([frozenset(), tips, able]))


def _able_to_slide(chain: Chain) -> frozenset[int]:
    """Revolute joints whose frame does not stand next to its antecedent's origin."""
    zero = chain.program.zero
    return frozenset(
        f.number
        for f in chain.frames
        if f.revolute and f.has_body() and f.rotation[:, 2] @ f.position is not zero
    )


def _slid_otherwise(chain: Chain, best: Strategy) -> list[Strategy]:
    """The same with one frame slid more or less."""
    gauges = [replace(best.gauge, slide=best.gauge.slide ^ {j}) for j in sorted(_able_to_slide(chain))]
    return [replace(best, gauge=gauge) for gauge in gauges]


def _balanced(chain: Chain, best: Strategy) -> list[Strategy]:
    """The same with a mass kept behind a joint, whose frame then stays where it is."""
    joints = [frame.number for frame in chain.frames if _balances(chain, frame)][:_MEETINGS]
    return [replace(best, gauge=Gauge(best.gauge.slide - {j}, frozenset({j}))) for j in joints]


def _in_units(chain: Chain, gauge: Gauge) -> list[Gauge]:
    """The same in units of each fixed length of the chain; a force of a prismatic joint would have to be turned back."""
    if any(frame.prismatic for frame in chain.frames):
        return []
    positions = slid_origins(chain, gauge.slide).positions.values()
    lengths = {abs(entry.number) for position in positions for entry in position if entry.number}
    return [replace(gauge, unit=length) for length in sorted(lengths, reverse=True)]


def _balances(chain: Chain, frame: Frame) -> bool:
    """Whether a mass behind a joint can balance its antecedent: the joint turns and stands away from it, across z."""
    if not frame.revolute or frame.parent is None:
        return False
    return any(entry.number for entry in frame.position[:2])


def _meetings(chain: Chain) -> list[int]:
    """Last frames of the segments, from the base."""
    spun = segments(chain)
    inside = {f.parent.number for f in chain.frames if spun[f.number].continues and f.parent is not None}
    return [frame.number for frame in chain.frames if frame.number not in inside and frame.has_body()][:_MEETINGS]
