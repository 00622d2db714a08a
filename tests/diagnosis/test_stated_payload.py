"""A payload that is another one than sidecars state: found beside the model, and corrected where runs are played."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

from generator.robot.readers import read
from identification.diagnosis.columns.hypothesis import LOAD
from identification.diagnosis.columns.payload_body import STATED_MASS, beyond, corrected
from identification.diagnosis.command import Request
from identification.diagnosis.diagnosis import NAMED, NOTHING
from identification.diagnosis.verdict.finding import FIRM, TENTATIVE
from identification.drive_train import coupling
from identification.observation import Regressors
from identification.sidecar import UNITS, Payload
from tests.diagnosis.diagnosed_arm import answered, diagnosis_of
from tests.recorded import TRUTH, TWO_LINKS, as_recorded, fourier
from tests.recorded import UNITS as OF_LINKS

#: Mass that the arm carries at the tool frame's origin [kg], what sidecars state of it, the length of the first link
#: and where the tool is on the second [m].
MASS, STATED, LENGTH, TOOL = 1.5, 4.5, 0.5, 0.4
#: What is known is known to 1 %.
SURE = [f"      {name}: {{value: {x}, unit: {OF_LINKS[name[:2]]}, relative_std: 1}}" for name, x in TRUTH.items()]
TEXT = "\n".join([f"{TWO_LINKS}parameters:", "  known:", "    values:", *SURE, ""])


def carrying(mass: float) -> dict[str, float]:
    """Base parameters of the arm with a point mass at the tool, grouped by hand."""
    more = {"ZZ1R": LENGTH**2, "MX1R": LENGTH, "ZZ2": TOOL**2, "MX2": TOOL}
    return {name: value + mass * more.get(name, 0.0) for name, value in TRUTH.items()}


def with_masses(
    folder: Path, masses: Sequence[tuple[float, float]], gains: Sequence[float] = (1.0, 1.0)
) -> tuple[Regressors, list[str]]:
    """Runs with a mass each and what its sidecar states, that of none states that; what is recorded of the motors'
    torques is ``gains`` times as large.
    """
    path = folder / "two_links.yaml"
    path.write_text(TEXT)
    regressors, draw, sources = Regressors(read(path)), np.random.default_rng(3), []
    N = coupling(regressors.model.robot)
    for seed, (mass, stated) in enumerate(masses, 1):
        t, motion = fourier(regressors.model.robot, 20.0, 200.0, seed)
        true = regressors.torques(carrying(mass), motion) + draw.normal(size=motion.q.shape)
        tau = N.T @ np.diag(gains) @ np.linalg.solve(N.T, true)
        sources.append(str(as_recorded(regressors, t, motion.q, tau).save(folder / f"{seed}.csv")))
        values = ["payload: none"] if not stated else ["payload:", f"  M: {stated} kg"]
        values += [f"  {stem}: 0 {unit}" for stem, unit in UNITS.items() if stated and stem != "M"]
        (folder / f"{seed}.yaml").write_text("\n".join(["robot: two_links", *values]) + "\n")
    return regressors, sources


def test_another_payload_than_the_stated_one_is_found_and_played(tmp_path: Path) -> None:
    _, sources = with_masses(tmp_path, [(MASS, STATED)] * 4)
    path = tmp_path / "two_links.yaml"
    wanted = Request(sources[:3], test=sources[3:], prior="known")
    found, new = answered(path, wanted, tmp_path / "out")
    (one,) = found.findings
    assert (one.hypothesis.effect, one.hypothesis.kind, one.status) == ("stated_payload", LOAD, FIRM)
    mass = one.parameters["M_beyond"]
    assert mass.value == pytest.approx(MASS - STATED, abs=3 * mass.std)
    assert mass.std < 0.2 * (STATED - MASS)
    assert new is not None
    assert any("by the runs L has" in note and "kg for 4.5 of its sidecar" in note for note in new.notes)
    first, second = (sum(one.residuals.total.norm for one in each) for each in (new.before, new.after))
    assert second < 0.6 * first
    # The arm itself stays as it was known, to twice as much.
    for name in ("ZZ1R", "MX1R", "ZZ2", "MX2"):
        assert new.fit.values[name] == pytest.approx(TRUTH[name], rel=0.02), name


@pytest.mark.long
def test_beside_a_free_fit_gains_may_be_wrong_as_well(tmp_path: Path) -> None:
    regressors, sources = with_masses(tmp_path, [(0.0, 0.0), (MASS, STATED), (0.0, 0.0), (MASS, STATED)])
    found = diagnosis_of(sources, regressors)
    assert found.verdict == NAMED
    (one,) = found.findings
    assert (one.hypothesis.effect, one.status) == ("stated_payload", TENTATIVE)
    assert [each.effect for each in one.alternatives] == ["torque_gain"]
    mass = one.parameters["M_beyond"]
    assert mass.value == pytest.approx(MASS - STATED, abs=3 * mass.std)


@pytest.mark.parametrize("known", [pytest.param(None, marks=pytest.mark.long), "known"])
def test_a_payload_that_is_as_stated_is_nothing(known: str | None, tmp_path: Path) -> None:
    regressors, sources = with_masses(tmp_path, [(0.0, 0.0), (MASS, MASS), (0.0, 0.0)])
    assert diagnosis_of(sources, regressors, known).verdict == NOTHING


@pytest.mark.long
@pytest.mark.parametrize(
    ("gains", "found"),
    [((1.15, 1.15), {0: 0.15}), ((1.15, 1.25), {1: 0.15, 2: 0.25})],
)
def test_gains_are_not_taken_for_a_payload(gains: Sequence[float], found: dict[int, float], tmp_path: Path) -> None:
    """Known values tell that the payload is as stated: one error of all motors, or of each."""
    regressors, sources = with_masses(tmp_path, [(0.0, 0.0), (STATED, STATED)] * 2, gains)
    told = diagnosis_of(sources, regressors, "known").findings
    assert {(one.hypothesis.effect, one.status) for one in told} == {("torque_gain", FIRM)}
    assert {one.hypothesis.joint: one.main[0].value for one in told} == pytest.approx(found, abs=0.005)


def test_what_is_found_adds_to_the_payload_of_that_mass_alone() -> None:
    stated = Payload("L", dict.fromkeys(UNITS, 2.0))
    found = {STATED_MASS: 2.0, beyond("M"): -0.5, beyond("I"): 0.25, beyond("YY-I"): 0.125}
    right = corrected(stated, found)
    changed = {stem: x - 2.0 for stem, x in right.known.items() if x != 2.0}
    assert (right.name, changed) == ("L", {"M": -0.5, "XX": 0.25, "YY": 0.375, "ZZ": 0.25})
    other = Payload("L", dict.fromkeys(UNITS, 3.0))
    assert corrected(other, found) == other
    assert corrected(stated, {}) == stated


@pytest.mark.long
def test_runs_with_another_payload_are_played_with_what_they_state(tmp_path: Path) -> None:
    regressors, sources = with_masses(tmp_path, [(0.0, 0.0), (MASS, STATED), (1.0, 1.0), (MASS, STATED)])
    found = diagnosis_of(sources, regressors, "known")
    (one,) = found.findings
    assert (one.hypothesis.effect, one.shape) == ("stated_payload", {STATED_MASS: STATED})
    assert one.parameters["M_beyond"].value == pytest.approx(MASS - STATED, abs=0.05)
