"""The batch functions against the NumPy module, numpy.convolve, and numpy's linear algebra."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from generator.backends import batch as batch_backend
from generator.backends import c as c_backend
from generator.backends import numpy as numpy_backend
from generator.derivation import derive
from generator.resources import find_robot
from generator.robot.readers import read
from generator.symbolic.model import Model
from tests.batches import Batch, Filter
from tests.commands import PENDULUM, ROOT
from tests.compiled import module, write

ROBOTS = ("kr500", "scara", pytest.param("tree_two_arms", marks=pytest.mark.long), "pendulum")
#: All that the batch functions are made of and compared with.
QUANTITIES = ("inverse_dynamics", "regressor", "regressor_packed")
SIZES = (0, 1, 7, 8, 9, 150)
LOW_PASS = tuple(float(x) for x in np.hanning(23)[1:-1] / np.hanning(23).sum())
FILTERS = {
    "as they are": None,
    "one tap": Filter((1.0,), 1),
    "pick": Filter((1.0,), 3),
    "scaled": Filter((-2.5,), 2),
    "low pass": Filter(LOW_PASS, 4),
    "not decimated": Filter((0.25, 0.5, 0.25), 1),
    "gaps": Filter((0.25, 0.5, 0.25), 20),
    "not symmetric": Filter((0.1, -0.2, 0.3, 0.4, 1.5), 2),
}
DOUBLE, SINGLE = 1e-13, 2e-5
USUAL = ("-O2", "-march=native", "-ffp-contract=fast", "-fno-math-errno", "-fopenmp")

Array = NDArray[Any]


@dataclass(frozen=True)
class Arm:
    """A robot's files, and its NumPy module as what the batch functions are compared with."""

    model: Model
    folder: Path
    numpy: ModuleType

    @property
    def name(self) -> str:
        return self.model.robot.name

    @property
    def parameters(self) -> Array:
        return self.model.default_parameters() + np.random.default_rng(5).uniform(0.5, 2.0, len(self.model.parameters))

    def batch(self, *flags: str, compiler: str = "gcc") -> Batch:
        """The functions with these flags, ready to call."""
        result = Batch(self.folder, self.name, flags, compiler)
        result.prepare(self.parameters)
        return result

    def signals(self, n: int) -> tuple[Array, Array, Array]:
        q, qd, qdd = np.random.default_rng(n).uniform(-2.0, 2.0, (3, n, self.model.dof))
        qd[:1, 0] = 0.0  # sign(0)
        return q, qd, qdd

    def regressor(self, q: Array, qd: Array, qdd: Array) -> Array:
        """(n, NQ, NBASE) by the NumPy module."""
        arguments = {"parameters": self.parameters, "q": q, "qd": qd, "qdd": qdd}
        return self._called("regressor", arguments)

    def torques(self, q: Array, qd: Array, qdd: Array) -> Array:
        return self._called("inverse_dynamics", {"parameters": self.parameters, "q": q, "qd": qd, "qdd": qdd})

    @property
    def felt(self) -> Array:
        """Which columns of [W_j tau_j] are no structural zeros, for each joint (NQ, NBASE + 1)."""
        result = np.zeros((self.model.dof, len(self.model.base_parameters) + 1), bool)
        result[self.numpy.SPARSITY["regressor_packed"]] = True
        result[:, -1] = True
        return result

    def _called(self, name: str, arguments: dict[str, Array]) -> Array:
        function = self.numpy.FUNCTIONS[name]
        wanted = function.__code__.co_varnames[: function.__code__.co_argcount]
        result: Array = function(*(arguments[argument] for argument in wanted))
        return result


@pytest.fixture(scope="module", params=ROBOTS)
def arm(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Arm:
    folder = tmp_path_factory.mktemp(request.param)
    path = folder / "pendulum.yaml"
    path.write_text(PENDULUM)
    robot = read(path if request.param == "pendulum" else find_robot(request.param))
    model = derive(robot, QUANTITIES, check=False)
    write(folder / "c", c_backend.library(model, ()))
    write(folder / "batch", batch_backend.emit(model))
    numpy_module = module(numpy_backend.emit(model)[f"{robot.name}.py"], robot.name)
    return Arm(model, folder, numpy_module)


@pytest.fixture(scope="module")
def batch(arm: Arm) -> Batch:
    """The functions as a user compiles them for the machine at hand."""
    return arm.batch(*USUAL)


def agree(found: Array, wanted: Array, tolerance: float = DOUBLE) -> bool:
    assert found.shape == wanted.shape
    if not wanted.size:
        return True
    # written so that a NaN fails
    return bool(np.abs(found - wanted).max() <= tolerance * np.abs(wanted).max())


def stacked(W: Array, tau: Array) -> Iterator[Array]:
    """[W_j tau_j] of each joint."""
    for j in range(tau.shape[1]):
        yield np.column_stack([W[:, j], tau[:, j]])


@pytest.mark.parametrize("n", SIZES)
def test_inverse_dynamics(arm: Arm, batch: Batch, n: int) -> None:
    signals = arm.signals(n)
    assert agree(batch.inverse_dynamics(*signals), arm.torques(*signals))


@pytest.mark.parametrize("n", SIZES)
@pytest.mark.parametrize("layout", ["rows", "columns"])
def test_observation_matrix(arm: Arm, batch: Batch, layout: str, n: int) -> None:
    signals = arm.signals(n)
    for gap in (0, 5):
        assert agree(getattr(batch, layout)(*signals, gap=gap), arm.regressor(*signals))


@pytest.mark.parametrize("chosen", FILTERS.values(), ids=FILTERS)
def test_filtered_and_decimated(arm: Arm, batch: Batch, chosen: Filter | None) -> None:
    for n in SIZES:
        signals = arm.signals(n)
        apply = chosen.applied if chosen else (lambda y: y)
        wanted, torques = apply(arm.regressor(*signals)), apply(arm.torques(*signals))
        assert batch.kept(n, chosen) == len(wanted)
        assert agree(batch.rows(*signals, chosen), wanted)
        assert agree(batch.columns(*signals, chosen), wanted)
        assert agree(batch.filtered(arm.torques(*signals), chosen), torques)


@pytest.mark.parametrize("chosen", [None, FILTERS["low pass"]], ids=["as they are", "low pass"])
@pytest.mark.parametrize("n", [0, 1, 9, 1000])
def test_gram(arm: Arm, batch: Batch, chosen: Filter | None, n: int) -> None:
    signals = arm.signals(n)
    tau = arm.torques(*signals)
    apply = chosen.applied if chosen else (lambda y: y)
    found = batch.normal("observation_gram", [*signals, tau], chosen)
    for G, A in zip(found, stacked(apply(arm.regressor(*signals)), apply(tau)), strict=True):
        assert agree(G, A.T @ A)
        assert (G == G.T).all()


@pytest.mark.parametrize("chosen", [None, FILTERS["low pass"]], ids=["as they are", "low pass"])
@pytest.mark.parametrize("n", [0, 1, 9, 1000])
def test_triangular_factor(arm: Arm, batch: Batch, chosen: Filter | None, n: int) -> None:
    signals = arm.signals(n)
    tau = arm.torques(*signals) + np.random.default_rng(1).normal(size=(n, arm.model.dof))
    apply = chosen.applied if chosen else (lambda y: y)
    found = batch.normal("observation_qr", [*signals, tau], chosen)
    blocks = stacked(apply(arm.regressor(*signals)), apply(tau))
    for R, A, felt in zip(found, blocks, arm.felt, strict=True):
        assert agree(R, np.triu(R), 0.0)
        assert (np.diag(R) >= 0).all()
        assert agree(R.T @ R, A.T @ A)
        assert not R[:, ~felt].any()
        assert not R[~felt].any()
        if len(A) > 2 * np.count_nonzero(felt):
            wanted = np.linalg.qr(A[:, felt], mode="r")
            wanted *= np.sign(np.diag(wanted))[:, None]
            assert agree(R[np.ix_(felt, felt)], wanted, DOUBLE * np.linalg.cond(A[:, felt]))


def test_the_factor_keeps_digits_that_the_gram_matrix_loses(arm: Arm, batch: Batch) -> None:
    """A torque next to a column: what separates them is beyond the square root of the precision."""
    signals = arm.signals(1000)
    W = arm.regressor(*signals)
    rest = 1e-10 * np.random.default_rng(2).normal(size=(1000, arm.model.dof))
    tau = W.sum(axis=2) + rest
    factors, grams = (batch.normal(f"observation_{name}", [*signals, tau]) for name in ("qr", "gram"))
    for R, G, A in zip(factors, grams, stacked(W, tau), strict=True):
        felt = np.flatnonzero(np.any(A, axis=0))
        wanted = abs(np.linalg.qr(A[:, felt], mode="r")[-1, -1])
        scale = np.abs(A).max() * np.sqrt(len(A))
        assert abs(R[-1, -1] - wanted) <= 1e-14 * scale
        kept = G[np.ix_(felt, felt)]
        # Some matrices are singular to the last bit.
        solution = np.linalg.lstsq(kept[:-1, :-1], kept[:-1, -1], rcond=None)[0]
        square = kept[-1, -1] - kept[-1, :-1] @ solution
        assert abs(square - wanted**2) > 0.5 * wanted**2


def test_dependent_columns_give_no_nan(arm: Arm, batch: Batch) -> None:
    """At rest in one pose the columns are multiples of each other."""
    q, qd, qdd = (np.repeat(x, 300, axis=0) for x in arm.signals(1))
    found = batch.normal("observation_qr", [q, 0 * qd, 0 * qdd, q])
    W = arm.regressor(q, 0 * qd, 0 * qdd)
    for R, A in zip(found, stacked(W, q), strict=True):
        assert agree(R.T @ R, A.T @ A)


@pytest.mark.parametrize("arm", ["kr500", pytest.param("tree_two_arms", marks=pytest.mark.long)], indirect=True)
def test_threads_change_no_bit(arm: Arm, batch: Batch, tmp_path: Path) -> None:
    """In processes of their own, as OpenMP reads the number of threads once."""
    found = []
    for threads in ("1", "3"):
        path = tmp_path / f"{threads}.npz"
        call = [sys.executable, "-c", _THREADED, str(arm.folder), arm.name, str(path)]
        environment = {**os.environ, "OMP_NUM_THREADS": threads, "PYTHONPATH": str(ROOT)}
        subprocess.run(call, check=True, env=environment)
        found.append(np.load(path))
    assert set(found[0]) == {"tau", "rows", "columns", "gram", "qr"}
    for name in found[0]:
        assert found[0][name].tobytes() == found[1][name].tobytes(), name


_THREADED = """
import sys
from pathlib import Path
import numpy as np
from tests.batches import Batch, Filter
from tests.test_batch import USUAL
folder, name, out = sys.argv[1:]
batch = Batch(Path(folder), name, USUAL)
count = batch.sizes["NQ"]
q, qd, qdd = np.random.default_rng(1).uniform(-2, 2, (3, 3000, count))
chosen = Filter((0.25, 0.5, 0.25), 2)
np.savez(
    out, tau=batch.inverse_dynamics(q, qd, qdd), rows=batch.rows(q, qd, qdd, chosen), columns=batch.columns(q, qd, qdd),
    gram=batch.normal("observation_gram", [q, qd, qdd, q]), qr=batch.normal("observation_qr", [q, qd, qdd, q], chosen),
)
"""


#: The further ones have nothing that others of gcc have not, each by itself.
OPTIONS = [
    ("gcc", ("-O0",)),
    pytest.param("gcc", ("-O2",), marks=pytest.mark.long),
    pytest.param("gcc", ("-O2", "-mavx2", "-mfma"), marks=pytest.mark.long),
    ("gcc", ("-O3", "-march=native")),
    ("gcc", ("-O1", "-D{}_BATCH_SCALAR")),
    ("gcc", ("-O1", "-D{}_USE_LIBM")),
    ("gcc", ("-O1", "-D_OPENMP=200203")),  # with the pragmas unknown, as earlier ones' unsigned loops are
    ("gcc", ("-O2", "-funsafe-math-optimizations")),
    ("gcc", ("-O2", "-march=native", "-D{}_STREAM_BYTES=0")),
    ("gcc", ("-O2", "-D{}_STREAM_BYTES=0")),
    ("gcc", ("-O2", "-march=native", "-D{}_USE_FLOAT")),
    pytest.param("gcc", ("-O2", "-D{}_USE_FLOAT", "-D{}_STREAM_BYTES=0"), marks=pytest.mark.long),
    ("gcc", ("-O1", "-D{}_USE_FLOAT", "-D{}_BATCH_SCALAR")),
    ("clang", ("-O2",)),
    pytest.param("clang", ("-O2", "-march=native", "-D{}_STREAM_BYTES=0"), marks=pytest.mark.long),
    ("clang", ("-O2", "-march=native", "-D{}_USE_FLOAT", "-D{}_STREAM_BYTES=0")),
]


@pytest.mark.parametrize("arm", ["scara", pytest.param("pendulum", marks=pytest.mark.long)], indirect=True)
@pytest.mark.parametrize(
    ("compiler", "flags"),
    OPTIONS,
    ids=lambda value: value if isinstance(value, str) else " ".join(value),
)
def test_compilers_and_options_agree(arm: Arm, compiler: str, flags: tuple[str, ...]) -> None:
    if compiler != "gcc" and not shutil.which(compiler):
        pytest.skip(f"{compiler} is not installed")
    options = [flag.format(arm.name.upper()) for flag in flags]
    if any(flag.startswith("-m") for flag in options) and os.uname().machine != "x86_64":
        pytest.skip("flags of x86-64")
    batch = arm.batch(*options, compiler=compiler)
    tolerance = SINGLE if batch.single else DOUBLE
    signals = tuple(x.astype(batch.type).astype(float) for x in arm.signals(75))
    W, tau = arm.regressor(*signals), arm.torques(*signals)
    assert agree(batch.inverse_dynamics(*signals), tau, tolerance)
    for gap in (0, 5):
        assert agree(batch.rows(*signals, gap=gap), W, tolerance)
        assert agree(batch.columns(*signals, gap=gap), W, tolerance)
    chosen = Filter(LOW_PASS, 4)
    assert agree(batch.rows(*signals, chosen), chosen.applied(W), tolerance)
    for name in ("gram", "qr"):
        found = batch.normal(f"observation_{name}", [*signals, tau])
        for R, A in zip(found, stacked(W, tau), strict=True):
            assert agree(R.T @ R if name == "qr" else R, A.T @ A, tolerance)


def test_positions_out_of_the_kernels_reach(arm: Arm, batch: Batch) -> None:
    q, qd, qdd = arm.signals(20)
    q[3], q[11, -1] = 3e5, -1e7
    assert agree(batch.inverse_dynamics(q, qd, qdd), arm.torques(q, qd, qdd))
    assert agree(batch.rows(q, qd, qdd), arm.regressor(q, qd, qdd))


@pytest.mark.parametrize("arm", ["pendulum"], indirect=True)
def test_a_sine_of_ones_own_is_that_of_the_batch_too(arm: Arm) -> None:
    q, *_ = arm.signals(20)
    W = arm.batch("-O1", "-Dpendulum_sin=-").rows(q, 0 * q, 0 * q)
    assert agree(W, np.stack([0 * q, 9.81 * np.cos(q), 9.81 * q, 0 * q, 0 * q], axis=-1))


def test_a_good_stride_is_no_multiple_of_a_page(batch: Batch) -> None:
    for size in (0, 1, 6, 511, 512, 513, 6 * 4096, 10**6, 6 * 10**6):
        stride = batch.stride(size)
        assert size <= stride <= size + 16
        assert stride * batch.type.itemsize % 64 == 0
        assert stride == 0 or stride * batch.type.itemsize % 4096


def test_a_model_without_the_dynamics_has_no_batch_functions() -> None:
    model = derive(read(find_robot("scara")), ["gravity"], check=False)
    assert batch_backend.emit(model) == {}
