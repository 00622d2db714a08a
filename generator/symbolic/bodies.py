"""Inertial parameters of a body as nodes, and how they look from another frame."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from generator.robot.parameters import INERTIAL_STEMS
from generator.symbolic.statements import Node, Program
from generator.symbolic.vectors import Array, array


@dataclass(frozen=True)
class Body:
    """A body seen from a frame: ``inertia`` J (3 x 3) about its origin, first ``moment`` MS (3), ``mass`` M."""

    inertia: Array
    moment: Array
    mass: Node

    def __add__(self, other: Body) -> Body:
        return Body(self.inertia + other.inertia, self.moment + other.moment, self.mass + other.mass)


def body(program: Program, values: Mapping[str, Node]) -> Body:
    """The body of the parameters ``values`` ("XX" ... "M"); those that are absent are zero."""
    xx, xy, xz, yy, yz, zz, mx, my, mz, m = (values.get(name, program.zero) for name in INERTIAL_STEMS)
    inertia = array(program, [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    return Body(inertia, array(program, [mx, my, mz]), m)


def bodies(program: Program, values: Mapping[str, Node], numbers: list[int]) -> dict[int, Body]:
    """The bodies of the numbered frames from parameters named ``XX1`` ... ``M1``."""
    given = {j: {name: values[f"{name}{j}"] for name in INERTIAL_STEMS if f"{name}{j}" in values} for j in numbers}
    return {j: body(program, own) for j, own in given.items()}


def seen_from_antecedent(moved: Body, rotation: Array, position: Array) -> Body:
    """The same matter seen from the antecedent's frame (Huygens with first moments: Gautier and Khalil 1990)."""
    moment = rotation @ moved.moment
    inertia = rotation @ moved.inertia @ rotation.T
    twice = 2 * (position @ moment) + moved.mass * (position @ position)
    arm = moment + moved.mass * position
    shifted = np.empty((3, 3), dtype=object)
    for i in range(3):
        for k in range(i, 3):
            entry = inertia[i, k] - position[i] * moment[k] - arm[i] * position[k]
            shifted[i, k] = shifted[k, i] = entry + twice if i == k else entry
    return Body(shifted, arm, moved.mass)
