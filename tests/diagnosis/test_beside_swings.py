"""Base parameters of the flexible model are those of the search, where both models have them alike."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from generator.derivation import derive
from generator.effects.library import effects_of
from generator.robot.description import ParameterSet, ParameterValue
from identification.diagnosis.columns.hypothesis import BODY, EFFECT, ELASTIC, SIGNAL
from identification.diagnosis.mending.addition import Addition
from identification.diagnosis.mending.beside_swings import (
    beside_swings,
    drive_trains,
    has_swings,
    swinging_alone,
    swinging_joints,
    without_findings,
)
from identification.diagnosis.runs.stated_elasticity import names
from identification.diagnosis.verdict.stated_swings import stiffer
from identification.robot_text import robot_of
from tests.recorded import TWO_LINKS, parameters_text

MODEL = derive(robot_of(TWO_LINKS, "two_links"), names=("inverse_dynamics",))
NAMES = [one.name for one in MODEL.base_parameters]
RIGID = ParameterSet("diagnosed", "of a test", "", {p.name: ParameterValue(5.0, p.unit) for p in MODEL.base_parameters})
#: The same robot with an elastic drive train of joint 2.
STATED = f"{TWO_LINKS}flexible: [2]\n{parameters_text({'stiff': {'k2': 1e5}})}"


def searched(text: str, shown: float = 0.0, std: float = 2.0) -> Any:
    """A search of the robot ``text``, by which every base parameter is 8 +- 2, and the drive trains of its file show so
    much of their torque, known to a standard deviation.
    """
    model = derive(robot_of(text, "two_links"), names=("inverse_dynamics",))
    trains = names(model.robot)
    base = (*(one.name for one in model.base_parameters), *trains)
    fit = np.array([shown if name in trains else 8.0 for name in base])
    bank = SimpleNamespace(
        base=base,
        robot=model.robot,
        scenes=[SimpleNamespace(regressors=SimpleNamespace(model=model))],
        values=lambda solution: dict(zip(base, solution.tolist(), strict=True)),
    )
    covariance = np.diag([std**2 if name in trains else 4.0 for name in base])
    weighing = SimpleNamespace(fitted=lambda variants, _: (fit + 100 * len(variants), covariance))
    values = dict(zip(base, fit.tolist(), strict=True))
    return SimpleNamespace(bank=bank, variants=[], weighing=weighing, values=values, covariance=covariance)


def soft(effect: str, joint: int, damping: float = 0.03) -> Any:
    """A finding of an elastic drive train."""
    hypothesis = SimpleNamespace(kind=ELASTIC, effect=effect, key=(effect, joint))
    return SimpleNamespace(hypothesis=hypothesis, joints=(joint,), shape={"damping": damping})


def test_swings_do_not_count_as_inertia() -> None:
    found = beside_swings(searched(TWO_LINKS), [], MODEL, RIGID)
    assert {one.value for one in found.values.values()} == {8.0}
    assert {one.relative_std for one in found.values.values()} == {25.0}


def test_what_another_model_groups_otherwise_stays() -> None:
    """Without rotors nothing else is in ZZ1R; friction that was found is no parameter of the searched model."""
    bare = TWO_LINKS.replace("  - {effect: rotor_inertia, joints: all}\n", "")
    assert bare != TWO_LINKS
    found = beside_swings(searched(bare), [], MODEL, RIGID).values
    changed = {name for name, one in found.items() if one.value == 8.0}
    assert changed == {
        name for name in NAMES if not any(term.startswith("Ia") for term in MODEL.grouping.numeric()[name])
    }
    assert 0 < len(changed) < len(NAMES)


def test_a_rotor_that_an_elastic_drive_train_brings_was_in_the_base_parameters_before() -> None:
    """Unless it was found by itself: then what is grouped lacked it."""
    bare = searched(TWO_LINKS.replace("  - {effect: rotor_inertia, joints: all}\n", ""))
    rotor = SimpleNamespace(hypothesis=SimpleNamespace(kind=EFFECT, effect="rotor_inertia", key=()), joints=(1,))
    (holds,) = [name for name in NAMES if "Ia1" in MODEL.grouping.numeric()[name]]
    elastic = soft("joint_elasticity", 1)
    assert beside_swings(bare, [elastic], MODEL, RIGID).values[holds].value == 8.0
    assert beside_swings(bare, [elastic, rotor], MODEL, RIGID).values[holds] == RIGID.values[holds]


def test_base_parameters_are_those_beside_what_the_model_holds() -> None:
    """Of two choices one is in no robot file: the fit of the search is beside the other alone."""
    held = soft("joint_elasticity", 1)
    found = searched(TWO_LINKS)
    found.variants = [SimpleNamespace(key=held.hypothesis.key), SimpleNamespace(key=("other", 2))]
    assert {one.value for one in beside_swings(found, [held], MODEL, RIGID).values.values()} == {108.0}


def test_the_old_model_swings_where_the_file_s_drive_trains_do() -> None:
    assert without_findings(searched(TWO_LINKS)) == without_findings(searched(STATED, 0.2, 0.05)) == {}
    swings = without_findings(searched(STATED, 0.9, 0.05))
    assert swings["elasticity"] == 0.9
    assert {swings[name] for name in NAMES} == {8.0}


@pytest.mark.parametrize(
    ("kinds", "shown", "plays"),
    [
        ((), 0.0, False),
        ((EFFECT,), 0.0, False),
        ((ELASTIC, EFFECT), 0.0, True),
        ((ELASTIC, BODY), 0.0, False),
        ((EFFECT,), 0.9, True),
        ((SIGNAL,), 0.9, False),
    ],
)
def test_a_model_plays_with_swings_unless_something_else_changes_its_base_parameters(
    kinds: tuple[str, ...], shown: float, plays: bool
) -> None:
    assert has_swings(searched(STATED, shown, 0.05), [Addition(kind, "", (1,)) for kind in kinds]) == plays


@pytest.mark.parametrize(("effect", "plays"), [("torque_delay", True), ("position_offset", False)])
def test_a_delay_changes_no_base_parameter(effect: str, plays: bool) -> None:
    both = [Addition(ELASTIC, "joint_elasticity", (1,)), Addition(SIGNAL, effect, (1, 2))]
    assert has_swings(searched(TWO_LINKS), both) == plays


def test_drive_trains_of_the_file_swing_where_the_runs_show_them() -> None:
    still, swings = searched(STATED, 0.2, 0.05), searched(STATED, 0.9, 0.05)
    assert drive_trains(still, []) == {}
    assert drive_trains(swings, []) == {"elasticity": 0.9, "stiffness2": 0.9, "damping2": 0.9}
    assert drive_trains(searched(STATED, 0.2, 0.2), [])["elasticity"] == 0.2  # too vague to be none
    assert (stiffer(still), stiffer(swings), stiffer(searched(TWO_LINKS))) == (0.2, None, None)


def test_drive_trains_that_were_found_swing_as_they_were_found() -> None:
    both = [soft("joint_elasticity", 1, 0.3), soft("backlash", 2)]
    assert drive_trains(searched(TWO_LINKS), both) == {
        "elasticity": 1.0,
        "damping1": pytest.approx(np.log(10)),
        "backlash2": 1.0,
        "damping2": 0.0,
    }


def test_what_was_found_goes_before_what_the_file_said() -> None:
    """A joint that the file calls elastic has play: its stiffness was found with the gap."""
    swings, still = searched(STATED, 0.9, 0.05), searched(STATED, 0.2, 0.05)
    found = [soft("backlash", 2)]
    assert drive_trains(swings, found) == {"elasticity": 0.9, "backlash2": 1.0, "damping2": 0.0}
    assert swinging_joints(swings, [soft("joint_elasticity", 1)], (1, 2)) == (1, 2)
    assert swinging_joints(still, [soft("joint_elasticity", 1)], (1, 2)) == (1,)


def test_a_drive_train_that_does_not_swing_has_no_gap() -> None:
    """The library refuses a gap on a joint that is not elastic."""
    robot = robot_of(
        STATED.replace("effects:\n", "effects:\n  - {effect: joint_elasticity, joint: 2, values: {gap: 1 mrad}}\n"),
        "two_links",
    )
    assert robot.has("joint_elasticity", 2)
    rigid = swinging_alone(robot, searched(STATED, 0.2, 0.05), [])
    assert effects_of(rigid) == effects_of(robot)
    assert (rigid.flexible, rigid.has("joint_elasticity", 2)) == ((), False)
    assert swinging_alone(robot, searched(STATED, 0.9, 0.05), []) == robot
