"""C99 over many samples: inverse dynamics, observation matrices and their normal equations, several samples at once."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import ceil

from generator.backends.printing.c_functions import MATHEMATICS
from generator.backends.printing.identifiers import C_RESERVED, Identifiers
from generator.backends.printing.language import LINE, Language
from generator.backends.printing.many_samples import DYNAMICS, INPUTS, REGRESSOR, of_many_samples
from generator.backends.printing.observation import layout
from generator.backends.printing.prepared import Prepared, index, is_parameter, prepare, signal_of
from generator.backends.printing.signals import headline, paragraph
from generator.backends.printing.straight_line import straight_line
from generator.backends.printing.templates import render
from generator.symbolic.function import Function
from generator.symbolic.interpret import evaluate_nodes
from generator.symbolic.model import Model
from generator.symbolic.statements import Node
from generator.version import VERSION

NAME = "batch"

_TRIGONOMETRY = ("sin", "cos")

#: Operations on lanes, under the names that the template gives them.
_LANGUAGE = Language(
    calls={operation: f"lanes_{operation}" for operation in (*MATHEMATICS, "sign", "directed")},
    statement="const lanes {name} = {value};",
    literal="R({value})",
    reserved=C_RESERVED | {"lanes", "prepared", "to", *INPUTS},
)


@dataclass(frozen=True)
class LaneFunction:
    """The program of a function on lanes: its statements, and the lanes of each output entry in order.

    ``unread`` are the inputs that the program does not read.
    """

    statements: tuple[str, ...]
    results: tuple[str, ...]
    reads_prepared: bool
    unread: tuple[str, ...]


def emit(model: Model) -> dict[str, str | bytes]:
    """The header and the source by their paths.

    Nothing for a model without the functions that they are made of, or whose effects read more than the motion.
    """
    if not of_many_samples(model):
        return {}
    prefix = model.robot.name
    prepared = prepare(model.functions.values(), model.parameters, C_RESERVED)
    dynamics, regressor = model.functions[DYNAMICS], model.functions[REGRESSOR]
    assert regressor.sparsity is not None
    called = [*dynamics.called, *regressor.called]
    used = {node.operation for node in called}
    context = {
        "prefix": prefix,
        "macro": prefix.upper(),
        "robot": model.robot,
        "version": VERSION,
        "title": paragraph(headline(prefix, model.robot.description), LINE - 3),
        "layout": layout(regressor.sparsity),
        "dynamics": lane_function(dynamics, prepared),
        "regressor": lane_function(regressor, prepared),
        "mathematics": {name: function for name, function in MATHEMATICS.items() if name in used},
        "trigonometry": [name for name in _TRIGONOMETRY if name in used],
        "uses_sign": "sign" in used,
        "uses_directed": "directed" in used,
        "spread": _spread(called),
    }
    return {
        f"{prefix}_batch.h": render("batch/header.h.jinja", **context),
        f"{prefix}_batch.c": render("batch/source.c.jinja", **context),
    }


def lane_function(function: Function, prepared: Prepared) -> LaneFunction:
    """A function whose signals are lanes, each with one sample, and whose parameters are read from ``prepared``."""
    nodes = function.called
    fields = {field.node: f"prepared->{field.name}" for field in prepared.fields}
    signals = {
        node: f"{signal_of(node)}[{index(node)}]"
        for node in nodes
        if node.operation == "input" and not is_parameter(node)
    }
    read = {signal_of(node) for node in signals}
    constants = _constants(nodes)
    leaves = {**fields, **signals, **constants}
    block = straight_line(nodes, function.roots, leaves, _LANGUAGE, Identifiers(_LANGUAGE.reserved))
    results = (
        f"lanes_splat({text})" if node.number is not None or node.parameter_only or node in constants else text
        for node, text in zip(function.roots, block.results, strict=True)
    )
    return LaneFunction(
        block.statements,
        tuple(results),
        _reads(nodes, function.roots, fields),
        tuple(name for name in INPUTS if name not in read),
    )


def _spread(nodes: Sequence[Node]) -> int | None:
    """A number that no angle of a sine or cosine exceeds while the positions' norm is at most 1, and in proportion.

    None where an angle is no sum of positions and constants.
    """
    bounds: dict[Node, float | None] = {}
    for node in nodes:
        bounds[node] = _bound(node, [_known(argument, bounds) for argument in node.arguments])
    angles = [bounds[node.arguments[0]] for node in nodes if node.operation in _TRIGONOMETRY]
    known = [bound for bound in angles if bound is not None]
    return ceil(max(known, default=1.0)) if len(known) == len(angles) else None


def _known(node: Node, bounds: Mapping[Node, float | None]) -> float | None:
    return float(abs(node.number)) if node.number is not None else bounds.get(node)


def _bound(node: Node, arguments: Sequence[float | None]) -> float | None:
    """The largest magnitude of a sum of positions, each at most 1, and constants; None for any other node."""
    if node.operation == "input" and signal_of(node) == "q":
        return 1.0
    known = [bound for bound in arguments if bound is not None]
    if node.operation in ("add", "sub", "neg") and len(known) == len(arguments):
        return sum(known)
    return None


def _reads(nodes: Sequence[Node], roots: Sequence[Node], fields: Mapping[Node, str]) -> bool:
    return any(node in fields for user in nodes for node in (user, *user.arguments)) or any(r in fields for r in roots)


def _constants(nodes: Sequence[Node]) -> dict[Node, str]:
    """The value, as text, of each node that is computed from numbers alone: no lane function is called with those."""
    fixed: list[Node] = []
    for node in nodes:
        if node.arguments and all(a.number is not None or a in fixed for a in node.arguments):
            fixed.append(node)
    if not fixed:
        return {}
    values = evaluate_nodes(fixed[0].program.reachable(fixed), {})
    literals = {node: _LANGUAGE.literal.format(value=repr(abs(float(values[node])))) for node in fixed}
    return {node: literal if values[node] >= 0 else f"(-{literal})" for node, literal in literals.items()}
