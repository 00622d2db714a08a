"""Positions in steps so coarse that a drive which trembles over them makes torques of its own.

The link moves by less than a step, so that no position shows it, and where the loop has no noise of its own it does so
in every period alike: what is left looks like something that the model lacks.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import sqrt

import numpy as np

from generator.words import listed, numbered
from identification.diagnosis.noise.noise_floor import noise_floor
from identification.diagnosis.noise.rounding import deviations, rounding
from identification.diagnosis.search.loop import Search
from identification.residuals import rms

#: Part of the noise that the steps of positions make, from which a drive may tremble by as much as the noise; in these
#: parts a drive trembles at most.
_COARSE = 0.1


def notes(found: Search, lacks: Mapping[int, float]) -> list[str]:
    """What is to be told of joints (numbers) that keep something unexplained, as large as in ``lacks`` in parts of the
    noise's rms, if their positions are so coarse that a drive may make it.
    """
    bank = found.bank
    repeating = [(run, scene) for run, scene in zip(bank.runs, bank.scenes, strict=True) if run.times]
    if not repeating:
        return []
    steps = sqrt(12) * np.max([deviations(run.sampled.run, bank.robot) for run, _ in repeating], axis=0)
    coarse = []
    for k, joint in enumerate(bank.robot.moving):
        if joint.number in lacks:
            torques = [rounding(run, scene)[k] / sqrt(run.times) for run, scene in repeating]
            part = rms(np.concatenate(torques)) / noise_floor(bank, k, repeating[0][0].rate)
            if part > _COARSE * max(1.0, lacks[joint.number]):
                coarse.append(f"{part:.2g} of the noise on joint {joint.number}")
    if not coarse:
        return []
    alike: dict[str, list[int]] = {}
    for step, joint in zip(steps.tolist(), bank.robot.moving, strict=True):
        if step:
            alike.setdefault(f"{step:.2g} {joint.position_unit}", []).append(joint.number)
    told = [f"{step} on {numbered('joint', numbers)}" for step, numbers in alike.items()]
    return [
        f"positions come in steps, {listed(told)}, whose rounding alone makes torques, {listed(coarse)}; drives that "
        "tremble over them make larger ones, which repeat with the motion and look like something missing"
    ]
