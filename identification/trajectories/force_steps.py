"""Force steps against a rigid stop (report section 4.2): the tool presses along an axis of its own, step by step."""

from __future__ import annotations

import numpy as np

from identification.trajectory import Array, Reference, Setting, Stop, Task, Trajectory

_AXES = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}
_AXES |= {f"-{name}": (-x, -y, -z) for name, (x, y, z) in tuple(_AXES.items())}
#: Points along the way for which the joints are computed, and what is good enough there [m, rad].
_POINTS, _NEAR, _ROUNDS = 41, 1e-11, 50
#: Damping of the stop, in parts of the critical one of a mass [kg] that is typical of a robot.
_DAMPING, _MASS = 1.0, 300.0
#: Part of a step in which the force changes.
_CHANGING = 0.3


def _plan(task: Task) -> Reference:
    """The references move into the stop by what stop and drive trains yield; the tool keeps its orientation."""
    n = len(task.pose)
    if n != 6:
        raise ValueError(f"force_steps keeps the tool's orientation, which {n} joints cannot, expected 6")
    axis = np.array(_AXES[str(task.settings["axis"])])
    stiffness = task.number("stiffness")
    pose = task.model.tool_transform(task.pose)
    direction = pose[:3, :3] @ axis
    # Torques J^T f of a force wind up the drive trains: the tool yields by f^T J K^-1 J^T f.
    wound = direction @ task.model.tool_jacobian(task.pose)[:3]
    compliance = 1 / stiffness + float(wound**2 @ task.compliances)
    depth = task.number("force") * compliance
    ways = np.linspace(0.0, depth, _POINTS)
    joints = _joints(task, pose, direction, ways)
    part, rate = _staircase(task)
    q, slope = _along(ways, joints, depth * part)
    damping = 2 * _DAMPING * np.sqrt(stiffness * _MASS)
    x, y, z = axis.tolist()
    return Reference(q, slope * (depth * rate)[:, None], stop=Stop((x, y, z), stiffness, damping))


def _along(ways: Array, joints: Array, way: Array) -> tuple[Array, Array]:
    """Joints and their slopes over the way: polynomials through the computed points."""
    centre, half = ways.mean(), np.ptp(ways) / 2
    polynomials = np.polynomial.chebyshev.chebfit((ways - centre) / half, joints, 5)
    x = (way - centre) / half
    slopes = np.polynomial.chebyshev.chebder(polynomials)
    q: Array = np.polynomial.chebyshev.chebval(x, polynomials).T
    slope: Array = np.polynomial.chebyshev.chebval(x, slopes).T / half
    return q, slope


def _joints(task: Task, pose: Array, direction: Array, ways: Array) -> Array:
    """Joint positions that put the tool that far along the direction, turned as in ``pose`` (Newton's method)."""
    q, result = task.pose.copy(), []
    for way in ways:
        for _ in range(_ROUNDS):
            now = task.model.tool_transform(q)
            turn = pose[:3, :3] @ now[:3, :3].T
            rotation = np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]) / 2
            error = np.concatenate([pose[:3, 3] + way * direction - now[:3, 3], rotation])
            if np.abs(error).max() < _NEAR:
                break
            jacobian = task.model.tool_jacobian(q)
            if np.linalg.cond(jacobian) > 1e6:
                raise ValueError("the pose is singular, expected --pose with a bent arm and wrist")
            q = q + np.linalg.solve(jacobian, error)
        else:
            raise ValueError("the tool cannot be moved along the axis from this pose, expected another --pose")
        result.append(q)
    return np.array(result)


def _staircase(task: Task) -> tuple[Array, Array]:
    """Part of the largest force and its rate [1/s]: up in steps, down again, over the whole run."""
    count = round(task.number("steps"))
    levels = np.concatenate([np.arange(count + 1), np.arange(count - 1, -1, -1)]) / count
    hold = task.samples * task.period / len(levels)
    index = np.minimum((task.times / hold).astype(int), len(levels) - 1)
    before = levels[np.maximum(index - 1, 0)]
    s = np.clip((task.times / hold - index) / _CHANGING, 0.0, 1.0)
    rise = levels[index] - before
    rate = rise * 6 * s * (1 - s) / (_CHANGING * hold)
    return before + rise * s**2 * (3 - 2 * s), rate


TRAJECTORY = Trajectory(
    name="force_steps",
    title="the tool presses on a stop in steps, from the pose on",
    settings={
        "axis": Setting("z", "of the tool along which it presses", choices=tuple(_AXES)),
        "force": Setting(2000.0, "largest force [N]"),
        "steps": Setting(8.0, "number of steps up, and down again", below=1000, whole=True),
        "stiffness": Setting(1e7, "of the stop [N/m]"),
    },
    plan=_plan,
)
