"""Runs that hold the same samples, in one file or in a copy of it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from generator.errors import InputError
from generator.robot.description import Robot
from identification.dataset import load
from identification.observation import Regressors
from identification.shared_samples import fitted_too, unshared
from tests.recorded import TRUTH, Recorded, recorded


@pytest.fixture(scope="module")
def noisy(links: Regressors) -> Recorded:
    return recorded(links, TRUTH, duration=8.0, noise=0.1)


def test_a_copy_with_other_line_ends_and_digits_shares_samples(noisy: Recorded, robot: Robot, tmp_path: Path) -> None:
    path = noisy.save(tmp_path / "a.csv")
    rounded = Recorded({name: np.round(values, 9) for name, values in noisy.columns.items()})
    copy = rounded.save(tmp_path / "copy.csv")
    copy.write_bytes(copy.read_bytes().replace(b"\n", b"\r\n"))
    whole, part = load(str(path), robot), load(f"{copy}@2:5", robot)
    with pytest.raises(InputError, match=r"copy.csv:1:1: its samples from 2 s to 5 s fit in a.csv and fit in copy"):
        unshared({"fit": [whole, part]})
    (told,) = fitted_too([whole], [part])
    assert told.startswith("copy.csv@2:5 tests what is fitted in a.csv, from 2 s to 5 s")


def test_parts_that_touch_do_not_and_parts_that_overlap_by_two_periods_do(
    noisy: Recorded, robot: Robot, tmp_path: Path
) -> None:
    """One sample at the joint of two parts belongs to both."""
    path = noisy.save(tmp_path / "a.csv")
    unshared({"fit": [load(f"{path}@:4", robot), load(f"{path}@4:", robot)]})
    with pytest.raises(InputError, match=r"its samples from 4 s to 4.01 s fit in a.csv"):
        unshared({"fit": [load(f"{path}@:4.01", robot), load(f"{path}@4:", robot)]})


def test_the_same_motion_once_more_does_not(noisy: Recorded, robot: Robot, tmp_path: Path) -> None:
    draw = np.random.default_rng(2)
    again = {name: noisy.columns[name] + 0.1 * draw.normal(size=1600) for name in ("tau1", "tau2")}
    runs = [
        load(str(noisy.save(tmp_path / "a.csv")), robot),
        load(str(noisy.with_columns(**again).save(tmp_path / "b.csv")), robot),
    ]
    unshared({"fit": runs})
