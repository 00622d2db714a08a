"""What the laws of effects that were found may leave, and what is missing beside them all the same."""

from __future__ import annotations

from typing import Any

import pytest

from identification.diagnosis.columns.hypothesis import VALUE
from identification.diagnosis.search.imperfect_laws import lacking
from identification.outcome import Value
from tests.diagnosis.laws import variant


@pytest.mark.parametrize(
    ("one", "beside", "part"),
    [
        (variant("load_friction", (1,), "load"), variant("stribeck_friction", (1,)), 0.01),
        (variant("dahl_friction", (1,)), variant("stribeck_friction", (1,)), 0.15),
        (variant("load_friction", (2,), "load"), variant("stribeck_friction", (1,)), 1e-5),
        (variant("load_friction", (2,), "load"), variant("coulomb_friction", (1,)), 0.0),
        (variant("viscous_friction", (1,)), variant("stribeck_friction", (1,)), 0.0),
        (variant("rotor_inertia", (1,), "qdd"), variant("viscous_friction", (1,)), 0.0),
        (variant("rotor_inertia", (1,), "qdd", kind=VALUE), variant("viscous_friction", (1,)), 0.01),
        (variant("gradual_friction", (1,)), variant("torque_delay", (0, 1), "frequency", joint=0), 0.002),
        (variant("dahl_friction", (1,), "time since reversal"), variant("torque_delay", (0, 1), "f", joint=0), 0.01),
        (variant("gradual_friction", (1,)), variant("torque_delay", (1,), "frequency"), 0.01),
    ],
)
def test_no_law_is_exact_on_its_joint_and_hardly_elsewhere(one: Any, beside: Any, part: float) -> None:
    assert lacking(one, [beside], [1e6]) == pytest.approx(1e6 * part)


def test_delays_that_rows_of_their_own_tell_lack_nothing_of_each_other() -> None:
    told = {"torque_delay": Value(0.01, 1e-4, "s")}
    one, other = (variant("torque_delay", (k,), "frequency", told) for k in (0, 1))
    assert lacking(one, [other], [1e6]) == 0.0


@pytest.mark.parametrize(("motors", "joint", "part"), [((0, 1), 0, 1e-5), ((0,), 1, 0.01)])
def test_a_delay_that_several_motors_tell_alike_is_no_lack_of_one_joints_law(
    motors: tuple[int, ...], joint: int, part: float
) -> None:
    one = variant("torque_delay", motors, "frequency", {"torque_delay": Value(0.01, 1e-4, "s")}, joint=joint)
    one.hypothesis.joints = tuple(k + 1 for k in motors)
    assert lacking(one, [variant("cable_spring", (0,), "q")], [1e6]) == pytest.approx(1e6 * part)
