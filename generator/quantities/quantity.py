"""What a quantity is: one emitted function, stated in one file of its own."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from generator.quantities import signals
from generator.symbolic.directed import directed
from generator.symbolic.factoring import factored
from generator.symbolic.function import Function, Output, Signal, Sparsity
from generator.symbolic.model import Model


def always(model: Model) -> bool:
    """Most quantities exist for every robot."""
    return True


def nothing(model: Model) -> str:
    """Most quantities are the same thing on every robot."""
    return ""


@dataclass(frozen=True)
class Quantity:
    """A function that every backend emits.

    ``inputs`` and ``outputs`` are signals of a model (their shapes depend on the robot); what effects read beside the
    motion (their states, warmth) follows the inputs where the outputs depend on it. ``build`` returns the output
    arrays, one per output signal, of nodes. ``applies`` tells for which models it exists. ``sparsity`` gives the
    structure of a packed output; ``solves`` tells whether equations are solved, whose condition magnifies rounding.
    ``caveat`` is what its user must know of it on a robot, ``absence`` why a robot that might have it has it not.
    """

    name: str
    summary: str
    details: str
    inputs: Callable[[Model], Sequence[Signal]]
    outputs: Callable[[Model], Sequence[Signal]]
    build: Callable[[Model], Sequence[Any]]
    applies: Callable[[Model], bool] = always
    sparsity: Callable[[Model], Sparsity] | None = None
    solves: bool = False
    caveat: Callable[[Model], str] = nothing
    absence: Callable[[Model], str] = nothing

    def function(self, model: Model) -> Function:
        """The quantity of one robot. Raises ValueError if an array does not have the shape of its signal."""
        outputs: list[Output] = []
        for signal, values in zip(self.outputs(model), self.build(model), strict=True):
            nodes = np.asarray(values, dtype=object)
            if nodes.shape != signal.shape:
                raise ValueError(f"{self.name}: {signal.name} is {nodes.shape}, its signal {signal.shape}")
            outputs.append(Output(signal, tuple(nodes.ravel())))
        outputs = _rewritten(model, outputs)
        sparsity = self.sparsity(model) if self.sparsity else None
        inputs = (*self.inputs(model), *_further(model, self.inputs(model), outputs))
        details = " ".join(filter(None, (self.details, self.caveat(model))))
        return Function(self.name, self.summary, details, inputs, tuple(outputs), model.program, sparsity, self.solves)


def _further(model: Model, inputs: Sequence[Signal], outputs: Sequence[Output]) -> list[Signal]:
    """What effects read beside the motion, where the outputs depend on it."""
    given = {signal.name for signal in inputs}
    candidates = [signal for signal in signals.of_effects(model) if signal.name not in given]
    if not candidates:
        return []
    nodes = model.program.reachable(node for output in outputs for node in output.nodes)
    read = {node.source[0] for node in nodes if node.operation == "input"}
    return [signal for signal in candidates if signal.name in read]


def _rewritten(model: Model, outputs: Sequence[Output]) -> list[Output]:
    roots = [node for output in outputs for node in output.nodes]
    if not model.plain:
        roots = factored(model.program, roots)
    nodes = iter(directed(model.program, roots))
    return [Output(output.signal, tuple(next(nodes) for _ in output.nodes)) for output in outputs]
