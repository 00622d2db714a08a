"""Friction of which a set tells another value than the runs: not an effect that is missing."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from identification.diagnosis.contradiction import contradicted, pulled
from identification.diagnosis.diagnosis import NAMED, NOTHING, UNEXPLAINED, Diagnosis
from identification.diagnosis.priors import prior_of
from identification.report.diagnose.report import report
from tests.diagnosed_arm import ARM, TRUTH, diagnosis_of, recorded, torque
from tests.recorded import Array, parameters_text


def known(folder: Path, part: float) -> Diagnosis:
    """The arm with so much more friction than its set tells."""

    def more(q: Array, qd: Array) -> Array:
        return part * (TRUTH["Fv1"] * qd + TRUTH["Fc1"] * np.sign(qd))

    regressors, sources = recorded(folder, [more] * 3, ARM + parameters_text({"known": TRUTH}))
    return diagnosis_of(sources, regressors, "known")


@pytest.mark.parametrize("part", [1.0, -0.5])
def test_other_friction_than_the_set_tells_is_told_and_nothing_is_named(part: float, tmp_path: Path) -> None:
    found = known(tmp_path, part)
    assert found.verdict == NOTHING
    told = {one.name: one for one in found.contradicted}
    assert told.keys() == {"Fv1", "Fc1"}
    for name, one in told.items():
        assert one.known == pytest.approx(TRUTH[name])
        assert one.std == pytest.approx(0.05 * TRUTH[name])
        assert one.found == pytest.approx((1 + part) * TRUTH[name], rel=0.06)
    assert any("contradict values that are known: " in note and "Fv1" in note for note in found.notes)
    assert "by far more than their uncertainty" in report(found, None).decode()


def test_a_set_that_holds_is_not_contradicted(tmp_path: Path) -> None:
    found = known(tmp_path, 0.0)
    assert found.verdict == NOTHING
    assert not found.contradicted
    assert "by far more than their uncertainty" not in report(found, None).decode()


def test_what_known_bodies_stand_for_is_on_the_joint_whose_torque_they_change(tmp_path: Path) -> None:
    found = known(tmp_path, 0.0)
    prior = prior_of(found.found.bank.scenes[0].regressors.model, "known")
    names = found.found.bank.base
    far = np.zeros(len(names))
    far[names.index("MX1")] = 10 * 0.05 * TRUTH["MX1"]
    (one,) = contradicted(found.found, replace(prior, mean=prior.mean + far))
    assert one.name == "MX1"
    assert not one.friction
    assert pulled(found.found, [one]) == 0
    assert pulled(found.found, [replace(one, friction=True)]) is None
    assert pulled(found.found, [replace(one, found=one.known * 1.0001)]) is None
    said = replace(found, verdict=UNEXPLAINED, contradicted=(one,), by_values=True, after=replace(found.after, joint=1))
    assert "other values than are known of MX1" in report(said, None).decode()


def test_friction_that_depends_on_the_direction_is_named_beside_a_set(tmp_path: Path) -> None:
    regressors, sources = recorded(tmp_path, [torque("asymmetry")] * 3, ARM + parameters_text({"known": TRUTH}))
    found = diagnosis_of(sources, regressors, "known")
    assert found.verdict == NAMED
    (one,) = found.findings
    assert one.hypothesis.effect == "asymmetric_viscous"
    values = {name: value.value or 0.0 for name, value in one.parameters.items()}
    assert values["Fvp1"] - values["Fvn1"] == pytest.approx(8.0, abs=0.8)
