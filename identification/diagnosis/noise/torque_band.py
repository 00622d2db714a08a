"""Where the band of the recorded torques ends, which the torques that the positions ask for go beyond.

Torques that were filtered lack what is quick, and coarse positions ask for accelerations that never were. A link on a
spring or in a gap follows as a filter does: either would be taken for it.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from identification.arrays import Array
from identification.diagnosis.columns.whitening import ORDER, alike, colour, stretches
from identification.diagnosis.noise import rounding
from identification.diagnosis.runs.position_noise import drawn, torque_of
from identification.diagnosis.runs.prepared import RATE, windowed
from identification.diagnosis.runs.scene import Scene

#: Frequencies that are looked at, up to half the rate of the rows.
_FREQUENCIES = 50
#: Power of a torque, in parts of the model's, below which half of the amplitude is missing.
_SHORT = 0.25
#: Times as much as the errors of the positions make that they are taken to make: it is not known closely.
_ERRORS = 2.0
#: Part of the mean power density that is none, as of the spectra of what never was recorded.
_NOTHING = 1e-9
#: Part of the joints that lack it at one frequency: above the band noise may hide it on one of them.
_MOST = 0.75
#: Least joints of which most are not one or two that swing; and of fewer, the power at the rows' highest frequencies
#: that a rotor makes by itself.
_SEVERAL, _ROTOR = 3, 0.05
#: Power, in parts of that of the slowest, that no filter makes on any joint, but a link as it swings.
_LIFTED = 2.0


def end(scenes: Sequence[Scene]) -> float:
    """The frequency [Hz] at which most joints' torques are no longer those of the positions; infinite where there is
    none within the rows' band.

    A drive train that swings lacks torque about a frequency of its own, below which it has more than a stiff one, and
    beyond it has its rotor's alone. That is of one joint; a log's filter and its steps are of all, and leave less than
    a rotor of what is quick.
    """
    rate = min(_rate(scene) for scene in scenes)
    # A colour tells no lower ones apart.
    frequency = np.linspace(rate / 2 / ORDER, rate / 2, _FREQUENCIES)
    errors = [_of_positions(scene, number) for number, scene in enumerate(scenes)]
    moving = [k for k in range(len(scenes[0].tau)) if any(_kept(scene, k).any() for scene in scenes)]
    if not moving:
        return np.inf
    each = [_power(scenes, errors, k, frequency) for k in moving]
    power = np.quantile(each, _MOST, axis=0, method="inverted_cdf")
    short = power < _SHORT
    if len(moving) < _SEVERAL:
        lifted = any(one.max() > _LIFTED * one[0] for one in each)
        short = np.logical_and.accumulate(short[::-1])[::-1] & (power[-1] < _ROTOR) & ~lifted
    return float(frequency[np.argmax(short)]) if short.any() else np.inf


def notes(scenes: Sequence[Scene]) -> list[str]:
    """What is to be told where the band ends."""
    frequency = end(scenes)
    if np.isinf(frequency):
        return []
    return [
        f"from about {frequency:.0f} Hz on the recorded torques are far less than the recorded positions ask for: "
        "torques were filtered, positions are coarse, or one link that swings moves all joints; elasticity and "
        "backlash of drive trains are not looked for"
    ]


def _factor(scene: Scene) -> int:
    """Samples a row, as in a diagnosis; whatever divides a period."""
    return max(round(scene.sampled.run.rate / RATE), 1)


def _rate(scene: Scene) -> float:
    """Rows a second."""
    return scene.sampled.run.rate / _factor(scene)


def _kept(scene: Scene, k: int) -> NDArray[np.bool_]:
    """Rows (N) of a joint in which it moves. Reversals are left out, as in the rows: a model's friction jumps there,
    and a real one need not.
    """
    return np.asarray(windowed(scene.sampled.left_out[k].astype(float), _factor(scene)) == 0)


def _of_positions(scene: Scene, number: int) -> Array:
    """Torques (n x N) [N m, N] as errors of the positions make them, by draw ``number``."""
    noise = rounding.errors(scene.sampled.run, scene.robot)
    return torque_of(drawn(scene, noise, number), scene)


def _power(scenes: Sequence[Scene], errors: Sequence[Array], k: int, frequency: Array) -> Array:
    """The power density of a joint's recorded torque in parts of that by the model and what was found beside it, where
    the joint moves.
    """
    recorded = _density(scenes, [scene.tau[k] for scene in scenes], k, frequency)
    asked = _density(scenes, [scene.torque[k] for scene in scenes], k, frequency)
    noise = _density(scenes, [error[k] for error in errors], k, frequency)
    nothing = _NOTHING * asked.mean()
    # Accelerations that positions have by their errors alone no torque needs to make.
    return np.asarray((recorded + nothing) / (np.maximum(asked - _ERRORS * noise, 0.0) + nothing))


def _density(scenes: Sequence[Scene], signals: Sequence[Array], k: int, frequency: Array) -> Array:
    """The power density of signals of joint k, one a run, in the mean over its rows: runs alike have one colour."""
    total, rows = np.zeros_like(frequency), 0
    for of_rate in alike([(_rate(scene), _factor(scene)) for scene in scenes]):
        parts: list[Array] = []
        for r in of_rate:
            parts += stretches(windowed(signals[r], _factor(scenes[r])), _kept(scenes[r], k))
        count = sum(map(len, parts))
        total += count * colour(parts).spectrum(frequency, _rate(scenes[of_rate[0]]))
        rows += count
    return total / max(rows, 1)
