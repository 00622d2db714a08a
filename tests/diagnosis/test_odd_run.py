"""Runs that do not agree are told by name."""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from identification.diagnosis.diagnosis import UNEXPLAINED
from identification.diagnosis.verdict import odd_run
from identification.observation import Motion
from tests.diagnosis.diagnosed_arm import NOISE, TRUTH, Hidden, bumps, diagnosis_of, recorded, torque
from tests.recorded import Array, Recorded, fourier


def loaded(q: Array, qd: Array) -> Array:
    """A weight of 8 N on an arm of a metre."""
    return 8.0 * np.cos(q)


def damaged(q: Array, qd: Array) -> Array:
    """Friction at a place to which the first run alone goes."""
    return np.asarray(12.0 * np.sign(qd) * np.exp(-(((q - 0.44) / 0.02) ** 2)))


@pytest.mark.parametrize(
    ("hidden", "told"),
    [
        ([torque(""), loaded, torque("")], "without 2.csv the other runs agree: look for another load"),
        pytest.param(
            [damaged] * 3,
            "without 1.csv the other runs agree; most of what it keeps is where they do not go, at q 0.3",
            marks=pytest.mark.long,
        ),
        ([torque(""), loaded], "1.csv and 2.csv do not agree, each alone is explained: look for another load"),
        pytest.param([bumps(5.0, 0.05)] * 3, None, marks=pytest.mark.long),
        ([bumps(5.0, 0.05)] * 2, None),
    ],
)
def test_the_run_that_differs_from_the_others_is_told(hidden: list[Hidden], told: str | None, tmp_path: Path) -> None:
    regressors, sources = recorded(tmp_path, hidden)
    found = diagnosis_of(sources, regressors)
    assert found.verdict == UNEXPLAINED
    notes = [note for note in found.notes if "agree" in note]
    assert len(notes) == (told is not None)
    assert all((told or "") in note for note in notes)


def test_files_of_one_name_are_told_apart(tmp_path: Path) -> None:
    regressors, sources = recorded(tmp_path, [torque(""), loaded, torque("")])
    renamed = [Path(source).with_suffix("") / "run.csv" for source in sources]
    for source, path in zip(sources, renamed, strict=True):
        path.parent.mkdir()
        Path(source).rename(path)
    notes = diagnosis_of([str(path) for path in renamed], regressors).notes
    assert any(note.startswith("without 2/run.csv the other runs agree: look for another load") for note in notes)


def test_the_speed_that_one_run_alone_reaches_is_told_of_both_directions(tmp_path: Path) -> None:
    """It is played half as fast again, and slips there."""
    regressors, sources = recorded(tmp_path, [torque("")] * 3)
    t, motion = fourier(regressors.model.robot, 40.0, 100.0, 1)
    qd, qdd = 1.5 * motion.qd, 1.5**2 * motion.qdd
    tau = regressors.torques(TRUTH, Motion(motion.q, qd, qdd))[0] + NOISE * np.random.default_rng(5).normal(size=len(t))
    tau -= 40.0 * np.sign(qd[0]) * np.clip(np.abs(qd[0]) - 0.65, 0.0, None)
    Recorded({"t": t / 1.5, "q1": motion.q[0], "tau1": tau}).save(Path(sources[0]))
    found = diagnosis_of(sources, regressors)
    (note,) = (note for note in found.notes if "agree" in note)
    told = (
        r"without 1.csv the other runs agree; most .* where they do not go, at \|qd\| (\S+) to (\S+) rad/s of joint 1:"
    )
    span = re.match(told, note)
    assert span is not None, note
    assert 0.55 < float(span[1]) < 0.68
    assert float(span[2]) == pytest.approx(np.abs(qd).max(), rel=0.02)


@pytest.mark.parametrize(
    ("left", "alone", "where", "told"),
    [
        ((0.02, 0.16, 0.5), 0.1, "", "without 0.csv the other runs agree: look for another load"),
        (
            (0.02, 0.16, 0.5),
            0.1,
            "at q 1 to 2 rad",
            "without 0.csv the other runs agree; most of what it keeps is where",
        ),
        (
            (0.02, 0.16, 0.5),
            3.0,
            "at q 1 to 2 rad",
            "without 0.csv the other runs agree; most of what it keeps is where",
        ),
        ((0.02, 0.16, 0.5), 3.0, "", "most of what is missing shows in 0.csv alone"),
        ((0.15, 0.16, 0.5), 0.1, "", None),
        ((0.1, 0.25, 0.5), 0.1, "", None),
        ((0.02, 0.1, 0.5), 0.1, "", None),
        ((0.9, 1.0, 1.1), 0.1, "", None),
    ],
)
def test_only_a_run_that_stands_out_is_the_odd_one(
    left: tuple[float, ...], alone: float, where: str, told: str | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    """By what stays without each of three runs, in parts of all; and what stays of it where it is fitted ``alone``."""
    runs = [SimpleNamespace(sampled=SimpleNamespace(run=SimpleNamespace(name=f"{r}.csv"))) for r in range(3)]
    found: Any = SimpleNamespace(train=(0, 1), validate=(2,), bank=SimpleNamespace(runs=runs))

    def unexplained(found: Any, kept: Sequence[int], joints: Collection[int]) -> float:
        if len(kept) == 1:
            return alone
        (out,) = {0, 1, 2} - set(kept) or {None}
        return 1.0 if out is None else left[out]

    monkeypatch.setattr(odd_run, "_unexplained", unexplained)
    monkeypatch.setattr(odd_run, "own_range", lambda *_: where)
    notes = odd_run.notes(found, {1})
    assert len(notes) == (told is not None)
    assert all(note.startswith(told or "") for note in notes)
    assert ["another load" in note for note in notes] == [alone < 1.0] * len(notes)
