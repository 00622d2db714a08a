"""Output error: sensitivities against other simulations, the true parameters found again, the constraint on M(q)."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path

import cvxpy as cp
import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from generator.errors import InputError
from generator.resources import find_robot
from generator.robot.readers import read
from identification.dataset import Run, load
from identification.inverse_model import Options, identify
from identification.observation import Motion, Regressors
from identification.output_error.estimate import estimate, evaluated
from identification.output_error.experiment import Experiment, experiment
from identification.output_error.methods import gauss_newton, methods
from identification.output_error.open_loop import OpenLoop
from identification.output_error.positivity import Positivity, constrained
from identification.output_error.search import Search, Settings, search_of, starts
from identification.output_error.variations import variations
from identification.recipes import Filters, Recipe
from identification.simulation.machine import Machine, compiled
from identification.simulation.run_file import save
from identification.simulation.settings import Settings as Simulation
from identification.simulation.simulate import simulate
from tests.newton_euler import Arm
from tests.recorded import TRUTH, twin_text

Array = NDArray[np.float64]

#: Filters that leave the motion of a simulation without noise nearly as it is.
WIDE = Recipe(cutoff=100.0)


@pytest.fixture(scope="module")
def machine(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Machine]:
    path = tmp_path_factory.mktemp("output_error") / "two_links.yaml"
    path.write_text(twin_text())
    with compiled(read(path)) as made:
        yield made


@pytest.fixture(scope="module")
def slide() -> Iterator[Machine]:
    with compiled(read(find_robot("emps"))) as made:
        yield made


@pytest.fixture(scope="module")
def record(machine: Machine, tmp_path_factory: pytest.TempPathFactory) -> Callable[[float, int], str]:
    """Simulated runs by the currents' noise [A] and its seed."""
    folder = tmp_path_factory.mktemp("runs")

    def made(noise: float = 0.0, seed: int = 0) -> str:
        path = folder / f"{noise:g}_{seed}.csv"
        if not path.exists():
            found = simulate(machine, Simulation(duration=8.0, noise=[noise], noise_seed=seed))
            save(found, machine.robot.name, machine.robot.digest, path)
        return str(path)

    return made


def held(q: Array, tau: Array, start: Array, period: float) -> Experiment:
    """An experiment of one segment in which every sample is compared."""
    n = q.shape[1]
    nothing = np.zeros((n, len(q)))
    run = Run("made", read(find_robot("emps")).place, 0.0, period, q.T, tau.T)
    motion = Motion(q.T, nothing, nothing)
    filters = Filters(1 / period, 100.0, 4, 10, 0, 0)
    return Experiment(
        run, filters, period, 1, np.zeros(1), tau[None], q[None], start[None], np.zeros(n), motion, tau, np.zeros(n)
    )


def slopes(machine: Machine, values: Mapping[str, float], made: Experiment) -> dict[str, Array]:
    """Derivatives of the simulated positions (N x n) by the first state (0, 1, ..) and parameters."""
    loop = OpenLoop(machine.module, values)
    motion = loop.run(made, made.start)
    names = machine.module.BASE_PARAMETERS
    S = variations(loop.model, motion, made.step, np.arange(len(names))).forward()[0]
    states = [str(k) for k in range(S.shape[-1] - len(names))]
    return {name: S[:, :, k] for k, name in enumerate([*states, *names])}


def close(found: Array, wanted: Array, part: float) -> bool:
    return bool(np.abs(found - wanted).max() <= part * np.abs(wanted).max())


def test_sensitivities_are_those_of_another_simulation(machine: Machine) -> None:
    """Newton-Euler about the centres of mass, integrated by scipy, changed parameter by parameter."""
    standard = {"ZZ1": 2.0, "MX1": 3.0, "MY1": 0.6, "M1": 8.0, "ZZ2": 1.3, "MX2": 3.1, "MY2": -0.4, "M2": 9.0}
    motors = {"Ia1": 4.0, "Ia2": 0.9, "Fv1": 14.0, "Fv2": 7.0, "Off1": 1.5, "Off2": -0.8}
    tau, start, period, samples = np.array([90.0, 8.0]), np.array([0.3, -0.5, 0.4, -0.6]), 1e-3, 150
    t = period * np.arange(samples)

    def simulated(values: Mapping[str, float], start: Array) -> Array:
        arm = Arm(machine.robot, values)
        Ia, Fv, Off = (np.array([values[f"{stem}{j}"] for j in (1, 2)]) for stem in ("Ia", "Fv", "Off"))

        def rate(_: float, x: Array) -> Array:
            H = arm.torques(x[:2], x[2:], np.zeros(2)) + Fv * x[2:] + Off
            return np.concatenate([x[2:], np.linalg.solve(arm.inertia_matrix(x[:2]) + np.diag(Ia), tau - H)])

        found = solve_ivp(rate, (0, t[-1]), start, t_eval=t, method="DOP853", rtol=1e-9, atol=1e-11)
        result: Array = found.y[:2].T
        return result

    values = {**standard, **motors}
    coefficients = machine.model.grouping.numeric()
    base = {name: values.get(name, 0.0) for name in machine.module.BASE_PARAMETERS}
    base |= {name: sum(c * values.get(one, 0.0) for one, c in terms.items()) for name, terms in coefficients.items()}
    made = held(simulated(values, start), np.tile(tau, (samples, 1)), start, period)
    assert close(OpenLoop(machine.module, base).run(made, made.start).q[0], made.q[0], 1e-7)
    found = slopes(machine, base, made)
    for name, changed in {"ZZ1R": "ZZ1", "MX1R": "MX1", **{one: one for one in values if one in found}}.items():
        low, high = ({**values, changed: values[changed] + by} for by in (-1e-3, 1e-3))
        assert close(found[name], (simulated(high, start) - simulated(low, start)) / 2e-3, 1e-3), name
    for k, step in enumerate(1e-4 * np.eye(4)):
        assert close(found[str(k)], (simulated(values, start + step) - simulated(values, start - step)) / 2e-4, 1e-3)


@pytest.mark.parametrize(("force", "sticks"), [(-60.0, False), (-12.0, True)])
def test_sensitivities_pass_a_reversal_as_in_closed_form(slide: Machine, force: float, sticks: bool) -> None:
    """A slide with dry friction alone, whose speed reaches zero: it turns back, or stays where it is."""
    values = {"M1": 95.0, "Fv1": 0.0, "Fc1": 20.0, "Off1": 0.0}
    speed, period, samples = 0.2, 1e-3, 900
    t = period * np.arange(samples)

    def position(M: float, Fc: float, Off: float, q0: float, v0: float) -> Array:
        stop = v0 * M / (Fc + Off - force)
        rest = q0 + v0 * stop / 2
        back = np.zeros_like(t) if sticks else (force - Off + Fc) / M * (t - stop) ** 2 / 2
        return np.where(t < stop, q0 + v0 * t - (Fc + Off - force) / M * t**2 / 2, rest + back)

    names = ("M1", "Fc1", "Off1", "0", "1")
    at = np.array([95.0, 20.0, 0.0, 0.1, speed])
    made = held(position(*at)[:, None], np.full((samples, 1), force), at[3:], period)
    assert close(OpenLoop(slide.module, values).run(made, made.start).q[0], made.q[0], 1e-6)
    found = slopes(slide, values, made)
    for k, name in enumerate(names):
        step = 1e-5 * np.eye(5)[k]
        assert close(found[name][:, 0], (position(*(at + step)) - position(*(at - step))) / 2e-5, 5e-3), name


def test_without_noise_the_true_parameters_are_found(machine: Machine, record: Callable[..., str]) -> None:
    """From a start that is wrong by 15 and 20 %, with torques that are held as the simulation takes them."""
    wrong = {name: value * (1.2 if k % 2 else 0.85) for k, (name, value) in enumerate(TRUTH.items())}
    made = experiment(load(record(), machine.robot), machine.robot, WIDE, 1.0)
    exact = replace(made, q=OpenLoop(machine.module, TRUTH).run(made, made.start).q)
    of, first = search_of(machine.module, [exact], wrong, {}, Settings(WIDE))
    found = evaluated(of, gauss_newton.minimise(of, first))
    assert found.names == machine.module.BASE_PARAMETERS
    for name, value in TRUTH.items():
        assert found.values[name] == pytest.approx(value, rel=1e-4), name
    assert not found.limited
    assert found.hidden == ()


@pytest.mark.parametrize("recipe", [WIDE, Recipe()], ids=["wide", "usual"])
def test_a_recording_without_noise_gives_them_as_well(
    recipe: Recipe, machine: Machine, record: Callable[..., str]
) -> None:
    """A logged torque is the mean of those before and after its instant; filters take nothing of its jumps."""
    start = {name: 1.02 * value for name, value in TRUTH.items()}
    found = estimate(machine, [load(record(), machine.robot)], start, settings=Settings(recipe))
    for name, value in TRUTH.items():
        assert found.values[name] == pytest.approx(value, rel=1e-3, abs=1e-2), name
    assert found.train.total.relative_to_mean < 1e-3


def test_filtered_torques_are_those_of_the_recipe(machine: Machine, record: Callable[..., str]) -> None:
    run, recipe = load(record(0.5, 1), machine.robot), Recipe()
    plain, filtered = (experiment(run, machine.robot, recipe, 1.0, one).tau for one in (False, True))
    rough, smooth = (np.diff(one, axis=1).std() for one in (plain, filtered))
    assert smooth < 0.2 * rough
    assert filtered.mean(axis=(0, 1)) == pytest.approx(plain.mean(axis=(0, 1)), rel=0.02)


def test_whole_runs_can_be_simulated_at_once(machine: Machine, record: Callable[..., str]) -> None:
    start = {name: 1.02 * value for name, value in TRUTH.items()}
    found = estimate(machine, [load(record(), machine.robot)], start, settings=Settings(WIDE, segment=None))
    assert found.segments == 1
    for name, value in TRUTH.items():
        assert found.values[name] == pytest.approx(value, rel=1e-3, abs=2e-2), name


def test_true_values_lie_within_the_stated_uncertainty(machine: Machine, record: Callable[..., str]) -> None:
    regressors = Regressors(machine.robot)
    deviations = []
    for seed in range(12):
        path = record(0.5, seed)
        first = identify(machine.robot, [path], options=Options(Recipe()), regressors=regressors).full.solution
        found = estimate(machine, [load(path, machine.robot)], first.values)
        deviations.append([(found.values[name] - TRUTH[name]) / found.std(name) for name in found.names])
    z = np.array(deviations)
    assert 0.88 <= (np.abs(z) < 2).mean() <= 0.995
    assert np.abs(z).max() < 4.5
    assert (np.abs(z) < 3).mean() > 0.98
    assert 0.75 < np.sqrt((z**2).mean()) < 1.3


def test_a_parameter_that_nothing_shows_has_no_variance(machine: Machine, record: Callable[..., str]) -> None:
    """Joint 2 kept where it is: its rotor and its link accelerate with joint 1 alone."""
    run = load(record(), machine.robot)
    t = run.start + run.period * np.arange(run.samples)
    q, qd = np.zeros((2, run.samples)), np.zeros((2, run.samples))
    q[0], qd[0], qdd = 0.8 * np.sin(2 * t), 1.6 * np.cos(2 * t), np.zeros((2, run.samples))
    qdd[0] = -3.2 * np.sin(2 * t)
    tau = Regressors(machine.robot).torques(TRUTH, Motion(q, qd, qdd))
    tau[0] += np.random.default_rng(1).normal(size=run.samples)
    found = estimate(machine, [replace(run, q=q, tau=tau)], TRUTH)
    assert {"Fv2", "Fc2", "Off2"} <= set(found.hidden)
    assert found.std("Fv2") == np.inf
    assert "Fv1" not in found.hidden


@pytest.fixture(scope="module")
def search(machine: Machine, record: Callable[..., str]) -> tuple[Search, Array]:
    made = experiment(load(record(), machine.robot), machine.robot, WIDE, 1.0)
    return search_of(machine.module, [made], TRUTH, {}, Settings(WIDE))


def test_the_constraint_holds_the_parameters_where_m_is_positive(search: tuple[Search, Array]) -> None:
    of, first = search
    smallest = float(of.positivity.eigenvalues(first).min())
    # More than the robot has: what is found is on the border, at the smallest eigenvalue allowed.
    tight = replace(of, positivity=replace(of.positivity, margin=1.1 * smallest))
    begin = tight.positivity.nearest(first, of.std)
    assert begin is not None
    found = evaluated(tight, gauss_newton.minimise(tight, begin))
    assert found.limited
    assert found.eigenvalues.min() == pytest.approx(1.1 * smallest, rel=1e-4)
    assert not evaluated(of, gauss_newton.minimise(of, begin)).limited


class Unbounded(Positivity):
    """Every step keeps M positive."""

    def cut(self, chi: Array) -> None:
        return None


def test_what_the_runs_hardly_show_may_be_less_than_nothing_by_rounding() -> None:
    anywhere = Unbounded(None, np.zeros((1, 1)), ("a", "b"), {}, 0.0)
    H = np.array([[1.0, 1.0], [1.0, 1.0 - 1e-15]])
    step = constrained(H, np.array([2.0, 2.0]), np.ones(2), anywhere, np.zeros(2))
    assert step.sum() == pytest.approx(2.0)


def test_a_constrained_step_is_that_of_a_semidefinite_program(machine: Machine) -> None:
    """All poses at once, by another solver; M(q) per unit of each parameter from the NumPy-free regressors."""
    rng = np.random.default_rng(4)
    names, b = machine.module.BASE_PARAMETERS, len(machine.module.BASE_PARAMETERS)
    chi = np.array([TRUTH[name] for name in names])
    poses = rng.uniform(-2, 2, (6, 2))
    positivity = Positivity(machine.module, poses, names, {}, 0.5)
    A = rng.normal(size=(b, b))
    H, size = A @ A.T + 0.1 * np.eye(b), rng.uniform(0.5, 2, b)
    wanted = -1.5 * chi * size
    step = constrained(H, H @ wanted, size, positivity, chi)
    assert positivity.holds(chi + step)
    assert not positivity.holds(chi + wanted / size)

    regressors = Regressors(machine.robot)
    d, limits = cp.Variable(b), []
    for q in poses:
        columns = []
        for k in range(2):
            moved, rest = (
                np.array([regressors.torques({name: 1.0}, Motion(q[:, None], 0 * q[:, None], x)) for name in names])
                for x in (np.eye(2)[:, [k]], np.zeros((2, 1)))
            )
            columns.append((moved - rest)[:, :, 0])
        M = sum((chi[k] + d[k] / size[k]) * np.array([c[k] for c in columns]).T for k in range(b))
        limits.append((M + M.T) / 2 >> 0.5 * np.eye(2))
    objective = cp.quad_form(d - wanted, cp.psd_wrap(H)) / 2
    least = cp.Problem(cp.Minimize(objective), limits).solve(solver=cp.CLARABEL)
    scaled = step * size - wanted
    assert scaled @ H @ scaled / 2 == pytest.approx(least, rel=1e-3)


def test_further_starts_are_spread_and_allowed(search: tuple[Search, Array]) -> None:
    of, first = search
    wide = replace(of, std=np.abs(first), settings=replace(of.settings, spread=1.0))
    drawn = starts(wide, first, 8)
    assert next(iter(drawn)) == "start_001"
    assert (drawn["start_001"] == first).all()
    assert all(wide.positivity.holds(chi) for chi in drawn.values())
    assert np.std([chi[3] for chi in drawn.values()]) > 0.3 * abs(first[3])
    assert all((drawn[name] == chi).all() for name, chi in starts(wide, first, 8).items())


def test_what_is_shown_does_not_depend_on_the_weights(slide: Machine, tmp_path: Path) -> None:
    """Errors of a slide are far below a metre: in metres every parameter would hardly move anything."""
    gentle = {"speed": 0.05, "acceleration": 0.05, "harmonics": 3}
    short = Simulation(parameters="published", duration=6.0, noise=(0.001,), trajectory_settings=gentle)
    path = save(simulate(slide, short), slide.robot.name, slide.robot.digest, tmp_path / "slide.csv")[0]
    run = load(str(path), slide.robot)
    truth = {name: float(one.value) for name, one in slide.robot.parameter_sets["published"].values.items()}
    found = [
        estimate(slide, [run], truth, settings=Settings(Recipe(standstill=0.001, weights=weights), 0.4))
        for weights in ("joint", "none")
    ]
    assert [one.hidden for one in found] == [(), ()]
    for name in found[0].names:
        assert found[1].std(name) == pytest.approx(found[0].std(name), rel=1e-3)


def test_evolution_leaves_a_start_that_diverges(search: tuple[Search, Array]) -> None:
    of, first = search
    at = of.criterion.sought.index("Fv1")
    begin, std = first.copy(), np.full(len(first), 1e-3)
    begin[at], std[at] = -300.0, 300.0
    assert not np.isfinite(of.criterion.value(of.criterion.begin(begin)))
    wide = replace(of, std=std, settings=replace(of.settings, method="evolution", iterations=10))
    found = methods()["evolution"].minimise(wide, begin)
    assert np.isfinite(of.criterion.value(found.point))


@pytest.mark.parametrize("name", ["nelder-mead", "evolution"])
def test_other_methods_improve_on_their_start(search: tuple[Search, Array], name: str) -> None:
    of, first = search
    begin = 1.05 * first
    few = replace(of, std=0.05 * np.abs(first), settings=replace(of.settings, method=name, iterations=4))
    found = methods()[name].minimise(few, begin)
    at_start = of.criterion.value(of.criterion.begin(begin))
    assert of.criterion.value(replace(found.point)) < at_start
    if name == "nelder-mead":
        assert (found.iterations, found.settled) == (4, False)
        assert found.point.states[0] is of.criterion.experiments[0].start
    else:
        assert found.settled
        assert found.point.chi == pytest.approx(first, rel=1e-3, abs=2e-2)


def test_what_cannot_be_used_is_refused(machine: Machine, record: Callable[..., str]) -> None:
    run = load(record(), machine.robot)
    short = replace(run, q=run.q[:, :900], tau=run.tau[:, :900])
    cut_off = replace(run, unusable=run.q < 99)
    cases: list[tuple[str, Callable[[], object]]] = [
        ("segments of 0.01 s, expected at least 0.08 s", lambda: experiment(run, machine.robot, Recipe(), 0.01)),
        ("900 rows, expected at least 2000 for the filters", lambda: experiment(short, machine.robot, Recipe(), 1.0)),
        (
            "every segment holds a sample that was lost or cut off",
            lambda: experiment(cut_off, machine.robot, Recipe(), 1.0),
        ),
        (
            "M.q. is not positive definite",
            lambda: estimate(machine, [run], TRUTH, settings=Settings(fixed={"ZZ2": -99.0, "Ia2": 0.0})),
        ),
        ("all parameters are fixed", lambda: estimate(machine, [run], TRUTH, settings=Settings(fixed=TRUTH))),
    ]
    for message, call in cases:
        with pytest.raises(InputError, match=message):
            call()
