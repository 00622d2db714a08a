"""The generated Python module: every quantity against the NumPy module, arrays in place, mistakes by name."""

from __future__ import annotations

import importlib.util
import subprocess
import sys
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from generator.backends import numpy
from generator.python_library import build_library
from generator.robot.readers import read
from tests.commands import PENDULUM, ROOT, command
from tests.compiled import module
from tests.conftest import EVERY, derived
from tests.library_folder import folder_of
from tests.subject import Subject, subject

Array = NDArray[Any]
ROBOTS = ["kr500", "scara", pytest.param("tree_two_arms", marks=pytest.mark.long), "pendulum"]


@dataclass(frozen=True)
class Made:
    """A robot's module with its compiled library, and the NumPy module that it is compared with."""

    arm: Subject
    module: Any
    numpy: ModuleType
    folder: Path

    def inputs(self, name: str, seed: int) -> Mapping[str, Array]:
        return self.arm.inputs(self.arm.model.functions[name], seed)

    def wanted(self, name: str, inputs: Mapping[str, Array]) -> Any:
        """The quantity by the NumPy module."""
        function = self.numpy.FUNCTIONS[name]
        arguments = function.__code__.co_varnames[: function.__code__.co_argcount]
        return function(*({"parameters": self.arm.parameters, **inputs}[argument] for argument in arguments))


def load(path: Path) -> Any:
    specification = importlib.util.spec_from_file_location(path.stem, path)
    assert specification is not None
    assert specification.loader is not None
    result = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(result)
    return result


@pytest.fixture(scope="module", params=ROBOTS)
def made(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Made:
    folder = tmp_path_factory.mktemp(request.param)
    file = folder / "pendulum.yaml"
    file.write_text(PENDULUM)
    name = request.param
    arm = subject(read(file)) if name == "pendulum" else derived(name)
    build_library(folder_of(arm, folder), name)
    numpy_module = module(numpy.emit(arm.model)[f"{name}.py"], name)
    return Made(arm, load(folder / "python" / f"{name}.py"), numpy_module, folder)


@pytest.fixture(scope="module")
def robot(made: Made) -> Any:
    return made.module.Robot(made.arm.parameters)


def agree(found: Array, wanted: Array, tolerance: float = 1e-12) -> bool:
    assert found.shape == wanted.shape
    return bool(np.abs(found - wanted).max(initial=0.0) <= tolerance * np.abs(wanted).max(initial=1e-300))


@pytest.mark.parametrize("made", [*ROBOTS, EVERY], indirect=True)
def test_every_quantity_is_that_of_the_numpy_module(made: Made, robot: Any) -> None:
    for name, function in made.arm.model.functions.items():
        tolerance = 1e-8 if function.solves else 1e-12
        inputs = made.inputs(name, 1)
        found, wanted = getattr(robot, name)(**inputs), made.wanted(name, inputs)
        for value, right in zip(_several(found), _several(wanted), strict=True):
            assert agree(value, right, tolerance), name


@pytest.mark.parametrize("made", [*ROBOTS, EVERY], indirect=True)
def test_results_go_where_they_are_asked_to_go(made: Made, robot: Any) -> None:
    for name, function in made.arm.model.functions.items():
        inputs = made.inputs(name, 2)
        places = tuple(np.full(output.signal.shape, np.nan) for output in function.outputs)
        out = places if len(places) > 1 else places[0]
        found = getattr(robot, name)(**inputs, out=out)
        fresh = getattr(robot, name)(**inputs)
        for place, value, again in zip(places, _several(found), _several(fresh), strict=True):
            assert value is place
            assert (value == again).all()


def _several(results: Any) -> tuple[Any, ...]:
    return results if isinstance(results, tuple) else (results,)


def test_constants_are_those_of_the_numpy_module(made: Made) -> None:
    for name in ("PARAMETERS", "STANDARD_PARAMETERS", "PARAMETER_SETS", "SPARSITY"):
        assert getattr(made.module, name) == getattr(made.numpy, name)
    assert list(made.module.BASE_PARAMETERS) == [p.name for p in made.arm.model.base_parameters]
    assert list(made.module.DEFAULTS) == list(made.arm.model.default_parameters())


def test_parameters_by_set_name_value_and_default(made: Made) -> None:
    Robot, names = made.module.Robot, made.module.PARAMETERS
    assert list(Robot().parameters) == list(made.module.DEFAULTS)
    assert list(Robot(made.arm.parameters).parameters) == list(made.arm.parameters)
    for chosen, values in made.module.PARAMETER_SETS.items():
        assert list(Robot(chosen).parameters) == list(values)
    robot = Robot({names[0]: 3.5})
    assert robot.parameters[0] == 3.5
    before = robot.inverse_dynamics(*(np.ones(made.module.NQ) for _ in range(3)))
    robot.update({names[0]: 7.0})
    assert (robot.inverse_dynamics(*(np.ones(made.module.NQ) for _ in range(3))) != before).any()
    with pytest.raises(ValueError, match="no parameter"):
        robot.update({names[0]: 9.0, "no_such_parameter": 1.0})
    with pytest.raises(ValueError, match=f"^parameters: {names[1]} is 'much', expected a number$"):
        robot.update({names[0]: 9.0, names[1]: "much"})
    assert robot.parameters[0] == 7.0
    for wrong in ("no such set", {"no_such_parameter": 1.0}, np.zeros(len(names) + 1)):
        with pytest.raises(ValueError, match="parameters"):
            Robot(wrong)


def samples(made: Made, n: int = 100) -> list[Array]:
    return list(np.random.default_rng(n).uniform(-2.0, 2.0, (3, n, made.module.NQ)))


def test_many_samples(made: Made, robot: Any) -> None:
    signals = samples(made)
    given = dict(zip(("q", "qd", "qdd"), signals, strict=True))
    tau = robot.inverse_dynamics(*signals)
    assert agree(tau, made.wanted("inverse_dynamics", given))
    W = made.wanted("regressor", given)
    rows, columns = robot.observation_matrix(*signals), robot.observation_matrix(*signals, layout="columns")
    assert agree(rows, W.reshape(-1, W.shape[2]))
    assert agree(columns, W.transpose(1, 0, 2).reshape(-1, W.shape[2]))
    assert columns.flags.f_contiguous or columns.strides[0] == 8
    taps = (0.25, 0.5, 0.25)
    kept = robot.observation_matrix(*signals, taps=taps, decimation=2)
    picked = 0.25 * W[:-2:2] + 0.5 * W[1:-1:2] + 0.25 * W[2::2]
    assert agree(kept, picked.reshape(-1, W.shape[2]))
    y = made.module.filtered(tau, taps, 2)
    assert agree(y, 0.25 * tau[:-2:2] + 0.5 * tau[1:-1:2] + 0.25 * tau[2::2])
    G, R = robot.observation_gram(*signals, tau), robot.observation_qr(*signals, tau)
    stacked = np.concatenate([W, tau[:, :, None]], axis=2).transpose(1, 0, 2)
    assert agree(G, stacked.transpose(0, 2, 1) @ stacked)
    assert agree(R.transpose(0, 2, 1) @ R, G)


def test_many_samples_go_where_they_are_asked_to_go(made: Made, robot: Any) -> None:
    signals = samples(made)
    size, width = 100 * made.module.NQ, made.module.NBASE
    tau = np.zeros((100, made.module.NQ))
    assert robot.inverse_dynamics(*signals, out=tau) is tau
    padded = np.full((size, width + 3), -7.0)
    assert robot.observation_matrix(*signals, out=padded[:, :width]).base is padded
    assert (padded[:, width:] == -7.0).all()
    assert (padded[:, :width] == robot.observation_matrix(*signals)).all()
    tall = np.full((width, size + 5), -7.0)
    robot.observation_matrix(*signals, out=tall[:, :size].T, layout="columns")
    assert (tall[:, size:] == -7.0).all()
    assert (robot.observation_matrix(*signals, layout="columns") == tall[:, :size].T).all()
    if made.module.NQ == 1:
        # Of one row the distance to the next says nothing.
        single = np.lib.stride_tricks.as_strided(np.zeros(width), (1, width), (3, 8))
        assert (robot.observation_matrix(*(one[:1] for one in signals), out=single) == padded[:1, :width]).all()


def test_a_plant_moves_as_the_direct_model_says(made: Made, robot: Any) -> None:
    """Against scipy's integration of the NumPy module."""
    rng, nq = np.random.default_rng(5), made.module.NQ
    for kind, size in made.module.PLANTS.items():
        name = "direct_dynamics_smooth" if kind == "rigid" else "flexible_direct_dynamics_smooth"
        q, qd = 0.01 * rng.normal(size=(2, size))
        q[:nq] = made.arm.state(3)[0]
        given = {"tau": rng.normal(size=nq), "width": np.full(size, 0.5)}
        load = None if kind == "rigid" else rng.normal(size=nq)
        if load is not None:
            given["tau_ext"] = load

        def rate(_: float, x: Array, name: str = name, size: int = size, given: Any = given) -> Array:
            return np.concatenate([x[size:], made.wanted(name, {"q": x[:size], "qd": x[size:], **given})])

        plant = made.module.Plant(robot, kind, q, qd, method="DP8", steps=20, width=0.5)
        assert (plant.q == q).all()
        assert (plant.qd == qd).all()
        plant.advance(0.02, given["tau"], load)
        wanted = solve_ivp(rate, (0.0, 0.02), np.concatenate([q, qd]), rtol=1e-10, atol=1e-12).y[:, -1]
        assert np.concatenate([plant.q, plant.qd]) == pytest.approx(wanted, rel=1e-6, abs=1e-8)


def test_an_open_loop_is_one_advance_after_the_other(made: Made, robot: Any) -> None:
    """Torques held in turn; what is told are the states at which each begins."""
    rng, nq = np.random.default_rng(8), made.module.NQ
    q, period = made.arm.state(3)[0], 2e-3
    tau = rng.normal(size=(6, nq))
    for kind in made.module.PLANTS:
        plants = [made.module.Plant(robot, kind, q, np.full(nq, 0.1), width=0.5) for _ in range(2)]
        told_q, told_qd = plants[0].run(period, tau)
        for k in range(6):
            assert told_q[k] == pytest.approx(plants[1].q, rel=1e-12, abs=1e-14)
            assert told_qd[k] == pytest.approx(plants[1].qd, rel=1e-12, abs=1e-14)
            plants[1].advance(period, tau[k])
        assert plants[0].q == pytest.approx(plants[1].q, rel=1e-12, abs=1e-14)
        lost_q, lost_qd = plants[0].run(period, np.where(np.arange(6)[:, None] > 2, np.inf, tau))
        assert np.isfinite(lost_q[:3]).all()
        assert np.isnan(lost_q[3:]).all()
        assert np.isnan(lost_qd[3:]).all()


def test_a_controller_is_a_cascade(made: Made, robot: Any) -> None:
    """e = kp (q_ref - q) + qd_ref - qd of the rotors; z grows by ki period e, then the torque is kv (e + z)."""
    rng, nq = np.random.default_rng(6), made.module.NQ
    q_ref, qd_ref, q, qd = rng.normal(size=(4, nq))
    drives = made.arm.robot.drives
    N = np.eye(nq) if drives is None else np.array([[float(x) for x in row] for row in drives.coupling])
    controller = made.module.Controller(robot, 0.01, 3.0, 0.2, 5.0)
    first = controller.control(q_ref, qd_ref, None, q, qd)
    e = N @ (3.0 * (q_ref - q) + qd_ref - qd)
    assert first == pytest.approx(N.T @ (0.2 * 1.05 * e))
    assert controller.z == pytest.approx(0.05 * e)
    assert controller.control(q_ref, qd_ref, np.ones(nq), q, qd) == pytest.approx(N.T @ (0.2 * 1.1 * e) + 1.0)
    controller.z[:] = 0.0
    assert controller.control(q_ref, None, None, q, qd) == pytest.approx(N.T @ (0.21 * (e - N @ qd_ref)))
    still = made.module.Controller(robot, 0.01, 3.0, 0.2, 5.0, limit=1e-3).control(q_ref, qd_ref, None, q, qd)
    assert np.linalg.solve(N.T, still) == pytest.approx(1e-3 * np.sign(e))


def test_mistakes_of_a_simulation_name_the_argument(made: Made, robot: Any) -> None:
    n, Plant = made.module.NQ, made.module.Plant
    one, held, same = np.zeros(n), np.zeros((4, n)), np.zeros((4, n))
    for message, call in (
        ("^kind is 'soft', expected one of rigid", lambda: Plant(robot, "soft", one)),
        ("^q has shape", lambda: Plant(robot, "rigid", np.zeros(n + 1))),
        ("^method is 'Euler', expected", lambda: Plant(robot, "rigid", one, method="Euler")),
        ("^steps is 0, expected", lambda: Plant(robot, "rigid", one, steps=0)),
        ("^steps is nan, expected", lambda: Plant(robot, "rigid", one, steps=np.nan)),
        ("^width is not positive", lambda: Plant(robot, "rigid", one, width=0.0)),
        ("^width has shape", lambda: Plant(robot, "rigid", one, width=np.ones(n + 1))),
        ("^tau has shape", lambda: Plant(robot, "rigid", one).advance(1e-3, np.zeros(n + 1))),
        ("^tau has shape", lambda: Plant(robot, "rigid", one).run(1e-3, np.zeros((4, n + 1)))),
        ("^time is nan", lambda: Plant(robot, "rigid", one).advance(np.nan, one)),
        ("^time is -1", lambda: Plant(robot, "rigid", one).advance(-1, one)),
        ("^period is -1", lambda: Plant(robot, "rigid", one).run(-1, one[None])),
        ("^period is nan", lambda: Plant(robot, "rigid", one).run(np.nan, one[None])),
        ("^period is -1", lambda: made.module.Controller(robot, -1, 1, 1, 1)),
        ("^out shares memory with qd", lambda: Plant(robot, "rigid", one).run(1e-3, held, out=(same, same))),
    ):
        with pytest.raises(ValueError, match=message):
            call()


def test_wrong_types_in_a_simulation_name_the_argument(made: Made, robot: Any) -> None:
    one, Plant = np.zeros(made.module.NQ), made.module.Plant
    for message, call in (
        ("^q is no array of numbers", lambda: Plant(robot, "rigid", "text")),
        ("^qd is no array of numbers", lambda: Plant(robot, "rigid", one, [[0.0], [0.0, 1.0]])),
        ("^time is None, expected a number", lambda: Plant(robot, "rigid", one).advance(None, one)),
        ("^kp is no array of numbers", lambda: made.module.Controller(robot, 1e-3, "much", 1, 1)),
    ):
        with pytest.raises(TypeError, match=message):
            call()
    for plant, size in made.module.PLANTS.items():
        with pytest.raises(ValueError, match=f"^q has shape .*, expected {'.*or ' * (size > len(one))}.{size},.$"):
            Plant(robot, plant, np.zeros(3 * size))


def test_no_samples(made: Made, robot: Any) -> None:
    signals = samples(made, 0)
    assert robot.inverse_dynamics(*signals).shape == (0, made.module.NQ)
    for layout in ("rows", "columns"):
        assert robot.observation_matrix(*signals, layout=layout).shape == (0, made.module.NBASE)
    assert not robot.observation_qr(*signals, signals[0]).any()


def test_mistakes_name_the_argument(made: Made, robot: Any) -> None:
    n, (q, qd, qdd) = made.module.NQ, samples(made)
    one, huge = np.zeros(n), np.zeros((100, n + 1))
    frozen = np.zeros(n)
    frozen.flags.writeable = False
    crooked = np.zeros(8 * n + 4, np.uint8)[4:].view(float)
    matrix = np.zeros(8 * q.size * made.module.NBASE + 4, np.uint8)[4:].view(float).reshape(q.size, -1)
    mistakes: list[tuple[type[Exception], str, Any]] = [
        (ValueError, "^q has shape", lambda: robot.gravity(np.zeros(n + 1))),
        (TypeError, "^q is no array of numbers", lambda: robot.gravity("text")),
        (TypeError, "^out is a list", lambda: robot.gravity(one, out=[0.0] * n)),
        (TypeError, "^out has elements of float32", lambda: robot.gravity(one, out=np.zeros(n, np.float32))),
        (ValueError, "^out has shape", lambda: robot.gravity(one, out=np.zeros(n + 1))),
        (ValueError, "^out is read-only", lambda: robot.gravity(one, out=frozen)),
        (ValueError, "^out is not aligned", lambda: robot.gravity(one, out=crooked)),
        (ValueError, "^out is not aligned", lambda: robot.observation_matrix(q, qd, qdd, out=matrix)),
        (TypeError, "^out is a list", lambda: robot.observation_matrix(q, qd, qdd, out=[0.0], layout="columns")),
        (TypeError, "^qd has elements of float32", lambda: robot.inverse_dynamics(q, qd.astype(np.float32), qdd)),
        (TypeError, "^qd is a list", lambda: robot.inverse_dynamics(q, qd.tolist(), qdd)),
        (
            ValueError,
            rf"^q has shape \(100, {n}\), expected \({n},\), or numpy arrays of shape \(n, {n}\) for n samples$",
            lambda: robot.inverse_dynamics(q.tolist(), qd.tolist(), qdd.tolist()),
        ),
        (ValueError, rf"^q has shape .*, expected \({n},\)$", lambda: robot.gravity(q.tolist())),
        (ValueError, "^qdd has shape", lambda: robot.inverse_dynamics(q, qd, huge)),
        (ValueError, "^qdd has 50 samples, q has 100", lambda: robot.inverse_dynamics(q, qd, qdd[:50])),
        (ValueError, "^out shares memory with q", lambda: robot.inverse_dynamics(q, qd, qdd, out=q)),
        (ValueError, "^layout is 'diagonal'", lambda: robot.observation_matrix(q, qd, qdd, layout="diagonal")),
        (ValueError, "^taps has shape", lambda: robot.observation_matrix(q, qd, qdd, taps=[0.5, 0.5])),
        (TypeError, "^taps is no array of numbers", lambda: robot.observation_matrix(q, qd, qdd, taps="low")),
        (ValueError, "^decimation is 0", lambda: robot.observation_matrix(q, qd, qdd, decimation=0)),
        (ValueError, "^decimation is inf", lambda: robot.observation_matrix(q, qd, qdd, decimation=np.inf)),
        (TypeError, "^parameters: .* is None, expected", lambda: robot.update({made.module.PARAMETERS[0]: None})),
        (ValueError, "^out has not the shape", lambda: robot.observation_matrix(q, qd, qdd, out=np.zeros((1, 1)))),
        (ValueError, "^out has shape", lambda: robot.observation_qr(q, qd, qdd, q, out=np.zeros((1, 1, 1)))),
    ]
    if n > 1:
        mistakes.append((ValueError, "^q is not contiguous", lambda: robot.inverse_dynamics(q[::2], qd[::2], qdd[::2])))
    for kind, message, call in mistakes:
        with pytest.raises(kind, match=message):
            call()


def test_a_set_that_there_is_not(made: Made) -> None:
    with pytest.raises(ValueError, match=f"no set 'mine', expected one of {', '.join(made.arm.robot.parameter_sets)}$"):
        made.module.Robot("mine")


def test_a_robot_without_sets_says_so(tmp_path: Path) -> None:
    (tmp_path / "pendulum.yaml").write_text(PENDULUM)
    bare = replace(read(tmp_path / "pendulum.yaml"), parameter_sets={})
    build_library(folder_of(subject(bare), tmp_path), "pendulum")
    with pytest.raises(ValueError, match=r"no set 'mine', the robot has none, expected values by name$"):
        load(tmp_path / "python" / "pendulum.py").Robot("mine")


def test_an_input_that_is_not_contiguous_is_copied_for_one_state(made: Made, robot: Any) -> None:
    q = np.arange(2.0 * made.module.NQ)
    assert (robot.gravity(q[::2]) == robot.gravity(q[::2].tolist())).all()


def test_a_module_without_its_library_says_so(made: Made, tmp_path: Path) -> None:
    name = made.arm.robot.name
    (tmp_path / f"{name}.py").write_text((made.folder / "python" / f"{name}.py").read_text())
    with pytest.raises(
        ImportError, match=rf"lib{name}\.so is not there; counterpoise generate ROBOT --library compiles"
    ):
        load(tmp_path / f"{name}.py")


def test_the_library_is_no_part_of_the_manifest_and_goes_with_an_older_generation(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "pendulum.yaml"
    file.write_text(PENDULUM)
    library = tmp_path / "out" / "pendulum" / "python" / "libpendulum.so"
    assert command("generate", file, "--out", tmp_path / "out", "--library", capsys=capsys).status == 0
    assert library.is_file()
    assert ".so" not in (tmp_path / "out" / "pendulum" / "manifest.json").read_text()
    script = "import pendulum; print(pendulum.Robot('light').gravity([0.0])[0])"
    done = subprocess.run(
        [sys.executable, "-c", script], cwd=library.parent, capture_output=True, text=True, check=True
    )
    assert abs(float(done.stdout) - 9.81 * 3) < 1e-9
    assert command("generate", file, "--out", tmp_path / "out", capsys=capsys).status == 0
    assert not library.exists()
    ignored = subprocess.run(
        ["git", "check-ignore", "-q", "generated/kr500/python/libkr500.so"], cwd=ROOT, check=False
    ).returncode
    assert ignored in (0, 128)  # 128: no checkout
