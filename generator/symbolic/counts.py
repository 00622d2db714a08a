"""How many operations a piece of program takes."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import asdict, dataclass

_KINDS = {"mul": "mul", "add": "add", "sub": "add", "div": "div", "sin": "trig", "cos": "trig"}
_FREE = ("constant", "input", "neg")
#: What the kinds of operation are called, in the order of ``Count.as_dict``.
HEADS = ("mul", "add", "div", "sin/cos", "other")


@dataclass(frozen=True)
class Count:
    """Operations of a piece of program: ``div`` counts quotients, ``trig`` sines and cosines, ``other`` the rest."""

    mul: int = 0
    add: int = 0
    div: int = 0
    trig: int = 0
    other: int = 0

    @classmethod
    def of(cls, operations: Iterable[str]) -> Count:
        """The count of nodes' operations; constants, inputs and signs are free."""
        return cls(**Counter(_KINDS.get(one, "other") for one in operations if one not in _FREE))

    @property
    def total(self) -> int:
        """Multiplications, additions and divisions: the measure that the literature compares."""
        return self.mul + self.add + self.div

    def as_dict(self) -> dict[str, int]:
        """Numbers of operations by kind: mul, add, div, trig, other, in this order."""
        return asdict(self)
