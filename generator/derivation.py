"""From a robot to its model with every function: the one call that the commands and the tests make."""

from __future__ import annotations

from collections.abc import Collection
from functools import cache

import generator.quantities
from generator.discovery import modules
from generator.errors import InputError, Place
from generator.quantities.quantity import Quantity
from generator.robot.description import Robot
from generator.symbolic.built_in import built_in
from generator.symbolic.function import Function
from generator.symbolic.model import Model
from generator.verification import check_grouping


@cache
def quantities() -> dict[str, Quantity]:
    """Every quantity by name, found by listing their package."""
    found = [module.QUANTITY for module in modules(generator.quantities) if hasattr(module, "QUANTITY")]
    return {quantity.name: quantity for quantity in found}


def derive(
    robot: Robot,
    names: Collection[str] | None = None,
    check: bool = True,
    plain: bool = False,
    parameter_set: str | None = None,
) -> Model:
    """The model of ``robot`` with the functions ``names`` (all that apply, if None).

    A ``plain`` model writes the textbook recursion. With ``check`` the groupings are compared with the numerical rank
    of the regressor. The values of ``parameter_set``, if given, stand in the equations as numbers.

    Raises InputError for effects that do not fit the robot or of which the check cannot decide whether they are others,
    for a parameter set that does not fit, and GroupingMismatch if the check fails.
    """
    chosen = robot.parameter_sets.get(parameter_set or "")
    place = robot.place if chosen is None else chosen.place
    try:
        model = Model(robot, plain) if parameter_set is None else built_in(robot, parameter_set, plain)
        for name, quantity in quantities().items():
            if (names is None or name in names) and quantity.applies(model):
                model.functions[name] = _function(quantity, model, place)
        if check:
            check_grouping(model)
    except OverflowError:
        raise InputError(place, "its numbers are too large or too small to compute with", "those of a robot") from None
    return model


def _function(quantity: Quantity, model: Model, place: Place) -> Function:
    try:
        return quantity.function(model)
    except ZeroDivisionError:
        problem = f"{quantity.name} divides by a parameter that is zero"
        raise InputError(place, problem, "an inertia that moves") from None
