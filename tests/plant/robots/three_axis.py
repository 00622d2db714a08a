"""A three-axis arm on a leaning wall, with a spring balancer on its shoulder; made up."""

from __future__ import annotations

from math import pi

from tests.plant.effect import Effect
from tests.plant.robot import Joint, Robot, bar

ROBOT = Robot(
    name="three_axis",
    chain=(
        Joint(
            dh=(0.0, 0.0, 0.0, 0.6),
            body=bar(90.0, (0.0, 0.0, -0.4), (0.15, 0.0, 0.0), 0.14),
            range=(-2.5, 2.5, 2.2, 5.0),
            rotor=38.0, viscous=65.0, coulomb=48.0, offset=2.0, stiffness=2.5e5, ratio="120", constant=0.9, peak=7.5,
        ),
        Joint(
            dh=(-pi / 2, 0.2, 0.0, 0.0),
            body=bar(48.0, (-0.15, 0.0, 0.05), (0.7, 0.0, 0.05), 0.09),
            range=(-2.6, 0.4, 2.0, 5.0),
            rotor=42.0, viscous=80.0, coulomb=60.0, offset=-3.0, stiffness=2.8e5, ratio="120", constant=0.9, peak=10.0,
        ),
        Joint(
            dh=(0.0, 0.7, pi / 2, 0.0),
            body=bar(26.0, (0.05, 0.1, 0.0), (0.0, -0.55, 0.02), 0.07),
            range=(-2.2, 2.2, 2.6, 7.0),
            rotor=11.0, viscous=32.0, coulomb=30.0, offset=1.5, stiffness=9.0e4, ratio="-101", constant=0.6, peak=6.25,
        ),
    ),
    tool=0.1,
    base=(0.12, -0.2, 0.4),
    own=(Effect("spring_balancer", 2, 2500.0, {"d21": 0.45, "d22": 0.15, "phi": -1.5, "free_length": 0.1}),),
    speed_loop=90.0,
    home=(0.0, -1.1, 0.4),
)  # fmt: skip
