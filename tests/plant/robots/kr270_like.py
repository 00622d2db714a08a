"""A six-axis arm with a spring balancer: the numbers of the report's first robot and of its twin, typed again."""

from __future__ import annotations

from math import pi, radians

from tests.plant.effect import Effect
from tests.plant.robot import Joint, Robot


def _range(low: float, high: float, speed: float, acceleration: float) -> tuple[float, float, float, float]:
    return radians(low), radians(high), speed, acceleration


ROBOT = Robot(
    name="kr270_like",
    chain=(
        Joint(
            dh=(pi, 0.0, 0.0, -0.75),
            body=(14.8, 0.0, -3.5, 27.05, 0.0, 23.05, 52.5, 0.0, 0.0, 300.0),
            range=_range(-185, 185, 1.6, 2.5),
            rotor=458.267, viscous=1100.0, coulomb=311.0, offset=20.0, stiffness=1.73e6,
            ratio="-219", constant=1.25571, peak=30.0,
        ),
        Joint(
            dh=(pi / 2, 0.35, 0.0, 0.0),
            body=(3.12431, 0.0, 0.0, 196.219, 0.0, 196.143, -2.90339, 0.0, 0.0, 52.3125),
            range=_range(-146, 0, 1.5, 2.5),
            rotor=693.67, viscous=2640.0, coulomb=673.0, offset=-30.0, stiffness=1.91e6,
            ratio="-858/3", constant=1.48951, peak=30.0,
        ),
        Joint(
            dh=(0.0, 1.25, pi / 2, 0.0),
            body=(19.8704, -0.193701, 0.0, 49.6254, 0.0, 66.2958, 11.0052, -55.7196, 0.0, 240.059),
            range=_range(-119, 155, 1.5, 2.5),
            rotor=670.0, viscous=995.0, coulomb=396.0, offset=10.0, stiffness=1.84e6,
            ratio="-4593/17", constant=1.49532, peak=20.0,
        ),
        Joint(
            dh=(-pi / 2, 0.055, 0.0, -1.1),
            body=(9.36761, 0.0, 0.0, 9.36219, 0.0, 0.526856, 0.0, 0.0, 15.6399, 34.9183),
            range=_range(-350, 350, 2.0, 4.0),
            rotor=171.0, viscous=526.0, coulomb=189.0, offset=-5.0, stiffness=4.71e5,
            ratio="-4221/19", constant=1.34139, peak=10.0,
        ),
        Joint(
            dh=(pi / 2, 0.0, 0.0, 0.0),
            body=(0.48677, 0.0, 0.0, 0.356065, 0.0, 0.486283, 0.0, 0.0876743, 0.0, 11.4368),
            range=_range(-125, 125, 2.0, 4.0),
            rotor=202.0, viscous=701.0, coulomb=175.0, offset=8.0, stiffness=5.56e5,
            ratio="-3770/17", constant=1.35729, peak=10.0,
        ),
        Joint(
            dh=(-pi / 2, 0.0, -pi / 2, -0.23),
            body=(0.118385, 0.0, 0.0, 0.118294, 0.0, 0.0798978, 0.0, 0.0, 0.421378, 8.10536),
            range=_range(-350, 350, 2.5, 5.0),
            rotor=111.0, viscous=740.0, coulomb=303.0, offset=-4.0, stiffness=3.06e5,
            ratio="2611575/16576", constant=1.34559, peak=10.0,
        ),
    ),
    # Elements of diag(ratios) (1 + L)^-1 with L54 = 17/3770, L64 = 18872/2064075, L65 = 112/9855.
    coupling=((5, 4, "1"), (6, 4, "-53/37"), (6, 5, "-265/148")),
    tool=0.0,
    own=(
        Effect(
            law="spring_balancer",
            joint=2,
            size=39500.0,
            values={"d21": 0.6964, "d22": 0.1847, "phi": -1.6148, "free_length": 7380.0 / 39500.0},
        ),
    ),
    speed_loop=80.0,
    home=(0.0, radians(-80), radians(60), 0.0, radians(20), 0.0),
)  # fmt: skip
