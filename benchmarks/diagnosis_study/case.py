"""What a case is: a robot, what is hidden in it, how it moves and what is known of it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

#: The two modes, as ``diagnosis.json`` names them.
FREE, KNOWN = "free_fit", "known_parameters"


@dataclass(frozen=True)
class Hidden:
    """A law of the plant on a joint (from 1); ``size`` is in multiples of the noise, None for the law's typical one."""

    law: str
    joint: int
    size: float | None = None
    other: int | None = None


@dataclass(frozen=True)
class Case:
    """``cell`` is the part of the study that the case counts in; ``motion`` a key of ``runs.MOTIONS``.

    ``beside`` are more effects of the robot, which its file holds by the textbook's law.
    """

    cell: str
    robot: str
    mode: str
    seed: int
    hidden: tuple[Hidden, ...] = ()
    motion: str = "fourier"
    beside: tuple[Hidden, ...] = ()

    @property
    def name(self) -> str:
        """Of its files."""
        what = "_".join(f"{one.law}{one.joint}" for one in self.hidden) or "nothing"
        return f"{self.cell}-{self.mode}-{self.robot}-{what}-{self.seed}"

    def record(self) -> dict[str, Any]:
        """For JSON."""
        return asdict(self)


def case(record: Mapping[str, Any]) -> Case:
    """The case of a record."""
    effects = {key: tuple(Hidden(**one) for one in record[key]) for key in ("hidden", "beside")}
    return Case(**{**record, **effects})
