"""The freedom that the torques leave in the bodies' parameters, used to make the equations short.

Some of a body's parameters can be moved to its antecedent without changing any torque: behind a revolute joint S33 (XX
and YY together), MZ and M, behind a prismatic one the whole tensor (Gautier and Khalil 1990). The choice is made on
parameters, once, in ``prepare``.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from generator.symbolic.bodies import Body
from generator.symbolic.frames import Chain, Frame
from generator.symbolic.matter import Matter, matter, moved, nothing
from generator.symbolic.statements import Node
from generator.symbolic.vectors import Array, array, dot, identity, named, zeros


@dataclass(frozen=True)
class Gauge:
    """Which freedoms to use beyond S33 = MZ = M = 0.

    ``slide`` moves the origin of a last frame along its axis next to its antecedent's; ``balance`` names joints that
    keep a mass at their origin, such that one first moment of their antecedent vanishes.
    """

    slide: bool = True
    balance: tuple[int, ...] = ()

    def __str__(self) -> str:
        joints = ", ".join(map(str, self.balance))
        return f", a mass kept at O{joints} against a first moment" if self.balance else ""


@dataclass(frozen=True)
class Regauged:
    """The bodies after the choice by frame number, and the origins of the frames in their antecedents."""

    parts: Mapping[int, Matter]
    positions: Mapping[int, Array]


def regauge(chain: Chain, bodies: Mapping[int, Body], gauge: Gauge) -> Regauged:
    """Bodies with the same torques on every joint."""
    program = chain.program
    parts = {j: matter(body) for j, body in bodies.items()}
    positions = {frame.number: frame.position for frame in chain.frames}
    for frame in reversed(chain.frames):
        j = frame.number
        if j not in parts:
            continue
        part = parts[j]
        if gauge.slide and frame.revolute and is_last(chain, frame):
            part, positions[j] = _slid(frame, part)
        below = nothing(program)
        if frame.parent is not None:
            below = parts.get(frame.parent.number, below)
        leaving = _leaving(frame, part)
        if j in gauge.balance:
            kept = _balancing_mass(below + moved(leaving, frame.rotation, positions[j]), positions[j])
            leaving = Matter(leaving.sigma, leaving.moment, leaving.mass - kept)
        parts[j] = Matter(part.sigma - leaving.sigma, part.moment - leaving.moment, part.mass - leaving.mass)
        if frame.parent is not None:
            parts[frame.parent.number] = below + moved(leaving, frame.rotation, positions[j])
    for j, part in parts.items():
        named("S", j, part.sigma)
        named("MS", j, part.moment)
    return Regauged(parts, positions)


def _leaving(frame: Frame, part: Matter) -> Matter:
    """What no torque at the joint shows and the antecedent takes over."""
    program = part.mass.program
    if frame.revolute:
        sigma, moment = zeros(program, 3, 3), zeros(program, 3)
        sigma[2, 2], moment[2] = part.sigma[2, 2], part.moment[2]
        return Matter(sigma, moment, part.mass)
    if frame.prismatic:
        return Matter(part.sigma, zeros(program, 3), program.zero)
    return part


def is_last(chain: Chain, frame: Frame) -> bool:
    """Whether no body is carried by this frame."""
    return all(other.parent is not frame or not other.has_body() for other in chain.frames)


def _slid(frame: Frame, part: Matter) -> tuple[Matter, Array]:
    """The body about the point of its axis next to the antecedent's origin, and that point."""
    program = part.mass.program
    r = offset_along_axis(frame)
    shift = array(program, [0, 0, r])
    return moved(part, identity(program, 3), shift), slid_origin(frame)


def offset_along_axis(frame: Frame) -> Node:
    """How far the frame's origin stands along its own axis from the point next to its antecedent's origin."""
    return dot(frame.rotation[:, 2], frame.position)


def slid_origin(frame: Frame) -> Array:
    """That point, in the antecedent's frame."""
    origin: Array = frame.position - offset_along_axis(frame) * frame.rotation[:, 2]
    return origin


def _balancing_mass(below: Matter, position: Array) -> Node:
    """The mass to keep at ``position`` so that the antecedent's moment along y, else along x, becomes zero."""
    zero = below.mass.program.zero
    component = next((k for k in (1, 0) if position[k] is not zero), None)
    if component is None:
        return zero
    mass: Node = below.moment[component] / position[component]
    return mass
