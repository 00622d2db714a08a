"""A four-axis arm, the third one prismatic and vertical: the numbers of robots/scara.yaml, typed again, with drives
made up.
"""

from __future__ import annotations

from math import pi, radians

from tests.plant.robot import Joint, Robot

ROBOT = Robot(
    name="scara_like",
    chain=(
        Joint(
            dh=(0.0, 0.0, 0.0, 0.387),
            body=(0.0324, 0.0, -0.0585, 0.4441, 0.0, 0.4333, 1.95, 0.0, 0.36, 12.0),
            range=(radians(-105), radians(105), 4.0, 18.0),
            rotor=1.2, viscous=3.0, coulomb=4.0, stiffness=2.4e4, ratio="80", constant=0.2, peak=6.0,
        ),
        Joint(
            dh=(0.0, 0.325, 0.0, 0.0),
            body=(0.03, 0.0, -0.055, 0.22667, 0.0, 0.20667, 1.1, 0.0, 0.4, 8.0),
            range=(radians(-150), radians(150), 5.0, 22.0),
            rotor=0.5, viscous=1.5, coulomb=2.0, stiffness=1.2e4, ratio="50", constant=0.2, peak=4.0,
        ),
        Joint(
            dh=(pi, 0.275, 0.0, 0.0),
            body=(0.080054, 0.0, 0.0, 0.080054, 0.0, 0.000108, 0.0, 0.0, -0.3, 1.5),
            range=(0.0, 0.21, 0.6, 4.0), prismatic=True,
            rotor=20.0, viscous=120.0, coulomb=25.0, stiffness=1.5e6, ratio="314", constant=0.1, peak=4.0,
        ),
        Joint(
            dh=(0.0, 0.0, 0.0, 0.0),
            body=(0.00017917, 0.0, 0.0, 0.00017917, 0.0, 0.000225, 0.0, 0.0, 0.0, 0.5),
            range=(radians(-360), radians(360), 8.0, 40.0),
            rotor=0.01, viscous=0.05, coulomb=0.1, stiffness=4.0e2, ratio="20", constant=0.05, peak=1.6,
        ),
    ),
    tool=0.0,
    speed_loop=100.0,
)  # fmt: skip
