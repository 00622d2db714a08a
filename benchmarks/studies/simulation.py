"""Ten seconds of a flexible robot in closed loop: the generated simulation, its methods, and CasADi's cvodes.

Friction is smooth of a stated width, the controller holds its torque from sample to sample. Times are the processor's.
The error is the largest deviation from a tight reference over all samples and over the positions of all motors and
links, each in parts of the range over which it travels.
"""

from __future__ import annotations

import importlib.util
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

import casadi as ca
import numpy as np
from scipy.integrate import solve_ivp

from benchmarks.candidates import CANDIDATES
from benchmarks.closed_loop import ClosedLoop, Vector, closed_loop, control, folder
from benchmarks.compiling import FLAGS
from benchmarks.study import alone
from generator.backends import casadi as casadi_backend
from generator.backends.printing.runge_kutta import METHODS, Method
from generator.symbolic.interpret import evaluate
from tests.compiled import write
from tests.simulated import Simulation, compiled

TITLE = "Simulation of a flexible robot in closed loop"

ROBOT, SET = "kr500", "twin_flexible"
WIDTH = 0.01  # [rad/s]
PERIODS = (1e-3, 250e-6)
TARGETS = (1e-6, 1e-9, 1e-12)
_REPEATS = 5
#: Steps a sample that are tried.
_STEPS = (1, 2, 3, 4, 5, 6, 8, 10, 12, 16)

_BEST = "cvodes, Adams, functional iteration"
#: cvodes' best way on a model that oscillates, and its usual ones.
VARIANTS: dict[str, dict[str, object]] = {
    _BEST: {
        "linear_multistep_method": "adams",
        "nonlinear_solver_iteration": "functional",
    },
    "cvodes, Adams, Newton": {"linear_multistep_method": "adams"},
    "cvodes, BDF, Newton": {"linear_multistep_method": "bdf"},
}


def run(build: Path) -> dict[str, Any]:
    """A row for each way at each accuracy asked; with shorter samples for the emitted methods and the best cvodes."""
    rows: list[dict[str, object]] = []
    notes = [f"{ROBOT}, {SET}, 10 s, friction of width {WIDTH:g} rad/s; gcc {' '.join(FLAGS)}"]
    for period, methods, variants in zip(PERIODS, (CANDIDATES, METHODS), (list(VARIANTS), [_BEST]), strict=True):
        loop = closed_loop(ROBOT, SET, period)
        place = folder(build, f"methods{period:g}")
        own = Simulation(loop.model, compiled(loop.model, place, FLAGS, methods), loop.parameters, "flexible")
        tight, told = _reference(loop, own)
        found = list(_methods(loop, own, tight, methods))
        asked = [row for row in found if row["emitted"] and row["error asked"] == TARGETS[0]]
        fastest = min(row["time [ms]"] for row in asked)
        for row in _cvodes(loop, tight, TARGETS[0], variants):
            found.append({**row, "over the fastest emitted": round(row["time [ms]"] / fastest, 1)})
        rows += [{"sample": f"{period * 1e3:g} ms", **row} for row in found]
        notes += told
    return {"rows": rows, "notes": notes}


def error(loop: ClosedLoop, q: Vector, tight: Vector) -> float:
    """The largest deviation of motors and links, in parts of their ranges."""
    n = loop.model.dof
    found, wanted = (np.hstack([x[:, :n], x[:, :n] + x[:, n:]]) for x in (q, tight))
    return float((np.abs(found - wanted).max(axis=0) / np.ptp(wanted, axis=0)).max())


def _reference(loop: ClosedLoop, own: Simulation) -> tuple[Vector, list[str]]:
    """Positions by 16 steps of order 8 a sample, held against 8 steps and against scipy's DOP853."""
    of_steps = {}
    for steps in (8, 16):
        of_steps[steps] = own.simulate(
            loop.gains, own.integration("DP8", steps, WIDTH), loop.reference, _start(loop, own)
        )
    tight = of_steps[16].q
    N = loop.drives
    rotor = np.linalg.solve(N.T, of_steps[16].tau.T).T
    cut = np.mean((np.abs(rotor) >= np.asarray(loop.gains.limit) * (1 - 1e-12)).any(axis=1))
    return tight, [
        f"samples of {loop.gains.period * 1e3:g} ms: {cut:.1%} of them with a torque cut at its limit, largest "
        f"deviation of a motor from its reference {np.abs(tight[:, : loop.model.dof] - loop.reference['q']).max():.2g} "
        f"rad; highest frequency at rest {_highest(loop):.0f} Hz",
        f"reference: 16 steps of order 8 a sample; 8 steps differ by {error(loop, of_steps[8].q, tight):.1g}, scipy's "
        f"DOP853 at rtol 1e-13 over the first second by {_scipy(loop, own, tight):.1g}",
    ]


def _start(loop: ClosedLoop, own: Simulation) -> Any:
    return own.start(loop.q, loop.qd)


def _scipy(loop: ClosedLoop, own: Simulation, tight: Vector) -> float:
    """Deviation of a second with another integrator and another controller."""
    size, z, x = len(loop.q), np.zeros(loop.model.dof), np.concatenate([loop.q, loop.qd])
    rows = []
    for k in range(round(1 / loop.gains.period)):
        rows.append(x[:size])
        tau, z = control(loop, k, x[:size], x[size:], z)
        rate = own.smooth_rate(tau, WIDTH)
        x = solve_ivp(rate, (0, loop.gains.period), x, "DOP853", rtol=1e-13, atol=1e-15).y[:, -1]
    return error(loop, np.array(rows), tight[: len(rows)])


def _highest(loop: ClosedLoop) -> float:
    """Highest frequency of the undamped model where the moves begin [Hz]."""
    size, n = len(loop.q), loop.model.dof
    steps = 1e-6 * np.vstack([np.eye(size), -np.eye(size)])
    inputs = {"q": loop.q + steps, "qd": np.zeros(size), "tau": np.zeros(n), "tau_ext": np.zeros(n)}
    inputs |= {"direction": np.zeros(size), "parameters": loop.parameters}
    qdd = evaluate(loop.model.functions["flexible_direct_dynamics_sliding"], inputs)["qdd"]
    slope = (qdd[:size] - qdd[size:]).T / 2e-6
    return float(np.sqrt(np.abs(np.linalg.eigvals(slope))).max() / (2 * np.pi))


def _methods(loop: ClosedLoop, own: Simulation, tight: Vector, methods: Sequence[Method]) -> Iterator[dict[str, Any]]:
    """Each method with the fewest steps a sample that reach an error."""
    for method in methods:
        errors: dict[int, float] = {}

        def deviation(steps: int, name: str = method.name.upper(), errors: dict[int, float] = errors) -> float:
            if steps not in errors:
                integration = own.integration(name, steps, WIDTH)
                done = own.simulate(loop.gains, integration, loop.reference, _start(loop, own))
                errors[steps] = error(loop, done.q, tight) if done.done == len(tight) else np.inf
            return errors[steps]

        for target in TARGETS:
            steps = next((s for s in _STEPS if deviation(s) <= target), None)
            if steps is None:
                continue
            integration = own.integration(method.name.upper(), steps, WIDTH)
            seconds = _best(lambda i=integration: own.timed(loop.gains, i, loop.reference, _start(loop, own)))
            yield {
                "way": method.title,
                "emitted": method in METHODS,
                "error asked": target,
                "error": float(f"{errors[steps]:.1g}"),
                "evaluations a sample": len(method.A) * steps,
                "time [ms]": round(1e3 * seconds, 1),
            }


def _best(measured: Callable[[], float], repeats: int = _REPEATS) -> float:
    return min(measured() for _ in range(repeats))


def _cvodes(loop: ClosedLoop, tight: Vector, target: float, variants: Sequence[str]) -> Iterator[dict[str, Any]]:
    """Each variant at the loosest tolerance that reaches ``target``, in steps of a quarter of a decade.

    The whole closed loop is one CasADi function, its right-hand side and Jacobian compiled like the C.
    """
    for name in variants:
        options = VARIANTS[name]
        loose, fine = 16, 48
        while fine - loose > 1:
            middle = (loose + fine) // 2
            loose, fine = (loose, middle) if _deviation(loop, options, middle, tight) <= target else (middle, fine)
        tolerance = 10 ** (-fine / 4)
        whole = _casadi_loop(loop, {**options, "abstol": tolerance, "reltol": tolerance})
        found: list[Vector] = []
        seconds = _best(lambda w=whole, f=found: _run_casadi(loop, w, f), 3)
        deviation = error(loop, found[0], tight)
        yield {
            "way": name,
            "emitted": False,
            "error asked": target,
            "error": float(f"{deviation:.1g}"),
            "time [ms]": round(1e3 * seconds, 1),
            "tolerance": float(f"{tolerance:.1g}"),
        }


def _deviation(loop: ClosedLoop, options: dict[str, object], quarter: int, tight: Vector) -> float:
    """The error of cvodes at tolerances of so many quarters of a decade."""
    tolerance = 10 ** (-quarter / 4)
    found: list[Vector] = []
    _run_casadi(loop, _casadi_loop(loop, {**options, "abstol": tolerance, "reltol": tolerance}), found)
    return error(loop, found[0], tight)


def _casadi_loop(loop: ClosedLoop, options: dict[str, object]) -> Any:
    """State and integrals after each sample, from those at first and the references as columns."""
    size, n, g, N = len(loop.q), loop.model.dof, loop.gains, loop.drives
    x, tau = ca.SX.sym("x", 2 * size), ca.SX.sym("tau", n)
    build = _casadi_module(loop).build
    qdd = build("flexible_direct_dynamics_smooth")(
        loop.parameters, x[:size], x[size:], tau, np.zeros(n), np.full(size, WIDTH)
    )
    compiled = {"jit": True, "compiler": "shell", "jit_options": {"flags": list(FLAGS)}}
    model = {"x": x, "p": tau, "ode": ca.vertcat(x[size:], qdd)}
    one = ca.integrator("one", "cvodes", model, 0, g.period, {**compiled, "max_num_steps": 10**6, **options})
    X, z, wanted = ca.MX.sym("X", 2 * size), ca.MX.sym("z", n), ca.MX.sym("wanted", 3 * n)
    q, qd, fed = ca.vertsplit(wanted, n)
    e = g.kp * (N @ (q - X[:n])) + N @ (qd - X[size : size + n])
    growth = g.ki * g.period * e
    free = g.kv * (e + z + growth) + np.linalg.inv(N.T) @ fed
    cut = ca.fmax(ca.fmin(free, g.limit), -np.asarray(g.limit))
    z_next = z + ca.if_else((free - cut) * growth > 0, 0, growth)
    X_next = one(x0=X, p=ca.mtimes(N.T, cut))["xf"]
    step = ca.Function("step", [ca.vertcat(X, z), wanted], [ca.vertcat(X_next, z_next)])
    return step.mapaccum("loop", len(loop.reference["q"]))


def _casadi_module(loop: ClosedLoop) -> Any:
    """The generated module of CasADi functions."""
    with tempfile.TemporaryDirectory() as place:
        name = loop.model.robot.name
        write(Path(place), casadi_backend.emit(loop.model))
        spec = importlib.util.spec_from_file_location(name, Path(place) / f"{name}.py")
        assert spec is not None
        assert spec.loader is not None
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
    return module


def _run_casadi(loop: ClosedLoop, whole: Any, found: list[Vector]) -> float:
    """Seconds of one run; its positions at the samples are appended to ``found``."""
    first = np.concatenate([loop.q, loop.qd, np.zeros(loop.model.dof)])
    wanted = np.hstack([loop.reference[name] for name in ("q", "qd", "tau")]).T
    start = time.process_time()
    after = whole(first, wanted)
    seconds = time.process_time() - start
    size = len(loop.q)
    found.append(np.vstack([loop.q, np.array(after)[:size, :-1].T]))
    return seconds


if __name__ == "__main__":
    import benchmarks.studies.simulation as study

    alone(__file__, study)
