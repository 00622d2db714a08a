"""Recordings of real robots, where they are at hand."""

from __future__ import annotations

from tests.at_hand import RECORDINGS

#: Of a KR300, a heavy arm with a gas balancer.
A, B = "kr300_r2500/A.csv", "kr300_r2500/B.csv"
#: Of a TX40, two axes of whose wrist are coupled.
TRAIN, TEST = "tx40/run.csv@3.6:9", "tx40/run.csv@0:3.6"


def data(*names: str) -> list[str]:
    return [f"{RECORDINGS.path}/{name}" for name in names]
