"""Which way of writing a chain's equations is shortest: tried on the chain itself, counted, chosen.

The textbook recursion is always among the candidates, so that no chain gets longer equations than it gives.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Generic, TypeVar

from generator.symbolic import inertia, lean_gravity, lean_inertia, lean_newton_euler, newton_euler, regressor
from generator.symbolic.bodies import Body
from generator.symbolic.candidates import (
    balanced,
    before_last,
    in_units,
    meetings,
    slid_otherwise,
    slides,
    unspun_candidates,
)
from generator.symbolic.frames import Chain
from generator.symbolic.gauge import Gauge
from generator.symbolic.lean_gravity import GravityStrategy
from generator.symbolic.lean_inertia import InertiaStrategy
from generator.symbolic.lean_newton_euler import Strategy
from generator.symbolic.regressor import RegressorStrategy
from generator.symbolic.statements import Node
from generator.symbolic.vectors import Array, Nodes, array

_Way = TypeVar("_Way")


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
    """The chosen ways for torques, gravity alone, the inertia matrix and regressors; None is the textbook recursion."""

    torque: Strategy | None = None
    gravity: GravityStrategy | None = None
    inertia: InertiaStrategy | None = None
    regressor: RegressorStrategy | None = None
    choices: Mapping[str, Choice] | None = None

    @property
    def gravity_beside_inertia(self) -> GravityStrategy | None:
        """The way for gravity where the inertia matrix is computed too: from the same composite bodies."""
        if self.gravity is None or self.inertia is None:
            return self.gravity
        return GravityStrategy(self.inertia.gauge, weighed=False)


TEXTBOOK = Strategies()
#: Whatever the parameters: the textbook recursion, but regressors by projection on screws.
PROJECTED = Strategies(regressor=RegressorStrategy())


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


def choose(chain: Chain, matter: Mapping[int, Body], qd: Nodes, qdd: Nodes, names: Collection[str]) -> Strategies:
    """The shortest ways for a chain; ``names`` are the parameters whose columns a regressor has."""
    matrix: _Search[InertiaStrategy] = _Search(chain, lambda way: inertia_matrix(chain, matter, way))
    matrix.among(InertiaStrategy(gauge=Gauge(slide)) for slide in slides(chain))
    slide = matrix.best.gauge if matrix.best is not None else Gauge()
    matrix.among(InertiaStrategy(j, unspun, slide) for j in meetings(chain) for unspun in (False, True))
    if matrix.best is not None:
        matrix.among(replace(matrix.best, gauge=gauge) for gauge in in_units(chain, matrix.best.gauge))
    torque: _Search[Strategy] = _Search(chain, lambda way: torques(chain, matter, qd, qdd, way))
    torque.among(Strategy(bodies, Gauge(slide)) for bodies in unspun_candidates(chain) for slide in slides(chain))
    if torque.best is not None:
        torque.among(balanced(chain, torque.best))
        torque.among(slid_otherwise(chain, torque.best))
        # The unit of the inertia matrix first: where both are asked for, they share what is in one unit.
        unit = matrix.best.gauge.unit if matrix.best is not None else None
        gauges = sorted(in_units(chain, torque.best.gauge), key=lambda gauge: gauge.unit != unit)
        torque.among([replace(torque.best, gauge=gauge) for gauge in gauges])
    weight: _Search[GravityStrategy] = _Search(chain, lambda way: gravity(chain, matter, way))
    weight.among(GravityStrategy(Gauge(slide)) for slide in slides(chain))
    # Only counted here: what both ways share is to bear the names of the short one.
    columns: _Search[RegressorStrategy] = _Search(
        chain, lambda way: _entries(chain, regressor.columns(chain, names, qd, qdd, way, readable=False))
    )
    columns.among(RegressorStrategy(slide, met) for met in (frozenset(), before_last(chain)) for slide in slides(chain))
    choices = {
        "torques": torque.choice,
        "gravity": weight.choice,
        "inertia matrix": matrix.choice,
        "regressor": columns.choice,
    }
    return Strategies(torque.best, weight.best, matrix.best, columns.best, choices)


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


def _entries(chain: Chain, columns: Mapping[str, Mapping[int, Node]]) -> Array:
    return array(chain.program, [entry for column in columns.values() for entry in column.values()])


def operations(chain: Chain, results: Array) -> int:
    """Multiplications, additions and divisions per call of some results."""
    return chain.program.count(chain.program.moving(results.ravel())).total
