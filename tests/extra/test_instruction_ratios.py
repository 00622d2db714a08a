"""The generated C against the C that CasADi generates from a recursion by hand, in instructions: exact on any machine.

``make bench`` times both; times prove nothing on a machine that others use too.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import pytest

from benchmarks.peers import casadi_recursion, ours
from benchmarks.peers.library import Library
from benchmarks.peers.measuring import disagreement, instructions, measure
from benchmarks.peers.subject import FUNCTIONS, Chain
from tests.extra.tools import tool

#: A processor with fused multiply-add that valgrind knows.
FLAGS = ("-O2", "-ffp-contract=fast", "-march=haswell")

#: CasADi's instructions over ours, at least. With the C library's sine both pay the same for it, which is most of both.
AT_LEAST = {
    ours.NAME: {
        "inverse_dynamics": 1.8,
        "inertia_matrix": 2.5,
        "direct_dynamics": 1.8,
        "regressor": 1.35,
        "gravity": 3.5,
    },
    ours.WITH_LIBM: {
        "inverse_dynamics": 1.2,
        "inertia_matrix": 1.2,
        "direct_dynamics": 1.25,
        "regressor": 0.9,
        "gravity": 1.1,
    },
}


@pytest.fixture(scope="module", params=["kr500", pytest.param("kr270", marks=pytest.mark.long)])
def compared(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> tuple[Chain, Path]:
    """A robot, and the folder that its libraries are in."""
    return Chain(request.param), tmp_path_factory.mktemp("ratios") / request.param


def libraries(subject: Chain, folder: Path) -> Sequence[Library]:
    """Ours, then CasADi's, as gcc makes them."""
    own = ours.libraries(subject.model, subject.parameters(subject.model), folder / "ours", FLAGS)
    return [one for one in (*own, *casadi_recursion.build(subject, folder, FLAGS)) if one.built == "gcc"]


def test_instructions_of_casadi_over_ours(compared: tuple[Chain, Path]) -> None:
    tool("valgrind")
    subject, folder = compared
    *own, other = libraries(subject, folder)
    timed = {(one.library.peer, one.function): one for one in measure(subject, [*own, other], folder, rounds=0)}
    short = {}
    for function in FUNCTIONS:
        theirs = instructions(subject, other, function, folder)
        for library in own:
            same = timed[library.peer, function], timed[other.peer, function]
            assert disagreement(subject, *same) < 1e-9
            ratio = theirs / instructions(subject, library, function, folder)
            if ratio < AT_LEAST[library.peer][function]:
                short[library.peer, function] = round(ratio, 2)
    assert short == {}
