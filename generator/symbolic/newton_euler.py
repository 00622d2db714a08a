"""Recursive Newton-Euler in the form of Khalil and Kleinfinger: linear in the inertial parameters.

All vectors of frame j are expressed in frame j. Reference: W. Khalil, E. Dombre, Modeling, Identification and Control
of Robots, 2002, ch. 9; the report uses it through SYMORO+ (eq. 2, 3).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from generator.symbolic.bodies import Body
from generator.symbolic.frames import Chain, Frame, axis
from generator.symbolic.statements import Node
from generator.symbolic.vectors import Array, Nodes, array, cross, named, skew, zeros


@dataclass(frozen=True)
class Motion:
    """Motion of frame j: angular velocity ``w`` [rad/s], U = skew(wd) + skew(w)^2 [rad/s2], acceleration ``a`` of O_j
    [m/s2] with gravity taken as an acceleration of the base, angular acceleration ``wd`` [rad/s2]. ``differences`` are
    U33 - U22, U11 - U33, U22 - U11.
    """

    w: Array
    wd: Array
    u: Array
    a: Array
    differences: Array


@dataclass(frozen=True)
class Wrench:
    """Force ``f`` [N] and moment ``n`` about O_j [N m]."""

    f: Array
    n: Array

    def __add__(self, other: Wrench) -> Wrench:
        return Wrench(self.f + other.f, self.n + other.n)


def motions(chain: Chain, qd: Nodes, qdd: Nodes, gravity: Array | None = None) -> dict[int, Motion]:
    """Forward recursion from joint speeds and accelerations; ``gravity`` (frame 0) defaults to the chain's."""
    program = chain.program
    free_fall = chain.gravity if gravity is None else gravity
    nothing = zeros(program, 3)
    rest = Motion(nothing, nothing, zeros(program, 3, 3), -free_fall, nothing)
    result: dict[int, Motion] = {}
    for frame in chain.frames:
        before = result[frame.parent.number] if frame.parent else rest
        result[frame.number] = _step(chain, frame, before, qd, qdd)
    return result


def _step(chain: Chain, frame: Frame, before: Motion, qd: Nodes, qdd: Nodes) -> Motion:
    to_frame = frame.rotation.T
    j = frame.number
    z = axis(chain.program)
    w = to_frame @ before.w
    wd = to_frame @ before.wd
    a = to_frame @ (before.a + before.u @ frame.position)
    if frame.coordinate is not None:
        speed, acceleration = qd[frame.coordinate] * z, qdd[frame.coordinate] * z
        if frame.revolute:
            wd = wd + cross(w, speed) + acceleration
            w = w + speed
        else:
            a = a + 2 * cross(w, speed) + acceleration
    u = skew(wd) + _skew_squared(w)
    differences = array(chain.program, [u[2, 2] - u[1, 1], u[0, 0] - u[2, 2], u[1, 1] - u[0, 0]])
    return Motion(named("W", j, w), named("WP", j, wd), u, named("VP", j, a), differences)


def _skew_squared(w: Array) -> Array:
    """skew(w)^2 = w w^T - (w.w) I, each product of two components computed once."""
    xx, yy, zz = w[0] * w[0], w[1] * w[1], w[2] * w[2]
    xy, xz, yz = w[0] * w[1], w[0] * w[2], w[1] * w[2]
    return array(w[0].program, [[-(yy + zz), xy, xz], [xy, -(xx + zz), yz], [xz, yz, -(xx + yy)]])


def inertial_wrench(j: int, motion: Motion, matter: Body) -> Wrench:
    """The wrench that moves a body: F = M a + U MS, N = J wd + w x J w + MS x a."""
    force = matter.mass * motion.a + motion.u @ matter.moment
    moment = matter.inertia @ motion.wd + cross(motion.w, matter.inertia @ motion.w) + cross(matter.moment, motion.a)
    return Wrench(named("F", j, force), named("N", j, moment))


def joint_torques(chain: Chain, wrenches: Mapping[int, Wrench], per: str | None = "") -> Array:
    """Backward recursion: torque [N m] (force [N]) at each moving joint that supplies ``wrenches`` on the frames, named
    f2_1, n2_1; fXX3_2_1, nXX3_2_1 where they are ``per`` unit of XX3; not at all if that is None.
    """
    f, n = (f"{stem}{per}_" if per else stem for stem in "fn")
    total = dict(wrenches)
    torques = zeros(chain.program, chain.dof)
    for frame in reversed(chain.frames):
        wrench = total.get(frame.number)
        if wrench is None:
            continue
        if per is not None:
            named(f, frame.number, wrench.f)
            named(n, frame.number, wrench.n)
        if frame.coordinate is not None:
            torques[frame.coordinate] = along_axis(frame, wrench)
        if frame.parent is not None:
            carried = to_antecedent(frame, wrench)
            below = total.get(frame.parent.number)
            total[frame.parent.number] = carried if below is None else below + carried
    return torques


def along_axis(frame: Frame, wrench: Wrench) -> Node:
    """Torque [N m] (force [N]) of a frame's joint that supplies a wrench on the frame."""
    torque: Node = wrench.n[2] if frame.revolute else wrench.f[2]
    return torque


def to_antecedent(frame: Frame, wrench: Wrench) -> Wrench:
    """A wrench on frame j seen from its antecedent: f about the antecedent's origin gains the moment P x f."""
    f = frame.rotation @ wrench.f
    return Wrench(f, frame.rotation @ wrench.n + cross(frame.position, f))


def inverse_dynamics(
    chain: Chain,
    motion: Mapping[int, Motion],
    matter: Mapping[int, Body],
    tool_wrench: Wrench | None = None,
) -> Array:
    """Joint torques of the bodies alone: M(q) qdd + H(q, qd) without effects (report eq. 2), plus the wrench that the
    tool exerts on its environment, in the tool frame (report eq. 73).
    """
    wrenches = {j: inertial_wrench(j, motion[j], part) for j, part in matter.items()}
    if tool_wrench is not None:
        j = chain.tool.number
        wrenches[j] = wrenches[j] + tool_wrench if j in wrenches else tool_wrench
    return joint_torques(chain, wrenches)
