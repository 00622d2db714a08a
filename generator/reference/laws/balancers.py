"""Torques of the gravity balancers about their joints (report eq. 19-38)."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from decimal import Decimal

from generator.reference.balancers import gas_energies, gas_forces, lever_arm, spring_energies, spring_forces
from generator.reference.law import At, Columns, Law, Ranges, Values


def _law(
    ranges: Ranges,
    forces: Callable[[Values, Decimal], Columns],
    energies: Callable[[Values, Decimal], Columns],
    defaults: Values,
) -> Law:
    def torque(at: At) -> Columns:
        arm = lever_arm(at.shape, at.q)
        return tuple(arm * force for force in forces(at.shape, at.q))

    return Law(
        tuple(ranges),
        torque,
        lambda at: forces(at.shape, at.q),
        lambda at: energies(at.shape, at.q),
        loads=True,
        ranges=ranges,
        defaults=defaults,
    )


#: By the effects' ids.
LAWS: Mapping[str, Law] = {
    "spring_balancer": _law({"Kr": (500.0, 900.0), "K0": (-80.0, 80.0)}, spring_forces, spring_energies, {}),
    "gas_balancer": _law({"F0": (300.0, 700.0)}, gas_forces, gas_energies, {"exponent": Decimal(1)}),
}
