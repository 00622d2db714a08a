"""The equations of long chains: how many there are grows with the square of the number of joints, not faster."""

from __future__ import annotations

from random import Random

from generator.derivation import derive
from tests.chains import random_chain


def test_operations_grow_quadratically_and_torques_linearly() -> None:
    short, long = (derive(random_chain(Random(count), count)) for count in (8, 16))
    assert len(long.program) <= 4.4 * len(short.program)
    torque = [model.functions["inverse_dynamics"].count.total / model.dof for model in (short, long)]
    # Operations a joint: what a random chain's right angles save differs between the two.
    assert torque[1] <= 1.3 * torque[0]
