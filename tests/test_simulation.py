"""The generated simulation: its integrators, controller and closed loop."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from generator.backends import c as c_backend
from generator.c_selftest import WARNINGS
from generator.resources import find_robot
from generator.robot.readers import read
from tests.compiled import run, write
from tests.simulated import METHODS, PLANTS, QUANTITIES, Gains, Make, Vector, arm, emit, positions, state_of
from tests.subject import Subject, subject

#: Wide enough that steps resolve the turn of the friction [rad/s].
WIDE = 0.5
#: A method's errors with a few steps fall by this much of its order at least.
SLACK = 0.35
NAMES = [method.name.upper() for method in METHODS]


# -- integrators ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("method", METHODS, ids=NAMES)
@pytest.mark.parametrize(
    ("name", "plant"),
    [("kr500", "rigid"), ("scara", "flexible"), pytest.param("tree_two_arms", "rigid", marks=pytest.mark.long)],
)
def test_errors_fall_with_the_order_of_the_method(name: str, plant: str, method: Any, make: Make) -> None:
    of = arm(name)
    simulated = make(of, plant)
    q, qd = state_of(of, plant)

    def after(name: str, steps: int) -> Vector:
        state = simulated.start(q, qd)
        simulated.advance(state, simulated.integration(name, steps, WIDE), time, np.zeros(of.dof))
        return np.concatenate([positions(state), list(state.qd)])

    time = 0.8 if plant == "rigid" else 0.2
    counts = {4: (200, 300, 400, 600), 8: (14, 18, 22, 28)}[method.order]
    exact = after("DP8", 2000)
    errors = [np.abs(after(method.name.upper(), steps) - exact).max() for steps in counts]
    slope = -np.polyfit(np.log(counts), np.log(errors), 1)[0]
    assert errors[-1] > 3e-14, "nothing but rounding is left to see"
    assert slope > method.order - SLACK


@pytest.mark.parametrize("method", [*NAMES[:1], *(pytest.param(name, marks=pytest.mark.long) for name in NAMES[1:])])
@pytest.mark.parametrize(("name", "plant"), PLANTS)
def test_an_undriven_robot_without_friction_keeps_its_energy(name: str, plant: str, method: str, make: Make) -> None:
    of = arm(name).without("Fv", "Fc", "Off", "Fvm", "Fcm", "Offm")
    simulated = make(of, plant)
    state = simulated.start(*state_of(of, plant))

    def energy() -> float:
        q, qd = positions(state), np.array(list(state.qd))
        if plant == "rigid":
            return total(of, q, qd)
        n, at = of.dof, list(of.model.elastic)
        link_q, link_qd = q[:n].copy(), qd[:n].copy()
        link_q[at] += q[n:]
        link_qd[at] += qd[n:]
        numbers = of.robot.flexible
        rotors = sum(of.values[f"Iam{j}"] * qd[i] ** 2 for i, j in zip(at, numbers, strict=True))
        springs = sum(of.values[f"k{j}"] * e**2 for j, e in zip(numbers, q[n:], strict=True))
        return total(of, link_q, link_qd) + 0.5 * float(rotors + springs)

    first = energy()
    simulated.advance(state, simulated.integration(method, 3000), 0.3, np.zeros(of.dof))
    moved = 1e-3 * abs(first) + sum(abs(x) for x in state.qd)
    assert energy() == pytest.approx(first, abs=2e-9 * max(abs(first), moved, 1e3))


def total(of: Subject, q: Vector, qd: Vector) -> float:
    """Energy of the links by the reference."""
    kinetic = of.expected("kinetic_energy", {"q": q, "qd": qd})["T"]
    return float(kinetic + of.expected("potential_energy", {"q": q})["U"])


@pytest.mark.parametrize(("name", "plant"), PLANTS)
def test_a_step_is_what_scipy_integrates(name: str, plant: str, make: Make) -> None:
    of = arm(name)
    simulated = make(of, plant)
    q, qd = state_of(of, plant)
    tau = 50 * np.cos(np.arange(of.dof))
    wanted = solve_ivp(simulated.smooth_rate(tau, 0.1), (0, 0.05), [*q, *qd], "DOP853", rtol=1e-12, atol=1e-14).y[:, -1]
    for method, steps in (("RK4", 2000), ("DP8", 200)):
        state = simulated.advance(simulated.start(q, qd), simulated.integration(method, steps, 0.1), 0.05, tau)
        found = np.concatenate([positions(state), list(state.qd)])
        assert np.abs(found - wanted).max() <= 1e-9 * np.abs(wanted).max(), method


def test_torques_of_the_surroundings_act_on_the_links(make: Make) -> None:
    of = arm("scara")
    push, tau = np.array([3.0, -2.0, 40.0, 0.5]), np.array([5.0, 4.0, -20.0, 0.2])
    rigid = make(of, "rigid")
    q, qd = state_of(of, "rigid")
    how = rigid.integration("DP8", 20, WIDE)
    together = rigid.advance(rigid.start(q, qd), how, 0.02, tau + push)
    apart = rigid.advance(rigid.start(q, qd), how, 0.02, tau, push)
    assert positions(apart) == pytest.approx(positions(together), abs=1e-14)

    # A push at once accelerates the links, their motors only through the springs.
    flexible = make(of.without("Fv", "Fc"), "flexible")
    still = np.zeros(flexible.size)
    pushed = flexible.advance(flexible.start(still, still), flexible.integration("DP8", 1, WIDE), 1e-6, 0 * push, push)
    free = flexible.advance(flexible.start(still, still), flexible.integration("DP8", 1, WIDE), 1e-6, 0 * push)
    M = of.without("Fv", "Fc").expected("inertia_matrix", {"q": np.zeros(4)})["M"]
    gained = np.array(list(pushed.qd)) - np.array(list(free.qd))
    at_links = gained[:4].copy()
    at_links[list(of.model.elastic)] += gained[4:]
    assert at_links == pytest.approx(np.linalg.solve(M, push) * 1e-6, rel=1e-5, abs=1e-12)
    assert np.abs(gained[:3]).max() < 1e-10


# -- the controller ---------------------------------------------------------------------------------------------------


def cascade(of: Subject, gains: Gains, wanted: list[Vector], q: Vector, qd: Vector, z: Vector) -> tuple[Vector, Vector]:
    """One sample of the controller, written apart from the template."""
    n = of.dof
    N = np.eye(n)
    if of.robot.drives is not None:
        N = np.array([[float(entry) for entry in row] for row in of.robot.drives.coupling])
    q_ref, qd_ref, fed = wanted
    speed = gains.kp * (N @ (q_ref - q[:n])) + N @ (qd_ref - qd[:n])
    grown = z + gains.ki * gains.period * speed
    free = gains.kv * (speed + grown) + np.linalg.solve(N.T, fed)
    limit = np.broadcast_to(gains.limit, n)
    tau = np.clip(free, -limit, limit)
    further = ((free > limit) & (grown > z)) | ((free < -limit) & (grown < z))
    return N.T @ tau, np.where(further, z, grown)


def gains_of(of: Subject) -> Gains:
    ratio = np.ones(of.dof)
    if of.robot.drives is not None:
        ratio = np.abs([float(of.robot.drives.coupling[k][k]) for k in range(of.dof)])
    return Gains(10.0, 300.0 / ratio**2, 20.0, 60.0 / ratio)


@pytest.mark.parametrize("plant", ["rigid", "flexible"])
@pytest.mark.parametrize("name", ["kr500", pytest.param("kr270", marks=pytest.mark.long), "scara"])
def test_a_closed_loop_in_saturation_is_the_same_elsewhere(name: str, plant: str, make: Make) -> None:
    of = arm(name)
    simulated, gains, n = make(of, plant), gains_of(of), of.dof
    q, qd = state_of(of, plant)
    q[n:], qd = 0, 0 * qd
    t = np.arange(50)[:, None] * gains.period
    reference = {"q": q[:n] + 0.05 * np.sin(40 * t), "qd": 2 * np.cos(40 * t) * np.ones(n), "tau": 5 * np.ones((50, n))}
    reference["tau_ext"] = 20 * np.sin(60 * t) * np.ones(n)
    found = simulated.simulate(gains, simulated.integration("DP8", 4, 0.1), reference, simulated.start(q, qd))

    x, z, cut = np.concatenate([q, qd]), np.zeros(n), 0
    assert found.done == len(t)
    for k in range(len(t)):
        assert np.concatenate([found.q[k], found.qd[k]]) == pytest.approx(x, abs=1e-9 * np.abs(x).max())
        wanted = [reference[signal][k] for signal in ("q", "qd", "tau")]
        tau, z = cascade(of, gains, wanted, x[: simulated.size], x[simulated.size :], z)
        assert found.tau[k] == pytest.approx(tau, rel=1e-6, abs=1e-6 * np.abs(tau).max())
        cut += int((np.abs(np.abs(cascade_at_rotor(of, tau)) - gains.limit) < 1e-9).any())
        pushed = simulated.smooth_rate(tau, 0.1, reference["tau_ext"][k])
        x = solve_ivp(pushed, (0, gains.period), x, "DOP853", rtol=1e-12, atol=1e-14).y[:, -1]
    assert cut > 5


def cascade_at_rotor(of: Subject, tau: Vector) -> Vector:
    """Torques of the rotors."""
    return tau if of.robot.drives is None else of.expected("motor_torque", {"tau": tau})["tau_r"]


def test_the_integral_waits_while_the_torque_is_cut(make: Make) -> None:
    of = arm("scara")
    simulated, still = make(of), np.zeros(4)
    gains = Gains(10.0, 100.0, 5.0, 20.0)
    far, near = np.full(4, 0.5), np.full(4, 0.001)
    tau, z = simulated.control(gains, still, [far, None, None], still, still)
    assert list(tau) == [20.0] * 4
    assert not z.any()
    tau, z = simulated.control(gains, still, [near, None, None], still, still)
    assert z == pytest.approx(5e-3 * 0.01 * np.ones(4))
    assert tau == pytest.approx(100 * (0.01 + z))
    _, back = simulated.control(gains, np.full(4, 5.0), [-near, None, None], still, still)
    assert (back < 5.0).all()  # cut above, and the error lets the integral come down


@pytest.mark.parametrize("flag", ["-O2", "-ffast-math"])
def test_a_run_that_diverges_ends(flag: str, make: Make) -> None:
    of = arm("scara")
    simulated = make(of, "flexible", flag)
    reference = {"q": np.ones((400, 4))}
    wild = replace(gains_of(of), kv=1e9, limit=1e300)
    still = np.zeros(simulated.size)
    done = simulated.simulate(wild, simulated.integration("RK4", 1, 0.01), reference, simulated.start(still, still))
    assert 0 < done.done < 400
    smallest = np.nextafter(0.0, 1.0)
    assert np.float64(2.0) * smallest > 0.0


# -- the code ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("precision", ["", "USE_FLOAT"])
@pytest.mark.parametrize("name", ["kr500", "kr270", "scara", "tree_two_arms"])
def test_strictly_compiled_in_both_precisions(name: str, precision: str, tmp_path: Path) -> None:
    emit(arm(name).model, tmp_path)
    define = [f"-D{name.upper()}_{precision}"] if precision else []
    source = tmp_path / "simulation" / f"{name}_simulation.c"
    run(["gcc", "-std=c99", "-O1", *WARNINGS, *define, f"-I{tmp_path / 'c'}", "-c", source, "-o", tmp_path / "s.o"])
    text = source.read_text()
    assert "malloc" not in text
    assert "static " in text
    assert "printf" not in text


@pytest.mark.parametrize("width", [0.05, None])
def test_single_precision_follows_double(width: float | None, make: Make) -> None:
    of = arm("scara")
    ends = []
    for flags in ((), ("-DSCARA_USE_FLOAT",)):
        simulated = make(of, "flexible", *flags)
        q, qd = state_of(of, "flexible")
        t = np.arange(100)[:, None] * 1e-3
        found = simulated.simulate(
            gains_of(of), simulated.integration("RK4", 2, width), {"q": q[:4] + t}, simulated.start(q, qd)
        )
        ends.append(found.q[-1])
    assert ends[1] == pytest.approx(ends[0], abs=2e-4)


def test_runs_under_sanitizers(tmp_path: Path) -> None:
    of = arm("scara")
    emit(of.model, tmp_path)
    write(tmp_path, {"main.c": _MAIN.replace("@", "scara").replace("#N", "SCARA")})
    sources = [tmp_path / "c" / "scara.c", tmp_path / "simulation" / "scara_simulation.c", tmp_path / "main.c"]
    flags = ["-std=c99", "-g1", "-fsanitize=address,undefined", "-fno-sanitize-recover=all"]
    folders = [f"-I{tmp_path / 'c'}", f"-I{tmp_path / 'simulation'}"]
    run(["gcc", *flags, *folders, *sources, "-o", tmp_path / "main", "-lm"])
    assert run([tmp_path / "main"]) == "60 60\n"


@pytest.mark.parametrize("precision", ["", "-DSCARA_USE_FLOAT"])
def test_events_are_found_in_few_trials(precision: str, tmp_path: Path) -> None:
    """A step takes 6 evaluations without an event; halving would take 34 trials of as many each, and 20 in float."""
    emit(arm("scara").model, tmp_path)
    write(tmp_path, {"main.c": _COUNTING})
    folders = [f"-I{tmp_path / 'c'}", f"-I{tmp_path / 'simulation'}"]
    flags = ["-std=c99", "-O1", *([precision] if precision else [])]
    run(["gcc", *flags, *folders, tmp_path / "c" / "scara.c", tmp_path / "main.c", "-o", tmp_path / "main", "-lm"])
    sliding, stopping = map(int, run([tmp_path / "main"]).split())
    assert sliding < stopping < 10 * sliding


_COUNTING = """
#include <stdio.h>
#include "scara.h"

static int evaluations;

static void counted(
    const scara_prepared *prepared, const scara_real q[4], const scara_real qd[4], const scara_real tau[4],
    const scara_real direction[4], scara_real qdd[4])
{
    ++evaluations;
    scara_direct_dynamics_sliding(prepared, q, qd, tau, direction, qdd);
}

#define scara_direct_dynamics_sliding counted
#include "scara_simulation.c"

static int of_a_step(scara_real speed)
{
    const scara_real q[4] = { R(0.1), R(0.2), R(0.3), R(0.4) };
    const scara_real qd[4] = { speed, R(0.3), R(0.2), R(0.2) };
    const scara_real tau[4] = { R(0.0) };
    const scara_integration how = { SCARA_METHOD_RK4, 1, NULL };
    scara_params params;
    scara_prepared prepared;
    scara_rigid_state state;
    scara_params_example(&params);
    scara_prepare(&params, &prepared);
    scara_rigid_start(&prepared, q, qd, &state);
    evaluations = 0;
    scara_rigid_advance(&prepared, &how, R(2e-3), tau, NULL, &state);
    return evaluations;
}

int main(void)
{
    printf("%d %d\\n", of_a_step(R(3.0)), of_a_step(R(1e-4)));
    return 0;
}
"""

_MAIN = """
#include <stdio.h>
#include <stdlib.h>
#include "@_simulation.h"

static size_t go(const @_real *width, @_method method)
{
    @_params params;
    @_prepared prepared;
    @_controller controller;
    @_controller_state memory = { { 0 } };
    @_flexible_state state;
    @_real zero[#N_FLEXIBLE_SIZE] = { 0 };
    @_integration how = { method, 2, width };
    @_reference wanted = { 60, NULL, NULL, NULL, NULL };
    @_run_log log;
    @_real *reference = calloc(60 * #N_NQ, sizeof(@_real));
    size_t done;
    log.q = calloc(60 * #N_FLEXIBLE_SIZE, sizeof(@_real));
    log.qd = calloc(60 * #N_FLEXIBLE_SIZE, sizeof(@_real));
    log.tau = calloc(60 * #N_NQ, sizeof(@_real));
    @_params_example(&params);
    @_prepare(&params, &prepared);
    controller.period = 1e-3;
    for (int i = 0; i < #N_NQ; ++i) {
        controller.kp[i] = 10.0;
        controller.kv[i] = 5.0;
        controller.ki[i] = 5.0;
        controller.limit[i] = 50.0;
        for (int k = 0; k < 60; ++k) {
            reference[k * #N_NQ + i] = 0.001 * k;
        }
    }
    for (int e = 0; e < 3; ++e) {
        params.value[#N_k1 + 5 * e] = 1e4;
        params.value[#N_Iam1 + 5 * e] = 0.5;
    }
    @_prepare(&params, &prepared);
    wanted.q = reference;
    @_flexible_start(&prepared, zero, zero, &state);
    done = @_flexible_simulate(&prepared, &controller, &how, &wanted, &memory, &state, &log);
    free(reference);
    free(log.q);
    free(log.qd);
    free(log.tau);
    return done;
}

int main(void)
{
    const @_real width[#N_FLEXIBLE_SIZE] = { 0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1 };
    printf("%d %d\\n", (int)go(NULL, #N_METHOD_DP8), (int)go(width, #N_METHOD_RK4));
    return 0;
}
"""


def test_nothing_but_the_simulation_is_emitted_and_always_the_same(tmp_path: Path) -> None:
    first = {path.name: path.read_text() for path in (emit(arm("scara").model, tmp_path) / "simulation").iterdir()}
    assert set(first) == {"scara_simulation.h", "scara_simulation.c"}
    again = subject(read(find_robot("scara")), names=QUANTITIES).model
    other = {path.name: path.read_text() for path in (emit(again, tmp_path / "again") / "simulation").iterdir()}
    assert first == other
    assert c_backend.NAME not in first
