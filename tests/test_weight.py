"""Torques of the weight where base parameters of the bodies hold what is none of a body."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from generator.derivation import derive
from generator.robot.readers import read
from generator.symbolic.function import PARAMETERS
from generator.symbolic.interpret import evaluate
from tests.commands import PENDULUM

SLIDE = """\
name: slide
gravity: [0 m/s2, 0 m/s2, -9.81 m/s2]
joints:
  - {j: 1, sigma: 1, alpha: ALPHA, d: 0, theta: 0, r: q1}
effects:
  - {effect: rotor_inertia, joint: 1}
  - {effect: EFFECT, joint: 1}
"""


@pytest.mark.parametrize(
    ("alpha", "effect", "told"),
    [("0", "offset", "M1R holds Ia1"), ("0", "viscous_friction", ""), ("pi/2", "offset", "")],
)
def test_what_is_no_weight_is_told(alpha: str, effect: str, told: str, tmp_path: Path) -> None:
    """Of a vertical slide whose offset no motion tells from its weight, and of others."""
    path = tmp_path / "slide.yaml"
    path.write_text(SLIDE.replace("ALPHA", alpha).replace("EFFECT", effect))
    model = derive(read(path))
    for name in ("gravity", "potential_energy", "dynamics"):
        if name in model.functions:
            said = re.findall(r"Not the bodies' weight alone here: (.*?)\.", model.functions[name].details)
            assert said == ([told] if told else [])
    assert "gravity" in model.functions


def test_it_is_told_where_values_are_built_in(tmp_path: Path) -> None:
    values = "parameters:\n  one: {values: {M1: 8 kg, Ia1: 12 kg, Off1: 0 N}}\n"
    path = tmp_path / "slide.yaml"
    path.write_text(SLIDE.replace("ALPHA", "0").replace("EFFECT", "offset") + values)
    model = derive(read(path), parameter_set="one")
    assert "M1R holds Ia1" in model.functions["gravity"].details


def test_bias_holds_the_robot_at_rest(tmp_path: Path) -> None:
    """The weight, an offset and a spring, whose torques are told here a second time; friction and rotors rest."""
    path = tmp_path / "pendulum.yaml"
    effects = ("offset", "joint_spring", "rotor_inertia", "coulomb_friction", "viscous_friction")
    lines = "".join(f"  - {{effect: {effect}, joint: 1}}\n" for effect in effects)
    path.write_text(PENDULUM.split("effects:")[0] + f"effects:\n{lines}")
    model = derive(read(path), ("bias", "gravity"), check=False)
    values = dict.fromkeys([parameter.name for parameter in model.parameters], 7.0)
    values |= {"MX1": 3.0, "MY1": 0.5, "Off1": -2.0, "ks1": 4.0}
    q = np.linspace(-1.0, 1.0, 5)[:, None]
    inputs = {PARAMETERS: np.array([*values.values()]), "q": q, "qd": 0 * q}
    weight = 9.81 * (3.0 * np.cos(q) - 0.5 * np.sin(q))
    (held,) = evaluate(model.functions["bias"], inputs).values()
    np.testing.assert_allclose(held, weight - 2.0 + 4.0 * q, atol=1e-12)
    (gravity,) = evaluate(model.functions["gravity"], {name: inputs[name] for name in (PARAMETERS, "q")}).values()
    np.testing.assert_allclose(gravity, weight, atol=1e-12)
    assert "bias(q, 0) holds the robot at rest" in model.functions["gravity"].details
