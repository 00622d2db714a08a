"""A heavy six-axis arm with a gas balancer: the numbers of the report's second robot and of its twin, typed again."""

from __future__ import annotations

from math import pi, radians

from tests.plant.effect import Effect
from tests.plant.robot import Joint, Robot


def _range(low: float, high: float, speed: float, acceleration: float) -> tuple[float, float, float, float]:
    return radians(low), radians(high), speed, acceleration


ROBOT = Robot(
    name="kr500_like",
    chain=(
        Joint(
            dh=(pi, 0.0, 0.0, -1.045),
            body=(56.3999, 0.0, -14.9999, 106.4, 0.0, 88.3996, 149.999, 0.0, 0.0, 599.999),
            range=_range(-185, 185, 1.2, 1.6),
            rotor=1047.82, viscous=8630.0, coulomb=936.0, offset=-153.0, stiffness=6.21e6,
            ratio="3755/8", constant=1.72, peak=30.0,
        ),
        Joint(
            dh=(pi / 2, 0.5, 0.0, 0.0),
            body=(130.856, -254.972, -55.5829, 616.703, -22.1942, 720.771, -31.7273, -3.98218, -4.1823, 133.775),
            range=_range(-130, 20, 1.1, 1.4),
            rotor=6087.98, viscous=8040.0, coulomb=1620.0, offset=-37.5, stiffness=6.66e6,
            ratio="3755/8", constant=1.72, peak=30.0,
        ),
        Joint(
            dh=(0.0, 1.3, pi / 2, 0.0),
            body=(3328.06, -61.669, 511.993, 3252.88, 373.275, 240.997, -19.6615, 198.81, 139.2, 430.62),
            range=_range(-94, 144, 1.0, 1.6),
            rotor=3880.0, viscous=9730.0, coulomb=1700.0, offset=-67.6, stiffness=3.91e6,
            ratio="76725/152", constant=1.33, peak=30.0,
        ),
        Joint(
            dh=(-pi / 2, -0.055, 0.0, -1.025),
            body=(58.0863, 5.33653, 3.97345, 72.3112, 5.82933, 19.7905, 0.649791, -16.0896, 107.563, 234.002),
            range=_range(-350, 350, 1.3, 2.5),
            rotor=267.0, viscous=1030.0, coulomb=182.0, offset=0.0, stiffness=2.69e5,
            ratio="-5473/21", constant=1.166, peak=15.0,
        ),
        Joint(
            dh=(pi / 2, 0.0, 0.0, 0.0),
            body=(52.3824, 1.67827, 22.184, 53.6153, -15.8569, 51.8692, -1.73301, -37.4951, -17.6196, 83.9357),
            range=_range(-118, 118, 1.2, 2.5),
            rotor=556.0, viscous=1660.0, coulomb=367.0, offset=36.3, stiffness=5.6e5,
            ratio="-44096/175", constant=1.166, peak=15.0,
        ),
        Joint(
            dh=(-pi / 2, 0.0, -pi / 2, -0.29),
            body=(8.5427, 0.787512, -0.168831, 1.12624, -0.696998, 7.78895, 1.18904, 4.90998, 6.40026, 45.0793),
            range=_range(-350, 350, 1.8, 3.5),
            rotor=217.0, viscous=795.0, coulomb=200.0, offset=10.1, stiffness=2.19e5,
            ratio="37851/230", constant=1.166, peak=15.0,
        ),
    ),
    # Elements of diag(ratios) (1 + L)^-1 with L54 = -7/1664, L64 = -64055/10497344, L65 = 230/37851.
    coupling=((5, 4, "-53/50"), (6, 4, "1"), (6, 5, "-1")),
    tool=0.0,
    own=(
        Effect("gas_isotherm", 2, 24500.0, {"d21": 0.9669, "d22": 0.2062, "phi": -1.6293, "l0": 0.5}),
    ),
    speed_loop=60.0,
    home=(0.0, radians(-70), radians(50), 0.0, radians(20), 0.0),
)  # fmt: skip
