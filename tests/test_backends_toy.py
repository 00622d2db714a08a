"""The backends on toy functions: random expressions in every language, and what the generated files promise."""

from __future__ import annotations

import hashlib
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import casadi
import numpy as np
import pytest
from hypothesis import assume, given

from generator.backends import c as c_backend
from generator.backends import casadi as casadi_backend
from generator.backends import numpy as numpy_backend
from generator.backends.printing.signals import safe
from generator.c_selftest import WARNINGS
from generator.selftest import Case
from generator.symbolic.function import PARAMETERS
from generator.symbolic.statements import Program
from tests.c_library import CLibrary
from tests.commands import ROOT
from tests.compiled import SHARED, module, run, write
from tests.misra import checked, documented_rules
from tests.toy import VALUES, Inputs, function, interpreted, programs, toy, uncertainty
from tests.toy_example import assert_close, example, expected, reference_cases, states


@pytest.fixture(scope="module")
def library(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The example's C library."""
    files = c_backend.library(example(), reference_cases(example()))
    return write(tmp_path_factory.mktemp("c"), files)


@pytest.fixture(scope="module")
def python() -> tuple[Any, Any]:
    """The example's NumPy and CasADi modules."""
    return tuple(module(b.emit(example())["toy.py"], "toy") for b in (numpy_backend, casadi_backend))  # type: ignore[return-value]


# -- the same numbers everywhere ------------------------------------------------------------------------------------


@given(built=programs(outputs=6))
def test_random_expressions_agree_in_every_language(built: tuple[Program, list[Any]]) -> None:
    program, roots = built
    value, error = interpreted(roots, VALUES), uncertainty(roots, VALUES)
    roots = [root for root in roots if error[root] <= 1e-12 * abs(value[root])]
    assume(roots)
    model = toy(program, *(function(program, f"f{number}", [root]) for number, root in enumerate(roots)))
    with tempfile.TemporaryDirectory() as folder:
        compiled = CLibrary(model, write(Path(folder), c_backend.library(model, ())), ("-O0",))
    numpy_module = module(numpy_backend.emit(model)["toy.py"], "toy")
    casadi_functions = module(casadi_backend.emit(model)["toy.py"], "toy").functions()
    for (name, built_), root in zip(casadi_functions.items(), roots, strict=True):
        arguments = casadi_inputs(built_, VALUES)
        assert_close(compiled.evaluate(name, VALUES)["y"], [value[root]])
        assert_close(numpy_module.FUNCTIONS[name](*arguments), [value[root]])
        assert_close(np.array(built_(*arguments)), [[value[root]]])


def casadi_inputs(built: Any, values: Mapping[str, Sequence[float]]) -> list[Any]:
    return [values[name] for name in built.name_in()]


@pytest.mark.parametrize("name", list(example().functions))
@pytest.mark.parametrize("optimisation", ["-O0", "-O2 -ffp-contract=fast"])
def test_c_computes_the_nodes(library: Path, name: str, optimisation: str) -> None:
    compiled = CLibrary(example(), library, optimisation.split())
    for values in states():
        for output, wanted in expected(example(), name, values).items():
            assert_close(compiled.evaluate(name, values)[output], wanted)


@pytest.mark.parametrize("name", list(example().functions))
def test_c_in_single_precision(library: Path, name: str) -> None:
    compiled = CLibrary(example(), library, ["-DTOY_USE_FLOAT"])
    for values in states():
        found = compiled.evaluate(name, values)
        for output, wanted in expected(example(), name, values).items():
            assert_close(found[output], wanted, 1e-4)
        assert all((value == np.float32(value)).all() for value in found.values())


@pytest.mark.parametrize("name", list(example().functions))
def test_casadi_computes_the_nodes(python: tuple[Any, Any], name: str) -> None:
    built = python[1].build(name)
    for values in states():
        found = built.call(casadi_inputs(built, values))
        for value, wanted in zip(found, expected(example(), name, values).values(), strict=True):
            rows = wanted.reshape(-1, wanted.shape[-1] if wanted.ndim > 1 else 1)
            assert_close(np.array(value), rows)


@pytest.mark.parametrize("name", list(example().functions))
def test_numpy_is_vectorised_over_samples(python: tuple[Any, Any], name: str) -> None:
    order = python[1].build(name).name_in()
    samples = states(6)
    stacked = [np.array([values[signal] for values in samples]).reshape(2, 3, -1) for signal in order]
    if order[0] == PARAMETERS:
        for values in samples:
            values[PARAMETERS] = samples[0][PARAMETERS]
        stacked[0] = np.array(samples[0][PARAMETERS])
    found = python[0].FUNCTIONS[name](*stacked)
    found = found if isinstance(found, tuple) else (found,)
    wanted = [expected(example(), name, values) for values in samples]
    for value, output in zip(found, example().functions[name].outputs, strict=True):
        numbers = np.array([one[output.signal.name] for one in wanted])
        assert_close(value, numbers.reshape(2, 3, *output.signal.shape))


def test_numpy_refuses_a_wrong_size(python: tuple[Any, Any]) -> None:
    with pytest.raises(ValueError, match=r"an input has shape \(4,\), expected \(\.\.\., 3\)"):
        python[0].plain([1, 2, 3, 4], [1, 2])


def test_sign_of_zero_is_zero(library: Path, python: tuple[Any, Any]) -> None:
    for zero in (0.0, -0.0):
        values = {"q": [1.0, zero, 1.0], "wrench": [1.0, 1.0]}
        assert CLibrary(example(), library).evaluate("plain", values)["y"][1] == 0
        assert python[0].plain(values["q"], values["wrench"])[1] == 0
        assert python[1].build("plain")(values["q"], values["wrench"])[1] == 0


# -- the C library --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("macros", [(), ("-DTOY_USE_FLOAT",)], ids=["double", "float"])
@pytest.mark.parametrize("standard", ["c99", "c11", "gnu17"])
def test_c_has_no_warnings(library: Path, tmp_path: Path, standard: str, macros: tuple[str, ...]) -> None:
    for source in ("toy.c", "toy_selftest.c"):
        run(["gcc", f"-std={standard}", "-O2", *WARNINGS, *macros, "-c", library / source, "-o", tmp_path / "object"])


@pytest.mark.parametrize("standard", ["c++98", "c++17"])
def test_header_is_cpp(library: Path, tmp_path: Path, standard: str) -> None:
    (tmp_path / "user.cpp").write_text(
        '#include "toy.h"\n#include "toy.h"\n'
        "int main() { toy_params p; toy_prepared r; toy_params_first(&p); toy_prepare(&p, &r); return 0; }\n"
    )
    warnings = ["-Wall", "-Wextra", "-pedantic", "-Werror"]
    run(["gcc", "-c", library / "toy.c", "-o", tmp_path / "toy.o"])
    run(
        ["g++", f"-std={standard}", *warnings, f"-I{library}", tmp_path / "user.cpp", tmp_path / "toy.o", "-lm"],
        cwd=tmp_path,
    )


def test_layout_assertion_stops_the_compiler(library: Path, tmp_path: Path) -> None:
    header = (library / "toy.h").read_text()
    assert "TOY_NPARAMETERS == 5" in header
    (tmp_path / "toy.h").write_text(header.replace("TOY_NPARAMETERS == 5", "TOY_NPARAMETERS == 6"))
    for standard in ("c99", "c11"):
        command = ["gcc", f"-std={standard}", "-c", str(tmp_path / "toy.h"), "-o", str(tmp_path / "object")]
        assert subprocess.run(command, capture_output=True, check=False).returncode != 0


@pytest.mark.parametrize("macros", [(), ("-DTOY_USE_FLOAT",)], ids=["double", "float"])
def test_selftest_passes_under_sanitizers(library: Path, tmp_path: Path, macros: tuple[str, ...]) -> None:
    flags = ["-std=c99", "-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=all", *macros]
    run(["gcc", *flags, library / "toy.c", library / "toy_selftest.c", "-o", tmp_path / "test", "-lm"])
    count = len(reference_cases(example()))
    assert run([tmp_path / "test"]) == f"{count} passed, 0 failed\n"


@pytest.mark.parametrize("wrong", [1 + 1e-9, float("nan")])
def test_selftest_fails_on_a_wrong_number(tmp_path: Path, wrong: float) -> None:
    cases = reference_cases(example(), 1e-10)
    energy = cases[0].outputs["energy"][0]
    bad = Case("two", cases[0].parameters, cases[0].inputs, {**cases[0].outputs, "energy": (energy * wrong,)}, 1e-10)
    write(tmp_path, c_backend.library(example(), [*cases, bad]))
    selftest = tmp_path / "toy_selftest.c"
    selftest.write_text(re.sub(r"\bnan\b", "(0.0/0.0)", selftest.read_text()))
    run(["gcc", "-std=c99", tmp_path / "toy.c", tmp_path / "toy_selftest.c", "-o", tmp_path / "test", "-lm"])
    done = subprocess.run([str(tmp_path / "test")], capture_output=True, text=True, check=False)
    assert done.stdout == f"FAILED toy_two, state 2\n{len(cases)} passed, 1 failed\n"
    assert done.returncode == 1


def test_selftest_refuses_a_case_of_the_wrong_size() -> None:
    case = Case("plain", (0.0,) * 5, {"q": (1.0, 2.0), "wrench": (0.0, 0.0)}, {"y": (0.0,) * 3}, 1e-9)
    with pytest.raises(ValueError, match="a case gives 2 values for q, which has 3"):
        c_backend.library(example(), [case])


def test_parameters_change_without_regenerating(library: Path) -> None:
    compiled = CLibrary(example(), library)
    first, second = states(2)
    for parameters in (first[PARAMETERS], second[PARAMETERS]):
        values = {**first, PARAMETERS: parameters}
        assert_close(compiled.evaluate("two", values)["y"], expected(example(), "two", values)["y"])


def test_functions_without_parameters_take_null(library: Path) -> None:
    compiled = CLibrary(example(), library)
    for name in ("plain", "constant", "matrix", "array"):
        values = {key: value for key, value in states()[0].items() if key != PARAMETERS}
        for output, wanted in expected(example(), name, states()[0]).items():
            assert_close(compiled.evaluate(name, values)[output], wanted)


def test_what_depends_on_parameters_alone_is_prepared(library: Path) -> None:
    header, source = ((library / name).read_text() for name in ("toy.h", "toy.c"))
    fields = re.search(r"typedef struct toy_prepared \{([^}]*)\} toy_prepared;", header)
    assert fields is not None
    found = re.findall(r"toy_real (\w+); /\*\*< (.*) \*/", fields[1])
    assert found == [
        ("Fc1", "[kg m2] some * / parameter"),
        ("MASS", "ZZ1R + 2.0*MX1"),
        ("p2", "class/NQ"),
    ]
    assert "params" not in source.split("void toy_two", 1)[1].split("}", 1)[0]


def test_no_text_ends_a_comment_or_joins_its_line_with_the_next() -> None:
    assert safe('What is this??/\n?????*/ \\ "x"') == "What is this? ?/ ? ? ? ? ?* / / 'x'"


def test_a_run_of_zeros_is_a_loop(library: Path) -> None:
    body = (library / "toy.c").read_text().split("void toy_sparse", 1)[1].split("\n}", 1)[0]
    assert re.findall(r"for .*", body) == ["for (int i = 4; i < 20; ++i) {"]
    assert re.findall(r"y\[(\w+)\] =", body) == ["22", "0", "1", "2", "3", "i", "20", "21", "23"]


def test_parameter_constants(library: Path) -> None:
    header = (library / "toy.h").read_text()
    found = re.findall(r"^    (TOY_\w+)(?: = 0)?,? /\*\*<", header, re.MULTILINE)
    names = ["ZZ1R", "MX1", "Fc1", "class", "NQ_", "NPARAMETERS", "STD_ZZ1", "STD_MX1", "STD_Fc1", "NSTANDARD"]
    assert found == [f"TOY_{name}" for name in names]


def test_parameter_set(library: Path, python: tuple[Any, Any]) -> None:
    assert CLibrary(example(), library).parameter_set("first") == [-2.5, 1.0, 2.0, 3.0, 4.0]
    assert all(one.PARAMETER_SETS == {"first": (-2.5, 1.0, 2.0, 3.0, 4.0)} for one in python)


def test_places_of_a_packed_output(library: Path, python: tuple[Any, Any]) -> None:
    assert CLibrary(example(), library).sparsity("packed") == ([0, 1], [3, 2])
    assert all(one.SPARSITY == {"packed": ((0, 1), (3, 2))} for one in python)


def test_a_sine_of_ones_own(library: Path, tmp_path: Path) -> None:
    program = Program((PARAMETERS,))
    q = Inputs(program).q
    model = toy(program, function(program, "sine", [program.function("sin", q[0])]))
    folder = write(tmp_path, c_backend.library(model, ()))
    compiled = CLibrary(model, folder, ["-Dtoy_sin=-"])
    assert compiled.evaluate("sine", VALUES)["y"] == [-VALUES["q"][0]]


@pytest.mark.parametrize("macros", [(), ("-DTOY_USE_FLOAT",)], ids=["double", "float"])
def test_misra_deviations_are_the_documented_ones(library: Path, macros: tuple[str, ...]) -> None:
    report = checked(library / "toy.c", "-DTOY_LANES=1", *macros)
    found = set(re.findall(r"\[([\w.-]+)\]$", report, re.MULTILINE)) - {"unusedFunction", "checkersReport"}
    documented = documented_rules()
    assert found == {f"misra-c2012-{rule}" for rule in documented}


# -- CasADi ---------------------------------------------------------------------------------------------------------


def test_saved_functions_load(python: tuple[Any, Any], tmp_path: Path) -> None:
    folder = write(tmp_path, casadi_backend.emit(example())) / "functions"
    assert sorted(path.stem for path in folder.iterdir()) == sorted(example().functions)
    for name in example().functions:
        loaded, built = casadi.Function.load(str(folder / f"{name}.casadi")), python[1].build(name)
        assert (loaded.name_in(), loaded.name_out()) == (built.name_in(), built.name_out())
        given_ = casadi_inputs(built, VALUES)
        for one, other in zip(loaded.call(given_), built.call(given_), strict=True):
            assert (np.array(one) == np.array(other)).all()


@pytest.fixture(scope="module")
def external(library: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = write(tmp_path_factory.mktemp("casadi"), casadi_backend.emit(example()))
    flags = ["-std=c99", "-O1", *WARNINGS, *SHARED, f"-I{library}"]
    run(["gcc", *flags, folder / "toy_casadi.c", library / "toy.c", "-o", folder / "toy.so", "-lm"])
    return folder / "toy.so"


@pytest.mark.parametrize("name", list(example().functions))
def test_c_is_external_to_casadi(external: Path, python: tuple[Any, Any], name: str) -> None:
    loaded, built = casadi.external(f"toy_casadi_{name}", str(external)), python[1].build(name)
    assert (loaded.name_in(), loaded.name_out()) == (built.name_in(), built.name_out())
    for values in states():
        given_ = casadi_inputs(built, values)
        for one, other in zip(loaded.call(given_), built.call(given_), strict=True):
            assert one.shape == other.shape
            assert_close(np.array(one), np.array(other))


def test_external_inside_an_expression(external: Path) -> None:
    loaded = casadi.external("toy_casadi_matrix", str(external))
    q = casadi.MX.sym("q", 3)
    wrapped = casadi.Function("wrapped", [q], [casadi.mtimes(loaded(q, 0).T, loaded(q, 0))])
    wanted = expected(example(), "matrix", VALUES)["M"]
    assert_close(np.array(wrapped(VALUES["q"])), wanted.T @ wanted)


def test_casadi_differentiates(python: tuple[Any, Any]) -> None:
    built = python[1].build("matrix")
    jacobian = np.array(built.jacobian().call([VALUES["q"], VALUES["wrench"], casadi.DM.zeros(3, 2)])[0])
    assert jacobian[0, 0] == 1  # M[0, 0] = q1, the first of the columns
    assert jacobian[1, 1] == -1  # M[1, 0] = -q2


# -- the files ------------------------------------------------------------------------------------------------------

_DIGESTS = """
from tests.test_backends_toy import digests
print(digests())
"""


def digests() -> str:
    files: dict[str, str | bytes] = {}
    files |= c_backend.library(example(), reference_cases(example()))
    files |= {f"numpy/{name}": content for name, content in numpy_backend.emit(example()).items()}
    files |= {f"casadi/{name}": content for name, content in casadi_backend.emit(example()).items()}
    contents = {name: text.encode() if isinstance(text, str) else text for name, text in files.items()}
    return "\n".join(f"{hashlib.sha256(contents[name]).hexdigest()} {name}" for name in contents)


def test_bytes_do_not_depend_on_the_hash_seed() -> None:
    first, second = (
        run([sys.executable, "-c", _DIGESTS], cwd=ROOT, env={**os.environ, "PYTHONHASHSEED": seed}) for seed in "12"
    )
    assert first == second
    assert first.count("\n") == len(first.splitlines()) > 10


def test_files_name_no_place_and_no_day() -> None:
    for backend in (c_backend, numpy_backend, casadi_backend):
        emit = backend.emit if backend is not c_backend else (lambda model: c_backend.library(model, ()))
        for name, content in emit(example()).items():
            text = content.decode() if isinstance(content, bytes) else content
            assert str(ROOT) not in text, name
            assert not re.search(r"\b20[2-9]\d-\d\d-\d\d\b", text), name


@pytest.mark.skipif(shutil.which("cmake") is None, reason="cmake is not installed")
def test_cmake_project(library: Path, tmp_path: Path) -> None:
    run(["cmake", "-S", library, "-B", tmp_path / "build", f"-DCMAKE_INSTALL_PREFIX={tmp_path / 'installed'}"])
    run(["cmake", "--build", tmp_path / "build"])
    run(["ctest", "--test-dir", tmp_path / "build"])
    run(["cmake", "--install", tmp_path / "build"])
    user = write(
        tmp_path / "user",
        {
            "CMakeLists.txt": "cmake_minimum_required(VERSION 3.13)\nproject(user C)\nfind_package(toy REQUIRED)\n"
            "add_executable(user user.c)\ntarget_link_libraries(user PRIVATE toy::toy)\n",
            "user.c": "#include <toy.h>\n"
            "int main(void) { toy_params p; toy_params_first(&p); return p.value[0] != -2.5; }\n",
        },
    )
    run(["cmake", "-S", user, "-B", user / "build", f"-DCMAKE_PREFIX_PATH={tmp_path / 'installed'}"])
    run(["cmake", "--build", user / "build"])
    run([user / "build" / "user"])


@pytest.mark.skipif(shutil.which("cmake") is None, reason="cmake is not installed")
def test_without_an_operating_system_the_mathematics_library_is_linked_too(library: Path, tmp_path: Path) -> None:
    bare = ("-DCMAKE_SYSTEM_NAME=Generic", "-DCMAKE_TRY_COMPILE_TARGET_TYPE=STATIC_LIBRARY")
    run(["cmake", "-S", library, "-B", tmp_path / "build", *bare])
    run(["cmake", "--build", tmp_path / "build"])
    assert re.search(r"-lm\b", (tmp_path / "build/CMakeFiles/toy_selftest.dir/link.txt").read_text())
