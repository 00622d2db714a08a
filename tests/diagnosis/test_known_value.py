"""An offset or a rotor's inertia that is another one than a set tells: found as such, and a value of the new set."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from generator.robot.readers import read
from identification.diagnosis.candidates.known_value import hypotheses
from identification.diagnosis.columns.hypothesis import VALUE
from identification.diagnosis.columns.priors import prior_of
from identification.diagnosis.command import Request, diagnosed
from identification.diagnosis.diagnosis import NAMED, NOTHING, Diagnosis
from identification.diagnosis.mending.addition import Addition
from identification.diagnosis.mending.refit import with_values
from identification.diagnosis.mending.repair import repaired
from identification.diagnosis.verdict.alternatives import OTHER_BODY, OTHER_GEOMETRY
from identification.diagnosis.verdict.doubts import doubted
from identification.diagnosis.verdict.finding import FIRM, TENTATIVE
from identification.observation import Regressors
from identification.outcome import Value
from tests.diagnosis.diagnosed_arm import ARM, TRUTH, Hidden, diagnosis_of, recorded, torque
from tests.recorded import TRUTH as LINKS
from tests.recorded import TWO_LINKS, Array, as_recorded, fourier, parameters_text

#: What the offset is beyond the known one [N m], which a set tells to a part of the little that it is.
MORE = -12.0
LITTLE = {**TRUTH, "Off1": 0.01}
KNOWN = ARM + parameters_text({"known": LITTLE})


def beside(hidden: str, more: float = MORE) -> Hidden:
    def of(q: Array, qd: Array) -> Array:
        return np.asarray(torque(hidden)(q, qd) + more)

    return of


def test_another_offset_than_the_known_one_is_found(tmp_path: Path) -> None:
    regressors, sources = recorded(tmp_path, [beside("")] * 3, KNOWN, LITTLE)
    found = diagnosis_of(sources, regressors, "known")
    assert found.verdict == NAMED
    (one,) = found.findings
    assert (one.hypothesis.key, one.hypothesis.kind, one.status) == (("offset", 1), VALUE, FIRM)
    value = one.parameters["Off1"]
    assert value.value == pytest.approx(MORE, abs=3 * value.std)
    assert value.std < 0.1 * abs(MORE)
    assert not found.contradicted
    little = doubted(replace(one, evidence=replace(one.evidence, sizes={0: 0.28})), 0.0, (), True)
    assert (little.status, [each.effect for each in little.alternatives]) == (TENTATIVE, [OTHER_GEOMETRY])


@pytest.fixture(scope="module")
def lighter(tmp_path_factory: pytest.TempPathFactory) -> Diagnosis:
    """Of a second motor whose inertia the set tells wrongly."""
    regressors, sources = with_rotor(tmp_path_factory.mktemp("rotor"), known=1.5)
    return diagnosis_of(sources, regressors, "known")


def test_another_inertia_of_a_rotor_is_found(lighter: Diagnosis) -> None:
    assert lighter.verdict == NAMED
    (one,) = lighter.findings
    assert (one.hypothesis.key, one.hypothesis.kind, one.status) == (("rotor_inertia", 2), VALUE, FIRM)
    value = one.parameters["Ia2"]
    assert value.value == pytest.approx(LINKS["Ia2"] - 1.5, abs=3 * value.std)
    assert value.std < 0.2 * LINKS["Ia2"]
    assert not lighter.contradicted


@pytest.mark.long
def test_an_inertia_of_a_rotor_that_is_as_known_is_nothing(tmp_path: Path) -> None:
    regressors, sources = with_rotor(tmp_path, known=LINKS["Ia2"])
    assert diagnosis_of(sources, regressors, "known").verdict == NOTHING


def test_what_no_motion_tells_from_a_body_is_tentative(lighter: Diagnosis) -> None:
    grouped = {one.coefficients[0].name: one.grouped for one in hypotheses(lighter.search.bank.scenes)}
    assert grouped == {"Ia1": True, "Ia2": False, "Off1": False, "Off2": False}
    (one,) = lighter.findings
    assert doubted(one, 0.0, (), True) == one
    other = doubted(replace(one, hypothesis=replace(one.hypothesis, grouped=True)), 0.0, (), True)
    assert other.status == TENTATIVE
    assert [each.effect for each in other.alternatives] == [OTHER_BODY]


def with_rotor(folder: Path, known: float) -> tuple[Regressors, list[str]]:
    """Two links, three runs, and a set that tells an inertia of the second motor."""
    path = folder / "two_links.yaml"
    path.write_text(TWO_LINKS + parameters_text({"known": {**LINKS, "Ia2": known}}))
    regressors, draw = Regressors(read(path)), np.random.default_rng(2)
    sources = []
    for seed in range(1, 4):
        t, motion = fourier(regressors.model.robot, 20.0, 200.0, seed)
        tau = regressors.torques(LINKS, motion) + draw.normal(size=motion.q.shape)
        sources.append(str(as_recorded(regressors, t, motion.q, tau).save(folder / f"{seed}.csv")))
    return regressors, sources


def test_another_offset_is_found_beside_what_is_missing(tmp_path: Path) -> None:
    regressors, sources = recorded(tmp_path, [beside("stribeck")] * 3, KNOWN, LITTLE)
    found = diagnosis_of(sources, regressors, "known")
    assert {one.hypothesis.effect for one in found.findings} == {"offset", "stribeck_friction"}


@pytest.mark.parametrize(("more", "known"), [(0.0, "known"), (MORE, None)])
def test_an_offset_that_is_as_known_or_fitted_is_nothing(more: float, known: str | None, tmp_path: Path) -> None:
    regressors, sources = recorded(tmp_path, [beside("", more)] * 3, KNOWN, LITTLE)
    found = diagnosis_of(sources, regressors, known)
    assert found.verdict == NOTHING
    assert "offset" not in {one.effect for one in found.invisible}


def test_the_new_set_holds_it_and_the_code_explains_the_untouched_run(tmp_path: Path) -> None:
    _, sources = recorded(tmp_path, [beside("")] * 3, KNOWN, LITTLE)
    path, out = tmp_path / "arm.yaml", tmp_path / "out"
    wanted = Request(sources[:1], sources[1:2], sources[2:], "known")
    found, new, _ = diagnosed(path, read(path), wanted, out, lambda *_: {})
    assert new is not None
    assert [one.effect for one in new.robot.effects] == [one.effect for one in found.robot.effects]
    assert [line for line in new.notes if line.startswith("the new set has Off1 with what was found")]
    written = read(out / "arm.yaml")
    assert written.parameter_sets["diagnosed"].values["Off1"].value == pytest.approx(MORE, abs=2.0)
    before, after = (each.residuals.per_joint[0] for each in (*new.before, *new.after))
    assert after.norm < 0.5 * before.norm
    again = Request(sources[:1], sources[1:2], sources[2:], "diagnosed")
    repeated, _, _ = diagnosed(out / "arm.yaml", written, again, tmp_path / "again", lambda *_: {})
    assert repeated.verdict == NOTHING


def test_what_is_known_of_a_parameter_is_moved_and_widened(tmp_path: Path) -> None:
    (tmp_path / "arm.yaml").write_text(KNOWN)
    regressors = Regressors(read(tmp_path / "arm.yaml"))
    prior = prior_of(regressors.model, "known")
    moved = with_values(prior, regressors, {"Off1": Value(MORE, 0.3, "N m")})
    at = regressors.names.index("Off1")
    expected = prior.mean.copy()
    expected[at] += MORE
    np.testing.assert_allclose(moved.mean, expected)
    was, now = (np.linalg.inv(one.precision).diagonal() for one in (prior, moved))
    assert now[at] == pytest.approx(was[at] + 0.3**2)
    np.testing.assert_allclose(np.delete(now, at), np.delete(was, at))


def test_a_value_leaves_the_text() -> None:
    found = repaired(KNOWN, "arm.yaml", [Addition(VALUE, "offset", (1,), values={"Off1": MORE})])
    assert found.text == KNOWN
    assert found.notes == ("the new set has Off1 with what was found: the robot file has the effect already",)
