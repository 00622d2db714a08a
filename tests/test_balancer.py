"""Gravity balancers: statics against energy, geometry with the right quadrant, and the numbers of the report."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from math import asin, atan, atan2, cos, pi, sin
from pathlib import Path

import numpy as np
import pytest
from sympy import Integer, Rational

from generator.errors import InputError
from generator.resources import find_robot
from generator.robot.description import EffectUse, Robot
from generator.robot.readers import read
from generator.units import Quantity
from tests.chains import anthropomorphic
from tests.commands import PENDULUM, command
from tests.subject import Subject, Vector, close, slope, subject

#: Balancer, inverse model and energy are all that these tests need.
QUANTITIES = ("balancer", "inverse_dynamics", "potential_energy", "regressor")

#: d21, d22 [m] and phi [rad] of report section 2.3.4, by robot.
CRANKS = {"kr270": (0.6964, 0.1847, -1.6148), "kr500": (0.9669, 0.2062, -1.6293)}


def with_exponent(robot: Robot, exponent: Rational | Integer) -> Robot:
    """The robot with another polytropic exponent of its gas balancer."""

    def changed(use: EffectUse) -> EffectUse:
        if use.effect != "gas_balancer":
            return use
        return replace(use, values={**use.values, "exponent": Quantity(exponent, "1")})

    return replace(robot, effects=tuple(map(changed, robot.effects)))


@cache
def of_file(name: str) -> Subject:
    return subject(read(find_robot(name)), names=QUANTITIES)


@cache
def gas(exponent: Rational | Integer) -> Subject:
    """The KR500 with this exponent."""
    return subject(with_exponent(read(find_robot("kr500")), exponent), names=QUANTITIES)


def made_up(kind: str) -> Subject:
    """Report Table 4's structure with a balancer of another size on joint 3."""
    lengths = {name: Rational(k + 3, 10) for k, name in enumerate(("d2", "d3", "d4", "rl1", "rl4", "rl6"))}
    values = {"d21": Quantity(Rational(3, 10), "m"), "d22": Quantity(Rational(9, 10), "m")}
    values["phi"] = Quantity(Rational(6, 5), "rad")
    if kind == "gas_balancer":
        values |= {"l0": Quantity(Integer(1), "m"), "exponent": Quantity(Rational(7, 5), "1")}
    return subject(anthropomorphic(kind, lengths, EffectUse(kind, (3,), values)), names=QUANTITIES)


MAKERS: dict[str, Callable[[], Subject]] = {
    "spring": lambda: of_file("kr270"),
    "isotherm": lambda: of_file("kr500"),
    "polytrope": lambda: gas(Rational(13, 10)),
    "spring on joint 3": lambda: made_up("spring_balancer"),
    "polytrope on joint 3": lambda: made_up("gas_balancer"),
}


@pytest.fixture(scope="module", params=[*MAKERS])
def balanced(request: pytest.FixtureRequest) -> Subject:
    """Arms with a balancer of each kind."""
    return MAKERS[request.param]()


def balancer_use(arm: Subject) -> EffectUse:
    """The effect of the arm that is a balancer."""
    return next(use for use in arm.robot.effects if use.effect.endswith("_balancer"))


def axis(arm: Subject) -> Vector:
    """The balanced joint's direction in q."""
    (number,) = balancer_use(arm).joints
    return np.eye(arm.dof)[number - 1]


def around_dead_centres(arm: Subject) -> list[float]:
    """Positions of the balanced joint close to both dead centres, on either side, and elsewhere."""
    phi = float(balancer_use(arm).values["phi"].value)
    return [centre - phi + offset for centre in (0.0, pi, -pi) for offset in (-1.3, -0.2, -0.01, 0.01, 0.2, 1.3)]


def observed(arm: Subject, x: float) -> dict[str, float]:
    """Length, force and torque at position ``x`` of the balanced joint."""
    return {name: float(value) for name, value in arm.generated("balancer", {"q": x * axis(arm)}).items()}


def pull(arm: Subject, x: float) -> float:
    """The balancer's part of the inverse dynamic model."""
    alone = arm.only("Kr", "K0", "F0")
    q = x * axis(arm)
    tau = alone.output("inverse_dynamics", q=q, qd=0 * q, qdd=0 * q)
    assert not (tau * (1 - axis(arm))).any()
    return float(tau @ axis(arm))


def test_torque_is_the_derivative_of_the_energy(balanced: Subject) -> None:
    alone = balanced.only("Kr", "K0", "F0")
    for x in around_dead_centres(balanced):
        torque = slope(lambda t, x=x: alone.output("potential_energy", q=(x + t) * axis(balanced)))
        scale = abs(observed(balanced, x)["force"])
        assert abs(torque - observed(balanced, x)["torque"]) < 1e-9 * scale


def test_torque_is_force_times_the_derivative_of_the_length(balanced: Subject) -> None:
    for x in around_dead_centres(balanced):
        seen = observed(balanced, x)
        arm_of_lever = slope(lambda t, x=x: observed(balanced, x + t)["length"])
        assert abs(seen["torque"] - seen["force"] * arm_of_lever) < 1e-9 * abs(seen["force"])


def test_torque_adds_to_the_inverse_model(balanced: Subject) -> None:
    for x in around_dead_centres(balanced):
        assert abs(pull(balanced, x) - observed(balanced, x)["torque"]) < 1e-9 * abs(observed(balanced, x)["force"])


def test_torque_changes_sign_at_dead_centre(balanced: Subject) -> None:
    phi = float(balancer_use(balanced).values["phi"].value)
    for centre in (0.0, pi):
        before, after = (observed(balanced, centre - phi + x) for x in (-0.05, 0.05))
        assert before["torque"] * before["force"] * after["torque"] * after["force"] < 0
        assert abs(observed(balanced, centre - phi)["torque"]) < 1e-9 * abs(before["force"])


def angles(crank: tuple[float, float, float], x: float) -> tuple[float, float]:
    """q23 of report eq. 24 with its quadrant, and as eq. 29 prints it."""
    d21, d22, phi = crank
    across, along = d21 + d22 * cos(phi + x), d22 * sin(phi + x)
    return atan2(across, -along), atan(-across / along)


def lever(crank: tuple[float, float, float], q23: float, x: float) -> float:
    """d22 sin(psi) with psi of report eq. 21."""
    return crank[1] * sin(q23 - (crank[2] + x) - pi / 2)


@pytest.mark.parametrize("name", CRANKS)
def test_torque_is_the_reports_with_the_quadrant_kept(name: str) -> None:
    arm = of_file(name)
    for x in np.linspace(-2.6, 0.6, 41):
        seen = observed(arm, x)
        q23, _ = angles(CRANKS[name], x)
        assert close(seen["torque"], seen["force"] * lever(CRANKS[name], q23, x), 1e-9)


@pytest.mark.parametrize(("name", "dead_centre"), [("kr270", -87.5), ("kr500", -86.7)])
def test_the_printed_arctangent_is_wrong_beyond_dead_centre(name: str, dead_centre: float) -> None:
    arm = of_file(name)
    crank = CRANKS[name]
    assert close(np.degrees(-pi - crank[2]), dead_centre, 1e-3)
    for x in (-1.2, -1.8):
        _, printed = angles(crank, x)
        seen = observed(arm, x)
        sign = 1.0 if x > -pi - crank[2] else -1.0
        assert close(seen["force"] * lever(crank, printed, x), sign * seen["torque"], 1e-9)


def test_length_is_the_law_of_cosines(balanced: Subject) -> None:
    d21, d22, phi = (float(balancer_use(balanced).values[name].value) for name in ("d21", "d22", "phi"))
    for x in around_dead_centres(balanced):
        pivots = np.array([-d21, 0.0]), d22 * np.array([cos(phi + x), sin(phi + x)])
        assert close(observed(balanced, x)["length"], np.linalg.norm(pivots[1] - pivots[0]))


def test_spring_force_is_linear_in_the_length() -> None:
    arm = of_file("kr270")
    for x in (-2.0, -0.4, 0.0):
        seen = observed(arm, x)
        assert close(seen["force"], arm.values["Kr2"] * seen["length"] + arm.values["K02"])


def test_printed_spring_offset_pushes_and_the_tenth_of_it_carries_the_arm() -> None:
    arm = of_file("kr270")
    printed, tenth = (arm.with_values({"Kr2": 3.95e4, "K02": offset}) for offset in (-7.38e4, -7.38e3))
    lower, upper = (float(arm.robot.joints[1].lower), float(arm.robot.joints[1].upper))  # type: ignore[arg-type]
    reach = np.linspace(lower, upper, 200)
    pushing, pulling = ([observed(one, x)["force"] for x in reach] for one in (printed, tenth))
    assert max(pushing) < -45e3
    assert min(pulling) > 12e3
    assert 3.6e3 < observed(tenth, 0.0)["torque"] < 3.8e3


@pytest.mark.parametrize("exponent", [Integer(1), Rational(13, 10), Rational(7, 5)])
def test_gas_keeps_force_times_volume_to_the_exponent(exponent: Rational | Integer) -> None:
    arm = gas(exponent)
    at_zero, F0 = observed(arm, 0.0), arm.values["F02"]
    assert close(at_zero["force"], F0)
    for x in (-2.2, -1.0, 0.3):
        seen = observed(arm, x)
        chamber = 0.5 - seen["length"] + at_zero["length"]
        assert close(seen["force"] * chamber ** float(exponent), F0 * 0.5 ** float(exponent))


def test_isotherm_is_the_limit_of_polytropes() -> None:
    isotherm = of_file("kr500").only("F0")
    near = [gas(1 + Rational(1, 10**k)).only("F0") for k in (4, 6)]
    for name in ("potential_energy", "balancer"):
        for x in (-2.2, -1.0, 0.3):
            limit = np.array(list(isotherm.generated(name, {"q": x * axis(isotherm)}).values()))
            coarse, fine = (np.array(list(arm.generated(name, {"q": x * axis(arm)}).values())) - limit for arm in near)
            assert np.abs(coarse).max() < 1e-3 * np.abs(limit).max()
            # The distance shrinks with exponent - 1, by a hundred here. The energy is a difference of terms of
            # F0 l0 / (exponent - 1), whose rounding the hundred takes along.
            rounding = 100 * np.finfo(float).eps * isotherm.values["F02"] * 0.5 / 1e-6
            np.testing.assert_allclose(fine * 100, coarse, rtol=1e-3, atol=rounding)


def test_spring_stiffness_hides_in_the_weight_of_the_arm_at_rest() -> None:
    # Kr's column is -d21 d22 sin(phi + q2), MX2R's and MY2's are g cos q2 and g sin q2 up to sign.
    arm = of_file("kr270")
    names = list(arm.base_values)
    states = [arm.state(seed)[0] for seed in range(40)]
    rest = np.concatenate([arm.output("regressor", q=q, qd=0 * q, qdd=0 * q) for q in states])
    weight, stiffness, preload = (
        rest[:, [names.index("MX2R"), names.index("MY2")]],
        *rest[:, [names.index("Kr2"), names.index("K02")]].T,
    )
    for column, hidden in ((stiffness, True), (preload, False)):
        left = column - weight @ np.linalg.lstsq(weight, column)[0]
        assert (np.linalg.norm(left) < 1e-10 * np.linalg.norm(column)) == hidden


def test_the_lever_arm_is_largest_where_the_rod_is_tangent_to_the_crank() -> None:
    d21, d22, phi = CRANKS["kr500"]
    arm = of_file("kr500").only("F0")
    tangent = pi / 2 + asin(d22 / d21)
    for side in (1.0, -1.0):
        x = side * tangent - phi
        seen = observed(arm, x)
        assert close(abs(seen["torque"]), seen["force"] * d22, 1e-9)


def balancer(tmp_path: Path, effect: str, values: str, limits: str = "") -> Path:
    """A pendulum with a balancer; ``limits`` of its joint."""
    path = tmp_path / "pendulum.yaml"
    use = f"  - {{effect: {effect}, joint: 1, values: {{{values}}}}}\n"
    text = PENDULUM.replace("parameters:", f"{use}parameters:")
    path.write_text(text.replace("r: 0}", f"r: 0, limits: [{limits}]}}" if limits else "r: 0}"))
    return path


def test_a_chamber_does_not_end_between_the_limits(tmp_path: Path) -> None:
    """At q = 1 the pivots are 0.0361 m further apart than at q = 0, at both limits less than a chamber of 0.03 m."""
    crank = "d21: 0.3 m, d22: 0.1 m, phi: -1 rad"
    told = r":9:\d+: l0 is too small: within the joint's limits -0.00611 m is left, expected a longer one"
    with pytest.raises(InputError, match=told):
        subject(read(balancer(tmp_path, "gas_balancer", f"{crank}, l0: 0.03 m", "-0.1 rad, 2.1 rad")), names=())
    for values, limits in (("0.03 m", "-0.1 rad, 0.5 rad"), ("0.037 m", "-0.1 rad, 2.1 rad")):
        subject(read(balancer(tmp_path, "gas_balancer", f"{crank}, l0: {values}", limits)), names=())


@pytest.mark.parametrize(
    ("phi", "limits", "where"),
    [("180 deg", "", "at q = 0"), ("90 deg", "0 deg, 100 deg", "within the joint's limits")],
)
@pytest.mark.parametrize("more", ["spring_balancer:", "gas_balancer:, l0: 1 m"])
def test_the_pivots_of_a_balancer_do_not_meet(tmp_path: Path, phi: str, limits: str, where: str, more: str) -> None:
    effect, _, length = more.partition(":")
    path = balancer(tmp_path, effect, f"d21: 0.3 m, d22: 0.3 m, phi: {phi}{length}", limits)
    with pytest.raises(InputError, match=f"d22 is equal to d21: {where} 0 m is left, expected pivots that stay apart"):
        subject(read(path), names=())


def test_check_tells_the_limits_that_a_balancer_needs(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = balancer(tmp_path, "gas_balancer", "d21: 0.3 m, d22: 0.1 m, phi: 180 deg, l0: 0.05 m")
    _, *notes = command("check", path, capsys=capsys).out.splitlines()
    told = "l0 is too small for joint 1 without limits: over a turn -0.15 m is left"
    assert notes == [f"note: {path}:9:89: {told}"]
    path = balancer(tmp_path, "gas_balancer", "d21: 0.3 m, d22: 0.1 m, phi: 180 deg, l0: 0.21 m")
    assert len(command("check", path, capsys=capsys).out.splitlines()) == 1


def test_limits_of_many_turns_are_looked_at_in_a_moment(tmp_path: Path) -> None:
    path = balancer(tmp_path, "spring_balancer", "d21: 0.3 m, d22: 0.3 m, phi: 0 rad", "-1e7 rad, 1e7 rad")
    with pytest.raises(InputError, match="d22 is equal to d21: within the joint's limits 0 m is left"):
        subject(read(path), names=())
