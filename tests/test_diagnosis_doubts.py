"""Runs with torques of another sign or unit than the rest are refused, not explained."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from generator.errors import InputError
from generator.robot.readers import read
from identification.diagnosis.command import Request, diagnosed
from identification.inverse_model import identify
from tests.diagnosed_arm import recorded, torque
from tests.recorded import Recorded


def diagnose(folder: Path, factors: list[float]) -> None:
    """Of runs whose torques are multiplied by ``factors``."""
    _, sources = recorded(folder, [torque("")] * len(factors))
    for source, factor in zip(sources, factors, strict=True):
        t, q, tau = np.loadtxt(source, delimiter=",", skiprows=1).T
        Recorded({"t": t, "q1": q, "tau1": factor * tau}).save(Path(source))
    path = folder / "arm.yaml"
    diagnosed(path, read(path), Request(sources), folder / "out", lambda *about: {})


def test_a_run_with_torques_of_another_sign_is_refused(tmp_path: Path) -> None:
    message = r"2.csv:1:1: the torques have another sign than those of the other runs, expected one sign"
    with pytest.raises(InputError, match=message):
        diagnose(tmp_path, [1.0, -1.0, 1.0, 1.0])
    assert not (tmp_path / "out").exists()


def test_runs_of_which_most_stays_unexplained_are_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"1.csv:1:1: the model of arm leaves \d+ % of the torques unexplained"):
        diagnose(tmp_path, [1.0, 1000.0])


def test_torques_that_all_have_the_other_sign_are_refused(tmp_path: Path) -> None:
    message = "1.csv:1:1: all friction and inertia that the torques show alone is negative, expected torques of the dri"
    with pytest.raises(InputError, match=message):
        diagnose(tmp_path, [-1.0, -1.0])
    with pytest.raises(InputError, match=message):
        identify(read(tmp_path / "arm.yaml"), [tmp_path / "1.csv"])
