"""The chain of report Table 5, springs on its even joints, moves as the reduced elastic model does (report eq. 10)."""

from __future__ import annotations

import numpy as np
import pytest

from generator.derivation import derive
from generator.reference.sample import physical_parameters
from generator.resources import find_robot
from generator.robot.description import ParameterValue
from generator.robot.parameters import INERTIAL_STEMS
from generator.robot.readers import read
from generator.symbolic.function import PARAMETERS
from generator.symbolic.interpret import evaluate
from generator.symbolic.parameter_sets import parameter_vector


def _values(given: dict[str, float]) -> dict[str, ParameterValue]:
    return {name: ParameterValue(value, "") for name, value in given.items()}


@pytest.mark.parametrize("name", ["kr500", pytest.param("kr270", marks=pytest.mark.long)])
@pytest.mark.parametrize("seed", [0, pytest.param(1, marks=pytest.mark.long)])
def test_chain_and_reduced_model_accelerate_alike(name: str, seed: int) -> None:
    robot, twelve = read(find_robot(name)), read(find_robot(f"{name}_table5"))
    reduced = derive(robot, ["flexible_direct_dynamics"], check=False)
    chain = derive(twelve, ["direct_dynamics"], check=False)
    sample = physical_parameters(robot, seed)
    joints = range(1, 7)
    # Table 5 has no friction and no balancer; its motors carry no matter, its links no rotors.
    matter = {f"{stem}{j}": sample[f"{stem}{j}"] for j in joints for stem in INERTIAL_STEMS}
    drives = {f"{stem}{j}": sample[f"{stem}{j}"] for j in joints for stem in ("Iam", "k")}
    on_chain = {f"{stem}{2 * j}": sample[f"{stem}{j}"] for j in joints for stem in INERTIAL_STEMS}
    on_chain |= {f"ks{2 * j}": sample[f"k{j}"] for j in joints}
    on_chain |= {f"Ia{2 * j - 1}": sample[f"Iam{j}"] for j in joints}

    random = np.random.default_rng(seed)
    q, qd, tau = random.uniform(-1.0, 1.0, 12), random.uniform(-1.0, 1.0, 12), random.uniform(-1.0, 1.0, 6)
    motors, springs = list(range(0, 12, 2)), list(range(1, 12, 2))
    state = {signal: np.zeros(12) for signal in ("q", "qd", "tau")}
    state["q"][motors + springs], state["qd"][motors + springs], state["tau"][motors] = q, qd, tau

    expected = evaluate(
        reduced.functions["flexible_direct_dynamics"],
        {"q": q, "qd": qd, "tau": tau, PARAMETERS: parameter_vector(reduced, _values(matter | drives))},
    )["qdd"]
    actual = evaluate(
        chain.functions["direct_dynamics"], {**state, PARAMETERS: parameter_vector(chain, _values(on_chain))}
    )["qdd"][motors + springs]
    np.testing.assert_allclose(actual, expected, rtol=0, atol=1e-8 * np.abs(expected).max())
