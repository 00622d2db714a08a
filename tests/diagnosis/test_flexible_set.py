"""The set of the model with elastic drive trains: with springs at rest it moves as the rigid one."""

from __future__ import annotations

from copy import copy
from dataclasses import replace

import numpy as np
import pytest

from generator.derivation import derive
from generator.resources import find_robot
from generator.robot.description import ParameterSet, ParameterValue
from generator.symbolic.parameter_sets import parameter_vector
from identification.diagnosis.columns.priors import notes_of, prior_of
from identification.diagnosis.mending.flexible_set import flexible_set
from identification.observation import generated_module
from identification.robot_text import robot_of
from tests.recorded import TWO_LINKS

COUPLED = TWO_LINKS.replace("joints:\n", "flexible: [2]\njoints:\n", 1)


@pytest.mark.parametrize("name", ["coupled", "tilted_two_link", "scara", "kr270"])
def test_springs_at_rest_move_as_the_rigid_robot(name: str) -> None:
    """A slide, a coupled wrist, rotors that are grouped with links or stand alone."""
    text = COUPLED if name == "coupled" else find_robot(name).read_text(encoding="utf-8")
    model = derive(robot_of(text, name), names=("inverse_dynamics", "flexible_inverse_dynamics"))
    draw = np.random.default_rng(1)
    values = {p.name: ParameterValue(draw.uniform(1, 9), p.unit, 2.0) for p in model.base_parameters}
    found = {f"{stem}{j}": value for j in model.robot.flexible for stem, value in (("Iam", 0.7), ("k", 1e4))}
    rigid = ParameterSet("diagnosed", "of a test", "", values)
    flexible = flexible_set(model, rigid, found)
    assert set(found) <= set(flexible.values)
    assert not {f"{stem}{j}" for j in model.robot.flexible for stem in ("Ia", "Fv", "Fc")} & set(flexible.values)
    q, qd, qdd = draw.uniform(-1, 1, (3, model.dof))
    module, at = generated_module(model), list(model.elastic)
    still = np.zeros(len(at))
    motors, links = module.flexible_inverse_dynamics(
        parameter_vector(model, flexible.values), *(np.append(one, still) for one in (q, qd, qdd))
    )
    torques = np.array(motors, dtype=float)
    torques[at] += links
    expected = module.inverse_dynamics(parameter_vector(model, values), q, qd, qdd)
    np.testing.assert_allclose(torques, expected, atol=1e-9 * np.abs(expected).max())


@pytest.mark.parametrize("name", ["coupled", "tilted_two_link", "scara", "kr270"])
def test_both_sets_tell_a_prior_the_same(name: str) -> None:
    text = COUPLED if name == "coupled" else find_robot(name).read_text(encoding="utf-8")
    model = derive(robot_of(text, name), names=("inverse_dynamics",))
    draw = np.random.default_rng(2)
    values = {p.name: ParameterValue(draw.uniform(1, 9), p.unit, 2.0) for p in model.base_parameters}
    rigid = ParameterSet("rigid", "", "", values)
    found = {f"{stem}{j}": value for j in model.robot.flexible for stem, value in (("Iam", 0.7), ("k", 1e4))}
    sets = {"rigid": rigid, "flexible": flexible_set(model, rigid, found)}
    told = copy(model)
    told.robot = replace(model.robot, parameter_sets=sets)
    first, second = (prior_of(told, one) for one in sets)
    np.testing.assert_allclose(second.mean, first.mean, rtol=1e-12)
    np.testing.assert_allclose(second.precision, first.precision, rtol=1e-6, atol=1e-12 * first.precision.max())
    assert notes_of(told, "flexible") == []


def test_a_rotor_that_nothing_tells_is_called_assumed() -> None:
    model = derive(robot_of(COUPLED.replace("flexible: [2]", "flexible: [1]"), "coupled"), names=("inverse_dynamics",))
    rigid = ParameterSet("diagnosed", "", "", {"ZZ1R": ParameterValue(10.0, "kg m2", 1.0)})
    found = flexible_set(model, rigid, {"Iam1": 5.0, "k1": 1e4}).values
    assert (found["ZZ1R"].value, found["ZZ1R"].relative_std) == (5.0, 2.0)
    assert (found["Iam1"].value, found["k1"].value) == (5.0, 1e4)
    assert found["Iam1"].note.startswith("assumed")
    assert "assumed" not in found["k1"].note
