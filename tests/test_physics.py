"""The laws that any mechanism obeys, asked of the generated functions: no second implementation is needed for these."""

from __future__ import annotations

import numpy as np
import pytest

from tests.subject import FAST, FRICTION, LOADED, LOSSES, SPRINGS, Subject, Vector, close, slope

SEEDS = (11, 12)


def inertia_matrix(arm: Subject, q: Vector) -> Vector:
    return arm.output("inertia_matrix", q=q)


def potential_energy(arm: Subject, q: Vector) -> Vector:
    return arm.output("potential_energy", q=q)


def gradient(arm: Subject, q: Vector, step: float = 1e-3) -> Vector:
    """Gradient of the potential energy (n)."""
    axes = np.eye(arm.dof)
    return np.array([slope(lambda x, axis=axis: potential_energy(arm, q + x * axis), step) for axis in axes])


@pytest.mark.parametrize("seed", SEEDS)
def test_inertia_matrix_is_the_hessian_of_the_kinetic_energy(arm: Subject, seed: int) -> None:
    q, _, _ = arm.state(seed)
    axes = np.eye(arm.dof)

    def energy(qd: Vector) -> float:
        return float(arm.output("kinetic_energy", q=q, qd=qd))

    M = [[energy(a + b) - energy(a) - energy(b) for b in axes] for a in axes]
    assert close(inertia_matrix(arm, q), M)


@pytest.mark.parametrize("seed", SEEDS)
def test_inertia_matrix_is_symmetric_and_positive_definite(arm: Subject, seed: int) -> None:
    q, _, _ = arm.state(seed)
    M = inertia_matrix(arm, q)
    assert close(M, M.T, 1e-15)
    assert np.linalg.eigvalsh(M).min() > 0


@pytest.mark.parametrize("seed", SEEDS)
def test_gravity_is_the_gradient_of_the_potential(arm: Subject, seed: int) -> None:
    unsprung = arm.without(*SPRINGS)
    q, _, _ = arm.state(seed)
    assert close(gradient(unsprung, q), unsprung.output("gravity", q=q), 1e-8)


@pytest.mark.parametrize("seed", SEEDS)
def test_torque_at_rest_is_the_gradient_of_the_potential(arm: Subject, seed: int) -> None:
    quiet = arm.kept.without(*LOSSES, *FAST)
    q, _, _ = arm.state(seed)
    assert close(gradient(quiet, q), quiet.output("bias", q=q, qd=0 * q), 1e-8)


@pytest.mark.parametrize("seed", SEEDS)
def test_ripple_of_the_motors_is_the_gradient_of_its_energy(arm: Subject, seed: int) -> None:
    rippling = arm.only(*FAST)
    q, _, _ = arm.state(seed)
    rates = [
        abs(ratio * one.site.values["order"])
        for one in arm.model.effects
        if "motor" in one.effect.needs
        for ratio in one.site.ratios.values()
    ]
    step = 1e-3 / float(max(rates, default=1))
    assert close(gradient(rippling, q, step), rippling.output("bias", q=q, qd=0 * q), 1e-8)


def test_potential_energy_starts_at_zero(arm: Subject) -> None:
    assert abs(potential_energy(arm, np.zeros(arm.dof))) < 1e-9


@pytest.mark.parametrize("seed", SEEDS)
def test_torques_are_inertia_times_acceleration_and_bias(arm: Subject, seed: int) -> None:
    # Friction by load is not affine in the acceleration.
    arm = arm.kept.without(*LOADED) if arm.loaded else arm
    q, qd, qdd = arm.state(seed)
    tau = inertia_matrix(arm, q) @ qdd + arm.output("bias", q=q, qd=qd)
    assert close(arm.output("inverse_dynamics", q=q, qd=qd, qdd=qdd), tau)


@pytest.mark.parametrize("seed", SEEDS)
def test_coriolis_torques_are_the_christoffel_symbols_of_the_inertia_matrix(arm: Subject, seed: int) -> None:
    # With C made of Christoffel symbols M' - 2 C is skew: the motion is passive.
    quiet = arm.without(*LOSSES)
    q, qd, _ = arm.state(seed)
    axes = np.eye(arm.dof)
    dM = np.array([slope(lambda x, axis=axis: inertia_matrix(quiet, q + x * axis)) for axis in axes])
    C = 0.5 * (np.einsum("kij,k->ij", dM, qd) + np.einsum("jik,k->ij", dM, qd) - np.einsum("ijk,k->ij", dM, qd))
    coriolis = quiet.output("bias", q=q, qd=qd) - quiet.output("bias", q=q, qd=0 * q)
    scale = np.abs(inertia_matrix(quiet, q)).max() * np.abs(qd).max() ** 2
    assert np.abs(C @ qd - coriolis).max() <= 1e-9 * scale
    rate = np.einsum("kij,k->ij", dM, qd) - 2 * C
    assert close(rate, -rate.T, 1e-12)


@pytest.mark.parametrize("seed", SEEDS)
def test_power_becomes_energy_and_loss(arm: Subject, seed: int) -> None:
    # What the groupings mix, an offset with weight, say, is neither: the parameters that stay tell.
    arm = arm.kept.without(*FAST)
    q, qd, qdd = arm.state(seed)

    def energy(t: float) -> Vector:
        at, speed = q + qd * t + qdd * t * t / 2, qd + qdd * t
        return arm.output("kinetic_energy", q=at, qd=speed) + potential_energy(arm, at)

    tau = arm.output("inverse_dynamics", q=q, qd=qd, qdd=qdd)
    state = {"q": q, "qd": qd, "qdd": qdd}
    lossless = arm.without(*LOSSES)
    loss = arm.expected("inverse_dynamics", state)["tau"] - lossless.expected("inverse_dynamics", state)["tau"]
    power = (tau - loss) @ qd
    scale = np.abs(tau) @ np.abs(qd)
    assert abs(slope(energy, 1e-4) - power) <= 1e-8 * max(scale, 1e-3)


@pytest.mark.parametrize("seed", SEEDS)
def test_direct_after_inverse_is_identity(arm: Subject, seed: int) -> None:
    inputs = arm.inputs(arm.model.functions["direct_dynamics_loaded"], seed)
    q, qd, qdd = arm.state(seed)
    load = {name: inputs[name] for name in ("payload", "wrench")}
    tolerance = 1e-12 * max(100.0, np.linalg.cond(inertia_matrix(arm, q)))
    tau = arm.output("inverse_dynamics", q=q, qd=qd, qdd=qdd)
    assert close(arm.output("direct_dynamics", q=q, qd=qd, tau=tau), qdd, tolerance)
    tau = arm.output("inverse_dynamics_loaded", q=q, qd=qd, qdd=qdd, **load)
    assert close(arm.output("direct_dynamics_loaded", q=q, qd=qd, tau=tau, **load), qdd, tolerance)


@pytest.mark.parametrize("seed", SEEDS)
def test_friction_opposes_motion_and_vanishes_at_rest(arm: Subject, seed: int) -> None:
    rubbing = arm.only(*FRICTION)
    q, qd, _ = arm.state(seed)
    tau = rubbing.output("inverse_dynamics", q=q, qd=qd, qdd=0 * q)
    rubs = np.array([any(f"{stem}{j.number}" in rubbing.values for stem in FRICTION) for j in arm.robot.moving])
    assert (tau * qd > 1e-6 * rubs - 1e-9).all()
    assert close(tau * ~rubs, 0 * tau, 1e-6)
    # At rest asymmetric friction is the middle of the values that it can take.
    still = arm.only(*(stem for stem in FRICTION if stem not in ("Fcp", "Fcn")))
    assert close(still.output("inverse_dynamics", q=q, qd=0 * q, qdd=0 * q), 0 * q, 1e-6)


def test_a_payload_is_a_body_of_the_tool(arm: Subject) -> None:
    # What hangs on the tool is, for the rest of the robot, a change of the bodies that carry it.
    # What hangs on the tool rubs in the transmissions where friction depends on the load: that is not the body's.
    arm = arm.without(*LOADED)
    inputs = arm.inputs(arm.model.functions["inverse_dynamics_loaded"], 13)
    state = {name: value for name, value in inputs.items() if name not in ("payload", "wrench")}
    loaded = arm.output("inverse_dynamics_loaded", **inputs)
    parts = (
        arm.output("inverse_dynamics", **state)
        + arm.output("payload_regressor", **state) @ inputs["payload"]
        + arm.output("wrench_torque", q=inputs["q"], wrench=inputs["wrench"])
    )
    assert close(loaded, parts)
