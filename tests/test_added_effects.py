"""Effects that are placed in the library and have no second law: what a robot that has them can do."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from sympy import Abs, Integer, sign

from generator.derivation import derive
from generator.effects.effect import Effect, LinearParameter, Shape, State
from generator.effects.library import library
from generator.reference.joint_effects import LAWS
from generator.review.stated import effects
from generator.robot.readers import read
from generator.selftest import Case, cases
from generator.symbolic.interpret import evaluate
from generator.symbolic.model import Model

ARM = """
name: arm
gravity: [0 m/s2, 0 m/s2, -10 m/s2]
joints:
  - {j: 1, sigma: 0, alpha: pi/2, d: 0, theta: q1, r: 0}
  - {j: 2, sigma: 0, alpha: 0, d: 0.5 m, theta: q2, r: 0}
effects:
  - {effect: viscous_friction, joints: all}
"""

CREEP = replace(
    library()["dahl_friction"],
    id="creep_friction",
    parameters=(LinearParameter("Fz", ("N m", "N"), "friction that creeps", 0.0),),
    columns=lambda at: (at.on_joint(at.state("zc")),),
    states=(State("zc", ("1", "1"), "part of the friction that is built up"),),
    rates=lambda at: ((at.qd - abs(at.qd) * at.state("zc")) / at.values["xs"],),
)

Added = Callable[..., None]


@pytest.fixture
def added(monkeypatch: pytest.MonkeyPatch) -> Added:
    """Puts effects into the library, in the order of ranks."""

    def add(*effects: Effect) -> None:
        found = sorted([*library().values(), *effects], key=lambda effect: (effect.rank, effect.id))
        monkeypatch.setattr("generator.effects.library.library", lambda: {effect.id: effect for effect in found})

    return add


def model(folder: Path, more: str = "") -> Model:
    path = folder / "arm.yaml"
    path.write_text(ARM + more)
    return derive(read(path))


@pytest.mark.parametrize("beside", ["", "  - {effect: dahl_friction, joints: [1, 2], values: {xs: 1 mrad}}\n"])
def test_an_effect_with_a_state_has_self_tests_in_which_it_is_zero(added: Added, beside: str, tmp_path: Path) -> None:
    added(CREEP)
    creeping = model(tmp_path, beside + "  - {effect: creep_friction, joint: 1, values: {xs: 1 mrad}}\n")
    found = cases(creeping)
    tested = {case.function for case in found}
    assert {"inverse_dynamics", "direct_dynamics"} <= tested
    assert tested.isdisjoint({"effect_rates", "regressor", "regressor_standard", "regressor_packed"})
    assert "payload_regressor" in tested
    agree(creeping, found)


def agree(model: Model, found: Iterable[Case]) -> None:
    """The cases hold for the model's own functions."""
    for case in found:
        signals = {name: np.array(values)[None, :] for name, values in (case.inputs | _parameters(case)).items()}
        computed = evaluate(model.functions[case.function], signals)
        for name, values in case.outputs.items():
            expected = np.array(values)
            assert np.abs(computed[name].ravel() - expected).max() <= case.tolerance * np.abs(expected).max(initial=1.0)


BRAKE = Effect(
    id="eddy_brake",
    title="eddy-current brake",
    parameters=(LinearParameter("Kb", ("N m s/rad", "N s/m"), "braking per speed near rest", 0.0),),
    columns=lambda at: (at.on_joint(at.qd / (1 + (at.qd / at.values["vc"]) ** 2)),),
    shapes=(Shape("vc", "rad/s", "critical speed", lower=0.0, prismatic="m/s"),),
    needs=("qd",),
    sign_convention="the motor supplies it",
    source="none",
    drive_train=True,
    dissipates=True,
)
TWO_WAY = replace(
    library()["asymmetric_viscous"],
    id="two_way_viscous",
    parameters=tuple(
        LinearParameter(stem, ("N m s/rad", "N s/m"), "viscous friction one way", 0.0) for stem in ("Fwp", "Fwn")
    ),
    drive_train=True,
)
ELASTIC = "flexible: [1, 2]\n"
BRAKED = "  - {effect: eddy_brake, joint: 2, values: {vc: 2 rad/s}}\n"


@pytest.mark.parametrize(("more", "braked"), [(ELASTIC, []), (BRAKED + ELASTIC, ["Kbm2"])])
def test_an_effect_of_drive_trains_with_a_value_of_the_file_is_where_the_file_has_it(
    added: Added, more: str, braked: list[str], tmp_path: Path
) -> None:
    added(BRAKE)
    elastic = model(tmp_path, more)
    names = [parameter.name for parameter in elastic.motor_parameters]
    assert [name for name in names if name.startswith("Kbm")] == braked
    assert [row for row in effects(elastic) if row[0] == "eddy_brake"] == (
        [("eddy_brake", "2", "vc = 2 rad/s")] if braked else []
    )
    found = cases(elastic)
    assert "flexible_inverse_dynamics" in {case.function for case in found}
    assert ("flexible_regressor" in {case.function for case in found}) != bool(braked)
    agree(elastic, found)


def test_an_effect_of_drive_trains_that_needs_no_value_is_on_every_motor_side(added: Added, tmp_path: Path) -> None:
    added(replace(BRAKE, shapes=(replace(BRAKE.shapes[0], default=Integer(2)),)))
    elastic = model(tmp_path, ELASTIC)
    assert {"Kbm1", "Kbm2"} < {parameter.name for parameter in elastic.motor_parameters}
    found = cases(elastic)
    assert "flexible_regressor" not in {case.function for case in found}
    agree(elastic, found)


def test_an_effect_of_drive_trains_is_grouped_with_those_whose_torque_it_repeats(added: Added, tmp_path: Path) -> None:
    added(TWO_WAY)
    grouped = model(tmp_path, "  - {effect: two_way_viscous, joint: 1}\n")
    terms = grouped.grouping.numeric()
    assert terms["Fv1R"] == {"Fv1": 1.0, "Fwn1": 1.0}
    assert terms["Fwp1R"] == {"Fwp1": 1.0, "Fwn1": -1.0}
    agree(grouped, cases(grouped))


def test_an_effect_of_drive_trains_needs_what_a_motor_has() -> None:
    with pytest.raises(ValueError, match="drive-train effect creep_friction needs state, expected some of q, qd"):
        replace(CREEP, drive_train=True)


def _parameters(case: Case) -> dict[str, tuple[float, ...]]:
    return {"parameters": case.parameters}


def test_friction_by_the_load_needs_no_rotor(tmp_path: Path, added: Added, monkeypatch: pytest.MonkeyPatch) -> None:
    """Without that value, all that accelerates is load, as with a rotor of no inertia."""
    of_load = library()["load_friction"]
    added(
        replace(
            of_load,
            id="pressed_friction",
            parameters=(LinearParameter("Fl", ("1", "1"), "friction", 0.0),),
            columns=lambda at: (at.on_joint(sign(at.qd) * Abs(at.load)),),
            shapes=(),
        )
    )
    law = replace(LAWS["load_friction"], torque=lambda at: (at.direction * abs(at.load),), defaults={})
    monkeypatch.setitem(LAWS, "pressed_friction", law)  # type: ignore[arg-type]
    alone = "  - {effect: pressed_friction, joint: 2}\n"
    without = "  - {effect: load_friction, joint: 2, values: {rotor: 0 kg m2}}\n"
    one, other = (model(tmp_path, text) for text in (alone, without))
    parameters = [0.1 * k for k in range(1, len(one.parameters) + 1)]
    state = {"parameters": parameters, "q": [0.3, 0.4], "qd": [1.0, -2.0], "tau": [3.0, 4.0]}
    qdd, expected = (evaluate(each.functions["direct_dynamics"], state)["qdd"] for each in (one, other))
    np.testing.assert_allclose(qdd, expected, rtol=1e-12)
    rotor = "  - {effect: rotor_inertia, joint: 2}\n"
    for mine, others in zip(*(cases(model(tmp_path, rotor + text)) for text in (alone, without)), strict=True):
        assert mine.function == others.function
        assert (mine.inputs, mine.outputs) == (others.inputs, others.outputs)
