"""Which robots have functions of many samples, and what those are made of."""

from __future__ import annotations

from generator.symbolic.model import Model

DYNAMICS, REGRESSOR = "inverse_dynamics", "regressor_packed"
#: Their inputs.
INPUTS = ("q", "qd", "qdd")


def of_many_samples(model: Model) -> bool:
    """Whether the model has what they are made of, and no effect reads more than the motion."""
    made_of = (DYNAMICS, REGRESSOR)
    if not {*made_of} <= model.functions.keys():
        return False
    return all(signal.name in INPUTS for name in made_of for signal in model.functions[name].inputs)
