"""Generated code made callable: C through gcc and cffi, Python modules by running them."""

from __future__ import annotations

import subprocess
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import ModuleType
from typing import Any

import cffi  # type: ignore[import-untyped]
import numpy as np
from numpy.typing import ArrayLike, NDArray

from generator.symbolic.model import Model

Results = dict[str, NDArray[np.float64]]


def write(folder: Path, files: Mapping[str, str | bytes]) -> Path:
    """Writes what a backend emitted; returns ``folder``."""
    for name, content in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content.encode() if isinstance(content, str) else content)
    return folder


def run(command: Sequence[str | Path], **options: Any) -> str:
    """The output of a command; fails the test with that output if the command fails."""
    words = [str(word) for word in command]
    done = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False, **options)
    output: str = done.stdout
    assert done.returncode == 0, f"{' '.join(words)}\n{output}"
    return output


def module(source: str | bytes, name: str) -> ModuleType:
    """A generated Python module, run."""
    result = ModuleType(name)
    exec(compile(source, f"{name}.py", "exec"), result.__dict__)
    return result


class CLibrary:
    """The generated C of ``model`` in ``folder``, compiled and bound.

    ``flags`` go to the compiler; ``-D<MACRO>_USE_FLOAT`` among them selects single precision.
    """

    def __init__(self, model: Model, folder: Path, flags: Sequence[str] = ("-O1",)) -> None:
        self._model = model
        self._name = model.robot.name
        library = folder / f"lib{self._name}{len(list(folder.iterdir()))}.so"
        run(["gcc", "-std=c99", "-shared", "-fPIC", *flags, folder / f"{self._name}.c", "-o", library, "-lm"])
        self._ffi = cffi.FFI()
        self._ffi.cdef(_declarations(folder / f"{self._name}.h", flags))
        self._library = self._ffi.dlopen(str(library))

    def evaluate(self, function: str, inputs: Mapping[str, ArrayLike]) -> Results:
        """Outputs by name, shaped, for inputs by name; NULL is passed as prepared where no parameters are given."""
        wanted = self._model.functions[function]
        arrays = [self._array(inputs[signal.name]) for signal in wanted.inputs]
        results = [self._array(np.zeros(output.signal.size)) for output in wanted.outputs]
        getattr(self._library, f"{self._name}_{function}")(self._prepared(inputs), *arrays, *results)
        return {
            output.signal.name: np.array(list(result), dtype=float).reshape(output.signal.shape)
            for output, result in zip(wanted.outputs, results, strict=True)
        }

    def parameter_set(self, name: str) -> list[float]:
        """The values that the library's own function fills in."""
        params = self._new("params *")
        getattr(self._library, f"{self._name}_params_{name}")(params)
        return list(params.value)

    def sparsity(self, function: str) -> tuple[list[int], list[int]]:
        """Rows and columns of a packed output."""
        size = self._model.functions[function].outputs[0].signal.size
        rows, columns = self._ffi.new(f"int[{size}]"), self._ffi.new(f"int[{size}]")
        getattr(self._library, f"{self._name}_{function}_sparsity")(rows, columns)
        return list(rows), list(columns)

    def _prepared(self, inputs: Mapping[str, ArrayLike]) -> Any:
        if "parameters" not in inputs:
            return self._ffi.NULL
        params, prepared = self._new("params *"), self._new("prepared *")
        params.value = [float(value) for value in np.asarray(inputs["parameters"])]
        getattr(self._library, f"{self._name}_prepare")(params, prepared)
        return prepared

    def _array(self, values: ArrayLike) -> Any:
        return self._new("real[]", [float(value) for value in np.ravel(values)])

    def _new(self, kind: str, *initial: Any) -> Any:
        return self._ffi.new(f"{self._name}_{kind}", *initial)


def _declarations(header: Path, flags: Sequence[str]) -> str:
    """The header as cffi reads it: preprocessed, without the assertions, which C99 writes as array types."""
    macros = [flag for flag in flags if flag.startswith("-D")]
    lines = run(["gcc", "-std=c99", "-E", "-P", *macros, header]).splitlines()
    return "\n".join(line for line in lines if not line.startswith("typedef char "))
