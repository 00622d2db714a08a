"""Units of the controller in the generated simulation."""

from __future__ import annotations

from pathlib import Path

import pytest

from generator.backends import python, simulation
from generator.derivation import derive
from generator.robot.readers import read


@pytest.mark.parametrize("drives", [True, False])
def test_gains_are_in_units_of_what_the_controller_moves(drives: bool, tmp_path: Path) -> None:
    """Of rotors on a slide, too, where there are drives; of the slide itself without them."""
    path = tmp_path / "slide.yaml"
    path.write_text(
        "name: slide\ngravity: [0 m/s2, 0 m/s2, -9.81 m/s2]\n"
        "joints: [{j: 1, sigma: 1, alpha: 0, d: 0, theta: 0, r: q1}]\n" + "drives: {gear_ratios: [314]}\n" * drives
    )
    model = derive(read(path))
    header = simulation.emit(model)["slide_simulation.h"]
    page = python.emit(model)["slide.py"]
    assert isinstance(header, str)
    assert isinstance(page, str)
    for text in (header, page[page.index("class Controller") : page.index("def control")]):
        assert ("[N m s/rad]" in text) == drives
        assert ("[N m s/rad, N s/m]" in text) != drives
