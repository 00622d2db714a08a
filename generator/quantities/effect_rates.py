"""Time derivatives of the states inside effects."""

from dataclasses import replace

from generator.quantities import signals
from generator.quantities.quantity import Quantity
from generator.symbolic.function import Signal
from generator.symbolic.model import Model


def _rates(model: Model) -> tuple[Signal]:
    states = signals.states(model)
    units = tuple(f"{unit}/s" if unit != "1" else "1/s" for unit in states.units)
    return (replace(states, name="rates", units=units, meaning="time derivatives of the states"),)


QUANTITY = Quantity(
    name="effect_rates",
    summary="Time derivatives of the states inside the effects, to be integrated beside q and qd.",
    details="States start at zero: an effect that has been at rest for long.",
    inputs=signals.together(signals.q, signals.qd, signals.states),
    outputs=_rates,
    build=lambda model: (model.base.effect_rates,),
    applies=lambda model: bool(model.effect_states),
)
