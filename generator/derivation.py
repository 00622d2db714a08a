"""From a robot to its model with every function: the one call that the commands and the tests make."""

from __future__ import annotations

from collections.abc import Collection
from functools import cache

import generator.quantities
from generator.discovery import modules
from generator.quantities.quantity import Quantity
from generator.robot.description import Robot
from generator.symbolic.model import Model
from generator.verification import check_grouping


@cache
def quantities() -> dict[str, Quantity]:
    """Every quantity by name, found by listing their package."""
    found = [module.QUANTITY for module in modules(generator.quantities) if hasattr(module, "QUANTITY")]
    return {quantity.name: quantity for quantity in found}


def derive(robot: Robot, names: Collection[str] | None = None, check: bool = True, plain: bool = False) -> Model:
    """The model of ``robot`` with the functions ``names`` (all that apply, if None).

    A ``plain`` model writes the textbook recursion. With ``check`` the groupings are compared with the numerical rank
    of the regressor.

    Raises InputError for effects that do not fit the robot and GroupingMismatch if the check fails.
    """
    model = Model(robot, plain)
    for name, quantity in quantities().items():
        if (names is None or name in names) and quantity.applies(model):
            model.functions[name] = quantity.function(model)
    if check:
        check_grouping(model)
    return model
