"""A review shows all that a robot file states: whoever changes a value sees it in the difference of groupings.md."""

from __future__ import annotations

from pathlib import Path

import pytest

from generator.derivation import derive
from generator.review.stated import drives, effects
from generator.robot.description import PRISMATIC
from generator.robot.readers import read
from tests.commands import PENDULUM
from tests.reviewed import files, model
from tests.subject import Subject

#: One of everything whose value the groupings themselves do not hold.
STATED = PENDULUM.replace(
    "parameters:",
    """drives:
  gear_ratios: [-101/2]
  torque_constants: {unit: N m/A, use: warm, cold: [0.5], warm: [0.4]}
  torque_drift: [-0.05]
signals:
  torque_delay: [3 ms]
  position_offset: [0.5 deg]
parameters:""",
).replace(
    "r: 0}\neffects:",
    """r: 0, limits: [-90 deg, 1.5 rad], speed_limit: 100 deg/s, acceleration_limit: 5 rad/s2, torque_limit: 0.3 kN m}
base: {rotation: [40 deg, 0 deg, 0 deg], translation: [0 m, 0 m, 0.25 m]}
effects:
  - {effect: stribeck_friction, joints: [1], values: {vs: 0.05 rad/s, exponent: 2}}""",
)


def table(markdown: str, heading: str) -> list[list[str]]:
    """The cells of the first table under a heading, without its head."""
    text = markdown.split(f"\n## {heading}\n\n", 1)[1].split("\n\n", 1)[0]
    return [line.strip("| ").split(" | ") for line in text.splitlines()[2:]]


def test_values_built_in_are_told_with_all_their_digits(tmp_path: Path) -> None:
    path = tmp_path / "pendulum.yaml"
    text = PENDULUM.replace("Fv1: 0.25", "Fv1: 0.123456789012345").replace("MX1: 3 ", "MX1: 12345678 ")
    path.write_text(text.replace("Fc1: 0.125", "Fc1: 0"))
    told = files(derive(read(path), parameter_set="light"))
    rows = told["groupings.md"].split("## Parameters built in", 1)[1].split("|---|---|---|\n", 1)[1].split("\n\n", 1)[0]
    values = {row.split(" | ")[0].strip("| "): row.split(" | ")[1] for row in rows.strip().splitlines()}
    assert values == {"ZZ1": "2", "MX1": "1.2345678e7", "MY1": "0.5", "Fv1": "0.123456789012345"}
    assert all(f">{value}</td>" in told["review.html"] for value in values.values())


def test_the_gas_balancer_and_the_drives_of_the_report() -> None:
    text = files(model("kr500"))["groupings.md"]
    values = "d21 = 0.9669 m, d22 = 0.2062 m, phi = -1.6293 rad, l0 = 0.5 m, exponent = 1"
    assert table(text, "Effects")[-1] == ["gas_balancer", "2", values]
    assert table(text, "Effects")[0] == ["rotor_inertia", "1 to 6", "none"]
    assert table(text, "Drives")[4] == ["5", "-44096/175", "0, 0, 0, -53/50, -44096/175, 0", "1.14", "1.166"]
    assert "Free fall is 0, 0, -9.81 m/s2 in the world frame, which is frame 0." in text
    assert "Elastic drive trains: joints 1 to 6." in text


def test_all_limits_of_a_joint_are_told(tmp_path: Path) -> None:
    path = tmp_path / "pendulum.yaml"
    path.write_text(STATED)
    told = files(derive(read(path), (), check=False))
    assert "| -90 to 85.944 deg; 1.745329 rad/s, 5 rad/s2, 300 N m either way |" in told["groupings.md"]
    path.write_text(STATED.replace("limits: [-90 deg, 1.5 rad], speed_limit: 100 deg/s, ", ""))
    told = files(derive(read(path), (), check=False))
    assert "| 5 rad/s2, 300 N m either way |" in told["groupings.md"]


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("gear_ratios: [-101/2]", "gear_ratios: [-50]"),
        ("cold: [0.5]", "cold: [0.6]"),
        ("use: warm", "use: cold"),
        ("torque_drift: [-0.05]", "torque_drift: [-0.06]"),
        ("torque_delay: [3 ms]", "torque_delay: [4 ms]"),
        ("position_offset: [0.5 deg]", "position_offset: [0.6 deg]"),
        ("0.05 rad/s", "0.06 rad/s"),
        ("exponent: 2", "exponent: 1"),
        ("40 deg, 0 deg, 0 deg", "50 deg, 0 deg, 0 deg"),
        ("0.25 m", "0.26 m"),
        ("-90 deg", "-91 deg"),
        ("100 deg/s", "101 deg/s"),
        ("5 rad/s2", "6 rad/s2"),
        ("0.3 kN m", "0.4 kN m"),
    ],
)
def test_another_value_is_another_text(tmp_path: Path, old: str, new: str) -> None:
    texts = []
    for k, stated in enumerate((STATED, STATED.replace(old, new))):
        path = tmp_path / f"{k}.yaml"
        path.write_text(stated)
        texts.append(files(derive(read(path), (), check=False))["groupings.md"])
    changed = set(texts[0].splitlines()) ^ set(texts[1].splitlines())
    assert 2 <= len(changed) <= 6, changed


def test_every_effect_and_drive_of_any_robot_has_its_row(arm: Subject) -> None:
    text = files(arm.model)["groupings.md"]
    rows = {row[0] for row in effects(arm.model)[1:]} - {"joint_elasticity"}
    assert rows == {one.effect.id for one in arm.model.effects}
    gaps = {row[2] for row in effects(arm.model)[1:] if row[0] == "joint_elasticity"}
    springs = [one for one in arm.model.motor_effects if one.effect.id == "joint_elasticity"]
    assert len(gaps) == len({one.site.values["gap"] for one in springs} - {0})
    if arm.model.effects:
        assert len(table(text, "Effects")) == len(effects(arm.model)) - 1
    if arm.robot.drives:
        ratios = [row[1] for row in table(text, "Drives")]
        units = [" rad/m" if joint.sigma == PRISMATIC else "" for joint in arm.robot.moving]
        assert ratios == [f"{ratio}{unit}" for ratio, unit in zip(arm.robot.drives.ratios, units, strict=True)]
    else:
        assert drives(arm.robot) == ()
