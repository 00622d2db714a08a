"""Findings written into robot files: read back, derived, and nothing else of the text touched."""

from __future__ import annotations

import difflib
import re
from pathlib import Path

import numpy as np
import pytest
import scipy.linalg

from generator.derivation import derive
from generator.effects.library import effects_of
from generator.errors import InputError
from generator.resources import find_robot
from generator.robot.description import Robot
from identification.corrections import NEVER
from identification.diagnosis.columns.hypothesis import BASE, BODY, DRIVE, EFFECT, ELASTIC, SIGNAL
from identification.diagnosis.mending.addition import Addition
from identification.diagnosis.mending.repair import Repaired, repaired
from identification.robot_text import robot_of, with_item, with_value

ROBOTS = ("kr500", "lbr_iiwa14", "scara", "emps")


def text_of(name: str) -> str:
    return find_robot(name).read_text(encoding="utf-8")


def repair(name: str, *additions: Addition) -> Repaired:
    return repaired(text_of(name), f"{name}.yaml", additions)


def added(old: str, new: str) -> list[str]:
    """Lines that are new; no line may have gone."""
    diff = list(difflib.ndiff(old.splitlines(), new.splitlines()))
    assert not [line for line in diff if line.startswith("- ")]
    return [line[2:] for line in diff if line.startswith("+ ")]


def uses(robot: Robot) -> set[tuple[str, int]]:
    return {(use.effect, joint) for use in robot.effects for joint in use.joints}


@pytest.mark.parametrize("name", ROBOTS)
def test_an_effect_is_one_line_with_its_evidence(name: str) -> None:
    found = repair(
        name, Addition(EFFECT, "stribeck_friction", (1,), {"vs": 0.0123456789, "exponent": 2}, evidence="bic 99")
    )
    comment, line = added(text_of(name), found.text)
    assert comment == "  # bic 99"
    assert line.startswith("  - {effect: stribeck_friction, joint: 1, values: {vs: 0.0123457 ")
    (use,) = [use for use in found.robot.effects if use.effect == "stribeck_friction"]
    assert float(use.values["vs"].value) == 0.0123457
    assert "Fst1" in {p.name for p in derive(found.robot, names=(), check=False).parameters}


def test_an_effect_with_the_same_values_on_several_joints_is_one_entry() -> None:
    found = repair(
        "kr500",
        Addition(EFFECT, "asymmetric_viscous", (3,)),
        Addition(EFFECT, "dahl_friction", (2,), {"xs": 1e-3}),
        Addition(EFFECT, "asymmetric_viscous", (1,)),
        Addition(EFFECT, "dahl_friction", (1,), {"xs": 2e-3}),
        Addition(EFFECT, "dahl_friction", (4,), {"xs": 1e-3}),
    )
    assert added(text_of("kr500"), found.text) == [
        "  - {effect: asymmetric_viscous, joints: [1, 3]}",
        "  - {effect: dahl_friction, joints: [2, 4], values: {xs: 0.001 rad}}",
        "  - {effect: dahl_friction, joint: 1, values: {xs: 0.002 rad}}",
    ]
    assert len(effects_of(found.robot)) == len(effects_of(robot_of(text_of("kr500"), "x"))) + 5


def test_the_same_number_in_another_unit_is_another_entry() -> None:
    found = repair(
        "scara",
        *(Addition(EFFECT, "power_friction", (joint,), {"v": 1.0, "exponent": 2.0}) for joint in (1, 2, 3)),
        *(Addition(EFFECT, "asymmetric_viscous", (joint,)) for joint in (1, 3)),
    )
    assert added(text_of("scara"), found.text) == [
        "  - {effect: power_friction, joints: [1, 2], values: {v: 1 rad/s, exponent: 2}}",
        "  - {effect: power_friction, joint: 3, values: {v: 1 m/s, exponent: 2}}",
        "  - {effect: asymmetric_viscous, joints: [1, 3]}",
    ]
    assert effects_of(found.robot)


def test_the_comment_tells_every_joint_of_an_effect_once() -> None:
    found = repair(
        "kr500",
        Addition(EFFECT, "asymmetric_viscous", (3,), evidence="a name, firm", amplitude={3: 20.0}),
        Addition(EFFECT, "asymmetric_viscous", (1,), evidence="a name, firm", amplitude={1: 1234.5}),
    )
    comment = "  # a name, firm: rms torque 1.23e+03 N m on joint 1, 20 N m on joint 3"
    assert added(text_of("kr500"), found.text)[0] == comment


def test_an_effect_that_is_there_is_not_written_twice() -> None:
    found = repair("kr500", Addition(EFFECT, "gas_balancer", (2,), {"l0": 1.0}), Addition(EFFECT, "offset", (1, 3)))
    assert found.text == text_of("kr500")
    assert len(found.notes) == 3
    again = repaired(found.text, "x", [Addition(EFFECT, "cable_spring", (1,), {"neutral": 0.1})] * 2)
    twice = repaired(again.text, "x", [Addition(EFFECT, "cable_spring", (1,), {"neutral": 0.2})])
    assert twice.text == again.text
    assert twice.text.count("cable_spring") == 1


def test_a_coupled_rotor_names_its_other_joint() -> None:
    found = repair("tx40", Addition(EFFECT, "coupled_rotor", (6,), {"other": 5.0, "ratio": 1.0}))
    assert "{effect: coupled_rotor, joint: 6, values: {other: 5, ratio: 1}}" in found.text
    derive(found.robot, names=(), check=False)


def test_signals_add_up_and_a_gain_multiplies() -> None:
    first = repair(
        "stanford",
        Addition(SIGNAL, "position_offset", (3,), values={"position_offset": 2e-3}),
        Addition(SIGNAL, "torque_gain", (2,), values={"torque_gain": 1.05}),
        Addition(SIGNAL, "torque_delay", (1, 2, 3, 4, 5, 6), values={"torque_delay": 8e-4}),
    )
    assert added(text_of("stanford"), first.text) == [
        "",
        "signals:",
        "  position_offset: [0 rad, 0 rad, 0.002 m, 0 rad, 0 rad, 0 rad]",
        "  torque_gain: [1, 1.05, 1, 1, 1, 1]",
        "  torque_delay: [0.0008 s, 0.0008 s, 0.0008 s, 0.0008 s, 0.0008 s, 0.0008 s]",
    ]
    second = repaired(
        first.text,
        "x",
        [
            Addition(SIGNAL, "position_offset", (3,), values={"position_offset": 1e-3}),
            Addition(SIGNAL, "torque_gain", (2,), values={"torque_gain": 0.9}),
            Addition(SIGNAL, "current_limit", (1,), values={"current_limit": 12.0}),
        ],
    )
    signals = second.robot.signals
    assert float(signals.position_offset[2]) == pytest.approx(3e-3)
    assert float(signals.torque_gain[1]) == pytest.approx(0.945)
    assert float(signals.current_limit[0]) == 12
    assert all(float(one) > 1e5 for one in signals.current_limit[1:])


DASHES = """
signals:
  torque_gain:  # of the drives
  - 1
  - 1.1
  - 1
  - 1
  - 1
  - 1
  position_offset:
  - 0 rad
  - 0 rad
  - 0.001 m
  - 0 rad
  - 0 rad
  - 0 rad
flexible:
- 1
- 2
"""


@pytest.mark.parametrize(
    ("stated", "written"),
    [
        ("[180 deg, pi/3 rad, 0 m, 0 rad, 0 rad, 1/3 rad]", "[180 deg, pi/3 rad, 0.001 m, 0 rad, 0 rad, 1/3 rad]"),
        ("[180 deg, 0 rad, 1 mm, 0 rad, 0 rad, 0 rad]", "[180 deg, 0 rad, 0.002 m, 0 rad, 0 rad, 0 rad]"),
    ],
)
def test_values_that_do_not_change_stay_as_they_are_written(stated: str, written: str) -> None:
    text = f"{text_of('stanford').rstrip()}\nsignals:\n  position_offset: {stated}\n"
    found = repaired(text, "x", [Addition(SIGNAL, "position_offset", (3,), values={"position_offset": 1e-3})])
    assert f"\n  position_offset: {written}\n" in found.text


def test_one_value_for_all_stays_that_of_the_others() -> None:
    text = f"{text_of('stanford').rstrip()}\nsignals:\n  torque_gain: 10/9\n"
    found = repaired(text, "x", [Addition(SIGNAL, "torque_gain", (2,), values={"torque_gain": 0.9})])
    assert "\n  torque_gain: [10/9, 1, 10/9, 10/9, 10/9, 10/9]\n" in found.text


def test_a_list_whose_dashes_stand_below_their_key_is_written_anew() -> None:
    text = text_of("stanford").rstrip() + "\n" + DASHES
    found = repaired(
        text,
        "x",
        [
            Addition(SIGNAL, "torque_gain", (2,), values={"torque_gain": 0.9}),
            Addition(SIGNAL, "position_offset", (3,), values={"position_offset": 1e-3}),
            Addition(ELASTIC, "joint_elasticity", (3,), {}, {"k3": 1e6}),
        ],
    )
    assert [float(one) for one in found.robot.signals.torque_gain] == pytest.approx([1, 0.99, 1, 1, 1, 1])
    assert float(found.robot.signals.position_offset[2]) == pytest.approx(2e-3)
    assert found.robot.flexible == (1, 2, 3)


def coupling(robot: Robot) -> np.ndarray:
    assert robot.drives is not None
    return np.array([[float(one) for one in row] for row in robot.drives.coupling])


@pytest.mark.parametrize("quote", ["", '"'])
@pytest.mark.parametrize("convention", ["row", "as_printed", "direct"])
def test_a_gears_ratio_scales_its_column_of_the_coupling(convention: str, quote: str) -> None:
    text = text_of("kr500").replace("convention: row", f"convention: {quote}{convention}{quote}")
    new = repaired(text, "x", [Addition(DRIVE, "gear_ratio", (5,), {"gear_ratio": 1.01})])
    expected = coupling(robot_of(text, "x")) * [1, 1, 1, 1, 1.01, 1]
    np.testing.assert_allclose(coupling(new.robot), expected, rtol=1e-12)


def test_the_torque_constant_drifts_from_where_it_starts() -> None:
    found = repair(
        "kr500",
        Addition(DRIVE, "torque_drift", (2,), {"torque_drift": -0.06, "torque_gain": 1.02, "warm_up_time": 30.0}),
    )
    assert found.robot.drives is not None
    assert [float(part) for part in found.robot.drives.torque_drift] == [0, -0.06, 0, 0, 0, 0]
    assert [float(one) for one in found.robot.signals.torque_gain] == [1, 1.02, 1, 1, 1, 1]
    assert [float(one) for one in found.robot.signals.warm_up_time] == [NEVER, 30, NEVER, NEVER, NEVER, NEVER]
    with pytest.raises(InputError, match="emps has no drives, expected drives in the robot file"):
        repair("emps", Addition(DRIVE, "torque_drift", (1,), {"torque_drift": -0.06}))


@pytest.mark.parametrize("name", ["kr500", "tilted_two_link"])
def test_the_base_turns_about_the_worlds_axes(name: str) -> None:
    found = repair(name, Addition(BASE, "base_tilt", (), values={"tilt_x": 0.02, "tilt_y": -0.03}))
    before = np.array(robot_of(text_of(name), "x").base.evalf(), dtype=float)
    after = np.array(found.robot.base.evalf(), dtype=float)
    turn = after[:3, :3] @ before[:3, :3].T
    spin = np.array([[0, 0, -0.03], [0, 0, -0.02], [0.03, 0.02, 0]])
    np.testing.assert_allclose(turn, scipy.linalg.expm(spin), atol=1e-8)
    np.testing.assert_array_equal(after[:3, 3], before[:3, 3])


def test_elastic_joints_and_backlash() -> None:
    found = repair("kr300", Addition(ELASTIC, "joint_elasticity", (2,), {"gap": 1e-3}, {"k2": 1e6}))
    assert found.robot.flexible == (2,)
    assert ("joint_elasticity", 2) in uses(found.robot)
    more = repaired(found.text, "x", [Addition(ELASTIC, "joint_elasticity", (1,), {}, {"k1": 1e6})])
    assert more.robot.flexible == (1, 2)
    names = {p.name for p in derive(more.robot, names=("flexible_regressor",), check=False).parameters}
    assert {"k1", "k2", "Iam1"} <= names
    assert repair("kr500", Addition(ELASTIC, "joint_elasticity", (2,), {}, {"k2": 1e6})).text == text_of("kr500")


def test_an_elastic_drive_train_brings_its_rotor_where_none_is() -> None:
    """One that was found by itself is written first, whatever the order."""
    train = Addition(ELASTIC, "joint_elasticity", (2,), {}, {"Iam2": 3.0, "k2": 1e6})
    text = re.sub(r"\{effect: rotor_inertia, .*\}", "{effect: rotor_inertia, joint: 1}", text_of("scara"))
    found = repaired(text, "x", [train])
    assert uses(found.robot) == uses(robot_of(text, "x")) | {("rotor_inertia", 2)}
    assert "rotor_inertia of joint 2 comes with it: its part of the inertia is told by the swing" in found.notes
    by_itself = repaired(text, "x", [train, Addition(EFFECT, "rotor_inertia", (2,))])
    assert uses(by_itself.robot) == uses(found.robot)
    assert not any("rotor_inertia" in note for note in by_itself.notes)
    assert not any("rotor_inertia" in note for note in repair("scara", train).notes)


ELASTIC_ENTRIES = {
    "braces": ("  - {effect: joint_elasticity, joint: 1}  # soft", 0),
    "braces without values": ("  - {joints: [1], effect: joint_elasticity, values: {}}", 0),
    "lines": ("  - effect: joint_elasticity  # soft\n    joint: 1\n  # the end", 0),
    "several": ("  - {effect: joint_elasticity, joints: [2, 1, 3]}  # soft", 1),
    "all of them": ("  - effect: joint_elasticity\n    joints: all  # soft", 1),
    "among others": ("  - {effect: offset, joint: 1}\n  - {effect: joint_elasticity, joints: [1, 4]}", 1),
}


@pytest.mark.parametrize("entry", ELASTIC_ENTRIES)
def test_a_gap_goes_into_the_elasticity_that_is_there(entry: str) -> None:
    written, more = ELASTIC_ENTRIES[entry]
    head, middle, tail = text_of("scara").partition("effects:\n")
    text = with_value(f"{head}{middle}{written}\n{tail}", ("flexible",), "all")
    before = robot_of(text, "x")
    found = repaired(text, "x", [Addition(ELASTIC, "backlash", (1,), {"gap": 1e-3}, {"k1": 1e4}, "why")])
    gaps = {
        joint: [float(one.value) for one in use.values.values()]
        for use in found.robot.effects
        for joint in use.joints
        if use.effect == "joint_elasticity"
    }
    assert gaps == {joint: [1e-3] if joint == 1 else [] for use, joint in uses(before) if use == "joint_elasticity"}
    assert uses(found.robot) == uses(before)
    assert len(found.robot.effects) == len(before.effects) + more
    assert found.text.count("#") == text.count("#") + more
    assert not any("the file's stays" in note for note in found.notes)
    assert effects_of(found.robot)


def test_a_gap_of_the_file_stays() -> None:
    text = with_item(text_of("kr500"), "effects", "{effect: joint_elasticity, joint: 2, values: {gap: 1 mrad}}")
    found = repaired(text, "x", [Addition(ELASTIC, "backlash", (2,), {"gap": 2e-3})])
    assert found.text == text
    assert "joint 2 has the effect joint_elasticity already; the file's stays" in found.notes


def test_warm_friction_comes_with_a_word_on_the_warmth() -> None:
    """The file's own, if it has one."""
    found = repair("emps", warm := Addition(EFFECT, "warm_friction", (1,), {"warm_up_time": 70.0}))
    assert [float(one) for one in found.robot.signals.warm_up_time] == [70.0]
    told = repaired(text_of("emps") + "\nsignals: {warm_up_time: [900 s]}\n", "x", [warm])
    assert [float(one) for one in told.robot.signals.warm_up_time] == [900.0]
    assert ("warm_friction", 1) in uses(told.robot)


def test_each_drive_keeps_the_warmth_that_was_found_for_it() -> None:
    rubbing = [Addition(EFFECT, "warm_friction", (joint,), {"warm_up_time": 10.0 * joint}) for joint in (2, 3)]
    heat = {"torque_drift": -0.06, "torque_gain": 1.02, "warm_up_time": 20.0, "warm_torque": 5.0}
    drift = Addition(DRIVE, "torque_drift", (2,), heat)
    apart = repair("kr500", *rubbing)
    assert [float(one) for one in apart.robot.signals.warm_up_time] == [NEVER, 20, 30, NEVER, NEVER, NEVER]
    assert not apart.notes
    for additions in ([*rubbing, drift], [drift, *rubbing]):
        both = repair("kr500", *additions)
        assert [float(one) for one in both.robot.signals.warm_up_time] == [NEVER, 20, 30, NEVER, NEVER, NEVER]
        assert [float(one) for one in both.robot.signals.warm_torque] == [NEVER, 5, NEVER, NEVER, NEVER, NEVER]
        (said,) = [note for note in both.notes if "another warmth" in note]
        assert said.startswith("warm_friction of joint 2 was found by another warmth")


@pytest.mark.parametrize(("name", "unit"), [("emps", "N"), ("tilted_two_link", "N m")])
def test_a_warm_torque_is_of_what_the_motor_gives(name: str, unit: str) -> None:
    text = text_of(name) + f"\nsignals: {{warm_up_time: 60 s, warm_torque: 3 {unit}}}\n"
    assert {float(one) for one in robot_of(text, "x").signals.warm_torque} == {3.0}
    other = "N" if unit == "N m" else "N m"
    with pytest.raises(InputError, match=rf"'{other}' is the wrong unit, expected {unit}$"):
        robot_of(text.replace(f"3 {unit}", f"3 {other}"), "x")
    with pytest.raises(InputError, match=rf"warm_torque of joint 1 is 0 {unit}, expected a positive torque"):
        robot_of(text.replace(f"3 {unit}", f"0 {unit}"), "x")


def test_a_payload_leaves_the_text() -> None:
    found = repair("kr500", Addition(BODY, "payload", (6,), values={"M": 150.0}))
    assert found.text == text_of("kr500")
    assert "payload" in found.notes[0]


LAYOUTS = {
    "no section": ("gravity: [0 m/s2, 0 m/s2, -9.81 m/s2]\n", "parameters: {}\n# the end\n"),
    "empty list": ("effects: []   # nothing yet\n", ""),
    "one line": ("effects: [{effect: offset, joint: 1}]  # one\n", "flexible: [1]\n"),
    "lines with comments": (
        "effects:\n    # first\n    - effect: offset   # simple\n      joints: all\n\n    # last words\n",
        "flexible: [1]\n",
    ),
    "no end of line": ("effects:\n- effect: offset\n  joints: [1]", ""),
}


@pytest.mark.parametrize("layout", LAYOUTS)
def test_the_layout_stays(layout: str, tmp_path: Path) -> None:
    middle, end = LAYOUTS[layout]
    gravity = "" if "gravity" in middle else "gravity: [0 m/s2, 0 m/s2, -9.81 m/s2]\n"
    text = f"name: one\n{gravity}joints:\n  - {{j: 1, sigma: 0, alpha: 0, d: 0, theta: q1, r: 0}}\n{middle}{end}"
    found = with_item(text, "effects", "{effect: viscous_friction, joint: 1}", "why")
    assert ("viscous_friction", 1) in uses(robot_of(found, "x"))
    assert {one for one in text.split() if one.strip("[]}")} - set(found.split()) <= {"[{effect:", "1}]"}
    assert found.count("#") == text.count("#") + (layout != "one line")
    once = with_value(found, ("signals", "torque_delay"), "[1 ms]")
    twice = with_value(once, ("signals", "torque_delay"), "2 ms")
    assert float(robot_of(twice, "x").signals.torque_delay[0]) == 2e-3
    assert twice.replace("2 ms", "[1 ms]") == once


SECTIONS = {
    "braces": '{"name": "one", "gravity": DOWN, "joints": [ONE]}\n',
    "braces with empty sections": '{name: one, gravity: DOWN, joints: [ONE], "effects": [], signals: {}, base: {}}\n',
    "braces over lines": "{\n name: one,\n gravity: DOWN,\n joints: [ONE],\n effects: [{effect: offset, joint: 1}]}\n",
    "all of it indented": "  name: one\n  gravity: DOWN\n  joints:\n    - ONE\n  # the end\n",
    "indented, empty": "  name: one\n  gravity: DOWN\n  joints: [ONE]\n  effects: []\n  signals: {}\n",
}


@pytest.mark.parametrize("text", SECTIONS.values(), ids=SECTIONS)
def test_sections_find_their_place_in_any_layout(text: str) -> None:
    text = text.replace("DOWN", '["0 m/s2", "0 m/s2", "-9.81 m/s2"]')
    text = text.replace("ONE", '{"j": 1, "sigma": 0, "alpha": 0, "d": 0, "theta": "q1", "r": 0}')
    additions = [
        Addition(EFFECT, "viscous_friction", (1,), evidence="why"),
        Addition(SIGNAL, "torque_delay", (1,), {"torque_delay": 0.008}),
        Addition(BASE, "base_tilt", (), {"tilt_x": 0.02}),
        Addition(ELASTIC, "joint_elasticity", (1,), {}, {"k1": 1e4}),
    ]
    for count in range(1, len(additions) + 1):
        robot = repaired(text, "x", additions[:count]).robot
    assert ("viscous_friction", 1) in uses(robot)
    assert [float(one) for one in robot.signals.torque_delay] == [0.008]
    assert robot.flexible == (1,)
    assert float(robot.base[2, 1]) == pytest.approx(np.sin(0.02))


def test_a_value_in_nothing_is_refused() -> None:
    with pytest.raises(KeyError):
        with_value(text_of("emps"), ("drives", "torque_constants", "unit"), "N m/A")
