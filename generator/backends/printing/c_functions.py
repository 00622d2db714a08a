"""Quantities as C functions: one calling convention for all of them.

``void <robot>_<quantity>(const <robot>_prepared *prepared, <inputs>, <outputs>)``: every signal is an array of fixed
size, row-major, a number an array of one.
"""

from __future__ import annotations

from collections.abc import Container, Iterator, Sequence, Set
from dataclasses import dataclass
from functools import partial
from itertools import groupby

from generator.backends.printing.angles import gathered
from generator.backends.printing.identifiers import C_RESERVED, Identifiers
from generator.backends.printing.language import LINE, Language
from generator.backends.printing.prepared import Prepared, index, is_parameter, signal_of
from generator.backends.printing.signals import described, listed, paragraph
from generator.backends.printing.straight_line import Block, straight_line
from generator.symbolic.function import Function, Signal
from generator.symbolic.statements import Node

#: The operations that <math.h> computes: its function for double; the one for float has an f behind.
MATHEMATICS = {
    "sin": "sin",
    "cos": "cos",
    "sqrt": "sqrt",
    "log": "log",
    "exp": "exp",
    "tanh": "tanh",
    "abs": "fabs",
    "pow": "pow",
}

#: Angles whose sines and cosines one call computes side by side.
BLOCK = 4
_ZERO = "R(0.0)"
#: Zeros in a row that are worth a loop, which goes over a whole number of vectors of so many.
_RUN, _VECTOR = 16, 4


@dataclass(frozen=True)
class Argument:
    """A signal as an array argument; ``read`` tells whether the body reads an input at all."""

    signal: Signal
    name: str
    read: bool = True

    @property
    def size(self) -> int:
        """Number of entries of the array, 1 of a number."""
        return self.signal.size


@dataclass(frozen=True)
class Result:
    """``count`` entries of an output from ``start`` on that have one ``value``, which no statement has written."""

    output: str
    start: int
    count: int
    value: str


@dataclass(frozen=True)
class CFunction:
    """``source`` in C; ``results`` come after ``statements``, which write all other entries of the outputs."""

    source: Function
    prototype: str
    documentation: tuple[str, ...]
    reads_prepared: bool
    inputs: tuple[Argument, ...]
    outputs: tuple[Argument, ...]
    statements: tuple[str, ...]
    results: tuple[Result, ...]

    @property
    def name(self) -> str:
        """Name of the quantity, without the robot's prefix."""
        return self.source.name


def c_language(prefix: str) -> Language:
    """C as the generated source writes it: constants through R(), mathematics through the robot's own macros."""
    calls = {operation: f"{prefix}_{operation}" for operation in (*MATHEMATICS, "sign", "directed")}
    return Language(calls, f"const {prefix}_real {{name}} = {{value}};", "R({value})", C_RESERVED)


def c_function(function: Function, prepared: Prepared, prefix: str) -> CFunction:
    """One quantity; what depends on parameters alone is read from ``prepared``."""
    language = c_language(prefix)
    names = Identifiers(language.reserved | {"prepared", "i"})
    nodes = function.called
    fields = {field.node: f"prepared->{field.name}" for field in prepared.fields}
    read = {signal_of(node) for node in nodes if node.operation == "input"}
    inputs = tuple(Argument(s, names.claim(s.name), s.name in read) for s in function.inputs)
    outputs = tuple(Argument(output.signal, names.claim(output.signal.name)) for output in function.outputs)
    given = {argument.signal.name: argument.name for argument in inputs}
    leaves = fields | {
        node: f"{given[signal_of(node)]}[{index(node)}]"
        for node in nodes
        if node.operation == "input" and not is_parameter(node)
    }
    reads_prepared = any(node in fields for user in nodes for node in (user, *user.arguments))
    reads_prepared = reads_prepared or any(root in fields for root in function.roots)
    places = _places(function, outputs, set(nodes) - set(leaves))
    steps = gathered(nodes, partial(_sines_and_cosines, prefix))
    code = straight_line(steps, function.roots, leaves, language, names, places)
    return CFunction(
        function,
        _prototype(function.name, prefix, inputs, outputs),
        _documentation(function, prefix, reads_prepared, inputs, outputs),
        reads_prepared,
        inputs,
        outputs,
        code.statements,
        tuple(_results(function, outputs, places, code)),
    )


def _places(function: Function, outputs: Sequence[Argument], computed: Set[Node]) -> dict[Node, list[str]]:
    """The output entries of each node that the function computes."""
    places: dict[Node, list[str]] = {}
    for argument, output in zip(outputs, function.outputs, strict=True):
        for place, node in enumerate(output.nodes):
            if node in computed and node.number is None:
                places.setdefault(node, []).append(f"{argument.name}[{place}]")
    return places


def _results(
    function: Function, outputs: Sequence[Argument], written: Container[Node], code: Block
) -> Iterator[Result]:
    """The entries without a statement of their own, in order, a long run of zeros as one."""
    values = iter(code.results)
    for argument, output in zip(outputs, function.outputs, strict=True):
        entries = enumerate(zip(output.nodes, values, strict=False))
        for is_zero, run in groupby(entries, lambda entry: entry[1][0].number == 0):
            places = [(place, value) for place, (node, value) in run if node not in written]
            looped = len(places) // _VECTOR * _VECTOR if is_zero and len(places) >= _RUN else 0
            if looped:
                yield Result(argument.name, places[0][0], looped, places[0][1])
            yield from (Result(argument.name, place, 1, value) for place, value in places[looped:])


def _sines_and_cosines(
    prefix: str, nodes: Sequence[Node], angles: Sequence[Node], texts: Sequence[str], names: Identifiers
) -> tuple[Sequence[str], Sequence[str]]:
    """Calls that compute them side by side, a block of angles each; the last block is filled up with zeros."""
    sine, cosine = names.claim("sine"), names.claim("cosine")
    blocks = -(-len(texts) // BLOCK)
    filled = [*texts, *[_ZERO] * (blocks * BLOCK - len(texts))]
    statements = [f"{prefix}_real {sine}[{blocks * BLOCK}];", f"{prefix}_real {cosine}[{blocks * BLOCK}];"]
    for start in range(0, len(texts), BLOCK):
        count = min(BLOCK, len(texts) - start)
        results = (f"&{sine}[{start}]", f"&{cosine}[{start}]") if start else (sine, cosine)
        arguments = [str(count), *filled[start : start + BLOCK], *results]
        line = f"{prefix}_sines_cosines({', '.join(arguments)});"
        if len(line) > LINE - 4:
            *first, last = listed(arguments, LINE - 8)
            statements += [f"{prefix}_sines_cosines(", *(f"    {words}" for words in first), f"    {last[:-1]});"]
        else:
            statements.append(line)
    arrays = {"sin": sine, "cos": cosine}
    return statements, [f"{arrays[node.operation]}[{angles.index(node.arguments[0])}]" for node in nodes]


def _prototype(name: str, prefix: str, inputs: Sequence[Argument], outputs: Sequence[Argument]) -> str:
    arguments = [
        f"const {prefix}_prepared *prepared",
        *(f"const {prefix}_real {argument.name}[{argument.size}]" for argument in inputs),
        *(f"{prefix}_real {argument.name}[{argument.size}]" for argument in outputs),
    ]
    head = f"void {prefix}_{name}("
    line = f"{head}{', '.join(arguments)})"
    if len(line) < LINE:
        return line
    return head + "\n    " + "\n    ".join(listed(arguments, LINE - 4))[:-1] + ")"


def _documentation(
    function: Function, prefix: str, reads_prepared: bool, inputs: Sequence[Argument], outputs: Sequence[Argument]
) -> tuple[str, ...]:
    width = LINE - 3
    unread = "not read here, may be NULL"
    entries = [("[in] ", "prepared", f"from {prefix}_prepare()" if reads_prepared else unread)]
    entries += [("[in] ", argument.name, described(argument.signal)) for argument in inputs]
    entries += [("[out]", argument.name, described(argument.signal)) for argument in outputs]
    lines = [*paragraph(function.summary, width), "", *paragraph(function.details, width)]
    lines += [""] if function.details else []
    for direction, name, text in entries:
        lines += paragraph(f"@param{direction} {name}  {text}", width, hanging=4)
    return tuple(lines)
