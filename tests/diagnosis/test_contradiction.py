"""Friction of which a set tells another value than the runs: not an effect that is missing."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from identification.diagnosis.columns.hypothesis import BODY
from identification.diagnosis.columns.priors import prior_of
from identification.diagnosis.diagnosis import NAMED, NOTHING, UNEXPLAINED, Diagnosis
from identification.diagnosis.results import document
from identification.diagnosis.verdict.alternatives import OTHER_FRICTION
from identification.diagnosis.verdict.contradiction import Contradicted, contradicted, doubted, pulled
from identification.diagnosis.verdict.finding import FIRM, TENTATIVE
from identification.diagnosis.verdict.unexplained import VALUES
from identification.outcome import Value
from identification.report.diagnose.report import report
from tests.diagnosis.diagnosed_arm import ARM, TRUTH, Hidden, diagnosis_of, recorded, torque
from tests.recorded import Array, parameters_text


def known(folder: Path, part: float) -> Diagnosis:
    """The arm with so much more friction than its set tells."""

    def more(q: Array, qd: Array) -> Array:
        return part * (TRUTH["Fv1"] * qd + TRUTH["Fc1"] * np.sign(qd))

    regressors, sources = recorded(folder, [more] * 3, ARM + parameters_text({"known": TRUTH}))
    return diagnosis_of(sources, regressors, "known")


@pytest.mark.parametrize("part", [1.0, pytest.param(-0.5, marks=pytest.mark.long)])
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
    assert "other values than are known of " in report(found, None).decode()


def test_a_set_that_holds_is_not_contradicted(tmp_path: Path) -> None:
    found = known(tmp_path, 0.0)
    assert found.verdict == NOTHING
    assert not found.contradicted
    assert "other values than are known" not in report(found, None).decode()


def test_what_is_named_beside_friction_that_is_contradicted_is_not_firm(tmp_path: Path) -> None:
    regressors, sources = recorded(tmp_path, [torque("stribeck")] * 3, ARM + parameters_text({"known": TRUTH}))
    found = diagnosis_of(sources, regressors, "known")
    assert [(one.hypothesis.effect, one.status) for one in found.findings] == [("stribeck_friction", FIRM)]
    one = Contradicted("Fv1", found.search.bank.base.index("Fv1"), 5.0, TRUTH["Fv1"], 0.7, False, 1)
    for other, status in ((one, TENTATIVE), (replace(one, rubs=2), FIRM), (replace(one, rubs=0), FIRM)):
        (finding,) = doubted(found.search, found.findings, [other])
        assert finding.status == status
        said = ["the runs contradict Fv1, which another law may leave as known"]
        assert list(finding.doubts) == (said if status == TENTATIVE else [])
        assert [each.effect for each in finding.alternatives] == ([OTHER_FRICTION] if status == TENTATIVE else [])
    of_all = replace(found.findings[0], hypothesis=replace(found.findings[0].hypothesis, effect="payload", kind=BODY))
    assert doubted(found.search, [of_all], [one]) == (of_all,)


def beside_known(folder: Path, law: Hidden) -> Diagnosis:
    regressors, sources = recorded(folder, [law] * 3, ARM + parameters_text({"known": TRUTH}))
    return diagnosis_of(sources, regressors, "known")


@pytest.mark.parametrize("size", [3.0, pytest.param(5.0, marks=pytest.mark.long)])
def test_a_law_that_no_effect_has_contradicts_what_is_known(size: float, tmp_path: Path) -> None:
    """As much as is known where the joint is fast, and less below, by a law of its own."""
    (one,) = beside_known(tmp_path, lambda q, qd: -size * np.sign(qd) / (1 + np.abs(qd) / 0.1)).findings
    assert one.status == TENTATIVE
    assert OTHER_FRICTION in {each.effect for each in one.alternatives}


def test_friction_that_takes_the_place_of_what_is_known_does_not_contradict_it(tmp_path: Path) -> None:
    """The friction is as much as is known, and rises from rest."""

    def gradual(q: Array, qd: Array) -> Array:
        del q
        return TRUTH["Fc1"] * (np.tanh(qd / 0.1) - np.sign(qd))

    found = beside_known(tmp_path, gradual)
    assert [one.name for one in found.contradicted] == ["Fc1"]
    assert [(one.hypothesis.effect, one.status) for one in found.findings] == [("gradual_friction", FIRM)]
    hypothesis = next(one for one in found.search.offered if one.effect == "stribeck_friction")
    none = {one.name: Value(0.0, 0.0, one.unit) for one in hypothesis.coefficients}
    beside = replace(found.findings[0], hypothesis=hypothesis, shape=hypothesis.variants[0], parameters=none)
    both = doubted(found.search, [*found.findings, beside], found.contradicted)
    assert [one.status for one in both] == [FIRM, FIRM]
    less = replace(found.contradicted[0], found=found.contradicted[0].found - 0.5 * TRUTH["Fc1"])
    assert doubted(found.search, found.findings, [less])[0].status == TENTATIVE


def test_what_known_bodies_stand_for_is_on_the_joint_whose_torque_they_change(tmp_path: Path) -> None:
    found = known(tmp_path, 0.0)
    prior = prior_of(found.search.bank.scenes[0].regressors.model, "known")
    names = found.search.bank.base
    far = np.zeros(len(names))
    far[names.index("MX1")] = 10 * 0.05 * TRUTH["MX1"]
    (one,) = contradicted(found.search, replace(prior, mean=prior.mean + far))
    assert one.name == "MX1"
    assert (one.body, one.rubs) == (True, 0)
    assert pulled(found.search, [one]) == 0
    assert pulled(found.search, [replace(one, body=False)]) is None
    assert pulled(found.search, [replace(one, found=one.known * 1.0001)]) is None


def of_bodies(folder: Path, told: dict[str, float], hidden: str) -> Diagnosis:
    """The arm with a rotor, beside a set of other values than the true ones."""
    arm = ARM.replace("effects:\n", "effects:\n  - {effect: rotor_inertia, joint: 1}\n")
    truth = {"ZZ1R": TRUTH["ZZ1"], **{name: value for name, value in TRUTH.items() if name != "ZZ1"}}
    known = {**TRUTH, "ZZ1": TRUTH["ZZ1"] - 1.0, "Ia1": 1.0, **told}
    regressors, sources = recorded(folder, [torque(hidden)] * 3, arm + parameters_text({"known": known}), truth)
    return diagnosis_of(sources, regressors, "known")


@pytest.mark.parametrize(("told", "name"), [({"ZZ1": 5.0}, "ZZ1R"), ({"MX1": 22.0}, "MX1")])
def test_bodies_that_are_not_as_known_leave_it_unexplained(told: dict[str, float], name: str, tmp_path: Path) -> None:
    found = of_bodies(tmp_path, told, "")
    assert (found.verdict, found.reason, found.after.joint) == (UNEXPLAINED, VALUES, 1)
    assert not found.findings
    assert [one.name for one in found.contradicted] == [name]
    assert "other values than are known of " + name in report(found, None).decode()
    result = document(found)
    assert result["unexplained"] == {
        "joint": 1,
        "variable": "",
        "region": "by other values than are known",
        "shares": {},
    }
    assert [one["parameter"] for one in result["contradicted"]] == [name]


def test_bodies_that_are_not_as_known_are_told_beside_what_is_named(tmp_path: Path) -> None:
    found = of_bodies(tmp_path, {"MX1": 22.0}, "asymmetry")
    assert (found.verdict, found.reason) == (NAMED, "")
    assert [one.hypothesis.effect for one in found.findings] == ["asymmetric_viscous"]
    assert [one.name for one in found.contradicted] == ["MX1"]
    assert "these runs want other values than are known of MX1" in report(found, None).decode()


def test_friction_that_depends_on_the_direction_is_named_beside_a_set(tmp_path: Path) -> None:
    regressors, sources = recorded(tmp_path, [torque("asymmetry")] * 3, ARM + parameters_text({"known": TRUTH}))
    found = diagnosis_of(sources, regressors, "known")
    assert found.verdict == NAMED
    (one,) = found.findings
    assert one.hypothesis.effect == "asymmetric_viscous"
    values = {name: value.value or 0.0 for name, value in one.parameters.items()}
    assert values["Fvp1"] - values["Fvn1"] == pytest.approx(8.0, abs=0.8)


def test_friction_that_depends_on_the_direction_is_firm_where_it_makes_the_known_one_another(tmp_path: Path) -> None:
    """What is less one way than it is known takes another value of what is the same both ways: no other law."""

    def more(q: Array, qd: Array) -> Array:
        return 5.0 * np.abs(qd)

    regressors, sources = recorded(tmp_path, [more] * 3, ARM + parameters_text({"known": TRUTH}))
    found = diagnosis_of(sources, regressors, "known")
    assert [(one.hypothesis.effect, one.status) for one in found.findings] == [("asymmetric_viscous", FIRM)]
    assert [one.name for one in found.contradicted] == ["Fv1"]
    assert found.contradicted[0].found == pytest.approx(TRUTH["Fv1"] - 5.0, abs=1.0)
