"""A tool on a rigid stop: the force between them and the torques that it puts on the links; and links that are held."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from identification.arrays import Array
from identification.trajectory import Stop


class Contact:
    """The stop of a trajectory, where the tool's origin is at link positions ``q``, with the wrench it last gave.

    ``wrench`` (6) is that of the robot on its environment, in the tool frame: force [N], moment [N m] at its origin.
    """

    def __init__(self, model: Any, stop: Stop, q: Array) -> None:
        pose = model.tool_transform(q)
        self._model, self._stop = model, stop
        self._normal: Array = pose[:3, :3] @ np.array(stop.axis)
        self._place: Array = pose[:3, 3].copy()
        self.wrench: Array = np.zeros(6)

    def torques(self, q: Array, qd: Array) -> Array:
        """Torques on the links (n) [N m, N], positive with q; the stop pushes and never pulls."""
        pose = self._model.tool_transform(q)
        depth = self._normal @ (pose[:3, 3] - self._place)
        rate = self._normal @ (self._model.tool_jacobian(q)[:3] @ qd)
        force = max(0.0, self._stop.stiffness * depth + self._stop.damping * rate) if depth > 0 else 0.0
        self.wrench = np.concatenate([pose[:3, :3].T @ (force * self._normal), np.zeros(3)])
        result: Array = -self._model.wrench_torque(q, self.wrench)
        return result


class Foot:
    """What holds the ``locked`` links without a torque about the others: in an arm with a spherical wrist whose first
    three links stand, a ball joint in the wrist's centre.

    ``wrench`` (6) is that of the robot on it, in the tool frame: force [N], moment [N m] at the tool's origin.
    """

    def __init__(self, model: Any, locked: Sequence[int]) -> None:
        self._model, self._locked = model, list(locked)
        self.wrench: Array = np.zeros(6)

    def carry(self, q: Array, tau: Array) -> None:
        """Takes what drive trains put on the links (n) [N m, N] beyond the weight at link positions ``q`` (n)."""
        still, held = np.zeros(len(q)), np.zeros(len(q))
        weight = self._model.inverse_dynamics(q, still, still)
        held[self._locked] = (tau - weight)[self._locked]
        world = np.linalg.solve(self._model.tool_jacobian(q).T, held)
        turn = self._model.tool_transform(q)[:3, :3].T
        self.wrench = np.concatenate([turn @ world[:3], turn @ world[3:]])
