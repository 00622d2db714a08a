"""The generated C, with its own sine and cosine where it has them, and with those of the mathematics library."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path

from benchmarks.compiling import FLAGS, SHARED, C, compiled, compilers
from benchmarks.peers.library import SOURCES, Library
from benchmarks.peers.subject import Array, Chain, write
from generator.backends import c
from generator.symbolic.model import Model

NAME = "Counterpoise"
#: The same with the sine and cosine of the C library.
WITH_LIBM = "Counterpoise, libm"

_WRAPPER = """\
#include "{robot}.h"
#include "peer.h"

static {robot}_prepared model;

int peer_load(const char *file)
{{
    {robot}_params params;
    const size_t count = sizeof params.value / sizeof *params.value;
    if (peer_read(file, params.value, count) != count) {{
        return 1;
    }}
    {robot}_prepare(&params, &model);
    return 0;
}}
"""
_FUNCTION = """
void {function}(const double *q, const double *qd, const double *third, double *out)
{{
    {unused}{robot}_{function}(&model, {signals}, out);
}}
"""


def build(subject: Chain, folder: Path) -> list[Library]:
    """By each compiler, with each sine; the whole robot too."""
    reduced = libraries(subject.model, subject.parameters(subject.model), folder / "ours")
    whole = libraries(subject.whole, subject.parameters(subject.whole), folder / "ours_whole")
    return [*reduced, *(replace(library, whole=True) for library in whole)]


def libraries(model: Model, parameters: Array, folder: Path, flags: Sequence[str] = FLAGS) -> list[Library]:
    """The functions of ``model`` with a parameter vector."""
    robot = model.robot.name
    sources = [*generated(model, folder), folder / "peer.c"]
    sources[-1].write_text(_wrapper(robot, model.functions))
    data = write(parameters, folder / "parameters.bin")
    libm = f"{robot.upper()}_USE_LIBM"
    variants: dict[str, tuple[str, ...]] = {WITH_LIBM: (f"-D{libm}",)}
    if any(libm in path.read_text() for path in sources):
        variants = {NAME: (), **variants}
    result = []
    for compiler in compilers():
        for peer, macros in variants.items():
            target = folder / f"{'libm' if macros else 'own'}_{compiler.name}.so"
            options = [*SHARED, *macros, f"-I{SOURCES}", "-lm"]
            compiled(compiler, C, target, sources, options, flags)
            result.append(Library(peer, compiler.name, target, data, tuple(model.functions)))
    return result


def generated(model: Model, folder: Path) -> list[Path]:
    """The C sources of ``model``, written into ``folder``."""
    folder.mkdir(parents=True, exist_ok=True)
    files = c.library(model, ())
    for name in (f"{model.robot.name}.h", f"{model.robot.name}.c"):
        content = files[name]
        (folder / name).write_bytes(content.encode() if isinstance(content, str) else content)
    return [folder / f"{model.robot.name}.c"]


def _wrapper(robot: str, functions: Iterable[str]) -> str:
    text = _WRAPPER.format(robot=robot)
    for function in functions:
        positions_alone = function in ("inertia_matrix", "gravity")
        signals = "q" if positions_alone else "q, qd, third"
        unused = "(void)qd;\n    (void)third;\n    " if positions_alone else ""
        text += _FUNCTION.format(robot=robot, function=function, signals=signals, unused=unused)
    return text
