"""What no effect of the library has, along runs that do not repeat, where noise could hide it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from identification.diagnosis.diagnosis import NOTHING, UNEXPLAINED, Diagnosis
from tests.diagnosis.diagnosed_arm import Hidden, diagnosis_of, recorded
from tests.recorded import Array

#: A slide that knows no drive.
SLIDE = """\
name: slide
gravity: [0 m/s2, 0 m/s2, -9.81 m/s2]
joints:
  - {j: 1, sigma: 1, alpha: pi/2, d: 0, theta: 0, r: q1, limits: [-0.3 m, 0.3 m]}
effects:
  - {effect: viscous_friction, joint: 1}
  - {effect: coulomb_friction, joint: 1}
  - {effect: offset, joint: 1}
"""
TRUTH = {"M1": 30.0, "Fv1": 14.0, "Fc1": 9.0, "Off1": 1.5}
#: Seconds of a run, less than a period of its slowest sine [Hz]; length of a ripple [m].
SECONDS, SLOWEST, LENGTH = 20.0, 0.045, 0.0113


def diagnosis(folder: Path, hidden: Hidden) -> Diagnosis:
    regressors, sources = recorded(folder, [hidden] * 3, SLIDE, TRUTH, seconds=SECONDS, rate=250.0, slowest=SLOWEST)
    return diagnosis_of(sources, regressors)


def ripple(q: Array, qd: Array) -> Array:
    return np.asarray(np.sin(2 * np.pi * q / LENGTH + 0.4))


def sticky_end(q: Array, qd: Array) -> Array:
    return np.asarray(3000.0 * qd * q)


def nothing(q: Array, qd: Array) -> Array:
    return np.zeros_like(q)


def test_a_ripple_of_no_effect_is_told_with_its_length(tmp_path: Path) -> None:
    found = diagnosis(tmp_path, ripple)
    assert (found.verdict, found.findings) == (UNEXPLAINED, ())
    (told,) = (note for note in found.notes if "a ripple along its range" in note)
    length = float(told.split("every ")[1].split(" m")[0])
    assert length == pytest.approx(LENGTH, rel=0.02)


def test_friction_that_grows_with_the_speed_at_one_end_of_the_range_is_unexplained(tmp_path: Path) -> None:
    found = diagnosis(tmp_path, sticky_end)
    assert found.verdict == UNEXPLAINED
    assert not any(one.status == "firm" for one in found.findings)


def test_noise_is_no_ripple(tmp_path: Path) -> None:
    found = diagnosis(tmp_path, nothing)
    assert (found.verdict, found.findings) == (NOTHING, ())
