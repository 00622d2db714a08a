"""``manifest.json``: what programs read of a generation."""

from __future__ import annotations

from typing import Any

import pytest

from generator.derivation import derive
from generator.manifest import manifest
from generator.resources import find_robot
from generator.robot.readers import read
from generator.symbolic.model import Model
from generator.version import VERSION


@pytest.fixture(scope="module")
def model() -> Model:
    return derive(read(find_robot("kr270")), check=False)


@pytest.fixture(scope="module")
def contents(model: Model) -> dict[str, Any]:
    return manifest(model, ["review/b", "c/a"])


def test_identity(contents: dict[str, Any], model: Model) -> None:
    assert contents["robot"]["name"] == "kr270"
    assert contents["robot"]["sha256"] == model.robot.digest
    assert contents["generator"] == f"counterpoise {VERSION}"
    assert contents["format"] == 1
    assert contents["files"] == ["c/a", "review/b"]


def test_parameters_are_in_the_order_of_the_generated_vector(contents: dict[str, Any], model: Model) -> None:
    names = [parameter["name"] for parameter in contents["parameters"]]
    assert names == [parameter.name for parameter in model.parameters]
    assert contents["base_parameters"] == names[:60]
    assert {p["name"]: p["unit"] for p in contents["parameters"]}["Kr2"] == "N/m"


def test_groupings_of_the_report(contents: dict[str, Any]) -> None:
    """Report section 5.1 with the nominal lengths, and what stands alone."""
    assert list(contents["groupings"]) == list(contents["groupings_symbolic"]) == contents["base_parameters"]
    assert contents["groupings_symbolic"]["MX3R"] == "MX3 + d4 (M4 + M5 + M6)"
    d4 = -contents["groupings"]["MX3R"]["M4"]
    assert abs(d4) == 0.055
    assert contents["groupings"]["MX3R"] == {"MX3": 1.0, "M4": -d4, "M5": -d4, "M6": -d4}
    assert contents["groupings"]["Fv1"] == {"Fv1": 1.0}
    assert contents["groupings_symbolic"]["Fv1"] == "Fv1"


def test_effects_name_their_joints_and_parameters(contents: dict[str, Any]) -> None:
    effects = {effect["effect"]: effect for effect in contents["effects"]}
    assert effects["spring_balancer"]["joints"] == [2]
    assert effects["spring_balancer"]["parameters"] == ["Kr2", "K02"]
    assert effects["coulomb_friction"]["joints"] == [1, 2, 3, 4, 5, 6]
    assert effects["coulomb_friction"]["parameters"] == [f"Fc{j}" for j in range(1, 7)]


def test_functions_state_inputs_outputs_and_operations(contents: dict[str, Any], model: Model) -> None:
    assert list(contents["functions"]) == sorted(model.functions)
    dynamics = contents["functions"]["inverse_dynamics"]
    assert [(signal["name"], signal["shape"], signal["units"][0]) for signal in dynamics["inputs"]] == [
        ("q", [6], "rad"),
        ("qd", [6], "rad/s"),
        ("qdd", [6], "rad/s2"),
    ]
    assert [(signal["name"], signal["shape"], signal["units"][0]) for signal in dynamics["outputs"]] == [
        ("tau", [6], "N m")
    ]
    assert dynamics["uses_parameters"] is True
    assert contents["functions"]["tool_transform"]["uses_parameters"] is False
    assert dynamics["operations"] == model.functions["inverse_dynamics"].count.as_dict()
    assert dynamics["operations"]["trig"] >= 10
    assert contents["functions"]["tool_transform"]["prepare_operations"]["mul"] == 0
    assert dynamics["prepare_operations"]["mul"] > 0
