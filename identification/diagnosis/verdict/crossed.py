"""Joints whose friction follows two variables at once: their speed and place, or their direction and another's place.

Along runs that do not repeat no map of one variable takes it out of the noise.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from identification.arrays import Array
from identification.diagnosis.columns.bank import Bank
from identification.diagnosis.columns.maps import span_of
from identification.diagnosis.search.loop import Search
from identification.diagnosis.verdict.f_test import f_test
from identification.diagnosis.verdict.lack_of_fit import CHANCE

#: Part of the residual's squares that it must be: a fifth of the noise's rms, below which nothing is told of a joint.
_LEAST = 0.04
#: Powers of a place, from -1 to 1 along its range: a slope, a middle that differs from both ends, and one end alone.
_POWERS = (1, 2, 3)


@dataclass(frozen=True)
class Crossed:
    """What friction ``follows``, in words, and the ``part`` of the residual's squares that it is."""

    follows: str
    part: float


def crossed(found: Search, weights: Mapping[int, float]) -> dict[int, Crossed]:
    """By coordinate, the friction of two variables of runs that do not repeat with values of columns by number, the
    largest, where it is no chance.
    """
    bank, result = found.bank, {}
    for k in range(bank.dof if bank.alone else 0):
        e = np.concatenate([bank.residual(r, k, weights) for r in bank.alone])
        _, fitted = bank.counts(k)
        tried = [(f_test(X, e, fitted), follows) for X, follows in _columns(bank, k)]
        told = [Crossed(follows, one.part) for one, follows in tried if len(tried) * one.p < CHANCE]
        largest = max(told, key=lambda one: one.part, default=None)
        if largest is not None and largest.part > _LEAST:
            result[k] = largest
    return result


def _columns(bank: Bank, k: int) -> Iterator[tuple[Array, str]]:
    """White kept rows (m x N) of friction on coordinate k, and what it follows; a joint that is held has no place."""
    scenes = [bank.scenes[r] for r in bank.alone]
    for j, number in enumerate(bank.robot.numbers):
        if not any(bank.runs[r].kept[j].any() for r in bank.alone):
            continue
        lower, upper = span_of([scene.motion.q[j] for scene in scenes])
        parts = []
        for r in bank.alone:
            motion = bank.scenes[r].motion
            place = (2 * motion.q[j] - lower - upper) / (upper - lower)
            friction = motion.qd[k] if j == k else np.sign(motion.qd[k])
            rows = bank.runs[r].decimated(np.stack([friction * place**power for power in _POWERS]))
            parts.append(bank.whitened(r, k, rows))
        follows = "its speed by its place" if j == k else f"its direction by the place of joint {number}"
        yield np.concatenate(parts, axis=1), follows
