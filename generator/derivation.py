"""From a robot to its model with every function: the one call that the commands and the tests make."""

from __future__ import annotations

from collections.abc import Collection
from functools import cache

import generator.quantities
from generator.discovery import modules
from generator.errors import InputError
from generator.quantities.quantity import Quantity
from generator.robot.description import Robot
from generator.symbolic.built_in import built_in
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

    Raises InputError for effects that do not fit the robot, for a parameter set that does not, and GroupingMismatch
    if the check fails.
    """
    model = Model(robot, plain) if parameter_set is None else built_in(robot, parameter_set, plain)
    for name, quantity in quantities().items():
        if (names is None or name in names) and quantity.applies(model):
            try:
                model.functions[name] = quantity.function(model)
            except ZeroDivisionError:
                place = robot.place if parameter_set is None else robot.parameter_sets[parameter_set].place
                raise InputError(
                    place, f"{name} divides by a parameter that is zero", "an inertia that moves"
                ) from None
    if check:
        check_grouping(model)
    return model
