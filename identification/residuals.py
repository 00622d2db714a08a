"""How much of the torques a set of parameters leaves unexplained, joint by joint and in total, in both norms."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from identification.arrays import Array
from identification.factors import Factor, added

#: Median of the size of normal noise, in parts of its rms.
MEDIAN_SIZE = 0.6745


def rms(x: Array) -> float:
    """Root mean square of numbers; 0 of none."""
    return float(np.sqrt(np.mean(np.square(x)))) if np.size(x) else 0.0


def _percent(part: float, whole: float) -> float:
    if not whole:
        return float("inf") if part else 0.0
    return 100 * part / whole


@dataclass(frozen=True)
class Residual:
    """Of ``rows`` rows: ``norm`` ||e||, that of the torques ||Y||, and their ``spread`` ||Y - mean(Y)|| [N m, N].

    In total the spread is about each joint's own mean.
    """

    rows: int
    norm: float
    torque: float
    spread: float

    @classmethod
    def of(cls, e: Array, y: Array) -> Residual:
        """Of errors ``e`` and torques ``y`` (N each) [N m, N]."""
        spread = y - y.mean() if len(y) else y
        return cls(len(y), *(float(np.linalg.norm(x)) for x in (e, y, spread)))

    @classmethod
    def total(cls, some: Iterable[Residual]) -> Residual:
        """Of several together: roots of the sums of squares."""
        each = list(some)
        norm, torque, spread = (
            float(np.linalg.norm([getattr(one, name) for one in each])) for name in ("norm", "torque", "spread")
        )
        return cls(sum(one.rows for one in each), norm, torque, spread)

    @property
    def rms(self) -> float:
        """Root mean square of the errors [N m, N]."""
        return self.norm / float(np.sqrt(max(self.rows, 1)))

    @property
    def relative(self) -> float:
        """||e|| / ||Y|| in %; infinite where there is no torque."""
        return _percent(self.norm, self.torque)

    @property
    def relative_to_mean(self) -> float:
        """||e|| / ||Y - mean(Y)|| in %; infinite where the torque is constant."""
        return _percent(self.norm, self.spread)


@dataclass(frozen=True)
class Residuals:
    """Of several runs together: by joint (coordinates from 0) and in total."""

    per_joint: Mapping[int, Residual]

    @property
    def total(self) -> Residual:
        """All joints."""
        return Residual.total(self.per_joint.values())

    def by_joint(self, digits: str = ".1f") -> str:
        """||e|| / ||Y - mean(Y)|| in % of one joint after the other, ``-`` for one without rows."""
        each = (one for _, one in sorted(self.per_joint.items()))
        return " ".join(f"{one.relative_to_mean:{digits}}" if one.rows else "-" for one in each)


def residuals(factors: Sequence[Factor], values: Mapping[str, float]) -> Residuals:
    """What ``values`` of all parameters leave of the rows behind ``factors``."""
    each = {one.joint: Residual(one.rows, one.residual(values), one.norm, one.spread) for one in added(factors)}
    return Residuals(each)
