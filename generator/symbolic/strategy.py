"""Which way of writing a chain's equations is shortest: tried on the chain itself, counted, chosen.

The textbook recursion is always among the candidates, so that no chain gets longer equations than it gives.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import TypeVar

from generator.symbolic import inertia, lean_inertia, lean_newton_euler, newton_euler
from generator.symbolic.bodies import Body
from generator.symbolic.frames import Chain
from generator.symbolic.gauge import Gauge
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
    gravity: Strategy | None = None
    inertia: InertiaStrategy | None = None
    choices: Mapping[str, Choice] | None = None


TEXTBOOK = Strategies()


def torques(chain: Chain, matter: Mapping[int, Body], qd: Nodes, qdd: Nodes, way: Strategy | None) -> Array:
    """Joint torques of the bodies, written in the given way."""
    if way is None:
        return newton_euler.inverse_dynamics(chain, newton_euler.motions(chain, qd, qdd), matter)
    return lean_newton_euler.inverse_dynamics(chain, matter, qd, qdd, way)


def inertia_matrix(chain: Chain, matter: Mapping[int, Body], way: InertiaStrategy | None) -> Array:
    """Inertia matrix of the bodies, written in the given way."""
    return inertia.inertia_matrix(chain, matter) if way is None else lean_inertia.inertia_matrix(chain, matter, way)


def choose(chain: Chain, matter: Mapping[int, Body], qd: Nodes, qdd: Nodes) -> Strategies:
    """The shortest ways for a chain."""
    still = [chain.program.zero] * chain.dof
    torque, torque_choice = _shortest_torque(chain, lambda way: torques(chain, matter, qd, qdd, way))
    gravity, gravity_choice = _shortest_torque(chain, lambda way: torques(chain, matter, still, still, way))
    meeting = [InertiaStrategy()]
    meeting += [InertiaStrategy(j, block_unspun) for j in _meetings(chain) for block_unspun in (False, True)]
    matrix, matrix_choice = _shortest(chain, lambda way: inertia_matrix(chain, matter, way), meeting)
    choices = {"torques": torque_choice, "gravity": gravity_choice, "inertia matrix": matrix_choice}
    return Strategies(torque, gravity, matrix, choices)


def _shortest_torque(chain: Chain, write: Callable[[Strategy | None], Array]) -> tuple[Strategy | None, Choice]:
    """First the axes that bodies work in, then the joints that keep a mass."""
    axes = [Strategy(unspun=bodies) for bodies in _unspun_candidates(chain)]
    best, choice = _shortest(chain, write, axes)
    if best is None:
        return best, choice
    balanced = [
        Strategy(best.unspun, Gauge(best.gauge.slide, (frame.number,)))
        for frame in chain.frames
        if _balances(chain, frame.number)
    ]
    return _shortest(chain, write, [best, *balanced[:_MEETINGS]])


def _shortest(chain: Chain, write: Callable[[_Way | None], Array], ways: Iterable[_Way]) -> tuple[_Way | None, Choice]:
    textbook = operations(chain, write(None))
    best: _Way | None = None
    least = textbook
    for way in ways:
        count = operations(chain, write(way))
        if count < least:
            best, least = way, count
    return best, Choice("textbook recursion" if best is None else str(best), least, textbook)


def operations(chain: Chain, results: Array) -> int:
    """Multiplications, additions and divisions per call of some results."""
    nodes = chain.program.reachable(results.ravel())
    return chain.program.count(node for node in nodes if not node.parameter_only).total


def _unspun_candidates(chain: Chain) -> list[frozenset[int]]:
    """Bodies that may gain from unspun axes: those inside a segment, those at the tips, both, none."""
    spun = segments(chain)
    carriers = {frame.parent.number for frame in chain.frames if frame.parent is not None and frame.has_body()}
    inside = frozenset(
        frame.parent.number for frame in chain.frames if spun[frame.number].continues and frame.parent is not None
    )
    tips = frozenset(frame.number for frame in chain.frames if frame.revolute and frame.number not in carriers)
    return list(dict.fromkeys([frozenset(), inside, tips, inside | tips]))


def _balances(chain: Chain, number: int) -> bool:
    """Whether a mass behind a joint can balance its antecedent: the joint turns and stands away from it, across z."""
    frame = chain.frames[number - 1]
    zero = chain.program.zero
    return frame.revolute and frame.parent is not None and any(p is not zero for p in frame.position[:2])


def _meetings(chain: Chain) -> list[int]:
    """Last frames of the segments, from the base."""
    spun = segments(chain)
    inside = {f.parent.number for f in chain.frames if spun[f.number].continues and f.parent is not None}
    return [frame.number for frame in chain.frames if frame.number not in inside and frame.has_body()][:_MEETINGS]
