"""A torque that drifts, or oscillates by itself, while its motion repeats is no noise."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from scipy.signal import lfilter

from identification.diagnosis.diagnosis import NOTHING, UNEXPLAINED, Diagnosis
from identification.diagnosis.verdict.drifting import _Means
from identification.diagnosis.verdict.lack_of_fit import CHANCE
from identification.diagnosis.verdict.tones import lines
from identification.observation import Regressors
from tests.diagnosis.diagnosed_arm import diagnosis_of, recorded, rewritten, torque
from tests.recorded import Array

Added = Callable[[Array], Array]


def diagnosed(folder: Path, added: Added) -> Diagnosis:
    """Two runs of several periods with something of the time on top."""
    regressors, sources = recorded(folder, [torque("")] * 2)
    return with_more(regressors, sources, added)


def with_more(regressors: Regressors, sources: list[str], added: Added) -> Diagnosis:
    for source in sources:
        rewritten(source, lambda t, q, tau: (t, q, tau + added(t)))
    return diagnosis_of(sources, regressors)


def red(seconds: float, size: float) -> Added:
    """Noise that stays for a time."""
    draw = np.random.default_rng(4)

    def noise(t: Array) -> Array:
        stays = np.exp(-(t[1] - t[0]) / seconds)
        white = draw.normal(size=len(t)) * np.sqrt(1 - stays**2)
        return np.asarray(size * lfilter([1], [1, -stays], white))

    return noise


@pytest.mark.parametrize("drift", [lambda t: 5.0 * (1 - np.exp(-t / 25.0)), lambda t: -0.15 * t])
def test_a_drift_of_the_offset_is_unexplained(drift: Added, tmp_path: Path) -> None:
    found = diagnosed(tmp_path, drift)
    assert found.verdict == UNEXPLAINED
    (note,) = (note for note in found.notes if "drifts" in note)
    assert note.startswith("the torque of joint 1 drifts while its motion repeats, by ")
    assert (found.after.joint, found.after.variable) == (1, "time")
    assert not any(one.status == "firm" for one in found.findings)


@pytest.mark.parametrize("period", [500, 400, 120])
def test_drifts_are_seen_in_whatever_periods_there_are(period: int) -> None:
    """Of 990 rows whose first ten do not count: two periods that lost some, two and a part, and eight and a part."""
    draw, t, kept = np.random.default_rng(3), np.arange(990), np.arange(990) >= 10
    still, drifting = _Means(), _Means()
    for _ in range(4):
        noise = draw.normal(size=990)
        still.add(noise, kept, period)
        drifting.add(noise + 4e-3 * t, kept, period)
    assert drifting.p < CHANCE < still.p


@pytest.mark.parametrize("frequency", [0.077, 1.337, 11.73])
def test_an_oscillation_of_its_own_is_unexplained(frequency: float, tmp_path: Path) -> None:
    found = diagnosed(tmp_path, lambda t: 4.0 * np.sin(2 * np.pi * frequency * t + 1.0))
    assert found.verdict == UNEXPLAINED
    (note,) = (note for note in found.notes if "oscillation" in note)
    match = re.search(r"of joint 1 is an oscillation of ([\d.]+) Hz that does not follow the motion", note)
    assert match
    assert float(match[1]) == pytest.approx(frequency, rel=0.05)
    assert (found.after.joint, found.after.variable) == (1, "time")


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("rows", range(100, 130))
def test_the_part_of_an_oscillation_is_all_of_it_whatever_the_number_of_rows(rows: int) -> None:
    e = 2.0 * np.sin(2 * np.pi * 0.7 * np.arange(rows) / 10.0 + 1.0)
    frequency, part = lines(e, np.ones(rows, dtype=bool), 10.0, 0.1)
    best = int(np.argmax(part))
    assert frequency[best] == pytest.approx(0.7, abs=10.0 / 4 / rows)
    assert 0.95 < part[best] / (e @ e) <= 1 + 1e-9


@pytest.mark.parametrize(("frequency", "told"), [(1.337, True), (0.077, False)])
def test_a_slow_oscillation_must_be_more_of_what_differs(frequency: float, told: bool, tmp_path: Path) -> None:
    """Two thirds of it."""
    found = diagnosed(tmp_path, lambda t: 1.3 * np.sin(2 * np.pi * frequency * t + 1.0))
    assert any("oscillation" in note for note in found.notes) is told


@pytest.mark.parametrize("seconds", [0.05, 0.3, 2.0])
def test_noise_that_stays_for_a_time_is_no_drift(seconds: float, tmp_path: Path) -> None:
    found = diagnosed(tmp_path, red(seconds, 2.0))
    assert (found.verdict, found.findings) == (NOTHING, ())
    assert not any("drifts" in note or "oscillation" in note for note in found.notes)
