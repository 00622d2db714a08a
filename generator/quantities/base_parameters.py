"""Base parameters from standard ones: the groupings as a function."""

import numpy as np

from generator.quantities import signals
from generator.quantities.quantity import Quantity
from generator.symbolic.function import Signal
from generator.symbolic.lowering import lower
from generator.symbolic.model import Model
from generator.symbolic.statements import Node
from generator.symbolic.vectors import Array


def _signal(model: Model) -> tuple[Signal]:
    units = tuple(parameter.unit for parameter in model.base_parameters)
    return (Signal("base_parameters", (len(units),), units, "base parameters, in their order"),)


def _build(model: Model) -> tuple[Array]:
    values = []
    for base in model.grouping.base:
        total: Node = model.program.zero
        for coefficient, name in base.terms:
            total = total + lower(model.program, coefficient, model.lengths) * model.standard_nodes[name]
        values.append(total)
    result = np.empty(len(values), dtype=object)
    result[:] = values
    return (result,)


QUANTITY = Quantity(
    name="base_parameters",
    summary="Base parameters from standard parameters: the groupings.",
    details="Groupings as in report sections 5.1 and 6.1 (Gautier and Khalil 1990).",
    inputs=signals.together(signals.standard_parameters),
    outputs=_signal,
    build=_build,
)
