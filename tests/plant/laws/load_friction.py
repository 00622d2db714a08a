"""Coulomb friction that grows with the torque through the gear, rounded at no load: size sqrt(load^2 + floor^2)."""

from __future__ import annotations

from tests.plant.law import Law, stiff_way

LAW = Law(
    about="load-dependent friction",
    unit="1",
    typical=0.04,
    values={"floor_load": lambda robot, j: 0.3 * robot.chain[j].coulomb, "distance": stiff_way},
    torque="return size * sqrt(load * load + floor_load * floor_load) * bristle(s, v, distance, 1.0, h);",
    friction=True,
)
