"""What is to be known of torques and energies of the weight, which are computed from base parameters."""

from __future__ import annotations

from generator.symbolic.function import PARAMETERS
from generator.symbolic.model import Model


def caveat(model: Model) -> str:
    """Which base parameters of the weight hold something of an effect, for which it is not that of the bodies alone;
    empty where none does.
    """
    of_effects = {name for instance in model.effects for name in instance.names}
    # The weight is of masses and first moments: M, MX, MY, MZ.
    mixed = {
        base: sorted(of_effects & terms.keys())
        for base, terms in model.grouping.numeric().items()
        if base.startswith("M") and of_effects & terms.keys()
    }
    read = _read(model) if mixed else set()
    told = [f"{base} holds {' and '.join(names)}" for base, names in mixed.items() if base in read]
    if not told:
        return ""
    return f"Not the bodies' weight alone here: {', '.join(told)}."


def _read(model: Model) -> set[str]:
    """Names of the base parameters that the weight's torques depend on."""
    # Where values are built in the equations do not name their parameters.
    named = Model(model.robot) if model.constants else model
    return {
        named.parameters[int(node.source[1])].name
        for node in named.program.reachable(named.base.gravity.ravel())
        if node.operation == "input" and node.source[0] == PARAMETERS
    }
