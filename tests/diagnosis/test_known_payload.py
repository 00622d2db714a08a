"""A payload that a run's sidecar tells is part of the model: nothing of it is left for a diagnosis to name."""

from __future__ import annotations

from dataclasses import replace
from math import cos, sin

import numpy as np
import pytest

from generator.errors import InputError
from identification.diagnosis.candidates import base_tilt
from identification.diagnosis.columns.bank import Bank
from identification.diagnosis.runs.link_side import link_side
from identification.diagnosis.runs.prepared import prepared
from identification.diagnosis.runs.scene import Scene
from identification.recipes import Recipe
from identification.sidecar import Payload
from tests.bodies import STEMS, ten_parameters
from tests.diagnosis.diagnosed import CLEAN, Known, known
from tests.plant.effect import Effect
from tests.plant.robots import ROBOTS
from tests.plant.simulate import make_run, own_effects
from tests.plant.trajectories.fourier import fourier

MASS, CENTRE, RADIUS = 30.0, np.array([0.04, -0.02, 0.05]), 0.06
CARRIED = Effect("payload", 1, MASS)
ROBOT = ROBOTS["kr500_like"]


def sidecar() -> Payload:
    """The body of the simulated robot, in its tool's frame."""
    ten = ten_parameters(MASS, CENTRE, MASS * RADIUS**2 * np.eye(3))
    return Payload("L", dict(zip(STEMS, ten.tolist(), strict=True)))


@pytest.fixture(scope="module")
def robot(tmp_path_factory: pytest.TempPathFactory) -> Known:
    return known(ROBOT, tmp_path_factory.mktemp("robot"))


def loaded(robot: Known, *effects: Effect) -> tuple[Scene, Scene]:
    """A run with the payload, as its sidecar tells and without a sidecar."""
    own = [one for one in own_effects(ROBOT) if not one.law.startswith("wrist")]
    way = fourier(1, period=10.0, periods=1, before=2.0)
    untold = robot.scene(make_run(ROBOT, way, [CARRIED, *effects], sensors=CLEAN, own=own))
    run = replace(untold.sampled.run, payload=sidecar())
    return replace(untold, sampled=replace(untold.sampled, run=run)), untold


def left(bank: Bank, scene: Scene) -> np.ndarray:
    """Rms of each joint's kept rows that the true base parameters leave."""
    weights = {k: scene.values[name] for k, name in enumerate(bank.base)}
    kept = [bank.raw(0, k)[3] for k in range(bank.dof)]
    return np.array([np.std(bank.residual(0, k, weights, white=False)[kept[k]]) for k in range(bank.dof)])


def test_what_is_known_of_a_payload_is_no_ones_fault(robot: Known) -> None:
    banks = []
    for scene in loaded(robot):
        one = prepared(scene.sampled.run, Recipe(), scene.regressors)
        again = replace(scene, sampled=one.sampled)
        banks.append((Bank([one], [again]), again))
    told, untold = (left(*each) for each in banks)
    assert np.all(told[[1, 2, 4]] < 0.05 * untold[[1, 2, 4]])
    scene = banks[0][1]
    # Medians: at the recorded rate friction jumps where the speed, filtered, does not yet.
    error, wrong = (np.median(np.abs(each.tau - each.torque), axis=1) for _, each in banks)
    assert np.all(error[[1, 2]] < 0.05 * wrong[[1, 2]])
    # The link side of a drive train carries it too.
    heavier, lighter = (float(link_side(each, 1, 0.0).inertia.mean()) for _, each in banks)
    assert heavier > lighter + MASS
    np.testing.assert_allclose(scene.load - banks[1][1].load, scene.carried(scene.motion), atol=1e-6)


def test_a_tilted_base_turns_the_payloads_weight_too(robot: Known) -> None:
    told, _ = loaded(robot, Effect("base_tilt", 1, 0.01))
    (hypothesis,) = base_tilt.hypotheses([told])
    scale = np.std(told.tau, axis=1)[:, None]
    columns = (hypothesis.columns(told, {}) / scale).reshape(len(hypothesis.coefficients), -1)
    moving = (np.abs(told.motion.qd) > 0.04 * np.std(told.motion.qd, axis=1)[:, None]).reshape(-1)
    truth = ((told.tau - told.torque) / scale).reshape(-1)
    x = np.linalg.lstsq(columns[:, moving].T, truth[moving], rcond=None)[0]
    np.testing.assert_allclose(x[:2], [0.01 * cos(0.6), 0.01 * sin(0.6)], rtol=0.05)


def test_a_payload_that_is_sought_is_refused(robot: Known) -> None:
    told, _ = loaded(robot)
    run = replace(told.sampled.run, payload=Payload("L", {"M": 30.0, "MX": 0.0}))
    with pytest.raises(InputError, match="XX, XY, XZ, YY, YZ, ZZ, MY, MZ of payload L are sought"):
        prepared(run, Recipe(), told.regressors)
