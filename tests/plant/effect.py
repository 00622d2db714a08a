"""A law at work: on which joint of the robot, how large, with which values."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from tests.plant.law import Law, value_of
from tests.plant.library import LAWS
from tests.plant.robot import Robot


@dataclass(frozen=True)
class Effect:
    """``joint`` and ``other`` count from 1; ``size`` None is the law's typical one; ``values`` replace the law's own.

    ``weights`` (n) make a torque act on a sum of joints: on the speed weights . qd, and back along the same weights.
    """

    law: str
    joint: int = 1
    size: float | None = None
    values: Mapping[str, float] = field(default_factory=dict)
    other: int | None = None
    weights: tuple[float, ...] | None = None

    def __post_init__(self) -> None:
        """Raises ValueError for a law or a value that does not exist."""
        if self.law not in LAWS:
            raise ValueError(f"no law {self.law}")
        unknown = set(self.values) - set(LAWS[self.law].values)
        if unknown:
            raise ValueError(f"{self.law} has no {', '.join(sorted(unknown))}")

    @property
    def what(self) -> Law:
        """The law."""
        return LAWS[self.law]

    def amount(self, robot: Robot) -> float:
        """The size, in the law's unit."""
        return value_of(self.what.typical, robot, self.joint - 1) if self.size is None else self.size

    def value(self, name: str, robot: Robot) -> float:
        """A value, in SI units."""
        return value_of(self.values.get(name, self.what.values[name]), robot, self.joint - 1)

    def all_values(self, robot: Robot) -> list[float]:
        """Values in the law's order."""
        return [self.value(name, robot) for name in self.what.values]

    def along(self, robot: Robot) -> NDArray[np.float64]:
        """Weights (n) of the joints; a wrist's rotor without coupling turns with its joint and the one before."""
        if self.weights is not None:
            return np.array(self.weights, dtype=float)
        j = self.joint - 1
        unit: NDArray[np.float64] = np.eye(robot.joints)
        row = robot.ratios[j] / robot.ratios[j, j]
        if self.what.of_rotor:
            return np.asarray(row if np.count_nonzero(row) > 1 else unit[j] + unit[j - 1])
        return np.asarray(row if self.what.of_motor else unit[j])

    def record(self, robot: Robot) -> dict[str, object]:
        """What it is on a robot, for a study's own books."""
        return {
            "law": self.law,
            "joint": self.joint,
            "along": self.along(robot).tolist(),
            "size": self.amount(robot),
            "unit": self.what.unit,
            "values": dict(zip(self.what.values, self.all_values(robot), strict=True)),
        }

    def sized(self, size: float) -> Effect:
        """The same effect, of another size."""
        return replace(self, size=size)
