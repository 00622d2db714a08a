"""A robot of the simulation: plain numbers, SI units, joints from 0 in arrays."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from tests.plant.effect import Effect

Array = NDArray[np.float64]

#: Order of a body's ten numbers: inertia about the frame's origin, first moments, mass.
BODY = ("XX", "XY", "XZ", "YY", "YZ", "ZZ", "MX", "MY", "MZ", "M")


@dataclass(frozen=True)
class Joint:
    """One joint, its body and its drive.

    ``dh`` is (alpha, d, theta, r) of modified Denavit-Hartenberg at q = 0. ``range`` are limits of q, then the
    largest speed and acceleration. ``rotor``, ``viscous``, ``coulomb``, ``offset`` are on the joint side.
    ``stiffness`` is that of the drive train, where an effect makes it elastic. ``ratio`` is text: a fraction.
    ``peak`` is the largest current [A].
    """

    dh: tuple[float, float, float, float]
    body: tuple[float, ...]
    range: tuple[float, float, float, float]
    rotor: float
    viscous: float
    coulomb: float
    stiffness: float
    ratio: str
    constant: float
    peak: float
    offset: float = 0.0
    prismatic: bool = False


@dataclass(frozen=True)
class Robot:
    """Joints in order; ``coupling`` are elements (motor, joint, text of a fraction), from 1, of the matrix of ratios
    off its diagonal.

    ``tool`` is the distance of the tool along z of the last frame. ``base`` is roll, pitch, yaw of frame 0. ``own``
    are effects that the robot has besides rotor inertia, viscous and Coulomb friction and offset: a balancer, a
    wrist's coupling. ``speed_loop`` is the bandwidth [rad/s] of its speed controllers.
    """

    name: str
    chain: tuple[Joint, ...]
    coupling: tuple[tuple[int, int, str], ...] = ()
    tool: float = 0.1
    base: tuple[float, float, float] = (0.0, 0.0, 0.0)
    own: tuple[Effect, ...] = ()
    speed_loop: float = 100.0
    encoder_bits: int = 20
    home: tuple[float, ...] = field(default=())

    @property
    def joints(self) -> int:
        """n."""
        return len(self.chain)

    def column(self, name: str) -> Array:
        """A number of each joint (n)."""
        return np.array([getattr(joint, name) for joint in self.chain], dtype=float)

    @cached_property
    def ratios(self) -> Array:
        """Motor angles = ratios @ joint angles (n x n)."""
        N = np.diag([fraction(joint.ratio) for joint in self.chain])
        for motor, joint, text in self.coupling:
            N[motor - 1, joint - 1] = fraction(text)
        return N

    @property
    def base_rotation(self) -> Array:
        """Axes of frame 0 in the world (3 x 3): Rz(yaw) Ry(pitch) Rx(roll)."""
        return rotation(*self.base)

    @property
    def centre(self) -> Array:
        """Where the arm moves about (n)."""
        low, high = np.array([joint.range[:2] for joint in self.chain]).T
        return np.array(self.home if self.home else 0.5 * (low + high), dtype=float)


def fraction(text: str) -> float:
    """A number, or numerator/denominator."""
    above, _, below = text.partition("/")
    return float(above) / float(below or "1")


def rotation(roll: float, pitch: float, yaw: float) -> Array:
    """Turned about the world's x, then y, then z (3 x 3)."""
    (a, b, c), (d, e, f) = np.cos([roll, pitch, yaw]), np.sin([roll, pitch, yaw])
    about_x = np.array([[1, 0, 0], [0, a, -d], [0, d, a]])
    about_y = np.array([[b, 0, e], [0, 1, 0], [-e, 0, b]])
    about_z = np.array([[c, -f, 0], [f, c, 0], [0, 0, 1]])
    return np.asarray(about_z @ about_y @ about_x)


def bar(
    mass: float, start: tuple[float, float, float], end: tuple[float, float, float], radius: float
) -> tuple[float, ...]:
    """Ten numbers, in the order of BODY, of a solid round bar between two points of its frame."""
    a, b = np.array(start), np.array(end)
    length, centre = float(np.linalg.norm(b - a)), (a + b) / 2
    u = (b - a) / length
    along, across = mass * radius**2 / 2, mass * (3 * radius**2 + length**2) / 12
    I = across * np.eye(3) + (along - across) * np.outer(u, u)  # noqa: E741
    I = I + mass * (centre @ centre * np.eye(3) - np.outer(centre, centre))  # noqa: E741
    return (I[0, 0], I[0, 1], I[0, 2], I[1, 1], I[1, 2], I[2, 2], *(mass * centre), mass)
