"""An offset or a rotor's inertia that is another one than a set tells: found as such, and a value of the new set."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from generator.robot.readers import read
from identification.diagnosis.columns.hypothesis import VALUE
from identification.diagnosis.columns.priors import prior_of
from identification.diagnosis.command import Request, diagnosed
from identification.diagnosis.diagnosis import NAMED, NOTHING
from identification.diagnosis.mending.addition import Addition
from identification.diagnosis.mending.refit import with_values
from identification.diagnosis.mending.repair import repaired
from identification.diagnosis.verdict.finding import FIRM
from identification.observation import Regressors
from identification.outcome import Value
from tests.diagnosis.diagnosed_arm import ARM, TRUTH, Hidden, diagnosis_of, recorded, torque
from tests.recorded import Array, parameters_text

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


def test_another_inertia_of_a_rotor_is_found(tmp_path: Path) -> None:
    arm = ARM + "  - {effect: rotor_inertia, joint: 1}\n"
    known = {**TRUTH, "Ia1": 3.0}
    bodies = {name: value for name, value in TRUTH.items() if name != "ZZ1"}
    file = arm + parameters_text({"known": known})
    regressors, sources = recorded(tmp_path, [torque("stribeck")] * 3, file, {**bodies, "ZZ1R": 9.0 + 12.0})
    found = diagnosis_of(sources, regressors, "known")
    assert found.verdict == NAMED
    named = {one.hypothesis.effect: one for one in found.findings}
    assert named.keys() == {"rotor_inertia", "stribeck_friction"}
    assert (named["rotor_inertia"].hypothesis.kind, named["rotor_inertia"].status) == (VALUE, FIRM)
    value = named["rotor_inertia"].parameters["Ia1"]
    assert value.value == pytest.approx(9.0, abs=3 * value.std)
    assert value.std < 0.2 * 9.0
    assert not found.contradicted


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
