"""The order in which a program's statements are printed."""

from __future__ import annotations

from generator.symbolic.statements import Program


def test_what_waits_longest_comes_first_whenever_it_was_made() -> None:
    """A chain of quotients that was made early stands before a product that was made late, and is needed beside it."""
    program = Program()
    a, b, c = (program.input("q", index) for index in range(3))
    deep = a
    for _ in range(3):
        deep = program.one / (deep + b)
    shallow = (b * c) * (b + c)
    ordered = program.reachable([deep * shallow])
    assert ordered.index(deep) < ordered.index(shallow)
    assert deep.index < shallow.index
    place = {node: k for k, node in enumerate(ordered)}
    assert all(place[argument] < place[node] for node in ordered for argument in node.arguments)
    assert program.count(ordered).total == 3 * 2 + 3 + 1


def test_of_equally_deep_ones_the_one_made_last_comes_first() -> None:
    program = Program()
    a, b = program.input("q", 0), program.input("q", 1)
    first, last = a * a, b * b
    ordered = program.reachable([first + last])
    assert ordered.index(last) < ordered.index(first)
