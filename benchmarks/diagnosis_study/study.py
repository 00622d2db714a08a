"""What the study consists of, read from ``study.json``: laws with what counts as their name, robots, cells, seeds."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

FILE = Path(__file__).with_name("study.json")


@dataclass(frozen=True)
class Expected:
    """For a law of the plant: ``named`` are the ids that are right; ``variables`` what it shows in; ``joints`` by
    robot, from 1, where not all; ``anywhere`` where it has no joint of its own; ``parameter`` of the finding and the
    factor from the law's size to it, where it has one; with ``share`` what was recorded is 1 + the parameter of what
    was true, and what was true is 1 + the size of what was recorded.
    """

    named: tuple[str, ...]
    variables: tuple[str, ...] = ()
    joints: Mapping[str, tuple[int, ...]] | None = None
    anywhere: bool = False
    parameter: str = ""
    factor: float = 1.0
    share: bool = False

    def value(self, size: float) -> float:
        """Of the parameter, for a size of the law."""
        return 1 / (1 + size) - 1 if self.share else self.factor * size


@dataclass(frozen=True)
class Study:
    """``laws`` by name; ``outside`` laws must not be named; ``reserved`` laws are in no test of the development;
    ``pairs`` hide each other; ``power`` are the laws of the power curve; ``beside`` those that a robot may have and its
    file know.
    """

    seed: int
    robots: tuple[str, ...]
    laws: Mapping[str, Expected]
    outside: tuple[str, ...]
    reserved: tuple[str, ...]
    pairs: tuple[tuple[str, str], ...]
    power: tuple[str, ...]
    beside: tuple[str, ...]


def _expected(record: Mapping[str, Any]) -> Expected:
    joints = record.get("joints")
    return Expected(
        named=tuple(record["named"]),
        variables=tuple(record.get("variables", ())),
        joints=None if joints is None else {robot: tuple(at) for robot, at in joints.items()},
        anywhere=record.get("anywhere", False),
        parameter=record.get("parameter", ""),
        factor=record.get("factor", 1.0),
        share=record.get("share", False),
    )


def _read() -> Study:
    record = json.loads(FILE.read_text(encoding="utf-8"))
    return Study(
        seed=record["seed"],
        robots=tuple(record["robots"]),
        laws={name: _expected(one) for name, one in record["laws"].items()},
        outside=tuple(record["outside"]),
        reserved=tuple(record["reserved"]),
        pairs=tuple((first, second) for first, second in record["pairs"]),
        power=tuple(record["power"]),
        beside=tuple(record["beside"]),
    )


STUDY = _read()
