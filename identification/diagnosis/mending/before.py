"""The model as it stood, on the runs that test it and the new one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from identification.diagnosis.runs.played import Played, Player, aligned, play
from identification.diagnosis.runs.prepared import Prepared


class Before:
    """The old model on ``runs``, with ``values`` [SI] of base parameters by name, and instead of these those of
    ``beside`` and of the file's elastic drive trains where a model plays with swings.
    """

    def __init__(
        self, runs: Sequence[Prepared], player: Player, values: Mapping[str, float], beside: Mapping[str, float]
    ) -> None:
        self.runs, self._player = runs, player
        self._values = {False: values, True: {**values, **beside}}
        self._played: dict[bool, list[Played]] = {}

    def and_after(self, after: Sequence[Played], swings: bool) -> tuple[tuple[Played, ...], tuple[Played, ...]]:
        """The runs as the old model plays them, with ``swings`` or without, and as the new one did (``after``), over
        the rows that both have.
        """
        if swings not in self._played:
            self._played[swings] = [play(one, self._player, self._values[swings]) for one in self.runs]
        before, now = zip(*map(aligned, self._played[swings], after), strict=True)
        return before, now
