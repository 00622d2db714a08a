"""A compiled library with its robot, as the harness loads it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from benchmarks.peers.subject import FUNCTIONS, Array, Chain

#: Where the sources that the libraries share are.
SOURCES = Path(__file__).parent


@dataclass(frozen=True)
class Library:
    """``peer`` is what the tables call it, ``built`` tells its builds apart; ``path`` exports ``functions`` (peer.h).

    ``data`` is the file that its ``peer_load`` reads. Matrices come by columns if ``by_columns``; the regressor's
    columns are those of the bodies' standard parameters if ``standard``, of the base parameters otherwise. ``whole`` is
    the robot with all its effects, which no other library models.
    """

    peer: str
    built: str
    path: Path
    data: Path
    functions: Sequence[str] = FUNCTIONS
    by_columns: bool = False
    standard: bool = False
    whole: bool = False

    def size(self, function: str, subject: Chain) -> int:
        """Numbers that a function returns."""
        return int(np.prod(self._shape(function, subject)))

    def results(self, function: str, subject: Chain, outputs: Array) -> Array:
        """Outputs (states x size) as arrays (states x shape)."""
        shape = self._shape(function, subject)
        if self.by_columns and len(shape) == 2:
            return outputs.reshape(-1, *reversed(shape)).transpose(0, 2, 1)
        return outputs.reshape(-1, *shape)

    def _shape(self, function: str, subject: Chain) -> tuple[int, ...]:
        columns = {
            "inertia_matrix": (subject.dof,),
            "regressor": (len(subject.standard if self.standard else subject.base),),
        }
        return (subject.dof, *columns.get(function, ()))
