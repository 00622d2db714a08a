"""Cases that a generated self-test checks: random physical parameters and states, with outputs that the independent
numerical implementation computed.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from generator.reference import sample
from generator.reference.flexible import MOTOR_SIDE
from generator.reference.joint_effects import LAWS
from generator.reference.quantities import NAMES, Reference
from generator.reference.sample import payload, physical_parameters, signal
from generator.robot.description import ParameterValue, Robot
from generator.symbolic.effect_torques import STATES
from generator.symbolic.function import Function, Signal
from generator.symbolic.model import STANDARD, Model
from generator.symbolic.parameter_sets import parameter_vector

#: States per function.
_STATES = 3
#: Relative to an output's largest entry; a direct model loses what its inertia matrix's condition costs.
_TOLERANCE, _SOLVED_TOLERANCE = 1e-11, 1e-8
_PACKED = "_packed"
_NOTHING = 1e-25


@dataclass(frozen=True)
class Case:
    """One function at one state: flat row-major inputs and outputs by signal name, in SI units.

    ``tolerance`` is relative to the largest entry of each output, in double precision.
    """

    function: str
    parameters: tuple[float, ...]
    inputs: Mapping[str, tuple[float, ...]]
    outputs: Mapping[str, tuple[float, ...]]
    tolerance: float


def cases(model: Model) -> tuple[Case, ...]:
    """Cases for every function that the independent implementation knows.

    An effect without a law there has zero parameters in every case, and a robot with one no cases for the regressors
    of its parameters, nor for the rates of its states if that effect has some.
    """
    known = replace(model.robot, effects=tuple(use for use in model.robot.effects if use.effect in LAWS))
    states = _known_states(model, known)
    skipped = _skipped(model, known, states)
    values = {parameter.name: 0.0 for parameter in model.standard_parameters}
    values |= _constants(model) if model.constants else _physical(model, known)
    given = {name: ParameterValue(value, "") for name, value in values.items()}
    parameters = tuple(float(value) for value in parameter_vector(model, given))
    standard = tuple(values[parameter.name] for parameter in model.standard_parameters)
    reference = Reference(known, values)
    positions = [_positions(model, state) for state in range(_STATES)]
    result = []
    for function in model.functions.values():
        name = function.name.removesuffix(_PACKED)
        if name not in NAMES or name in skipped:
            continue
        for state in range(_STATES):
            inputs = {s.name: _input(s, state, positions[state], standard) for s in function.inputs}
            tolerance = _SOLVED_TOLERANCE if function.solves else _TOLERANCE
            outputs = _outputs(model, reference, function, inputs | _of_known(inputs, states))
            result.append(Case(function.name, parameters, inputs, outputs, tolerance))
    return tuple(result)


def _known_states(model: Model, known: Robot) -> list[int]:
    """Places, in the signal ``states``, of the states of effects with a law."""
    names = {f"{stem}{j}" for use in known.effects for stem in LAWS[use.effect].states for j in use.joints}
    return [place for place, state in enumerate(model.effect_states) if state.name in names]


def _skipped(model: Model, known: Robot, states: Sequence[int]) -> list[str]:
    """Functions whose outputs would lack those of an effect without a law; packed ones go by the dense ones."""
    regressors = []
    if len(known.effects) < len(model.robot.effects):
        regressors = ["regressor", "regressor_standard", "flexible_regressor"]
    sides = {f"{stem}{j}" for stem in MOTOR_SIDE for j in model.robot.flexible}
    if any(parameter.name not in sides for parameter in model.motor_parameters):
        regressors.append("flexible_regressor")
    return regressors + (["effect_rates"] if len(states) < len(model.effect_states) else [])


def _of_known(inputs: Mapping[str, Sequence[float]], states: Sequence[int]) -> dict[str, tuple[float, ...]]:
    """The signal ``states``, where there is one, without the states of effects without a law."""
    return {STATES: tuple(inputs[STATES][place] for place in states)} if STATES in inputs else {}


def _physical(model: Model, known: Robot) -> dict[str, float]:
    absent = _acting_as_weight(model)
    return {name: 0.0 if name in absent else value for name, value in physical_parameters(known, 1).items()}


def _constants(model: Model) -> dict[str, float]:
    """The built-in values, those of grouped parameters on the parameters that name them."""
    heads = {base.name: base.head for base in model.grouping.base}
    return {heads.get(name, name): float(value) for name, value in model.constants.items()}


def _acting_as_weight(model: Model) -> set[str]:
    """Effects that are grouped with the bodies' weight, where no torque tells them apart: gravity would hold them too.

    A balancer may act like a first moment; the rotor of a vertical slide acts like mass and an offset together.
    """
    of_effects = {name for one in model.effects for name in one.names}
    grouped = {one.name: one.into for one in model.grouping.eliminated if one.name in of_effects}
    rotors = {name for one in model.effects if one.effect.kinetic_energy for name in one.names}
    return {name for name, into in grouped.items() if name not in rotors or any(t.startswith("Off") for t in into)}


def _positions(model: Model, state: int) -> tuple[float, ...]:
    """Of the joints, within the limits, and the elongations of the elastic ones."""
    return (*sample.positions(model.robot, state), *signal(len(model.elastic), state, 0.01))


def _input(wanted: Signal, state: int, positions: tuple[float, ...], standard: tuple[float, ...]) -> tuple[float, ...]:
    """A signal of one state: some of its positions, a physical payload, else numbers of mixed signs."""
    if wanted.name == STANDARD:
        return standard
    if wanted.name == "q":
        return positions[: wanted.size]
    if wanted.name == "payload":
        return tuple(payload(state))
    if wanted.name == "width":
        return tuple(map(abs, signal(wanted.size, state + 5)))
    # Each signal draws its own numbers: qd and qdd must not be equal.
    return tuple(signal(wanted.size, state + 10 * len(wanted.name), 2.0))


def _outputs(
    model: Model, reference: Reference, function: Function, inputs: Mapping[str, Sequence[float]]
) -> dict[str, tuple[float, ...]]:
    heads = [base.head for base in model.grouping.base]
    columns = [parameter.name for parameter in model.standard_parameters]
    if "standard" not in function.name:
        columns = heads + [parameter.name for parameter in model.motor_parameters] * ("flexible" in function.name)
    computed = reference(function.name.removesuffix(_PACKED), inputs, columns)
    if function.sparsity is not None:
        places = (list(function.sparsity.rows), list(function.sparsity.columns))
        computed = {name: matrix[places] for name, matrix in computed.items()}
    return {name: tuple(_settled(float(entry)) for entry in np.ravel(value)) for name, value in computed.items()}


def _settled(entry: float) -> float:
    """What the exact arithmetic of the reference leaves of a zero is zero."""
    return entry if abs(entry) > _NOTHING else 0.0
