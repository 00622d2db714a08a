"""The laws of the effects: closed forms, limits, passivity, what they ask of a robot file; every one, in every way."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from decimal import Decimal
from pathlib import Path

import numpy as np
import pytest
from sympy import Integer, Rational, pi

from generator.derivation import derive
from generator.effects.library import effects_of, library
from generator.errors import InputError, Place
from generator.reference.joint_effects import LAWS
from generator.reference.law import At
from generator.robot.description import PRISMATIC, REVOLUTE, EffectUse, Length, ParameterValue, Robot
from generator.robot.readers import read
from generator.symbolic.interpret import evaluate
from generator.symbolic.model import Model
from generator.symbolic.parameter_sets import parameter_vector
from generator.units import Quantity
from tests.chains import STANDARD_GRAVITY, every_effect, joint, robot, symbol
from tests.effects_page import PATH, with_library
from tests.subject import Vector

#: An arm that hangs on a horizontal axis: x is across gravity at q = 0.
ARM = """
name: arm
gravity: [0 m/s2, 0 m/s2, -10 m/s2]
joints:
  - {{j: 1, sigma: 0, alpha: pi/2, d: 0, theta: q1, r: 0}}
  - {{j: 2, sigma: 2, alpha: 0, d: 0.5 m, theta: 0, r: 0, tool: true}}
drives: {{gear_ratios: [50]}}
effects:
  - {{effect: {effect}, joint: 1, values: {{{values}}}}}
"""


def arm(tmp_path: Path, effect: str, values: str = "", *others: str) -> Model:
    """A pendulum with one effect and ``others`` without values, its inverse dynamics and the effects' rates."""
    path = tmp_path / "arm.yaml"
    more = "".join(f"  - {{effect: {other}, joint: 1}}\n" for other in others)
    path.write_text(ARM.format(effect=effect, values=values) + more)
    return derive(read(path), ("inverse_dynamics", "inverse_dynamics_loaded", "direct_dynamics", "effect_rates"))


def call(model: Model, name: str, parameters: Mapping[str, float], **inputs: object) -> Vector:
    """The output of a function of an arm whose parameters, but for the effect's, are given too or zero."""
    given = {key: ParameterValue(value, "") for key, value in parameters.items()}
    n = len(np.atleast_1d(inputs["qd"]))  # type: ignore[arg-type]
    zero = {"q": 0.0, "qdd": 0.0, "states": 0.0, "warmth": 0.0}
    signals = {key: np.broadcast_to(inputs.get(key, value), n)[:, None] for key, value in zero.items()}
    signals["qd"] = np.atleast_1d(inputs["qd"])[:, None]  # type: ignore[call-overload]
    signals |= {key: np.atleast_2d(value) for key, value in inputs.items() if key not in signals}
    (result,) = evaluate(model.functions[name], {**signals, "parameters": parameter_vector(model, given)}).values()
    return result[:, 0]


def torque(model: Model, parameters: Mapping[str, float], **inputs: object) -> Vector:
    return call(model, "inverse_dynamics", parameters, **inputs)


SPEEDS = np.array([-2.0, -0.1, 0.0, 0.3, 5.0])


def test_every_effect_has_a_second_law_and_is_on_the_robot_that_has_all() -> None:
    assert set(library()) == set(LAWS) == {use.effect for use in every_effect().effects}


def test_the_page_of_the_library_is_that_of_today() -> None:
    text = PATH.read_text(encoding="utf-8")
    assert with_library(text) == text, "`python -m tests.effects_page` rewrites it"


def test_every_effect_is_stated_completely() -> None:
    for effect in library().values():
        assert effect.sign_convention, effect.id
        assert effect.source, effect.id
        assert len(effect.states) == 0 or effect.rates is not None, effect.id
        assert ("state" in effect.needs) == bool(effect.states), effect.id
        for parameter in effect.parameters:
            assert parameter.meaning, effect.id


def test_stems_are_no_others_and_end_in_no_digit_but_the_reports() -> None:
    stems = [p.stem for effect in library().values() for p in effect.parameters]
    stems += [state.stem for effect in library().values() for state in effect.states]
    assert len(stems) == len(set(stems))
    assert {stem for stem in stems if stem[-1].isdigit()} == {"K0", "F0"}


def test_asymmetric_friction(tmp_path: Path) -> None:
    viscous = torque(arm(tmp_path, "asymmetric_viscous"), {"Fvp1": 3, "Fvn1": 7}, qd=SPEEDS)
    assert viscous == pytest.approx([-14, -0.7, 0, 0.9, 15])
    coulomb = torque(arm(tmp_path, "asymmetric_coulomb"), {"Fcp1": 3, "Fcn1": 7}, qd=SPEEDS)
    assert coulomb == pytest.approx([-7, -7, -2, 3, 3])


@pytest.mark.parametrize(("exponent", "expected"), [("2", 12 * 4), ("1", 12 * 2), ("1/2", 12 * 2**0.5)])
def test_power_friction(tmp_path: Path, exponent: str, expected: float) -> None:
    model = arm(tmp_path, "power_friction", f"v: 0.5 rad/s, exponent: {exponent}")
    assert torque(model, {"Fp1": 12}, qd=[-1, 0, 0.5, 1]) == pytest.approx([-expected, 0, 12, expected])


def test_stribeck_friction_falls_from_rest(tmp_path: Path) -> None:
    model = arm(tmp_path, "stribeck_friction", "vs: 0.1 rad/s")
    assert torque(model, {"Fst1": 5}, qd=[0, 1e-9, 0.1, -0.1, 3]) == pytest.approx(
        [0, 5, 5 / np.e, -5 / np.e, 0], abs=1e-12
    )
    tustin = torque(arm(tmp_path, "stribeck_friction", "vs: 0.1 rad/s, exponent: 1"), {"Fst1": 5}, qd=[0.2])
    assert tustin == pytest.approx(5 * np.exp(-2))


def test_gradual_friction_rises_from_rest(tmp_path: Path) -> None:
    model = arm(tmp_path, "gradual_friction", "v0: 0.01 rad/s")
    assert torque(model, {"Fg1": 5}, qd=[0, 1e-4, 0.01, 1, -1]) == pytest.approx(
        [0, 5 * np.tanh(0.01), 5 * np.tanh(1), 5, -5]
    )


@pytest.mark.parametrize("speed", [1e-9, 3e-7, 2.0, -2.0])
def test_friction_of_the_lowest_speeds_has_its_second_law(speed: float) -> None:
    """At 2 rad/s the ratio to the speed of 1e-7 rad/s is beyond what an exponential of decimals can be of."""
    shape = {"v0": Decimal("1e-7"), "vs": Decimal("1e-7"), "exponent": Decimal(2)}
    at = At(shape, Decimal(0), Decimal(speed), Decimal(0), Decimal(np.sign(speed)), Decimal(1))
    (gradual,), (stribeck,) = (LAWS[name].torque(at) for name in ("gradual_friction", "stribeck_friction"))
    assert float(gradual) == pytest.approx(np.tanh(speed / 1e-7), rel=1e-12)
    assert float(stribeck) == pytest.approx(np.sign(speed) * np.exp(-((speed / 1e-7) ** 2)), rel=1e-12)


def test_load_friction_is_a_part_of_the_load(tmp_path: Path) -> None:
    model = arm(tmp_path, "load_friction")
    weight = {"MX1": 3, "ZZ1": 2}
    q = np.array([0, 0, np.pi / 3, np.pi, 0])
    load = 10 * 3 * np.cos(q) + 2 * 4
    without = torque(model, weight, q=q, qd=SPEEDS, qdd=4)
    rubbing = torque(model, {**weight, "Fl1": 0.1}, q=q, qd=SPEEDS, qdd=4) - without
    assert without == pytest.approx(load)
    assert rubbing == pytest.approx(0.1 * np.sign(SPEEDS) * np.abs(load))
    # A wrench and a payload of the tool load the transmission too; here they take the whole load away.
    nothing = {"wrench": [0, -60, 0, 0, 0, 0], "payload": np.zeros(10)}
    held = call(model, "inverse_dynamics_loaded", {**weight, "Fl1": 0.1}, qd=[1.0], **nothing)
    assert held == pytest.approx(0, abs=1e-9)
    hung = {"wrench": np.zeros(6), "payload": [0, 0, 0, 0, 0, 0, 0, 0, 0, 2]}
    held = call(model, "inverse_dynamics_loaded", {**weight, "Fl1": 0.1}, qd=[1.0], **hung)
    assert held == pytest.approx(1.1 * 10 * (3 + 2 * 0.5))


@pytest.mark.parametrize(
    ("speed", "tau", "load"), [(1, 55, 50), (1, -45, -50), (-1, 45, 50), (-1, -55, -50), (0, 7, 7)]
)
def test_a_drive_moves_what_load_friction_leaves(tmp_path: Path, speed: float, tau: float, load: float) -> None:
    model = arm(tmp_path, "load_friction")
    (qdd,) = call(model, "direct_dynamics", {"MX1": 3, "ZZ1": 2, "Fl1": 0.1}, qd=[speed], tau=[tau])
    assert qdd == pytest.approx((load - 30) / 2)


@pytest.mark.parametrize("speed", [1.0, -1.0])
@pytest.mark.parametrize("qdd", [-9.0, -5.0, 1.0, 20.0])
def test_a_rotor_does_not_load_its_transmission(tmp_path: Path, speed: float, qdd: float) -> None:
    """Of 5 kg m2 the rotor is 3.5: what the gear carries is 30 + 1.5 qdd, and changes its sign at -20 rad/s2."""
    model = arm(tmp_path, "load_friction", "rotor: 3.5 kg m2")
    values = {"MX1": 3, "ZZ1": 5, "Fl1": 0.2}
    tau = 30 + 5 * qdd + 0.2 * speed * abs(30 + 1.5 * qdd)
    assert torque(model, values, qd=[speed], qdd=qdd) == pytest.approx(tau)
    assert call(model, "direct_dynamics", values, qd=[speed], tau=[tau]) == pytest.approx(qdd)
    # The arm hangs the other way: the gear carries -30 + 1.5 qdd.
    tau = -30 + 5 * qdd + 0.2 * speed * abs(-30 + 1.5 * qdd)
    assert torque(model, values, q=np.pi, qd=[speed], qdd=qdd) == pytest.approx(tau)
    assert call(model, "direct_dynamics", values, q=np.pi, qd=[speed], tau=[tau]) == pytest.approx(qdd)


def one_slide(*effects: EffectUse) -> Robot:
    return robot("slide", (joint(1, PRISMATIC),), gravity=STANDARD_GRAVITY, effects=effects)


def test_a_slide_is_loaded_by_its_acceleration_too() -> None:
    both = Model(one_slide(EffectUse("coulomb_friction", (1,)), EffectUse("load_friction", (1,))))
    assert [parameter.name for parameter in both.base_parameters] == ["M1", "Fc1", "Fl1"]


def test_position_friction(tmp_path: Path) -> None:
    model = arm(tmp_path, "position_friction", "order: 2")
    q = np.array([0.3, 0.3, 0.3, 0.8, 0.8])
    expected = np.sign(SPEEDS) * (2 * np.cos(2 * q) - 3 * np.sin(2 * q) + 0.4 * np.cos(4 * q) + 0.7 * np.sin(4 * q))
    values = {"Fqc1": 2, "Fqs1": -3, "Fq2c1": 0.4, "Fq2s1": 0.7}
    assert torque(model, values, q=q, qd=SPEEDS) == pytest.approx(expected)


@pytest.mark.parametrize(
    ("effect", "stem", "order"), [("motor_ripple", "Rm", 50), ("wave_generator_ripple", "Rw", 100)]
)
def test_ripple_follows_the_motor(tmp_path: Path, effect: str, stem: str, order: int) -> None:
    q = np.linspace(-1, 1, 5)
    first, second = order * q, 2 * order * q
    expected = 2 * np.cos(first) - 3 * np.sin(first) + 0.5 * np.cos(second) + 0.7 * np.sin(second)
    values = {f"{stem}c1": 2, f"{stem}s1": -3, f"{stem}2c1": 0.5, f"{stem}2s1": 0.7}
    found = torque(arm(tmp_path, effect), values, q=q, qd=SPEEDS)
    assert found == pytest.approx(expected, abs=1e-12)


def test_coupled_motors_share_their_ripple_by_equal_power() -> None:
    made = every_effect()
    (wrist,) = (one for one in effects_of(made) if one.effect.id == "motor_ripple" and one.joint.number == 2)
    cosine, *_ = wrist.columns()
    assert set(cosine) == {1, 2}
    assert (cosine[1] / cosine[2]).equals(Rational(5, 4) / Rational(-165, 4))


def test_ripple_of_a_motor_needs_drives(tmp_path: Path) -> None:
    path = tmp_path / "arm.yaml"
    path.write_text(ARM.format(effect="motor_ripple", values="").replace("drives: {gear_ratios: [50]}\n", ""))
    with pytest.raises(InputError, match=r":8:14: effect motor_ripple needs the motor's position"):
        derive(read(path), ())


def test_a_value_has_the_unit_of_its_joint() -> None:
    speed = {"vs": Quantity(Rational(1, 10), "rad/s")}
    with pytest.raises(InputError, match="vs is given in rad/s, expected a value in m/s"):
        effects_of(one_slide(EffectUse("stribeck_friction", (1,), speed)))


@pytest.mark.parametrize("other", [1, 2, 7])
def test_the_other_joint_of_a_rotor_is_another_that_moves(other: int) -> None:
    values = {"other": Quantity(Integer(other), "1"), "ratio": Quantity(Integer(1), "1")}
    with pytest.raises(InputError, match=f"other of joint 1 is {other}, expected a second joint"):
        effects_of(one_slide(EffectUse("coupled_rotor", (1,), values)))


def test_a_rotor_that_the_other_joint_does_not_turn_is_its_own_joints_rotor() -> None:
    values = {"other": Quantity(Integer(2), "1"), "ratio": Quantity(Integer(0), "1", Place("arm.yaml", 9, 5))}
    two = (joint(1, REVOLUTE), joint(2, REVOLUTE, pi / 2))
    with pytest.raises(InputError, match=r"^arm.yaml:9:5: ratio is 0, expected a number other than zero$"):
        effects_of(robot("arm", two, effects=(EffectUse("coupled_rotor", (1,), values),)))


def test_a_rotor_that_bodies_imitate_by_symbolic_lengths_is_refused() -> None:
    values = {"other": Quantity(Integer(1), "1"), "ratio": Quantity(Rational(4, 5), "1")}
    joints = (joint(1, REVOLUTE), joint(2, PRISMATIC, pi / 2, d=symbol("a1")))
    behind = EffectUse("rotor_inertia", (1, 2), place=Place("jib.yaml", 12))
    uses = (EffectUse("coupled_rotor", (2,), values, Place("jib.yaml", 11)), behind)
    made = robot("jib", joints, effects=uses, lengths=[Length("a1", Rational(1, 4))])
    assert any(Model(made).grouping.coefficients("Iar2"))
    symbolic = replace(made, lengths=(Length("a1", Rational(1, 4), symbolic=True),))
    with pytest.raises(InputError, match=r"jib.yaml:11:1: Iar2 is grouped with other parameters by symbolic lengths"):
        _ = Model(symbolic).grouping


@pytest.mark.parametrize(("effect", "value"), [("gradual_friction", "v0"), ("stribeck_friction", "vs")])
@pytest.mark.parametrize("speed", ["0.005", "0.0001"])
def test_friction_of_the_lowest_speeds_is_no_other_friction(
    effect: str, value: str, speed: str, tmp_path: Path
) -> None:
    """Beyond the highest of them it is dry friction, or nothing."""
    model = arm(tmp_path, effect, f"{value}: {speed} rad/s", "coulomb_friction")
    (name, *_) = next(one for one in model.effects if one.effect.id == effect).names
    assert name in {base.head for base in model.grouping.base}
    assert all(name not in {part for _, part in base.terms[1:]} for base in model.grouping.base)


def test_a_default_may_be_told_too(tmp_path: Path) -> None:
    """It is at the bound that other values keep off."""
    (friction,) = arm(tmp_path, "load_friction", "rotor: 0 kg m2").effects
    assert friction.site.values == {"rotor": 0}


def test_friction_without_a_torque_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"arm.yaml:\d+:\d+: the torque of Fst1 vanishes at every speed from 1e-9 on"):
        arm(tmp_path, "stribeck_friction", "vs: 1e-12 rad/s")


def test_what_loads_a_drive_and_what_does_not_are_not_grouped_under_friction_by_the_load(tmp_path: Path) -> None:
    """An offset loads it, asymmetric dry friction does not, and the torque of both is the same."""
    model = arm(tmp_path, "offset", "", "asymmetric_coulomb")
    assert "Off1R" in {base.name for base in model.grouping.base}
    told = "the torque of Fcn1 is one that Off1 makes too, and friction by the load tells them apart"
    with pytest.raises(InputError, match=told):
        arm(tmp_path, "offset", "", "asymmetric_coulomb", "load_friction")


def test_a_joint_has_one_balancer() -> None:
    made = every_effect()
    doubled = replace(made, effects=(*made.effects, replace(made.effects[0], joints=(2,))))
    with pytest.raises(InputError, match="joint 2 has two balancers"):
        effects_of(doubled)


def test_warm_friction_drifts_with_the_warmth(tmp_path: Path) -> None:
    model = arm(tmp_path, "warm_friction")
    found = torque(model, {"Fvw1": -2, "Fcw1": -3}, qd=SPEEDS, warmth=[0, 0.5, 1, 1, 0.5])
    assert found == pytest.approx([0, 0.5 * (0.2 + 3), 0, -0.6 - 3, 0.5 * (-10 - 3)])


# -- states -----------------------------------------------------------------------------------------------------------

#: Values of the effects with a state: presliding within 0.01 rad.
STATEFUL = {
    "dahl_friction": ("xs: 0.01 rad", {"Fd1": 8.0}),
    "lugre_friction": ("xs: 0.01 rad, excess: 0.5, vs: 0.2 rad/s", {"Fz1": 8.0}),
    "hysteresis": ("xs: 0.01 rad", {"Fh1": 8.0}),
}


def test_every_effect_with_a_state_is_integrated_here() -> None:
    assert {effect.id for effect in library().values() if effect.states} == set(STATEFUL)


def pushed(model: Model, parameters: Mapping[str, float], speeds: Vector, dt: float) -> tuple[Vector, Vector]:
    """State and torque along a motion of given speeds, the state from zero by Heun's rule."""
    state, states, torques = 0.0, [], []
    for qd in speeds:
        rate = call(model, "effect_rates", {}, qd=[qd], states=state)[0]
        ahead = call(model, "effect_rates", {}, qd=[qd], states=state + rate * dt)[0]
        state += (rate + ahead) / 2 * dt
        states.append(state)
        torques.append(torque(model, parameters, qd=[qd], states=state)[0])
    return np.array(states), np.array(torques)


@pytest.mark.parametrize("effect", STATEFUL)
def test_a_long_motion_ends_at_coulombs_friction(tmp_path: Path, effect: str) -> None:
    values, parameters = STATEFUL[effect]
    model = arm(tmp_path, effect, values)
    for direction in (1, -1):
        _, torques = pushed(model, parameters, np.full(200, direction * 1.0), 0.001)
        assert torques[-1] == pytest.approx(8.0 * direction, rel=1e-3)


@pytest.mark.parametrize("effect", STATEFUL)
def test_a_small_push_is_a_spring(tmp_path: Path, effect: str) -> None:
    values, parameters = STATEFUL[effect]
    _, torques = pushed(arm(tmp_path, effect, values), parameters, np.full(10, 1e-3), 0.001)
    assert torques[-1] == pytest.approx(8.0 / 0.01 * 1e-5, rel=1e-2)


@pytest.mark.parametrize("effect", STATEFUL)
def test_a_cycle_takes_work_and_no_part_of_it_gives_any(tmp_path: Path, effect: str) -> None:
    values, parameters = STATEFUL[effect]
    t = np.linspace(0, 2, 801)
    speeds = 0.05 * np.cos(2 * np.pi * t)
    states, torques = pushed(arm(tmp_path, effect, values), parameters, speeds, t[1])
    stored = 8.0 * 0.01 * states**2 / 2
    spent = np.cumsum(torques * speeds) * t[1]
    assert np.diff(spent - stored).min() > -1e-6
    assert (spent - stored)[-1] > 0.01


def test_bristles_stick_better_at_rest_than_they_slide(tmp_path: Path) -> None:
    values, parameters = STATEFUL["lugre_friction"]
    model = arm(tmp_path, "lugre_friction", values)
    _, slow = pushed(model, parameters, np.full(400, 0.004), 0.1)
    assert slow[-1] == pytest.approx(8.0 * 1.5, rel=1e-3)
    damped = torque(model, {"Dz1": 3}, qd=[0.4], states=0.0)
    assert damped == pytest.approx(3 * 0.4)


def test_states_are_in_the_manifest_and_only_where_they_are_read(tmp_path: Path) -> None:
    model = arm(tmp_path, "dahl_friction", "xs: 1 mrad")
    inputs = {name: [signal.name for signal in f.inputs] for name, f in model.functions.items()}
    assert inputs["inverse_dynamics"] == ["q", "qd", "qdd", "states"]
    assert inputs["effect_rates"] == ["q", "qd", "states"]
    assert [state.name for state in model.effect_states] == ["zd1"]


# -- backlash ---------------------------------------------------------------------------------------------------------

LOOSE = ARM.replace("effects:", "flexible: all\neffects:")


def test_a_spring_pulls_beyond_its_gap_alone(tmp_path: Path) -> None:
    path = tmp_path / "loose.yaml"
    path.write_text(LOOSE.format(effect="joint_elasticity", values="gap: 2 mrad"))
    model = derive(read(path), ("flexible_inverse_dynamics",))
    parameters = parameter_vector(model, {"k1": ParameterValue(1e4, "")})
    elongations = np.array([-5e-3, -1e-3, -2e-4, 0, 1e-3, 1.5e-3])
    q = np.stack([np.full(6, 0.3), elongations], axis=1)
    inputs = {"q": q, "qd": 0 * q, "qdd": 0 * q, "parameters": parameters}
    found = evaluate(model.functions["flexible_inverse_dynamics"], inputs)["tau_mdi"][:, 0]
    assert found == pytest.approx([40, 0, 0, 0, 0, -5], abs=1e-9)


def test_backlash_needs_an_elastic_drive_train(tmp_path: Path) -> None:
    path = tmp_path / "stiff.yaml"
    path.write_text(ARM.format(effect="joint_elasticity", values="gap: 2 mrad"))
    with pytest.raises(
        InputError, match=":9:14: the drive train of joint 1 is not elastic, expected a joint of flexible"
    ):
        derive(read(path), ())


def test_a_gap_is_not_negative(tmp_path: Path) -> None:
    path = tmp_path / "loose.yaml"
    path.write_text(LOOSE.format(effect="joint_elasticity", values="gap: -2 mrad"))
    with pytest.raises(InputError, match="gap is -1/500"):
        derive(read(path), ())
