"""Shape values of effects: which numbers a robot file may give."""

from __future__ import annotations

import re
from contextlib import nullcontext
from pathlib import Path

import pytest

from generator.effects.library import effects_of
from generator.errors import InputError
from generator.robot.readers import read


@pytest.mark.parametrize(
    ("effect", "value", "told"),
    [
        ("dahl_friction", "xs: 1e-300 rad", "xs is 1e-300, expected a size from 1e-12 to 1e+12"),
        ("coupled_rotor", "other: 2, ratio: 1e-13", "ratio is 1e-13, expected a size from 1e-12 to 1e+12"),
        ("cable_spring", "neutral: 1e13 rad", "neutral is 1e+13, expected at most 1e+12 either way"),
        ("cable_spring", "neutral: 1e-17 rad", ""),
    ],
)
def test_shape_values_have_sizes_for_single_precision(effect: str, value: str, told: str, tmp_path: Path) -> None:
    path = tmp_path / "two.yaml"
    rows = "".join(f"  - {{j: {j}, sigma: 0, alpha: 0, d: 0, theta: q{j}, r: 0}}\n" for j in (1, 2))
    use = f"effects: [{{effect: {effect}, joint: 1, values: {{{value}}}}}]\n"
    path.write_text(f"name: two\ngravity: [0 m/s2, 0 m/s2, 0 m/s2]\njoints:\n{rows}{use}")
    with pytest.raises(InputError, match=re.escape(told)) if told else nullcontext():
        effects_of(read(path))
