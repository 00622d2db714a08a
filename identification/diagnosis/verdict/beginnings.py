"""What no record tells: how the states inside effects began, bristles deflected and hystereses built up."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from generator.effects.library import effects_of
from identification.arrays import Array
from identification.diagnosis.columns.effect_columns import NEEDS, EffectColumns
from identification.diagnosis.search.loop import Search


def beginnings(found: Search, r: int, weights: Mapping[int, float]) -> list[Array]:
    """What values of columns by number make of it along a run, of findings and of the file's effects: of each joint the
    white kept rows (m).
    """
    bank = found.bank
    run, numbers = bank.runs[r], bank.robot.numbers
    torque = np.zeros((len(numbers), bank.scenes[r].motion.samples))
    for column, begun in _columns(found, r):
        torque += weights.get(column, 0.0) * begun
    rows = run.decimated(torque)
    return [np.asarray(bank.whitened(r, k, rows[k][None])[0]) for k in range(len(numbers))]


def _columns(found: Search, r: int) -> Iterator[tuple[int, Array]]:
    """Numbers of columns, with what each holds of it (n x N) at the recorded rate."""
    bank = found.bank
    scene, robot = bank.scenes[r], bank.robot
    for variant in found.variants:
        if variant.hypothesis.of_beginning is not None:
            begun = variant.hypothesis.of_beginning(scene, variant.shape)
            yield from zip(variant.columns, begun[list(variant.used)], strict=True)
    for stated in effects_of(robot):
        if stated.effect.states and set(stated.effect.needs) <= NEEDS:
            columns = EffectColumns(stated.effect, stated.joint, robot.numbers.index(stated.joint.number), robot)
            shape = {name: float(value) for name, value in stated.site.values.items()}
            for name, begun in zip(stated.names, columns.of_beginning(scene, shape), strict=True):
                if name in bank.base:
                    yield bank.base.index(name), begun
