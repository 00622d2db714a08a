"""Every quantity by its name, from floats to the nearest doubles."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from decimal import localcontext
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from generator.reference.arithmetic import CONTEXT, Array, decimals, floats, smooth_signs
from generator.reference.drives import DriveTrain, drive_train
from generator.reference.flexible import Flexible, flexible
from generator.reference.matter import INERTIAL
from generator.reference.motion import jacobian, poses, stacked
from generator.reference.rigid import Rigid, rigid
from generator.robot.description import Robot

Results = Mapping[str, object]


@dataclass(frozen=True)
class Case:
    """One evaluation: a robot, values of its parameters and what they make of it at rest, the input signals by name,
    and the columns of a regressor.
    """

    robot: Robot
    values: Mapping[str, float]
    resting: Rigid
    signals: Mapping[str, Array]
    columns: Sequence[str]

    def __getitem__(self, signal: str) -> Array:
        return self.signals[signal]

    @property
    def state(self) -> tuple[Array, Array]:
        """q and qd (n each) [SI]; of the elastic robot [q_m; q_e] and its speeds."""
        return self["q"], self["qd"]

    @property
    def motion(self) -> tuple[Array, Array, Array]:
        """q, qd and qdd (n each) [SI]; of the elastic robot [q_m; q_e], its speeds and accelerations."""
        return self["q"], self["qd"], self["qdd"]

    @cached_property
    def rigid(self) -> Rigid:
        """The rigid robot in the effects' ``states`` and ``warmth`` among the signals, without them as at rest."""
        states, warmth = self.signals.get("states", ()), self.signals.get("warmth", self.resting.warmth)
        return replace(self.resting, states=tuple(states), warmth=warmth)

    @property
    def loaded(self) -> Rigid:
        """The rigid robot with ``payload`` in its tool frame, whose tool exerts ``wrench``."""
        return self.rigid.loaded(self["payload"]).holding(_held(self))

    @property
    def flexible(self) -> Flexible:
        """The robot with its elastic joints, whose links are ``rigid``."""
        return flexible(self.robot, self.rigid)

    @property
    def drives(self) -> DriveTrain:
        """The maps between motors and joints, torque constants at this warmth; raises ValueError without drives."""
        return drive_train(self.robot, self.values, self.rigid.warmth)


@dataclass(frozen=True)
class Reference:
    """Every quantity of ``robot`` with ``values`` [SI] of standard parameters (and Iam1, k1, kt1 ...), zero where
    absent, and of lengths, nominal where absent.
    """

    robot: Robot
    values: Mapping[str, float]

    def __call__(
        self, name: str, inputs: Mapping[str, ArrayLike], columns: Sequence[str] = ()
    ) -> dict[str, NDArray[np.float64]]:
        """The quantity ``name`` at one state, as {output: array}, each entry the nearest double.

        ``inputs`` are the quantity's input signals, one sample each, in SI units. ``columns`` names the standard
        parameters of a regressor, in order: for base parameters those that stay, for the elastic robot motor-side ones
        as well. Raises KeyError for a quantity that is not in ``NAMES`` and for an input that is missing.
        """
        with localcontext(CONTEXT):
            signals = {signal: decimals(value) for signal, value in inputs.items()}
            results = _QUANTITIES[name](Case(self.robot, self.values, self._resting, signals, columns))
            return {output: floats(value) for output, value in results.items()}

    @cached_property
    def _resting(self) -> Rigid:
        return rigid(self.robot, self.values)


def _transforms(case: Case) -> Results:
    chain = case.rigid.chain
    return {"T": stacked(chain, poses(chain, case["q"]))}


def _jacobians(case: Case) -> Results:
    chain = case.rigid.chain
    placed = poses(chain, case["q"])
    return {"J": stacked(chain, {link.number: jacobian(chain, placed, link.number) for link in chain.links})}


def _tool_transform(case: Case) -> Results:
    chain = case.rigid.chain
    return {"T": poses(chain, case["q"])[chain.tool]}


def _tool_jacobian(case: Case) -> Results:
    chain = case.rigid.chain
    return {"J": jacobian(chain, poses(chain, case["q"]), chain.tool)}


def _inverse_dynamics(case: Case) -> Results:
    return {"tau": case.rigid.inverse_dynamics(*case.motion)}


def _dynamics(case: Case) -> Results:
    q = case["q"]
    return {
        "tau": case.rigid.inverse_dynamics(*case.motion),
        "M": case.rigid.inertia_matrix(q),
        "Q": case.rigid.gravity(q),
    }


def _inverse_dynamics_loaded(case: Case) -> Results:
    return {"tau": case.loaded.inverse_dynamics(*case.motion)}


def _direct_dynamics_loaded(case: Case) -> Results:
    return {"qdd": case.loaded.direct_dynamics(*case.state, case["tau"])}


def _held(case: Case) -> Array:
    return case.rigid.wrench_torque(case["q"], case["wrench"])


def _regressor(case: Case) -> Results:
    return {"W": case.rigid.regressor(case.columns, *case.motion)}


def _payload_regressor(case: Case) -> Results:
    robot = case.rigid
    columns = robot.body_columns(robot.chain.tool, *case.motion)
    return {"W": np.stack([columns[stem] for stem in INERTIAL], axis=1)}


def _balancer(case: Case) -> Results:
    found = case.rigid.balancers(case["q"])
    results: dict[str, object] = {}
    for number, numbers in found.items():
        suffix = f"_{number}" if len(found) > 1 else ""
        for name, value in zip(("length", "force", "torque"), numbers, strict=True):
            results[f"{name}{suffix}"] = value
    return results


def _flexible_inverse_dynamics(case: Case) -> Results:
    tau_mdi, tau_e = case.flexible.inverse_dynamics(*case.motion)
    return {"tau_mdi": tau_mdi, "tau_e": tau_e}


def _direct_dynamics_sliding(case: Case) -> Results:
    return {"qdd": case.rigid.sliding(case["direction"]).direct_dynamics(*case.state, case["tau"])}


def _direct_dynamics_smooth(case: Case) -> Results:
    direction = smooth_signs(case["qd"], case["width"])
    return {"qdd": case.rigid.sliding(direction).direct_dynamics(*case.state, case["tau"])}


def _flexible_direct_dynamics_sliding(case: Case) -> Results:
    robot = case.flexible.sliding(case["direction"])
    return {"qdd": robot.direct_dynamics(*case.state, case["tau"], case["tau_ext"])}


def _flexible_direct_dynamics_smooth(case: Case) -> Results:
    direction = smooth_signs(case.flexible.surface_speeds(case["qd"]), case["width"])
    return {"qdd": case.flexible.sliding(direction).direct_dynamics(*case.state, case["tau"], case["tau_ext"])}


_QUANTITIES: Mapping[str, Callable[[Case], Results]] = {
    "transforms": _transforms,
    "jacobians": _jacobians,
    "tool_transform": _tool_transform,
    "tool_jacobian": _tool_jacobian,
    "inverse_dynamics": _inverse_dynamics,
    "inverse_dynamics_standard": _inverse_dynamics,
    "dynamics": _dynamics,
    "inverse_dynamics_loaded": _inverse_dynamics_loaded,
    "regressor": _regressor,
    "regressor_standard": _regressor,
    "payload_regressor": _payload_regressor,
    "wrench_torque": lambda case: {"tau": _held(case)},
    "inertia_matrix": lambda case: {"M": case.rigid.inertia_matrix(case["q"])},
    "bias": lambda case: {"H": case.rigid.bias(*case.state)},
    "effect_rates": lambda case: {"rates": case.rigid.effect_rates(*case.state)},
    "gravity": lambda case: {"Q": case.rigid.gravity(case["q"])},
    "direct_dynamics": lambda case: {"qdd": case.rigid.direct_dynamics(*case.state, case["tau"])},
    "direct_dynamics_loaded": _direct_dynamics_loaded,
    "direct_dynamics_sliding": _direct_dynamics_sliding,
    "direct_dynamics_smooth": _direct_dynamics_smooth,
    "kinetic_energy": lambda case: {"T": case.rigid.kinetic_energy(*case.state)},
    "potential_energy": lambda case: {"U": case.rigid.potential_energy(case["q"])},
    "balancer": _balancer,
    "motor_position": lambda case: {"qr": case.drives.to_motor(case["q"])},
    "joint_position": lambda case: {"q": case.drives.to_joint(case["qr"])},
    "motor_speed": lambda case: {"qrd": case.drives.to_motor(case["qd"])},
    "joint_speed": lambda case: {"qd": case.drives.to_joint(case["qrd"])},
    "motor_torque": lambda case: {"tau_r": case.drives.motor_torque(case["tau"])},
    "joint_torque": lambda case: {"tau": case.drives.joint_torque(case["tau_r"])},
    "motor_current": lambda case: {"current": case.drives.current(case["tau"])},
    "joint_torque_from_current": lambda case: {"tau": case.drives.torque_from_current(case["current"])},
    "flexible_inverse_dynamics": _flexible_inverse_dynamics,
    "flexible_direct_dynamics": lambda case: {"qdd": case.flexible.direct_dynamics(*case.state, case["tau"])},
    "flexible_direct_dynamics_sliding": _flexible_direct_dynamics_sliding,
    "flexible_direct_dynamics_smooth": _flexible_direct_dynamics_smooth,
    "flexible_regressor": lambda case: {"W": case.flexible.regressor(case.columns, *case.motion)},
}

#: The quantities that a ``Reference`` knows.
NAMES = tuple(_QUANTITIES)
