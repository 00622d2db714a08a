"""A seven-axis arm: the numbers of robots/lbr_iiwa14.yaml, typed again, with drives made up."""

from __future__ import annotations

from math import pi, radians

from tests.plant.robot import Joint, Robot

ROBOT = Robot(
    name="seven_axis",
    chain=(
        Joint(
            dh=(0.0, 0.0, 0.0, 0.36),
            body=(0.084907, 0.0, 0.0, 0.083598, -0.0020804, 0.012829, 0.0, -0.064, -0.576, 6.4),
            range=(radians(-170), radians(170), 1.4, 5.0),
            rotor=3.2, viscous=4.0, coulomb=3.0, offset=0.2, stiffness=16000.0,
            ratio="160", constant=0.11, peak=4.8,
        ),
        Joint(
            dh=(-pi / 2, 0.0, 0.0, 0.0),
            body=(0.10955, 0.0, 0.0, 0.020454, 0.01207, 0.10331, 0.0, -0.711, 0.1975, 7.9),
            range=(radians(-120), radians(120), 1.4, 5.0),
            rotor=3.1, viscous=4.0, coulomb=3.0, offset=-0.2, stiffness=16000.0,
            ratio="160", constant=0.11, peak=4.8,
        ),
        Joint(
            dh=(pi / 2, 0.0, 0.0, 0.42),
            body=(0.032646, 0.0, 0.0, 0.031924, 0.0022092, 0.0038465, 0.0, 0.0375, -0.225, 2.5),
            range=(radians(-170), radians(170), 1.7, 6.0),
            rotor=1.4, viscous=3.0, coulomb=2.0, offset=0.1, stiffness=11000.0,
            ratio="160", constant=0.11, peak=4.8,
        ),
        Joint(
            dh=(pi / 2, 0.0, 0.0, 0.0),
            body=(0.05851, 0.0, 0.0, 0.0096929, -0.0054672, 0.056077, 0.0, 0.408, 0.096, 4.8),
            range=(radians(-120), radians(120), 1.7, 6.0),
            rotor=1.4, viscous=3.0, coulomb=2.0, offset=-0.1, stiffness=11000.0,
            ratio="160", constant=0.11, peak=4.8,
        ),
        Joint(
            dh=(-pi / 2, 0.0, 0.0, 0.4),
            body=(0.028005, 0.0, 0.0, 0.027779, -0.0015635, 0.0024763, 0.0, -0.018, -0.198, 1.8),
            range=(radians(-170), radians(170), 2.2, 8.0),
            rotor=0.6, viscous=2.0, coulomb=1.5, offset=0.05, stiffness=8000.0,
            ratio="160", constant=0.11, peak=4.8,
        ),
        Joint(
            dh=(-pi / 2, 0.0, 0.0, 0.0),
            body=(0.0039323, 0.0, 0.0, 0.0038593, -0.00017755, 0.0026042, 0.0, 0.0125, 0.0125, 2.5),
            range=(radians(-120), radians(120), 2.2, 8.0),
            rotor=0.4, viscous=1.0, coulomb=1.0, offset=-0.05, stiffness=6000.0,
            ratio="100", constant=0.11, peak=4.8,
        ),
        Joint(
            dh=(pi / 2, 0.0, 0.0, 0.0),
            body=(0.0046185, 0.0, 0.0, 0.0046185, 0.0, 0.000225, 0.0, 0.0, 0.0465, 0.5),
            range=(radians(-175), radians(175), 2.3, 9.0),
            rotor=0.4, viscous=1.0, coulomb=1.0, offset=0.02, stiffness=5000.0,
            ratio="100", constant=0.11, peak=4.8,
        ),
    ),
    tool=0.126,
    speed_loop=80.0,
    home=(0.0, 0.4, 0.0, 1.2, 0.0, 0.6, 0.0),
)  # fmt: skip
