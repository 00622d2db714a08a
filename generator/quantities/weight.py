"""What is to be known of torques and energies of the weight, which are computed from base parameters."""

from __future__ import annotations

from generator.symbolic.function import PARAMETERS
from generator.symbolic.model import Model


def caveat(model: Model) -> str:
    """Which base parameters of the weight hold something of an effect, for which it is not that of the bodies alone;
    empty where none does.
    """
    # Where values are built in the equations do not name their parameters.
    named = Model(model.robot) if model.constants else model
    read = {
        named.parameters[int(node.source[1])].name
        for node in named.program.reachable(named.base.gravity.ravel())
        if node.operation == "input" and node.source[0] == PARAMETERS
    }
    of_effects = {name for instance in named.effects for name in instance.names}
    mixed = [
        f"{base} holds {' and '.join(sorted(of_effects & terms.keys()))}"
        for base, terms in named.grouping.numeric().items()
        if base in read and of_effects & terms.keys()
    ]
    if not mixed:
        return ""
    return f"Not the bodies' weight alone here: {', '.join(mixed)}. What holds the robot at rest is inverse_dynamics."
