"""A payload beside parameters that are known to a few per cent: its mass is what they leave of it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from generator.resources import find_robot
from generator.robot.readers import read
from generator.symbolic.parameter_sets import resolved
from identification.diagnosis.command import Request
from identification.diagnosis.diagnosis import NAMED, Diagnosis
from identification.observation import Regressors
from tests.bodies import ten_parameters
from tests.diagnosis.diagnosed_arm import answered
from tests.recorded import as_recorded, fourier

pytestmark = pytest.mark.long

ROBOT, SET = "puma560", "literature"
#: Of the body at the tool: mass [kg], centre [m], and radius of gyration [m].
MASS, CENTRE, RADIUS = 1.5, np.array([0.02, 0.0, 0.06]), 0.03
#: Part by which values of the set are wrong, and that of the noise in the torques' spread.
OFF, NOISE = 0.03, 0.002


@pytest.fixture(scope="module")
def found(tmp_path_factory: pytest.TempPathFactory) -> Diagnosis:
    folder = tmp_path_factory.mktemp("payload")
    path = find_robot(ROBOT)
    robot = read(path)
    regressors, draw = Regressors(robot), np.random.default_rng(2)
    given = robot.parameter_sets[SET].values
    true = {name: replace(one, value=one.value * (1 + OFF * draw.normal())) for name, one in given.items()}
    values = resolved(regressors.model, true)
    body = ten_parameters(MASS, CENTRE, MASS * RADIUS**2 * np.eye(3))
    sources = []
    for seed in (1, 2):
        t, motion = fourier(robot, 20.0, 200.0, seed)
        tau = regressors.torques(values, motion)
        tau = tau + np.stack([body @ one for one in regressors.payload(motion)])
        tau = tau + NOISE * tau.std(axis=1, keepdims=True) * draw.normal(size=tau.shape)
        sources.append(str(as_recorded(regressors, t, motion.q, tau).save(folder / f"{seed}.csv")))
    result, _ = answered(path, Request(sources, prior=SET), folder / "out")
    return result


def test_it_is_named_with_its_mass_and_its_centre(found: Diagnosis) -> None:
    assert found.verdict == NAMED
    (one,) = found.findings
    assert one.hypothesis.effect == "payload"
    # Of what lies beside the axis of the last joint the set knows nothing.
    wanted = {"M": MASS, "MZ": MASS * CENTRE[2]}
    for name, value in wanted.items():
        estimate = one.parameters[name]
        assert estimate.value is not None
        assert estimate.std is not None
        assert abs(estimate.value - value) < 4 * estimate.std, name
        assert estimate.std < 0.2 * MASS * (1.0 if name == "M" else 0.3)


def test_what_is_known_is_not_contradicted(found: Diagnosis) -> None:
    assert found.contradicted == ()
