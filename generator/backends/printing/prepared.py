"""What depends on the parameters alone, computed once: the structure that every function of the robot reads."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass

from generator.backends.printing.identifiers import Identifiers
from generator.backends.printing.language import Language
from generator.backends.printing.signals import safe
from generator.backends.printing.straight_line import Block, straight_line
from generator.robot.parameters import Parameter
from generator.symbolic.counts import Count
from generator.symbolic.function import PARAMETERS, Function
from generator.symbolic.statements import FUNCTIONS, Node

#: How a prepared value is explained to a reader: plain names and numbers.
_WORDS = Language(
    calls={operation: operation for operation in (*FUNCTIONS, "pow")},
    statement="{value}",
    literal="{value}",
    reserved=frozenset(),
    line=10**6,
)
#: A longer formula than this is replaced by the names that it contains.
_FORMULA = 90


@dataclass(frozen=True)
class Field:
    """One number of the prepared structure: ``node``, which is a parameter or computed from parameters."""

    name: str
    comment: str
    node: Node


@dataclass(frozen=True)
class Prepared:
    """The structure's ``fields``, the ``nodes`` that compute them, in order, and their operation ``count``."""

    fields: tuple[Field, ...]
    nodes: tuple[Node, ...]
    count: Count

    def block(self, parameters: Mapping[Node, str], language: Language, names: Identifiers) -> Block:
        """The code that computes the fields, in order, from the text of the parameters."""
        return straight_line(self.nodes, [field.node for field in self.fields], parameters, language, names)


def prepare(functions: Collection[Function], parameters: Sequence[Parameter], reserved: Iterable[str]) -> Prepared:
    """The union of what ``functions`` read: parameters as they are, then what is computed from parameters alone."""
    direct = {node for function in functions for node in function.called if is_parameter(node)}
    computed = {node for function in functions for node in function.prepared}
    fields = _fields(sorted(direct, key=index), sorted(computed, key=lambda node: node.index), parameters, reserved)
    if not fields:
        return Prepared((), (), Count())
    program = fields[0].node.program
    nodes = tuple(program.reachable(field.node for field in fields))
    return Prepared(tuple(fields), nodes, program.count(nodes))


def signal_of(node: Node) -> str:
    """The name of the signal that an input node is an entry of."""
    return node.value[0]  # type: ignore[index, no-any-return]


def index(node: Node) -> int:
    """The place of an input node in its signal."""
    return node.value[1]  # type: ignore[index, no-any-return]


def is_parameter(node: Node) -> bool:
    """Whether a node is an entry of the input signal ``parameters``."""
    return node.operation == "input" and signal_of(node) == PARAMETERS


def _fields(
    direct: Sequence[Node], computed: Sequence[Node], parameters: Sequence[Parameter], reserved: Iterable[str]
) -> list[Field]:
    names = Identifiers(reserved)
    fields = []
    for node in direct:
        parameter = parameters[index(node)]
        fields.append(Field(names.claim(parameter.name), f"[{safe(parameter.unit)}] {safe(parameter.meaning)}", node))
    own = {node: names.claim(node.name or f"p{number}") for number, node in enumerate(computed, 1)}
    return fields + [Field(name, _formula(node, own, parameters), node) for node, name in own.items()]


def _formula(node: Node, own: Mapping[Node, str], parameters: Sequence[Parameter]) -> str:
    """What a computed field is: its formula in parameters and other fields, or if that is long, what it depends on."""
    known = {other: name for other, name in own.items() if other is not node}
    nodes = node.program.reachable([node], known=known)
    used = {argument: known[argument] for inner in nodes for argument in inner.arguments if argument in known}
    leaves = used | {read: parameters[index(read)].name for read in nodes if is_parameter(read)}
    block = straight_line(nodes, [node], leaves, _WORDS, Identifiers(()))
    *steps, formula = (*block.statements, *([] if node.name else block.results))
    if steps or len(formula) > _FORMULA:
        return f"from {', '.join(leaves.values())}"
    return formula
