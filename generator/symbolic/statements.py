"""The straight-line program: hash-consed nodes that the recursions build and the backends print.

A node is an operation on earlier nodes. Equal operations on equal arguments are the same node, so every common
subexpression is shared by construction. Constants are exact fractions and are folded; zero and one disappear; signs are
moved outwards, so that a unary minus (which the counts take as free) is the only place where a sign lives.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from typing import Union

import sympy

from generator.constants import exact_constant
from generator.symbolic.counts import Count

Number = int | Fraction
Operand = Union["Node", int, Fraction]

#: Operations of one argument that are evaluated by the mathematics library of the target language.
FUNCTIONS = ("sin", "cos", "sqrt", "log", "exp", "tanh", "abs", "sign")

#: How long operations take, in additions; the others take one.
_LATENCY = {"constant": 0, "input": 0, "neg": 0, "div": 4}

#: Denominators beyond this belong to rounded irrational constants (see ``symbolic.lowering``).
_EXACT_DENOMINATOR = 10**30
_ROUNDING = Fraction(1, 10**40)


class Node:
    """One operation of a program; made by the program only, compared by identity.

    ``operation`` is ``constant``, ``input``, ``add``, ``sub``, ``mul``, ``div``, ``neg``, ``pow``, ``directed`` or one
    of ``FUNCTIONS``. ``value`` is the fraction of a constant, ``(signal, index)`` of an input, else None.
    ``parameter_only`` tells that no input signal of the moving robot is among its ancestors. ``depth`` is how long a
    processor waits for it, in additions one after the other.
    """

    __slots__ = ("arguments", "depth", "index", "name", "number", "operation", "parameter_only", "program", "value")

    def __init__(
        self,
        program: Program,
        index: int,
        operation: str,
        arguments: tuple[Node, ...],
        value: object,
        parameter_only: bool,
    ) -> None:
        self.program = program
        self.index = index
        self.operation = operation
        self.arguments = arguments
        self.value = value
        #: The exact value of a constant, None for every other node.
        self.number: Fraction | None = value if type(value) is Fraction else None
        self.parameter_only = parameter_only
        self.depth: int = max([one.depth for one in arguments], default=0) + _LATENCY.get(operation, 1)
        self.name: str | None = None

    @property
    def source(self) -> tuple[str, int]:
        """Signal and index of an input."""
        assert isinstance(self.value, tuple)
        signal, index = self.value
        return str(signal), int(index)

    # An operand that is no number (an array, say) is given its own turn.
    def __add__(self, other: Operand) -> Node:
        b = self.program.operand(other)
        return NotImplemented if b is None else self.program.add(self, b)

    def __radd__(self, other: Operand) -> Node:
        a = self.program.operand(other)
        return NotImplemented if a is None else self.program.add(a, self)

    def __sub__(self, other: Operand) -> Node:
        b = self.program.operand(other)
        return NotImplemented if b is None else self.program.subtract(self, b)

    def __rsub__(self, other: Operand) -> Node:
        a = self.program.operand(other)
        return NotImplemented if a is None else self.program.subtract(a, self)

    def __mul__(self, other: Operand) -> Node:
        b = self.program.operand(other)
        return NotImplemented if b is None else self.program.multiply(self, b)

    def __rmul__(self, other: Operand) -> Node:
        a = self.program.operand(other)
        return NotImplemented if a is None else self.program.multiply(a, self)

    def __truediv__(self, other: Operand) -> Node:
        b = self.program.operand(other)
        return NotImplemented if b is None else self.program.divide(self, b)

    def __rtruediv__(self, other: Operand) -> Node:
        a = self.program.operand(other)
        return NotImplemented if a is None else self.program.divide(a, self)

    def __neg__(self) -> Node:
        return self.program.negate(self)

    def __repr__(self) -> str:
        if self.operation == "constant":
            return str(self.value)
        if self.operation == "input":
            return "{}[{}]".format(*self.source)
        return f"{self.operation}({', '.join(map(repr, self.arguments))})"


class Program:
    """Owner of the nodes; every node is made here, once.

    ``parameter_signals`` are the input signals that do not change while the robot moves: what depends on them alone
    can be computed once (``prepare``).
    """

    def __init__(self, parameter_signals: Iterable[str] = ("parameters",)) -> None:
        self._nodes: dict[tuple[object, ...], Node] = {}
        self._constants: dict[tuple[int, int], Node] = {}
        self._parameter_signals = frozenset(parameter_signals)
        self.zero = self.constant(0)
        self.one = self.constant(1)

    def __len__(self) -> int:
        return len(self._nodes)

    # -- leaves ---------------------------------------------------------------------------------------------------

    def constant(self, value: Number) -> Node:
        """The node of an exact constant; a rounded irrational that meets an integer is that integer."""
        exact = value if type(value) is Fraction else Fraction(value)
        known = self._constants.get((exact.numerator, exact.denominator))
        if known is not None:
            return known
        if exact.denominator > _EXACT_DENOMINATOR and abs(exact - round(exact)) < _ROUNDING:
            return self.constant(Fraction(round(exact)))
        node = self._intern("constant", (), exact)
        self._constants[exact.numerator, exact.denominator] = node
        return node

    def input(self, signal: str, index: int) -> Node:
        """Element ``index`` (row-major) of an input signal."""
        return self._intern("input", (), (signal, index))

    def node(self, operand: Operand) -> Node:
        """The node of a node or an exact number."""
        return operand if type(operand) is Node else self.constant(operand)  # type: ignore[arg-type]

    def operand(self, operand: object) -> Node | None:
        """The node of a node or an exact number; None for anything else (an array, say)."""
        if type(operand) is Node:
            return operand
        return self.constant(operand) if isinstance(operand, (int, Fraction)) else None

    # -- operations -----------------------------------------------------------------------------------------------

    def negate(self, a: Node) -> Node:
        """-a; of a negated node its argument."""
        if a.operation == "neg":
            return a.arguments[0]
        if a.number is not None:
            return self.constant(-a.number)
        return self._intern("neg", (a,))

    def add(self, a: Node, b: Node) -> Node:
        """a + b, the same node as b + a."""
        return self._sum(a, b, False)

    def subtract(self, a: Node, b: Node) -> Node:
        """a - b; of a node from itself 0."""
        return self._sum(a, b, True)

    def multiply(self, a: Node, b: Node) -> Node:
        """a b, the same node as b a."""
        if a is self.zero or b is self.zero:
            return self.zero
        if a.number is not None and b.number is not None:
            return self.constant(a.number * b.number)
        negative_a, size_a = self._sign_and_size(a)
        negative_b, size_b = self._sign_and_size(b)
        if negative_a != negative_b:
            return self.negate(self.multiply(size_a, size_b))
        if size_a is self.one:
            return size_b
        if size_b is self.one:
            return size_a
        if size_b.number is not None or (size_a.number is None and size_a.index > size_b.index):
            size_a, size_b = size_b, size_a
        if size_a.number is not None and size_b.operation == "mul" and size_b.arguments[0].number is not None:
            return self.multiply(self.constant(size_a.number * size_b.arguments[0].number), size_b.arguments[1])
        gathered = self._gathered_product(size_a, size_b) or self._gathered_product(size_b, size_a)
        if gathered is not None:
            return gathered
        return self._intern("mul", (size_a, size_b))

    def divide(self, a: Node, b: Node) -> Node:
        """a / b; raises ZeroDivisionError where b is the constant 0."""
        if b is self.zero:
            raise ZeroDivisionError("a program divides by the constant 0")
        if b.number is not None:
            return self.multiply(a, self.constant(1 / b.number))
        if a is self.zero:
            return self.zero
        negative_a, size_a = self._sign_and_size(a)
        negative_b, size_b = self._sign_and_size(b)
        if negative_a != negative_b:
            return self.negate(self.divide(size_a, size_b))
        if size_a is size_b:
            return self.one
        return self._intern("div", (size_a, size_b))

    def power(self, base: Node, exponent: Fraction) -> Node:
        """``base`` to an exact power; small integer powers become products, one half a square root."""
        if exponent == 0:
            return self.one
        if exponent < 0:
            return self.divide(self.one, self.power(base, -exponent))
        if exponent == Fraction(1, 2):
            return self.function("sqrt", base)
        if exponent.denominator == 1 and exponent <= 8:
            half = self.power(base, Fraction(int(exponent) // 2))
            square = self.multiply(half, half)
            return self.multiply(square, base) if int(exponent) % 2 else square
        return self._intern("pow", (base, self.constant(exponent)))

    def function(self, name: str, a: Node) -> Node:
        """One of ``FUNCTIONS`` of a node; sign(0) = 0."""
        if name not in FUNCTIONS:
            raise ValueError(f"unknown function {name!r}")
        if a.number is not None:
            folded = _fold(name, a.number)
            if folded is not None:
                return self.constant(folded)
        negative, size = self._sign_and_size(a)
        if negative and name in ("sin", "tanh", "sign"):
            return self.negate(self.function(name, size))
        if negative and name in ("cos", "abs"):
            return self.function(name, size)
        return self._intern(name, (a,))

    def directed(self, size: Node, a: Node) -> Node:
        """``size`` sign(a) for a parameter ``size``: chosen among it, its negative and zero, without a product."""
        negative, size = self._sign_and_size(size)
        node = self._intern("directed", (size, a))
        return self.negate(node) if negative else node

    def apply(self, operation: str, arguments: Sequence[Node]) -> Node:
        """The node of an operation by its name, on as many arguments as it takes."""
        if operation == "add":
            return self.add(*arguments)
        if operation == "sub":
            return self.subtract(*arguments)
        if operation == "mul":
            return self.multiply(*arguments)
        if operation == "div":
            return self.divide(*arguments)
        if operation == "neg":
            return self.negate(arguments[0])
        if operation == "pow":
            exponent = arguments[1].number
            assert exponent is not None
            return self.power(arguments[0], exponent)
        if operation == "directed":
            return self.directed(*arguments)
        return self.function(operation, arguments[0])

    # -- reading --------------------------------------------------------------------------------------------------

    def reachable(self, outputs: Iterable[Node], known: Iterable[Node] = ()) -> list[Node]:
        """The nodes that ``outputs`` need, arguments before their users; ``known`` nodes are not entered.

        The order is depth first with the deeper argument first, which keeps few intermediate results alive.
        """
        done = set(known)
        wanted = list(outputs)
        depth = self._depths(wanted, done) if done else None
        ordered: list[Node] = []
        for output in wanted:
            stack = [output]
            while stack:
                node = stack[-1]
                if node in done:
                    stack.pop()
                    continue
                pending = [argument for argument in node.arguments if argument not in done]
                if not pending:
                    done.add(node)
                    ordered.append(node)
                    stack.pop()
                    continue
                if len(pending) > 1:  # the last on the stack comes first
                    pending.sort(key=lambda one: (one.depth if depth is None else depth[one], one.index))
                stack += pending
        return ordered

    def _depths(self, outputs: Iterable[Node], known: set[Node]) -> dict[Node, int]:
        """The depth of each node that ``outputs`` need where ``known`` ones are at hand."""
        depth = dict.fromkeys(known, 0)
        stack = list(outputs)
        while stack:
            node = stack[-1]
            pending = [argument for argument in node.arguments if argument not in depth]
            if pending:
                stack += pending
                continue
            stack.pop()
            if node not in depth:
                depth[node] = max((depth[one] for one in node.arguments), default=0) + _LATENCY.get(node.operation, 1)
        return depth

    def moving(self, outputs: Iterable[Node]) -> list[Node]:
        """The nodes that ``outputs`` need and that are not of parameters alone, in no order."""
        stack = [node for node in dict.fromkeys(outputs) if not node.parameter_only]
        found = set(stack)
        for node in stack:
            for argument in node.arguments:
                if not argument.parameter_only and argument not in found:
                    found.add(argument)
                    stack.append(argument)
        return stack

    def count(self, nodes: Iterable[Node]) -> Count:
        """Operation count of a list of nodes; a unary minus is free."""
        return Count.of(node.operation for node in nodes)

    # -- making ---------------------------------------------------------------------------------------------------

    def _sum(self, a: Node, b: Node, subtracted: bool) -> Node:
        """a + b, or a - b if ``subtracted``."""
        if b is self.zero:
            return a
        if a is self.zero:
            return self.negate(b) if subtracted else b
        if a.number is not None and b.number is not None:
            return self.constant(a.number - b.number if subtracted else a.number + b.number)
        negative_a, size_a = self._sign_and_size(a)
        negative_b, size_b = self._sign_and_size(b)
        negative_b = negative_b != subtracted
        if size_a is size_b:
            return self.zero if negative_a != negative_b else self.multiply(self.constant(2), a)
        if size_a.index > size_b.index:
            negative_a, negative_b, size_a, size_b = negative_b, negative_a, size_b, size_a
        if negative_a and negative_b:
            return self.negate(self._intern("add", (size_a, size_b)))
        if negative_a != negative_b:
            difference = self._intern("sub", (size_a, size_b))
            return self.negate(difference) if negative_a else difference
        return self._intern("add", (size_a, size_b))

    def _gathered_product(self, a: Node, b: Node) -> Node | None:
        """a (p x) as (a p) x where a and p are parameter-only, also above a quotient."""
        if not a.parameter_only or b.parameter_only:
            return None
        if b.operation == "div":
            above = self._gathered_product(a, b.arguments[0])
            return None if above is None else self.divide(above, b.arguments[1])
        if b.operation != "mul":
            return None
        first, second = b.arguments
        if first.parameter_only:
            return self.multiply(self.multiply(a, first), second)
        return self.multiply(self.multiply(a, second), first) if second.parameter_only else None

    def _sign_and_size(self, a: Node) -> tuple[bool, Node]:
        if a.operation == "neg":
            return True, a.arguments[0]
        if a.number is not None and a.number.numerator < 0:
            return True, self.constant(-a.number)
        return False, a

    def _intern(self, operation: str, arguments: tuple[Node, ...], value: object = None) -> Node:
        key = (operation, value, arguments)
        node = self._nodes.get(key)
        if node is None:
            if operation == "input":
                parameter_only = value[0] in self._parameter_signals  # type: ignore[index]
            else:
                parameter_only = False not in [argument.parameter_only for argument in arguments]
            node = Node(self, len(self._nodes), operation, arguments, value, parameter_only)
            self._nodes[key] = node
        return node


def _fold(name: str, a: Fraction) -> Fraction | None:
    """The function's value, None where it has none that is real and finite."""
    function = getattr(sympy, {"abs": "Abs"}.get(name, name))
    try:
        return exact_constant(function(sympy.Rational(a.numerator, a.denominator)))
    except ValueError:
        return None
