"""Instructions that one call of a generated C function executes, counted by valgrind's callgrind: exact, repeatable."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from benchmarks.callgrind import collected
from benchmarks.compiling import run
from generator.backends import c
from generator.derivation import derive
from generator.reference.sample import physical_parameters
from generator.robot.description import ParameterValue, Robot
from generator.symbolic.function import Function
from generator.symbolic.model import Model
from generator.symbolic.parameter_sets import parameter_vector
from tests.compiled import write

#: How the limits of this project count: fused multiply-add, four doubles in a register, nothing else special.
FLAGS = ("-std=c99", "-O2", "-ffp-contract=fast", "-march=haswell")

_CALLS = 2
_DRIVER = """#include "{prefix}.h"
{prefix}_params params = {{{{ {values} }}}};
{prefix}_prepared prepared;
{arrays}
int main(void)
{{
    {prefix}_prepare(&params, &prepared);
    for (int i = 0; i < {calls}; ++i) {{
        {prefix}_{function}(&prepared, {arguments});
    }}
    return 0;
}}
"""


def instructions(
    robot: Robot, functions: Sequence[str], build: Path, compiler: str = "gcc", flags: Sequence[str] = FLAGS
) -> dict[str, int]:
    """Instructions of one call by function, what it calls included and ``prepare`` left out; files go to ``build``.

    Parameters are physical ones, the state is arbitrary: apart from the signs of speeds no branch depends on it.
    """
    model = derive(robot, functions, check=False)
    write(build, c.library(model, ()))
    library = build / "library.o"
    run([compiler, *flags, "-c", str(build / f"{robot.name}.c"), "-o", str(library)])
    return {name: _count(model, model.functions[name], library, compiler, flags) for name in functions}


def _count(model: Model, function: Function, library: Path, compiler: str, flags: Sequence[str]) -> int:
    build, prefix = library.parent, model.robot.name
    source, program = build / f"call_{function.name}.c", build / f"call_{function.name}"
    source.write_text(_driver(model, function))
    macros = [flag for flag in flags if flag.startswith("-D")]
    bind_at_start = "-Wl,-z,now"
    run([compiler, *macros, str(source), str(library), bind_at_start, "-o", str(program), "-lm"])
    return collected(f"{prefix}_{function.name}", [program]) // _CALLS


def _driver(model: Model, function: Function) -> str:
    values = physical_parameters(model.robot, 1)
    parameters = parameter_vector(model, {name: ParameterValue(value, "") for name, value in values.items()})
    arrays = [(s.name, ", ".join(f"{0.1 * i - 0.25:.2f}" for i in range(s.size))) for s in function.inputs]
    arrays += [(output.signal.name, ", ".join(["0"] * output.signal.size)) for output in function.outputs]
    return _DRIVER.format(
        prefix=model.robot.name,
        function=function.name,
        values=", ".join(repr(float(value)) for value in parameters) or "0",
        arrays="\n".join(f"{model.robot.name}_real my_{name}[] = {{ {numbers} }};" for name, numbers in arrays),
        arguments=", ".join(f"my_{name}" for name, _ in arrays),
        calls=_CALLS,
    )
