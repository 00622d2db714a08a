"""C99: a library of one header and one source, its self-test, and a CMake project."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction

from generator.backends.printing.c_functions import BLOCK, MATHEMATICS, CFunction, c_function, c_language
from generator.backends.printing.c_names import size_constant, taken
from generator.backends.printing.identifiers import Identifiers
from generator.backends.printing.language import LINE
from generator.backends.printing.prepared import Prepared, index, is_parameter, prepare
from generator.backends.printing.selftest import self_tests
from generator.backends.printing.signals import headline, listed, paragraph, safe
from generator.backends.printing.stated_model import stated_model
from generator.backends.printing.straight_line import Block
from generator.backends.printing.templates import render
from generator.robot.parameters import Parameter
from generator.selftest import Case, cases
from generator.symbolic.counts import HEADS
from generator.symbolic.model import Model
from generator.symbolic.parameter_sets import resolved_sets
from generator.symbolic.statements import Node
from generator.version import VERSION

NAME = "c"

#: Of a set of drive constants, which a robot file may hold beside whole ones.
_NO_MODEL = "All base parameters are 0 here, with which nothing moves: take them from another set"


@dataclass(frozen=True)
class Constant:
    """The enumeration constant of a parameter's place."""

    name: str
    comment: str


@dataclass(frozen=True)
class Values:
    """A named parameter set: the literal and the constant of each parameter, in order."""

    name: str
    documentation: tuple[str, ...]
    entries: tuple[tuple[str, str], ...]


@dataclass(frozen=True)
class Packed:
    """The places of a packed output's entries in the matrix of ``shape``, as lines of tables."""

    function: str
    constant: str
    size: int
    shape: tuple[int, int]
    rows: tuple[str, ...]
    columns: tuple[str, ...]


def emit(model: Model) -> dict[str, str | bytes]:
    """The files of the C library by their paths; its self-test holds the cases of the independent implementation."""
    return library(model, cases(model))


def library(model: Model, reference: Iterable[Case]) -> dict[str, str | bytes]:
    """The files of the C library, with a self-test of the cases ``reference``."""
    prefix, macro = model.robot.name, model.robot.name.upper()
    prepared = prepare(model.functions.values(), model.parameters, c_language(prefix).reserved)
    functions = [c_function(function, prepared, prefix) for function in model.functions.values()]
    tests, parameter_sets = self_tests(functions, reference)
    names = Identifiers(taken(model))
    constants = _constants(model.parameters, f"{macro}_", names)
    moving = _operations(function.called for function in model.functions.values())
    angles = bool(moving & {"sin", "cos"})
    context = {
        "prefix": prefix,
        "macro": macro,
        "robot": model.robot,
        "version": VERSION,
        "width": len(model.base_parameters),
        "built_in": bool(model.constants),
        "base_parameters": paragraph(" ".join(one.name for one in model.base_parameters), LINE - 3),
        "title": paragraph(headline(prefix, model.robot.description), LINE - 3),
        "constants": constants,
        "standard_constants": _constants(model.standard_parameters, f"{macro}_STD_", names),
        "stated": stated_model(model),
        "prepared": prepared,
        "operations": _table(functions, prepared),
        "functions": functions,
        "packed": [_packed(function, prefix) for function in functions if function.source.sparsity],
        "sets": _values(model, constants),
        "uses_angles": angles,
        "solving": paragraph(_solving(model), LINE - 3),
    }
    used = moving | _operations([prepared.nodes]) | ({"sin", "cos"} if angles else set())
    source = {
        "prepare": _prepare(prepared, prefix, constants),
        "mathematics": {name: function for name, function in MATHEMATICS.items() if name in used},
        "uses_sign": "sign" in used,
        "uses_directed": "directed" in used,
        "block": BLOCK,
        "ways": _ways(model),
    }
    return {
        f"{prefix}.h": render("c/header.h.jinja", **context),
        f"{prefix}.c": render("c/source.c.jinja", **context, **source),
        f"{prefix}_selftest.c": render("c/selftest.c.jinja", **context, tests=tests, parameter_sets=parameter_sets),
        "CMakeLists.txt": render("c/CMakeLists.txt.jinja", **context),
    }


def _table(functions: Sequence[CFunction], prepared: Prepared) -> list[str]:
    """Operation counts per call, and those of the prepare function, as lines."""
    counts = {function.name: function.source.count for function in functions} | {"prepare (once)": prepared.count}
    width = max(map(len, counts))
    rows: list[tuple[str, ...]] = [("", *HEADS)]
    rows += [(name, *(str(number) for number in count.as_dict().values())) for name, count in counts.items()]
    return ["".join([row[0].ljust(width), *(cell.rjust(9) for cell in row[1:])]) for row in rows]


def _constants(parameters: Sequence[Parameter], prefix: str, names: Identifiers) -> list[Constant]:
    return [Constant(names.claim(f"{prefix}{p.name}"), f"[{safe(p.unit)}] {safe(p.meaning)}") for p in parameters]


def _prepare(prepared: Prepared, prefix: str, constants: Sequence[Constant]) -> Block:
    language = c_language(prefix)
    parameters = {
        node: f"params->value[{constants[index(node)].name}]" for node in prepared.nodes if is_parameter(node)
    }
    return prepared.block(parameters, language, Identifiers(language.reserved | {"params", "prepared"}))


def _operations(programs: Iterable[Iterable[Node]]) -> set[str]:
    return {node.operation for nodes in programs for node in nodes}


def _values(model: Model, constants: Sequence[Constant]) -> list[Values]:
    language = c_language(model.robot.name)
    names = Identifiers(())
    result = []
    for name, values in resolved_sets(model).items():
        given = model.robot.parameter_sets.get(name)
        said = (given.description, f"source: {given.source}" if given.source else "") if given else ()
        text = "; ".join(filter(None, said))
        if not any(values[parameter.name] for parameter in model.base_parameters):
            text = ". ".join(filter(None, (text, _NO_MODEL)))
        numbers = [values.get(parameter.name, 0.0) for parameter in model.parameters]
        entries = tuple(
            (f"{'-' if number < 0 else ''}{language.number(abs(Fraction(number)))}", constant.name)
            for number, constant in zip(numbers, constants, strict=True)
        )
        result.append(Values(names.claim(name), tuple(paragraph(text, LINE - 3)), entries))
    return result


def _packed(function: CFunction, prefix: str) -> Packed:
    sparsity = function.source.sparsity
    assert sparsity is not None
    rows, columns = (tuple(listed(map(str, places), LINE - 8)) for places in (sparsity.rows, sparsity.columns))
    return Packed(
        function.name, size_constant(prefix, function.name), len(sparsity.rows), sparsity.shape, rows, columns
    )


def _solving(model: Model) -> str:
    """Which functions solve with the inertias, so that a set without any is none for them; nothing where none does."""
    solving = [f"{model.robot.name}_{function.name}()" for function in model.functions.values() if function.solves]
    if not solving:
        return ""
    return (
        f"{', '.join(solving)} {'solve' if len(solving) > 1 else 'solves'} with the inertias: a set that gives none "
        "leaves no result there, and infinite what is prepared as a quotient."
    )


def _ways(model: Model) -> list[str]:
    """How the equations of the bodies are written, a kind in a line or more."""
    choices = model.strategies.choices or {}
    told = (f"{kind}: {choice.way}" for kind, choice in choices.items())
    return [line for text in told for line in paragraph(text, LINE - 5, hanging=4)]
