"""The closed loop, sample by sample: encoders, controller, robot, and what the surroundings do."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from generator.command_line import command_line
from generator.errors import InputError
from generator.robot.description import Robot
from identification.arrays import Array
from identification.drive_train import coupling
from identification.simulation import cascade
from identification.simulation.checks import each
from identification.simulation.contact import Contact, Foot
from identification.simulation.machine import Machine
from identification.simulation.settings import Settings
from identification.trajectory import Reference

#: Rest [s] before the log begins, in which controller and springs take up the weight.
_REST = 1.0
#: Time [s] after which drifting parameters are new, and finite numbers and progress are looked at.
_NEWS = 0.1
#: Dry friction [N m, N] that holds a locked link.
_LOCK = 1e8
#: Stems of the parameters that drift with the temperature.
_FRICTIONS = ("Fv", "Fc", "Fvm", "Fcm")

#: Told the part that is done, from 0 to 1.
Progress = Callable[[float], None]


@dataclass(frozen=True)
class Log:
    """What was so at the instants of the controller's samples (N rows each), on the joint side [rad, m; N m, N].

    ``q`` are the motors as measured, ``tau`` the mean of the torques before and after the instant, ``links`` the links
    themselves, ``wrench`` (N x 6) that of the robot on its environment, None without a stop.
    """

    q: Array
    tau: Array
    links: Array
    wrench: Array | None


class Loop:
    """The robot with its controller, at rest at the start of a reference."""

    def __init__(self, machine: Machine, model: Any, settings: Settings, reference: Reference) -> None:
        robot, module = machine.robot, machine.module
        self._machine, self._model, self._settings, self._reference = machine, model, settings, reference
        self._n = len(robot.moving)
        self._elastic = list(machine.model.elastic) if settings.flexible else []
        start = reference.q[0]
        links, motors = cascade.inertias(module, model, robot, start, settings.flexible)
        limit = each(settings.largest, self._n, "--largest") * torque_constants(machine, model)
        load, held = cascade.weight(module, model, robot, start, settings.flexible)
        self._controller = cascade.controller(
            module, model, robot, links + motors, held, settings.bandwidth, settings.period, limit
        )
        self._steps = cascade.steps(module, model, robot, links, motors, settings.period)
        numbers = [robot.moving[k].number for k in self._elastic]
        self._stiffness = np.array([cascade.value_of(module, model, f"k{number}") for number in numbers])
        self._plant = self._placed(np.concatenate([start, -load[self._elastic] / self._stiffness]))
        self._encoders = Encoders(robot, settings, start)

    def run(self, progress: Progress) -> Log:
        """The log of the whole reference, after a rest at its start.

        Raises InputError where the motion does not stay finite.
        """
        settings, reference = self._settings, self._reference
        still = np.zeros(self._n)
        for _ in range(max(1, round(_REST * settings.rate))):
            tau = self._sample(reference.q[0], still, None)
        if reference.locked:
            moving = self._machine.robot.moving
            self._model.update({f"Fc{moving[k].number}": _LOCK for k in reference.locked})
            self._plant = self._placed(self._plant.q.copy())
        contact = None if reference.stop is None else Contact(self._model, reference.stop, self._links())
        foot = Foot(self._model, reference.locked) if reference.measured else None
        rows = len(reference.q)
        q, torques, links = (np.empty((rows, self._n)) for _ in range(3))
        wrench = None if contact is None and foot is None else np.empty((rows, 6))
        news = max(1, round(_NEWS * settings.rate))
        frictions = self._frictions()
        for k in range(rows):
            if k % news == 0:
                self._check(k)
                progress(k / rows)
                part = 1 + settings.friction_drift * float(settings.warmth(np.array(k * settings.period)))
                if settings.friction_drift:
                    self._model.update({name: part * value for name, value in frictions.items()})
            links[k], twisted = self._links(), self._twisted()
            before = tau
            tau = self._sample(reference.q[k], reference.qd[k], contact)
            q[k], torques[k] = self._encoders.q, (before + tau) / 2
            if wrench is not None and contact is not None:
                wrench[k] = contact.wrench
            if wrench is not None and foot is not None:
                foot.carry(links[k], twisted)
                wrench[k] = foot.wrench
        self._check(rows)
        return Log(q, torques, links, wrench)

    def _placed(self, q: Array) -> Any:
        """The robot at rest."""
        kind = "flexible" if self._settings.flexible else "rigid"
        return self._machine.module.Plant(self._model, kind, q, steps=self._steps)

    def _sample(self, q_ref: Array, qd_ref: Array, contact: Contact | None) -> Array:
        """One sample; returns the torques that act until the next."""
        plant, n = self._plant, self._n
        q, qd = self._encoders.measured(plant.q[:n], plant.qd[:n])
        tau: Array = self._controller.control(q_ref, qd_ref, None, q, qd)
        load = None if contact is None else contact.torques(self._links(), self._links(speeds=True))
        plant.advance(self._settings.period, tau, load)
        return tau

    def _links(self, speeds: bool = False) -> Array:
        """Positions or speeds of the links (n)."""
        state = self._plant.qd if speeds else self._plant.q
        result: Array = state[: self._n].copy()
        result[self._elastic] += state[self._n :]
        return result

    def _twisted(self) -> Array:
        """Torques of the elastic drive trains on their links (n) [N m, N], zero where they are rigid."""
        result = np.zeros(self._n)
        result[self._elastic] = -self._stiffness * self._plant.q[self._n :]
        return result

    def _frictions(self) -> dict[str, float]:
        stems = (f"{stem}{joint.number}" for stem in _FRICTIONS for joint in self._machine.robot.moving)
        names = (name for stem in stems for name in (stem, f"{stem}R"))
        values = {name: cascade.value_of(self._machine.module, self._model, name) for name in names}
        return {name: value for name, value in values.items() if value and value < _LOCK}

    def _check(self, sample: int) -> None:
        if not (np.isfinite(self._plant.q).all() and np.isfinite(self._plant.qd).all()):
            raise InputError(
                command_line("counterpoise simulate"),
                f"the motion is not finite any more after {sample * self._settings.period:g} s",
                "a physically consistent parameter set, a lower --bandwidth or a higher --rate",
            )


class Encoders:
    """The motors' encoders: steps of a resolution, a delay; ``q`` (n) is what they last told, in joint units.

    Speeds are differences of positions over one sample where any motor has a resolution, else the motors' own.
    """

    def __init__(self, robot: Robot, settings: Settings, start: Array) -> None:
        n = len(start)
        self._resolution = each(settings.resolution, n, "--resolution")
        self._to_motor = coupling(robot)
        self._to_joint = np.linalg.inv(self._to_motor)
        self._rate = settings.rate
        self._ideal = not self._resolution.any()
        first = (self._stepped(start), np.zeros(n))
        self._pending = deque([first] * settings.late(settings.delay))
        self._newest = first[0]
        self.q: Array = first[0]

    def measured(self, q: Array, qd: Array) -> tuple[Array, Array]:
        """Positions and speeds of the motors (n each) [rad, m, s], in joint units, as the controller learns them."""
        stepped = self._stepped(q)
        speed = qd.copy() if self._ideal else (stepped - self._newest) * self._rate
        self._newest = stepped
        self._pending.append((stepped, speed))
        self.q, speed = self._pending.popleft()
        return self.q, speed

    def _stepped(self, q: Array) -> Array:
        if self._ideal:
            return q.copy()
        motor = self._to_motor @ q
        steps = np.where(self._resolution > 0, self._resolution, 1.0)
        motor = np.where(self._resolution > 0, steps * np.round(motor / steps), motor)
        result: Array = self._to_joint @ motor
        return result


def torque_constants(machine: Machine, model: Any) -> Array:
    """Torque of each rotor per unit of its logged effort (n): kt [N m/A], or 1 where there are none."""
    numbers = machine.robot.numbers
    if not machine.model.torque_constants:
        return np.ones(len(numbers))
    return np.array([cascade.value_of(machine.module, model, f"kt{number}") for number in numbers])
