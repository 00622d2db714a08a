"""Effects that are placed in the library and have no second law: what a robot that has them can do."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from generator.derivation import derive
from generator.effects.effect import Effect, LinearParameter, State
from generator.effects.library import library
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
    assert tested.isdisjoint({"effect_rates", "regressor", "regressor_standard"})
    for case in found:
        signals = {name: np.array(values)[None, :] for name, values in (case.inputs | _parameters(case)).items()}
        computed = evaluate(creeping.functions[case.function], signals)
        for name, values in case.outputs.items():
            expected = np.array(values)
            assert np.abs(computed[name].ravel() - expected).max() <= case.tolerance * np.abs(expected).max(initial=1.0)


def _parameters(case: Case) -> dict[str, tuple[float, ...]]:
    return {"parameters": case.parameters}
