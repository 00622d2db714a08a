"""An amplifier that clips below the drive's peak, while the log holds the current that was asked for; size is the
part cut off.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tests.plant.law import Law

if TYPE_CHECKING:
    from tests.plant.effect import Effect
    from tests.plant.machine import Machine


def _change(machine: Machine, effect: Effect) -> None:
    j = effect.joint - 1
    machine.limit[j] *= max(1 - effect.amount(machine.robot), 0.02)


LAW = Law(
    about="current saturation",
    unit="1",
    typical=0.7,
    largest=0.98,
    change=_change,
    reading="command",
)
