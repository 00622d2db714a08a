"""Coulomb friction as a stiff bristle: a LuGre state that saturates after ``distance``, where a textbook has sign(v).

Away from reversals it is size sign(v) to the last digit; within some distances of one it is a spring.
"""

from __future__ import annotations

from tests.plant.law import Law, stiff_way

LAW = Law(
    about="Coulomb friction",
    unit="N m",
    typical=lambda robot, j: robot.chain[j].coulomb,
    values={"distance": stiff_way},
    torque="return size * bristle(s, v, distance, 1.0, h);",
    friction=True,
)
