"""What no record tells: how the states inside effects began, bristles deflected and hystereses built up."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping

import numpy as np

from generator.effects.library import effects_of
from identification.arrays import Array
from identification.diagnosis.columns.effect_columns import NEEDS, EffectColumns
from identification.diagnosis.runs.scene import Scene
from identification.diagnosis.search.loop import Search

#: What an effect's columns hold of its beginning.
_Begun = Callable[[Scene, Mapping[str, float]], Array]


def beginnings(found: Search, weights: Mapping[int, float]) -> list[list[Array]]:
    """What values of columns by number make of it, of findings and of the file's effects: of each run, of each joint,
    the white kept rows (m).
    """
    bank = found.bank
    torques = [np.zeros(scene.motion.q.shape) for scene in bank.scenes]
    for columns, begun, shape in _effects(found):
        values = {p: weights.get(column, 0.0) for p, column in columns.items()}
        if any(values.values()):
            for torque, scene in zip(torques, bank.scenes, strict=True):
                each = begun(scene, shape)
                torque += sum(value * each[p] for p, value in values.items())
    return [
        [np.asarray(bank.whitened(r, k, row[None])[0]) for k, row in enumerate(bank.runs[r].decimated(torque))]
        for r, torque in enumerate(torques)
    ]


def _effects(found: Search) -> Iterator[tuple[dict[int, int], _Begun, Mapping[str, float]]]:
    """Effects with a state: numbers of the columns by parameter, what they hold of the beginning, and the shape."""
    base, robot = found.bank.base, found.bank.robot
    for variant in found.variants:
        if variant.hypothesis.of_beginning is not None:
            yield dict(zip(variant.used, variant.columns, strict=True)), variant.hypothesis.of_beginning, variant.shape
    for stated in effects_of(robot):
        if stated.effect.states and set(stated.effect.needs) <= NEEDS:
            columns = EffectColumns(stated.effect, stated.joint, robot.numbers.index(stated.joint.number), robot)
            shape = {name: float(value) for name, value in stated.site.values.items()}
            places = {p: base.index(name) for p, name in enumerate(stated.names) if name in base}
            yield places, columns.of_beginning, shape
