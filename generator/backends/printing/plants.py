"""The robots that are simulated: what they are called and which functions they stand on."""

from __future__ import annotations

from dataclasses import dataclass

from generator.symbolic.model import Model

#: What the direct models read that are simulated.
_SIGNALS = {"q", "qd", "tau", "tau_ext", "direction", "width"}
#: The maps between joints and rotors of a robot that has drives.
_MAPS = ("motor_position", "motor_speed", "motor_torque", "joint_torque")


@dataclass(frozen=True)
class Plant:
    """What is simulated: its ``name``, its coordinates' number ``size`` and meaning, the functions that it calls.

    ``links`` are the coordinates whose links slide as well, in the order of their elongations. ``load`` tells whether
    torques of the surroundings are an input of its own.
    """

    name: str
    size: int
    coordinates: str
    surfaces: str
    sliding: str
    smooth: str
    links: tuple[int, ...]
    load: bool


def turns_rotors(model: Model) -> bool:
    """Whether the controller moves rotors, in rad and N m on every joint; without drives it moves the joints."""
    return all(name in model.functions for name in _MAPS)


def plants(model: Model) -> list[Plant]:
    """The rigid robot and, where joints are elastic, the flexible one, as far as their models read known signals."""
    found = [
        Plant(
            "rigid",
            model.dof,
            "joint positions",
            "the joints",
            "direct_dynamics_sliding",
            "direct_dynamics_smooth",
            (),
            False,
        )
    ]
    if model.elastic:
        found.append(
            Plant(
                "flexible",
                model.flexible_dof,
                "[q_m; q_e]: motors in joint units, then elongations",
                "the motors, then the links of the elastic joints",
                "flexible_direct_dynamics_sliding",
                "flexible_direct_dynamics_smooth",
                model.elastic,
                True,
            )
        )
    return [plant for plant in found if _known(model, plant)]


def _known(model: Model, plant: Plant) -> bool:
    functions = [model.functions.get(name) for name in (plant.sliding, plant.smooth)]
    return all(one is not None and all(signal.name in _SIGNALS for signal in one.inputs) for one in functions)
