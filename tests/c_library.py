"""The generated C of a model made callable, function by function."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from generator.symbolic.model import Model
from tests.bound import Bound
from tests.compiled import SHARED, run

Results = dict[str, NDArray[np.float64]]


class CLibrary:
    """The generated C of ``model`` in ``folder``, compiled and bound.

    ``flags`` go to the compiler; ``-D<MACRO>_USE_FLOAT`` among them selects single precision.
    """

    def __init__(self, model: Model, folder: Path, flags: Sequence[str] = ("-O1",)) -> None:
        self._model = model
        name = model.robot.name
        library = folder / f"lib{name}{len(list(folder.iterdir()))}.so"
        run(["gcc", "-std=c99", *SHARED, *flags, folder / f"{name}.c", "-o", library, "-lm"])
        self._c = Bound(name, library, folder / f"{name}.h", flags)

    def evaluate(self, function: str, inputs: Mapping[str, ArrayLike]) -> Results:
        """Outputs by name, shaped, for inputs by name; NULL is passed as prepared where no parameters are given."""
        wanted = self._model.functions[function]
        arrays = [self._c.array(inputs[signal.name]) for signal in wanted.inputs]
        results = [self._c.array(np.zeros(output.signal.size)) for output in wanted.outputs]
        self._c.call(function, self._prepared(inputs), *arrays, *results)
        return {
            output.signal.name: np.array(list(result), dtype=float).reshape(output.signal.shape)
            for output, result in zip(wanted.outputs, results, strict=True)
        }

    def parameter_set(self, name: str) -> list[float]:
        """The values that the library's own function fills in."""
        params = self._c.new("params *")
        self._c.call(f"params_{name}", params)
        return list(params.value)

    def sparsity(self, function: str) -> tuple[list[int], list[int]]:
        """Rows and columns of a packed output."""
        size = self._model.functions[function].outputs[0].signal.size
        rows, columns = self._c.ffi.new(f"int[{size}]"), self._c.ffi.new(f"int[{size}]")
        self._c.call(f"{function}_sparsity", rows, columns)
        return list(rows), list(columns)

    def _prepared(self, inputs: Mapping[str, ArrayLike]) -> Any:
        if "parameters" not in inputs:
            return self._c.ffi.NULL
        params, prepared = self._c.new("params *"), self._c.new("prepared *")
        params.value = [float(value) for value in np.asarray(inputs["parameters"])]
        self._c.call("prepare", params, prepared)
        return prepared
