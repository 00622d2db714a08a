"""Recordings of real robots, where they are at hand: what is held out is explained."""

from __future__ import annotations

from dataclasses import replace

import pytest

from generator.errors import Place
from generator.robot.description import Robot
from generator.symbolic.parameter_sets import resolved_sets
from identification.consistent_fit import consistent_fit
from identification.fixing import fixed
from identification.inverse_model import Estimate, Identification, Options, identify
from identification.observation import Regressors
from identification.sidecar import Payload
from tests.at_hand import RECORDINGS
from tests.real_recordings import TEST, TRAIN, A, B, data
from tests.recorded import regressors

pytestmark = RECORDINGS.needed


def left(estimate: Estimate) -> tuple[float, list[float]]:
    """||e||/||Y - mean(Y)|| on held-out runs in %, in total and by joint."""
    assert estimate.test is not None
    return estimate.test.total.relative_to_mean, [one.relative_to_mean for one in estimate.test.per_joint.values()]


# -- KR300: a heavy arm with a gas balancer ---------------------------------------------------------------------------


def held_at_the_prior(of: Regressors, payload: dict[str, float]) -> Options:
    """Bodies and rotors as known beforehand; friction, offsets, the balancer and a payload are sought."""
    prior = of.model.robot.parameter_sets["a_priori"]
    given = fixed(["bodies", "Ia*"], prior, of.model, Place("test"))
    return Options(fixed=given, payload=Payload("L", payload))


@pytest.fixture(scope="module")
def heavy() -> Regressors:
    return regressors("kr300")


def test_both_kr300_runs_are_explained(heavy: Regressors) -> None:
    found = identify(heavy.model.robot, data(A, B), regressors=heavy)
    assert found.full.train.total.relative_to_mean < 3
    assert not found.full.solution.hidden


@pytest.mark.parametrize("payload", [{}, {"MX": 0.0, "MY": 0.0}], ids=["unknown", "on the axis"])
def test_payload_and_balancer_are_near_what_is_known(heavy: Regressors, payload: dict[str, float]) -> None:
    """About 150 kg are mounted; the balancer's force is that of its data sheet."""
    found = identify(heavy.model.robot, data(A, B), options=held_at_the_prior(heavy, payload), regressors=heavy)
    solution = found.full.solution
    sheet = resolved_sets(heavy.model)["a_priori"]["F02"]
    assert solution.values["ML"] == pytest.approx(150, abs=8)
    assert 0.5 < solution.std("ML") < 4
    assert solution.values["F02"] / sheet == pytest.approx(1, abs=0.05)
    assert 0.001 < solution.std("F02") / sheet < 0.02
    assert found.full.train.total.relative_to_mean < 5


@pytest.mark.parametrize(("train", "test"), [(A, B), (B, A)])
def test_what_is_known_carries_over_to_another_place(heavy: Regressors, train: str, test: str) -> None:
    """The two runs overlap little: least squares alone does not carry over, with known bodies it does."""
    known = identify(heavy.model.robot, data(train), data(test), held_at_the_prior(heavy, {}), heavy)
    alone = identify(heavy.model.robot, data(train), data(test), regressors=heavy)
    assert left(known.full)[0] < 7
    assert left(alone.full)[0] > 2 * left(known.full)[0]


@pytest.mark.parametrize(("train", "test"), [(A, B), (B, A)])
def test_bodies_that_can_be_carry_over_without_being_known(heavy: Regressors, train: str, test: str) -> None:
    found = identify(heavy.model.robot, data(train), data(test), regressors=heavy)
    consistent = consistent_fit(found, None, 0.03)
    assert consistent.test is not None
    assert consistent.test.total.relative_to_mean < 9
    assert 2 * consistent.test.total.relative_to_mean < left(found.full)[0]


# -- TX40: two coupled axes in the wrist ------------------------------------------------------------------------------


def on_tx40(of: Regressors) -> Identification:
    return identify(of.model.robot, data(TRAIN), data(TEST), regressors=of)


def uncoupled(robot: Robot) -> Robot:
    effects = tuple(use for use in robot.effects if use.effect != "coupled_rotor")
    return replace(robot, effects=effects)


def test_the_coupled_wrist_is_explained() -> None:
    found = on_tx40(regressors("tx40"))
    total, each = left(found.full)
    assert total < 7
    assert max(each[4:]) < 12
    assert not found.full.solution.hidden
    for name in ("Fvr6", "Fcr6"):
        assert found.full.solution.relative_std(name) < 15


def test_without_the_coupled_rotor_the_wrist_is_not() -> None:
    found = on_tx40(Regressors(uncoupled(regressors("tx40").model.robot)))
    total, each = left(found.full)
    assert total > 12
    assert each[4] > 40
    assert each[5] > 20
