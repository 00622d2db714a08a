"""Base parameters of the flexible model are those of the search, where both models have them alike."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from generator.derivation import derive
from generator.robot.description import ParameterSet, ParameterValue
from identification.diagnosis.columns.hypothesis import BODY, EFFECT, ELASTIC
from identification.diagnosis.mending.addition import Addition
from identification.diagnosis.mending.beside_swings import beside_swings, swinging, without_findings
from identification.diagnosis.runs.stated_elasticity import names
from identification.robot_text import robot_of
from tests.recorded import TWO_LINKS, parameters_text

MODEL = derive(robot_of(TWO_LINKS, "two_links"), names=("inverse_dynamics",))
NAMES = [one.name for one in MODEL.base_parameters]
RIGID = ParameterSet("diagnosed", "of a test", "", {p.name: ParameterValue(5.0, p.unit) for p in MODEL.base_parameters})


def searched(text: str, shown: float = 0.0) -> Any:
    """A search of the robot ``text``, by which every base parameter is 8 +- 2, and the drive trains of its file show so
    much of their torque.
    """
    model = derive(robot_of(text, "two_links"), names=("inverse_dynamics",))
    base = tuple(one.name for one in model.base_parameters)
    bank = SimpleNamespace(
        base=base,
        robot=model.robot,
        scenes=[SimpleNamespace(regressors=SimpleNamespace(model=model))],
        values=lambda solution: dict(zip(base, solution.tolist(), strict=True)),
    )
    count = len(base)
    weighing = SimpleNamespace(fitted=lambda *_: (np.full(count, 8.0), 4.0 * np.eye(count)))
    values = dict.fromkeys(names(model.robot), shown)
    return SimpleNamespace(bank=bank, variants=(), weighing=weighing, values=values)


def soft(effect: str, joint: int) -> Any:
    """A finding of an elastic drive train."""
    hypothesis = SimpleNamespace(kind=ELASTIC, effect=effect)
    return SimpleNamespace(hypothesis=hypothesis, joints=(joint,), shape={"damping": 0.03})


def test_swings_do_not_count_as_inertia() -> None:
    found = beside_swings(searched(TWO_LINKS), MODEL, RIGID, [Addition(ELASTIC, "joint_elasticity", (1,))])
    assert {one.value for one in found.values.values()} == {8.0}
    assert {one.relative_std for one in found.values.values()} == {25.0}


def test_what_another_model_groups_otherwise_stays() -> None:
    """Without rotors nothing else is in ZZ1R; friction that was found is no parameter of the searched model."""
    bare = TWO_LINKS.replace("  - {effect: rotor_inertia, joints: all}\n", "")
    assert bare != TWO_LINKS
    added = [Addition(ELASTIC, "joint_elasticity", (1,)), Addition(EFFECT, "rotor_inertia", (1, 2))]
    found = beside_swings(searched(bare), MODEL, RIGID, added).values
    changed = {name for name, one in found.items() if one.value == 8.0}
    assert changed == {
        name for name in NAMES if not any(term.startswith("Ia") for term in MODEL.grouping.numeric()[name])
    }
    assert 0 < len(changed) < len(NAMES)


@pytest.mark.parametrize("kinds", [(), (EFFECT,), (ELASTIC, BODY)])
def test_nothing_changes_without_swings_or_beside_another_body(kinds: tuple[str, ...]) -> None:
    added = [Addition(kind, "", (1,)) for kind in kinds]
    assert beside_swings(searched(TWO_LINKS), MODEL, RIGID, added) is RIGID


def test_drive_trains_of_the_file_swing_where_the_runs_show_them() -> None:
    text = f"{TWO_LINKS}flexible: [2]\n{parameters_text({'stiff': {'k2': 1e5}})}"
    still, swings = searched(text, 0.2), searched(text, 0.9)
    assert swinging(still) == {}
    assert swinging(swings) == {"elasticity": 0.9, "stiffness2": 0.9, "damping2": 0.9}
    assert without_findings(still) == {}
    assert set(without_findings(swings).values()) == {8.0}
    added = [Addition(EFFECT, "", (1,))]
    assert beside_swings(still, MODEL, RIGID, added) is RIGID
    assert {one.value for one in beside_swings(swings, MODEL, RIGID, added).values.values()} == {8.0}


def test_drive_trains_that_were_found_swing_as_they_were_found() -> None:
    found = swinging(searched(TWO_LINKS), [soft("joint_elasticity", 1), soft("backlash", 2)])
    assert found == {"elasticity": 1.0, "damping1": 0.0, "backlash2": 1.0, "damping2": 0.0}
