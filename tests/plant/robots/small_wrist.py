"""A small six-axis arm whose last two axes share their drives: lengths and ratios of a table-top robot, bodies made
up of bars.
"""

from __future__ import annotations

from math import pi

from tests.plant.effect import Effect
from tests.plant.robot import Joint, Robot, bar

ROBOT = Robot(
    name="small_wrist",
    chain=(
        Joint(
            dh=(0.0, 0.0, 0.0, 0.32),
            body=bar(8.0, (0.0, 0.0, -0.15), (0.0, 0.02, 0.03), 0.07),
            range=(-3.0, 3.0, 4.0, 14.0),
            rotor=0.34, viscous=7.9, coulomb=7.1, offset=0.3, stiffness=2.2e4, ratio="32", constant=0.23, peak=12.0,
        ),
        Joint(
            dh=(-pi / 2, 0.0, -pi / 2, 0.0),
            body=bar(7.0, (-0.02, 0.0, 0.09), (0.225, 0.0, 0.06), 0.05),
            range=(-2.0, 2.0, 4.0, 12.0),
            rotor=0.36, viscous=5.6, coulomb=8.2, offset=-0.5, stiffness=2.0e4, ratio="32", constant=0.23, peak=12.0,
        ),
        Joint(
            dh=(0.0, 0.225, pi / 2, 0.035),
            body=bar(3.2, (0.0, -0.03, 0.0), (0.0, 0.08, 0.01), 0.045),
            range=(-2.2, 2.2, 5.0, 18.0),
            rotor=0.14, viscous=2.1, coulomb=6.4, offset=0.2, stiffness=9.0e3, ratio="45", constant=0.18, peak=8.0,
        ),
        Joint(
            dh=(pi / 2, 0.0, 0.0, 0.225),
            body=bar(2.0, (0.0, 0.01, -0.12), (0.0, 0.0, 0.02), 0.04),
            range=(-3.5, 3.5, 6.0, 25.0),
            rotor=0.032, viscous=1.15, coulomb=2.4, offset=-0.1, stiffness=3.0e3, ratio="-48", constant=0.06, peak=6.0,
        ),
        Joint(
            dh=(-pi / 2, 0.0, 0.0, 0.0),
            body=bar(0.8, (0.0, -0.03, 0.0), (0.0, 0.03, 0.005), 0.03),
            range=(-2.0, 2.0, 6.0, 25.0),
            rotor=0.045, viscous=1.9, coulomb=3.0, offset=0.05, stiffness=2.5e3, ratio="45", constant=0.06, peak=6.0,
        ),
        Joint(
            dh=(pi / 2, 0.0, pi, 0.0),
            body=bar(0.4, (0.01, 0.0, 0.02), (0.0, 0.0, 0.09), 0.025),
            range=(-4.5, 4.5, 7.0, 30.0),
            rotor=0.012, viscous=0.6, coulomb=0.5, offset=0.02, stiffness=8.0e2, ratio="32", constant=0.06, peak=5.0,
        ),
    ),
    coupling=((6, 5, "32"),),
    tool=0.065,
    own=(Effect("wrist_inertia", 6, 0.010), Effect("wrist_friction", 6, 1.4)),
    speed_loop=120.0,
    home=(0.0, -0.3, 0.9, 0.2, 0.6, 0.0),
)  # fmt: skip
