"""C, CasADi and NumPy of every quantity of every robot against the nodes that they print."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import casadi
import numpy as np
import pytest
from numpy.typing import ArrayLike

from generator.backends import c as c_backend
from generator.backends import casadi as casadi_backend
from generator.backends import numpy as numpy_backend
from generator.symbolic.function import PARAMETERS, Function
from generator.symbolic.parameter_sets import parameter_vector
from tests.c_library import CLibrary, Results
from tests.compiled import SHARED, module, run, write
from tests.conftest import EVERY, FILES
from tests.subject import Subject

SEEDS = range(3)
#: Robots whose C is optimised: all effects, with a slide, and a branch.
OPTIMISED = (EVERY, "tree_two_arms")
#: Of the largest entry of an output.
DOUBLE, SINGLE = 1e-12, 1e-4


@dataclass(frozen=True)
class Case:
    """A function at a state, what its nodes give there, and the condition that a tolerance is scaled with."""

    function: Function
    inputs: Mapping[str, ArrayLike]
    wanted: Results
    worse: float


@dataclass(frozen=True)
class Emitted:
    """All that the backends emit for one robot, made callable."""

    arm: Subject
    folder: Path

    @property
    def name(self) -> str:
        return self.arm.robot.name

    @cached_property
    def library(self) -> CLibrary:
        return CLibrary(self.arm.model, self.folder / "c", ("-O1" if self.name in OPTIMISED else "-O0",))

    @cached_property
    def single(self) -> CLibrary:
        return CLibrary(self.arm.model, self.folder / "c", ("-O0", f"-D{self.name.upper()}_USE_FLOAT"))

    @cached_property
    def numpy(self) -> Any:
        return module((self.folder / "numpy" / f"{self.name}.py").read_text(), self.name)

    @cached_property
    def casadi(self) -> Mapping[str, Any]:
        return module((self.folder / "casadi" / f"{self.name}.py").read_text(), self.name).functions()  # type: ignore[no-any-return]

    @cached_property
    def external(self) -> Path:
        sources = [self.folder / "casadi" / f"{self.name}_casadi.c", self.folder / "c" / f"{self.name}.c"]
        library = self.folder / "external.so"
        run(["gcc", "-std=c99", "-O0", *SHARED, f"-I{self.folder / 'c'}", *sources, "-o", library, "-lm"])
        return library

    @cached_property
    def cases(self) -> Sequence[Case]:
        """Each function at each state."""
        return [self._case(function, seed) for function in self.arm.model.functions.values() for seed in SEEDS]

    def _case(self, function: Function, seed: int) -> Case:
        inputs = {PARAMETERS: self.arm.parameters, **self.arm.inputs(function, seed)}
        inputs = {name: np.array(value, dtype=float) for name, value in inputs.items()}
        for value in inputs.values():
            # All backends get the same arrays.
            value.setflags(write=False)
        wanted = self.arm.generated(function.name, inputs)
        return Case(function, inputs, wanted, condition(self.arm, function, inputs))


@pytest.fixture(scope="module")
def emitted(robot_arm: Subject, tmp_path_factory: pytest.TempPathFactory) -> Emitted:
    folder = tmp_path_factory.mktemp(robot_arm.robot.name)
    for backend in (c_backend, casadi_backend, numpy_backend):
        write(folder / backend.NAME, backend.emit(robot_arm.model))
    return Emitted(robot_arm, folder)


def condition(arm: Subject, function: Function, inputs: Mapping[str, ArrayLike]) -> float:
    """What a direct model loses: the condition of the inertia matrix that it solves with; 1 for other functions."""
    if not function.solves:
        return 1.0
    stacked = np.asarray(inputs["q"])
    q = stacked[: arm.dof].copy()
    for elongation, joint in zip(stacked[arm.dof :], arm.model.elastic, strict=False):
        q[joint] += elongation
    return float(np.linalg.cond(arm.output("inertia_matrix", q=q)))


def assert_same(found: Results, wanted: Results, tolerance: float) -> None:
    assert list(found) == list(wanted)
    for name, value in wanted.items():
        assert found[name].shape == value.shape, name
        worst = np.abs(found[name] - value).max()
        assert worst <= tolerance * np.abs(value).max(), f"{name}: {worst / np.abs(value).max():.1e}"


def test_c(emitted: Emitted) -> None:
    for case in emitted.cases:
        assert_same(emitted.library.evaluate(case.function.name, case.inputs), case.wanted, DOUBLE * case.worse)


def test_c_in_single_precision(emitted: Emitted) -> None:
    for case in emitted.cases:
        assert_same(emitted.single.evaluate(case.function.name, case.inputs), case.wanted, SINGLE * case.worse)


def test_numpy(emitted: Emitted) -> None:
    for case in emitted.cases:
        arguments = [case.inputs[name] for name in emitted.casadi[case.function.name].name_in()]
        found = emitted.numpy.FUNCTIONS[case.function.name](*arguments)
        found = found if isinstance(found, tuple) else (found,)
        assert_same(dict(zip(case.wanted, found, strict=True)), case.wanted, DOUBLE * case.worse)


def test_casadi(emitted: Emitted) -> None:
    for case in emitted.cases:
        saved = casadi.Function.load(str(emitted.folder / "casadi" / "functions" / f"{case.function.name}.casadi"))
        for built in (emitted.casadi[case.function.name], saved):
            assert_same(called(built, case.inputs), as_matrices(case.wanted), DOUBLE * case.worse)


def test_c_through_casadi(emitted: Emitted) -> None:
    for case in emitted.cases:
        built = casadi.external(f"{emitted.name}_casadi_{case.function.name}", str(emitted.external))
        assert built.name_in() == emitted.casadi[case.function.name].name_in()
        assert_same(called(built, case.inputs), as_matrices(case.wanted), DOUBLE * case.worse)


@pytest.mark.parametrize(
    "robot_arm",
    [EVERY, *(pytest.param(name, marks=pytest.mark.long) for name in FILES)],
    indirect=True,
)
def test_self_test_under_sanitizers(emitted: Emitted) -> None:
    sources = [emitted.folder / "c" / f"{emitted.name}{ending}.c" for ending in ("", "_selftest")]
    flags = ["-std=c99", "-g1", "-fsanitize=address,undefined", "-fno-sanitize-recover=all"]
    run(["gcc", *flags, *sources, "-o", emitted.folder / "selftest", "-lm"])
    passed = re.fullmatch(r"(\d+) passed, 0 failed\n", run([emitted.folder / "selftest"]))
    assert passed is not None
    assert int(passed[1]) >= len(emitted.arm.model.functions)


def test_packed_outputs_are_the_dense_ones(emitted: Emitted) -> None:
    for packed in (function for function in emitted.arm.model.functions.values() if function.sparsity):
        inputs = {PARAMETERS: emitted.arm.parameters, **emitted.arm.inputs(packed, 0)}
        (dense,) = emitted.library.evaluate(packed.name.removesuffix("_packed"), inputs).values()
        (values,) = emitted.library.evaluate(packed.name, inputs).values()
        scattered = np.zeros(dense.shape)
        scattered[emitted.library.sparsity(packed.name)] = values
        assert (scattered == dense).all()
        assert emitted.numpy.SPARSITY[packed.name] == tuple(map(tuple, emitted.library.sparsity(packed.name)))


def test_parameter_sets_are_those_of_the_robot(emitted: Emitted) -> None:
    model = emitted.arm.model
    assert set(emitted.numpy.PARAMETER_SETS) == set(model.robot.parameter_sets)
    for name, one in model.robot.parameter_sets.items():
        values = emitted.library.parameter_set(name)
        assert values == list(emitted.numpy.PARAMETER_SETS[name]) == list(parameter_vector(model, one.values))


def called(built: Any, inputs: Mapping[str, ArrayLike]) -> Results:
    """Outputs of a casadi.Function by name, as matrices."""
    found = built.call([inputs[name] for name in built.name_in()])
    return dict(zip(built.name_out(), map(np.array, found), strict=True))


def as_matrices(outputs: Results) -> Results:
    """Vectors as columns, and the leading dimensions of arrays merged: how CasADi has them."""
    return {name: value.reshape(-1, value.shape[-1] if value.ndim > 1 else 1) for name, value in outputs.items()}
