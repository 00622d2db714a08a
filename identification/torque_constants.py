"""Torque constants of motors that press: what their currents do beside overcoming their own dry friction (eq. 75, 78).

A motor that stands may hold any torque within its friction, so only samples count in which it turns:
i = (tau + Fc s) / kt + c, s the direction in which it turns, c what weight and preload ask in a pose. Currents and
forces are both noisy, so the instrument is the motor's position, which follows the twist that the force makes.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from generator.words import numbered
from identification.arrays import Array
from identification.colour import scatter
from identification.residuals import Residual

#: Fewest samples an unknown.
_FEWEST = 3
#: Times what the file states, or part of it, from which another unit is likelier than another constant.
_FAR = 10.0
#: Part of torques times positions that friction must not be able to stand for.
_SEEN = 1e-3


@dataclass(frozen=True)
class Turning:
    """Samples of one motor in one pose in which it turns (N each): current ``i`` [A], torque ``tau`` that the force and
    the rotor ask of it [N m], both on the motor side, ``position`` in any unit, and ``direction`` (1 or -1).
    """

    i: Array
    tau: Array
    position: Array
    direction: Array


def doubts(found: Mapping[int, float], stated: Mapping[int, float], exchanged: str) -> list[str]:
    """What is to be told of torque constants ``found`` [N m/A], by motor's number, beside those that the robot's file
    has ``stated``: their signs, which all are another where something was ``exchanged``, in words, and their sizes.
    """
    negative = [number for number, one in found.items() if one < 0]
    if len(negative) > 1 and len(negative) == len(found):
        notes = [f"all torque constants come out negative: are {exchanged}?"]
    else:
        why = "its torque constant comes out negative; is the sign of its gear ratio right, and of its currents?"
        notes = [f"motor {number}: {why}" for number in negative]
    times = {number: abs(one / stated[number]) for number, one in found.items() if one and stated.get(number)}
    if far := {number: one for number, one in times.items() if not 1 / _FAR < one < _FAR}:
        sizes = dict.fromkeys(f"{one:.3g}" for one in (min(far.values()), max(far.values())))
        asked = "is what is known of the load in SI units, and are the currents in A?"
        notes.append(f"{numbered('motor', far)}: {' to '.join(sizes)} times the torque constant of the file; {asked}")
    return notes


def torque_constant(poses: Sequence[Turning]) -> tuple[float, float, Residual]:
    """kt [N m/A] with its standard deviation for residuals coloured as found, and what is left of the torques.

    Raises ValueError, with the reason, where friction and preload cannot be told from the force.
    """
    names = ("i", "tau", "position", "direction")
    i, tau, position, direction = (np.concatenate([getattr(one, name) for one in poses]) for name in names)
    preload = np.repeat(np.eye(len(poses)), [len(one.i) for one in poses], axis=0)
    preload = preload[:, preload.any(axis=0)]
    others = np.column_stack([direction, preload])
    if len(i) < _FEWEST * (1 + others.shape[1]):
        raise ValueError("the motor hardly turns between the steps")
    instrument, asked, given = (_without(x, others) for x in (position, tau, i))
    power = float(instrument @ asked)
    if abs(power) <= _SEEN * np.linalg.norm(_without(tau, preload)) * np.linalg.norm(_without(position, preload)):
        raise ValueError("its friction cannot be told from the force: steps up and down are needed")
    slope = float(instrument @ given) / power
    error = given - slope * asked
    ends = np.cumsum([len(one.i) for one in poses if len(one.i)])[:-1]
    kt = 1 / slope if slope else np.inf
    spread = scatter(np.split(instrument, ends), np.split(error, ends), 1 + others.shape[1])
    std = spread / abs(power) * kt**2
    size = float(np.linalg.norm(kt * _without(i, preload)))
    return kt, std, Residual(len(i), float(np.linalg.norm(kt * error)), size, size)


def _without(x: Array, columns: Array) -> Array:
    """``x`` (N) without what ``columns`` (N x p) can stand for."""
    result: Array = x - columns @ np.linalg.lstsq(columns, x, rcond=None)[0]
    return result
