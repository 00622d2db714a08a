"""A robot that hangs another way than its file says."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import pytest
import sympy

from generator.errors import InputError
from generator.robot.readers import read
from identification.inverse_model import identify
from identification.observation import Regressors
from tests.recorded import TWO_LINKS, recorded


@pytest.mark.parametrize(("friction", "refused"), [(3.0, True), (60.0, False)])
def test_gravity_that_is_another_is_told(friction: float, refused: bool, tmp_path: Path) -> None:
    """Of a robot on a wall whose file has it on the floor, where its first axis feels no weight."""
    text = TWO_LINKS.replace("alpha: pi/2", "alpha: 0").replace(
        "j: 2, sigma: 0, alpha: 0", "j: 2, sigma: 0, alpha: pi/2"
    )
    (tmp_path / "pan.yaml").write_text(text.replace("two_links", "pan"))
    robot = read(tmp_path / "pan.yaml")
    there = Regressors(replace(robot, gravity=(sympy.Rational(981, 100), sympy.S.Zero, sympy.S.Zero)))
    sizes = {"MX": 6.0, "M": 2.0, "Fv": friction, "Fc": friction}
    values = {name: sizes.get(name.rstrip("12R"), 1.0) for name in there.names}
    path = recorded(there, values, seed=4, noise=0.02).save(tmp_path / "a.csv")
    told = "gravity as the robot is mounted: with [9.81, 0, 0] m/s2 far less is left"
    if refused:
        with pytest.raises(InputError, match=rf"pan.yaml:1:1: .* unexplained, expected {re.escape(told)}"):
            identify(robot, [path])
    else:
        assert f"does the file have {told}" in identify(robot, [path]).notes
    assert not any("mounted" in note for note in identify(there.model.robot, [path]).notes)
