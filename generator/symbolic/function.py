"""A function to be emitted: named, typed inputs and outputs over one straight-line program."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import prod

from generator.symbolic.counts import Count
from generator.symbolic.statements import Node, Program

#: The input signal that holds the robot's parameters; C passes it prepared, other backends as a vector.
PARAMETERS = "parameters"


@dataclass(frozen=True)
class Signal:
    """A named array: ``shape`` (row-major, () a scalar), ``units`` (one for all entries, or one per entry)."""

    name: str
    shape: tuple[int, ...]
    units: tuple[str, ...]
    meaning: str

    @property
    def size(self) -> int:
        """Number of entries, 1 of a scalar."""
        return prod(self.shape)


@dataclass(frozen=True)
class Output:
    """An output signal with its nodes, row-major."""

    signal: Signal
    nodes: tuple[Node, ...]


@dataclass(frozen=True)
class Sparsity:
    """Rows and columns, row-major order, of the structural nonzeros that a packed output holds."""

    shape: tuple[int, int]
    rows: tuple[int, ...]
    columns: tuple[int, ...]


@dataclass(frozen=True)
class Function:
    """A quantity of one robot, ready to print.

    ``inputs`` are the signals read per call, in call order; the parameters are not among them. ``uses_parameters``
    tells whether any output depends on the parameters. ``sparsity`` belongs to a packed output; ``solves``
    tells whether equations are solved, whose condition magnifies rounding.
    """

    name: str
    summary: str
    details: str
    inputs: tuple[Signal, ...]
    outputs: tuple[Output, ...]
    program: Program
    sparsity: Sparsity | None = None
    solves: bool = False

    @cached_property
    def roots(self) -> tuple[Node, ...]:
        """Every output node, in output order."""
        return tuple(node for output in self.outputs for node in output.nodes)

    @cached_property
    def nodes(self) -> list[Node]:
        """All nodes that the outputs need, parameter-only ones included, arguments before users."""
        return self.program.reachable(self.roots)

    @property
    def uses_parameters(self) -> bool:
        """Whether any output depends on the signal ``parameters``."""
        return any(node.operation == "input" and node.source[0] == PARAMETERS for node in self.nodes)

    @cached_property
    def prepared(self) -> list[Node]:
        """The nodes that a moving node or an output reads and that are computed of parameters alone: computed once."""
        of_numbers: set[Node] = set()
        read = set(self.roots)
        for node in self.nodes:
            if node.operation != "input" and of_numbers.issuperset(node.arguments):
                of_numbers.add(node)
            if not node.parameter_only:
                read.update(node.arguments)
        sizes = (node.arguments[0] if node.operation == "neg" else node for node in read if node.parameter_only)
        computed = {node for node in sizes if node.operation != "input" and node not in of_numbers}
        return sorted(computed, key=lambda node: node.index)

    @cached_property
    def called(self) -> list[Node]:
        """The nodes that a call reads or computes where the ``prepared`` ones are at hand, arguments before users."""
        return self.program.reachable(self.roots, known=self.prepared)

    @cached_property
    def moving(self) -> list[Node]:
        """The nodes computed at each call, in order."""
        return [node for node in self.nodes if not node.parameter_only]

    @cached_property
    def count(self) -> Count:
        """Operations per call, parameter-only work left out."""
        return self.program.count(self.moving)

    @cached_property
    def prepare_count(self) -> Count:
        """Operations of the parameter-only work, done once."""
        return self.program.count(node for node in self.nodes if node.parameter_only)
