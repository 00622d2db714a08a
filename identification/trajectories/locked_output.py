"""Locked output (report section 4.1): the links are held while the motors wind the drive trains up and down."""

from __future__ import annotations

import numpy as np

from identification.trajectory import Reference, Setting, Task, Trajectory, Unplanned


def _plan(task: Task) -> Reference:
    """Sines of all elastic motors, grown from nothing over the first period."""
    held = [f"Fc{joint.number}" for joint in task.robot.moving]
    lacking = [name for name in held if name not in task.values]
    if lacking:
        raise Unplanned(f"links are held by dry friction, and there is no {lacking[0]}", "coulomb_friction")
    w = 2 * np.pi * task.number("frequency")
    t = task.times
    s = np.clip(t * task.number("frequency"), 0.0, 1.0)
    grown, growth = s**2 * (3 - 2 * s), 6 * s * (1 - s) * task.number("frequency")
    elastic = np.array([float(joint.number in task.robot.flexible) for joint in task.robot.moving])
    angle = task.number("angle") * elastic
    q = task.pose + np.outer(grown * np.sin(w * t), angle)
    qd = np.outer(growth * np.sin(w * t) + grown * w * np.cos(w * t), angle)
    return Reference(q, qd, locked=tuple(range(len(task.pose))))


TRAJECTORY = Trajectory(
    name="locked_output",
    title="links held at the pose, motors winding up the drive trains",
    settings={
        "angle": Setting(3e-3, "of the motors, in joint units [rad, m]"),
        "frequency": Setting(0.1, "of winding up and down [Hz]"),
    },
    plan=_plan,
    flexible=True,
)
