"""A tool on a rigid stop: the force between them and the torques that it puts on the links."""

from __future__ import annotations

from typing import Any

import numpy as np

from identification.trajectory import Array, Stop


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
