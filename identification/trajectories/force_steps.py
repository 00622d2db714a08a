"""Force steps against a rigid stop (report section 4.2): the tool presses along an axis of its own, step by step."""

from __future__ import annotations

import numpy as np

from identification.arrays import Array
from identification.trajectory import Reference, Setting, Stop, Task, Trajectory, Unplanned

_AXES = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}
_AXES |= {f"-{name}": (-x, -y, -z) for name, (x, y, z) in tuple(_AXES.items())}
#: Points along the way for which the joints are computed, and what is good enough there [m, rad].
_POINTS, _NEAR, _ROUNDS = 41, 1e-11, 50
#: Condition number of a Jacobian from which a pose counts as singular.
_SINGULAR = 1e6
#: Damping of the stop, in parts of the critical one of a mass [kg] that is typical of a robot.
_DAMPING, _MASS = 1.0, 300.0
#: Part of a step in which the force changes.
_CHANGING = 0.3
#: Joints whose links a held tool keeps from moving; the others are the wrist.
_ARM = 3
HELD, SLIDING = "held", "sliding"


def _plan(task: Task) -> Reference:
    """The references yield as stop and drive trains do; the tool, as the motors have it, keeps its orientation."""
    n = len(task.pose)
    if n != 6:
        raise Unplanned(f"force_steps keeps the tool's orientation, which {n} joints cannot", "6")
    axis = np.array(_AXES[str(task.settings["axis"])])
    return _held(task, axis) if task.settings["contact"] == HELD else _sliding(task, axis)


def _held(task: Task, axis: Array) -> Reference:
    """The arm's motors wind up as the force twists them, so that its links stand; the wrist's turn against them."""
    lacking = [name for joint in task.robot.moving[:_ARM] if (name := f"Fc{joint.number}") not in task.values]
    if lacking or not task.flexible:
        problem = (
            f"links are held by dry friction, and there is no {lacking[0]}" if lacking else "no drive train yields"
        )
        raise Unplanned(problem, "coulomb_friction and elastic drive trains, or contact=sliding")
    pose = task.model.tool_transform(task.pose)
    torques = task.model.tool_jacobian(task.pose)[:3].T @ pose[:3, :3] @ axis
    parts = np.linspace(0.0, 1.0, _POINTS)
    arm = np.outer(parts, task.number("force") * torques * task.compliances)[:, :_ARM]
    part, rate = _staircase(task)
    q, slope = _along(parts, _turned(task, pose, task.pose[:_ARM] + arm), part)
    return Reference(q, slope * rate[:, None], locked=tuple(range(_ARM)), measured=True)


def _turned(task: Task, pose: Array, arms: Array) -> Array:
    """Joint positions with those of the arm given, and a wrist that turns the tool as in ``pose``."""
    q, result = task.pose.copy(), []
    for arm in arms:
        q = np.concatenate([arm, q[_ARM:]])
        for _ in range(_ROUNDS):
            error = _rotation(pose, task.model.tool_transform(q))
            if np.abs(error).max() < _NEAR:
                break
            jacobian = task.model.tool_jacobian(q)[3:, _ARM:]
            if np.linalg.cond(jacobian) > _SINGULAR:
                raise Unplanned("the wrist is straight", "--pose with a bent one")
            q[_ARM:] += np.linalg.solve(jacobian, error)
        else:
            raise Unplanned("the wrist cannot keep the tool's orientation", "another --pose")
        result.append(q)
    return np.array(result)


def _rotation(wanted: Array, now: Array) -> Array:
    """The small rotation (3) [rad] in world axes that is between two poses (4 x 4)."""
    turn = wanted[:3, :3] @ now[:3, :3].T
    return np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]) / 2


def _sliding(task: Task, axis: Array) -> Reference:
    """The references move into the stop by what stop and drive trains yield along the force, and slip sideways."""
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
            error = np.concatenate([pose[:3, 3] + way * direction - now[:3, 3], _rotation(pose, now)])
            if np.abs(error).max() < _NEAR:
                break
            jacobian = task.model.tool_jacobian(q)
            if np.linalg.cond(jacobian) > _SINGULAR:
                raise Unplanned("the pose is singular", "--pose with a bent arm and wrist")
            q = q + np.linalg.solve(jacobian, error)
        else:
            raise Unplanned("the tool cannot be moved along the axis from this pose", "another --pose")
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
        "contact": Setting(HELD, "how the tool stands", choices=(HELD, SLIDING)),
        "stiffness": Setting(1e7, "of the stop on which it slides [N/m]"),
    },
    plan=_plan,
)
