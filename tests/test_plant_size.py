"""Effects of the simulated robot of ``tests/plant``: what each adds to the torque, weighed against the noise."""

from __future__ import annotations

import numpy as np
import pytest

from tests.plant.effect import Effect
from tests.plant.library import LAWS
from tests.plant.machine import Machine
from tests.plant.measurement import Sensors
from tests.plant.robot import Array
from tests.plant.robots import ROBOTS
from tests.plant.run import Run
from tests.plant.simulate import RanAway, make_run, own_effects
from tests.plant.size import effect_torque, free_fit, scale_effect, torque_with, torque_without, whitened_size
from tests.plant.trajectories.fourier import fourier

ARM = ROBOTS["three_axis"]
SHORT = fourier(3, period=5.0, periods=2, harmonics=4)


@pytest.mark.parametrize("law", sorted(LAWS))
def test_every_law_acts_and_vanishes_with_its_size(law: str) -> None:
    joint = 3 if law.startswith("wrist") else 2
    values = {"place": float(ARM.centre[1])} if law in ("soft_stop", "position_bump", "sticky_spot") else {}
    effect = Effect(law, joint, values=values, other=1)
    effect = effect.sized(effect.amount(ARM))
    sensors = Sensors(link_encoders=3)
    played = make_run(ARM, SHORT, [effect], sensors=sensors)
    if law == "link_latency":
        plain = make_run(ARM, SHORT, sensors=sensors)
        assert played.qs is not None
        assert plain.qs is not None
        assert np.max(np.abs(played.qs - plain.qs)) > 1e-4
        return
    size = whitened_size(played, effect_torque(played, effect), limit=20.0)
    assert size > 0.1
    # What is elastic cannot be followed to no compliance at all: its steps become too short.
    part = 0.05 if law in ("joint_flexibility", "backlash") else 1e-4
    little = effect.sized(part * effect.amount(ARM))
    played = make_run(ARM, SHORT, [little], sensors=sensors)
    assert whitened_size(played, effect_torque(played, little), limit=20.0) < max(0.03, 1.5 * part * size)


def test_what_an_effect_adds_is_what_changes_along_the_same_motion() -> None:
    """A payload, a gain, a wrong ratio, a tilt and an offset of an encoder, each worked out by hand."""

    def rigid(machine: Machine, scale: float = 1.0, shift: float = 0.0) -> Array:
        column = np.array([1.0, scale, 1.0])
        truth = played.truth
        shifted = truth.q * column + np.array([0.0, shift, 0.0])
        return machine.rigid_torques(shifted, truth.qd * column, truth.qdd * column)

    own = [effect for effect in own_effects(ARM) if effect.law in ("viscous", "coulomb")]
    nominal = Machine(ARM, tuple(own))
    viscous = ARM.chain[1].viscous
    for effect in (
        Effect("payload", size=8.0),
        Effect("base_tilt", size=0.03),
        Effect("torque_gain", 2, -0.1),
        Effect("encoder_offset", 2, 0.02),
        Effect("gear_ratio", 2, 0.02),
    ):
        played = make_run(ARM, SHORT, [effect], own=own)
        if effect.law == "torque_gain":
            expected = np.zeros_like(played.q)
            expected[:, 1] = torque_with(played)[:, 1] * 0.1
        else:
            scale = 1.02 if effect.law == "gear_ratio" else 1.0
            shift = 0.02 if effect.law == "encoder_offset" else 0.0
            expected = rigid(played.machine) - rigid(nominal, scale, shift)
            if effect.law == "gear_ratio":
                # The log divides by the nominal ratio what acts over the true one.
                acting = rigid(played.machine) + _own_torque(played)
                expected = acting / np.array([1.0, 1.02, 1.0]) - rigid(nominal, scale) - _own_torque(played)
                expected[:, 1] -= 0.02 * viscous * played.truth.qd[:, 1]
        found = effect_torque(played, effect)
        left = whitened_size(played, found - expected, limit=50.0)
        assert left < 0.03, effect.law
        assert whitened_size(played, expected, limit=50.0) > 0.2, effect.law


def test_a_wrong_gain_scales_what_the_log_shows_of_another_effect() -> None:
    payload, gain = Effect("payload", size=8.0), Effect("torque_gain", 2, 0.5)
    plain, weak = make_run(ARM, SHORT, [payload]), make_run(ARM, SHORT, [payload, gain])
    expected = effect_torque(plain, payload) / np.array([1.0, 1.5, 1.0])
    assert whitened_size(weak, effect_torque(weak, payload) - expected, limit=20.0) < 0.05
    assert whitened_size(weak, expected, limit=20.0) > 1.0


def _own_torque(run: Run) -> Array:
    torques = (np.outer(run.truth.torque[:, k], effect.along(ARM)) for k, effect in enumerate(run.machine.torques))
    return np.asarray(np.sum(list(torques), axis=0))


def test_noise_has_size_one_and_is_lost_by_a_projection() -> None:
    run = make_run(ARM, fourier(1, period=5.0, periods=8), seed=3)
    noise = run.tau - torque_with(run)
    assert whitened_size(run, noise) == pytest.approx(1.0, abs=0.02)
    assert whitened_size(run, noise, limit=20.0) == pytest.approx(1.0, abs=0.05)
    basis = np.stack([noise, np.ones_like(noise), np.zeros_like(noise)], axis=2)
    assert whitened_size(run, noise, basis) < 1e-9
    basis[..., 0] = np.random.default_rng(1).normal(size=noise.shape)
    assert whitened_size(run, noise, basis) == pytest.approx(1.0, abs=0.02)


@pytest.mark.parametrize(
    ("effect", "target"),
    [
        (Effect("stribeck", 3), 1.0),
        (Effect("payload"), 0.5),
        (Effect("joint_flexibility", 2), 1.0),
        pytest.param(Effect("current_saturation", 2), 2.0, marks=pytest.mark.long),
        (Effect("encoder_offset", 2, -0.01), 1.0),
    ],
)
def test_an_effect_is_scaled_to_a_size(effect: Effect, target: float) -> None:
    found, _ = scale_effect(ARM, SHORT, effect, target, seed=4)
    again = make_run(ARM, SHORT, [found], seed=9)
    assert whitened_size(again, effect_torque(again, found)) == pytest.approx(target, rel=0.03)
    assert np.sign(found.amount(ARM)) == np.sign(effect.amount(ARM))


@pytest.mark.parametrize("name", ["three_axis", pytest.param("small_wrist", marks=pytest.mark.long), "scara_like"])
def test_a_free_fit_absorbs_a_payload_and_no_stribeck(name: str) -> None:
    robot = ROBOTS[name]
    payload, stribeck = Effect("payload"), Effect("stribeck", 2)
    played = make_run(robot, fourier(6, period=5.0, periods=2), [payload, stribeck])
    basis = free_fit(played, stribeck)
    assert basis.shape == (*played.q.shape, basis.shape[2])
    known = whitened_size(played, effect_torque(played, payload), limit=20.0)
    assert whitened_size(played, effect_torque(played, payload), basis, limit=20.0) < 0.05 * known + 0.02
    assert whitened_size(played, torque_with(played), free_fit(played), limit=20.0) < 0.03
    raw = whitened_size(played, effect_torque(played, stribeck), limit=20.0, joints=[2])
    left = whitened_size(played, effect_torque(played, stribeck), basis, limit=20.0, joints=[2])
    assert 0.3 * raw < left < raw


def test_sizes_out_of_reach_are_refused() -> None:
    with pytest.raises(ValueError, match="does not come to 1000"):
        scale_effect(ARM, SHORT, Effect("gradual_rise", 1), 1000.0)
    played = make_run(ARM, SHORT)
    with pytest.raises(ValueError, match="no payload"):
        torque_without(played, Effect("payload"))
    with pytest.raises(RanAway):
        make_run(ARM, SHORT, [Effect("offset", 1, 1e12)])
    with pytest.raises(ValueError, match="not whole"):
        make_run(ARM, fourier(1, period=5.0005))
