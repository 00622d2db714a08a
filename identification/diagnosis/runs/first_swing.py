"""How a link swings when a log begins: what is left of the torque tells it, while that swing dies out.

A robot that stood hangs still on its drive trains. One whose log begins as it moves, or is let go, swings by itself at
first; a swing that is damped little lasts for seconds.
"""

from __future__ import annotations

import numpy as np

from identification.arrays import Array
from identification.diagnosis.runs.link_side import LinkSide, Train
from identification.diagnosis.runs.scene import Scene
from identification.diagnosis.runs.swings import Rows

#: The least F, of its two values beside what is left, at which another start is told: noise that stays for a time
#: makes some ten.
_SURE = 50.0


class FirstSwings:
    """Those along several scenes, of which the rows are found once."""

    def __init__(self) -> None:
        self._rows: dict[int, tuple[Scene, Rows]] = {}

    def torque(self, side: LinkSide, train: Train) -> Array:
        """Change of the motors' torques (n x N) as the link of a ``side`` swings on a ``train`` without a gap, from the
        start that the torque tells, if it tells another than hanging still.
        """
        hanging = side.torque_per(side.deflection(train))
        free = np.stack([side.torque_per(side.free(train, start)) for start in ((1.0, 0.0), (0.0, 1.0))])
        # A drive train too stiff for the samples runs away.
        if not (np.all(np.isfinite(hanging)) and np.all(np.isfinite(free))):
            return hanging
        rows = self._along(side)
        left = rows.left - rows.seen(hanging[side.k, : rows.samples])
        columns = rows.seen(free[:, side.k, : rows.samples])
        with np.errstate(over="ignore"):
            size = np.linalg.norm(columns, axis=1)
        if not np.all(np.isfinite(size) & (size > 0)):
            return hanging
        start = np.linalg.lstsq((columns / size[:, None]).T, left, rcond=None)[0] / size
        after = left - start @ columns
        told = left @ left - after @ after > _SURE * 2 * (after @ after) / left.size
        return hanging + np.tensordot(start, free, 1) if told else hanging

    def _along(self, side: LinkSide) -> Rows:
        made = self._rows.get(id(side.scene))
        if made is None:
            # A scene that is kept keeps its identity.
            made = self._rows[id(side.scene)] = side.scene, Rows(side, 1)
        return made[1]
