"""A robot that hangs another way than its file says."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import pytest
import sympy

from generator.errors import InputError
from generator.robot.description import Robot
from generator.robot.readers import read
from identification.inverse_model import identify
from identification.observation import Regressors
from tests.recorded import TRUTH, TWO_LINKS, parameters_text, recorded

TOLD = "gravity as the robot is mounted: with [9.81, 0, 0] m/s2 far less is left"


@pytest.mark.parametrize(("friction", "refused"), [(3.0, True), (60.0, False)])
def test_gravity_that_is_another_is_told(friction: float, refused: bool, tmp_path: Path) -> None:
    """Of a robot on a wall whose file has it on the floor, where its first axis feels no weight."""
    robot = pan(tmp_path)
    there, path = on_the_wall(robot, friction, tmp_path)
    if refused:
        with pytest.raises(InputError, match=rf"pan.yaml:1:1: .* unexplained, expected {re.escape(TOLD)}"):
            identify(robot, [path])
    else:
        assert f"does the file have {TOLD}" in identify(robot, [path]).notes
    assert not any("mounted" in note for note in identify(there, [path]).notes)


def test_its_size_is_that_of_the_file(tmp_path: Path) -> None:
    """Which has the robot on a slope."""
    robot = pan(tmp_path)
    _, path = on_the_wall(robot, 3.0, tmp_path)
    slope = replace(robot, gravity=(sympy.S.Zero, sympy.Rational(5886, 1000), -sympy.Rational(7848, 1000)))
    assert f"does the file have {TOLD}" in identify(slope, [path]).notes


def test_sets_of_the_robots_own_base_parameters_are_no_matter(tmp_path: Path) -> None:
    """Its weight along an axis has no first moments on the first joint."""
    (tmp_path / "two_links.yaml").write_text(TWO_LINKS + parameters_text({"known": TRUTH}))
    regressors = Regressors(read(tmp_path / "two_links.yaml"))
    path = recorded(regressors, TRUTH, seed=4, noise=3.0).save(tmp_path / "a.csv")
    found = identify(regressors.model.robot, [path], regressors=regressors)
    assert found.full.train.total.relative_to_mean > 10
    assert not any("mounted" in note for note in found.notes)


def pan(folder: Path) -> Robot:
    """A vertical axis, and a horizontal one on it."""
    text = TWO_LINKS.replace("alpha: pi/2", "alpha: 0").replace("two_links", "pan")
    (folder / "pan.yaml").write_text(text.replace("j: 2, sigma: 0, alpha: 0", "j: 2, sigma: 0, alpha: pi/2"))
    return read(folder / "pan.yaml")


def on_the_wall(robot: Robot, friction: float, folder: Path) -> tuple[Robot, Path]:
    """The robot there, and its run."""
    there = replace(robot, gravity=(sympy.Rational(981, 100), sympy.S.Zero, sympy.S.Zero))
    regressors = Regressors(there)
    sizes = {"MX": 6.0, "M": 2.0, "Fv": friction, "Fc": friction}
    values = {name: sizes.get(name.rstrip("12R"), 1.0) for name in regressors.names}
    return there, recorded(regressors, values, seed=4, noise=0.02).save(folder / "a.csv")
