"""What is to be known of torques and energies of the weight, which are computed from base parameters."""

from __future__ import annotations

from generator.symbolic.function import PARAMETERS
from generator.symbolic.model import Model


def caveat(model: Model) -> str:
    """Which base parameters of the weight hold something of an effect, for which it is not that of the bodies alone;
    empty where none does.
    """
    nodes = model.program.reachable(model.base.gravity.ravel())
    read = {
        model.parameters[int(node.source[1])].name
        for node in nodes
        if node.operation == "input" and node.source[0] == PARAMETERS
    }
    of_effects = {name for instance in model.effects for name in instance.names}
    mixed = [
        f"{base} holds {' and '.join(sorted(of_effects & terms.keys()))}"
        for base, terms in model.grouping.numeric().items()
        if base in read and of_effects & terms.keys()
    ]
    if not mixed:
        return ""
    return f"Not the bodies' weight alone here: {', '.join(mixed)}. What holds the robot at rest is inverse_dynamics."
