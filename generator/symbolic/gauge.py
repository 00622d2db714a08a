"""The freedom that the torques leave in the bodies' parameters, used to make the equations short.

Some of a body's parameters can be moved to its antecedent without changing any torque: behind a revolute joint S33 (XX
and YY together), MZ and M, behind a prismatic one the whole tensor (Gautier and Khalil 1990). The choice is made on
parameters, once, in ``prepare``.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from fractions import Fraction

from generator.symbolic.bodies import Body
from generator.symbolic.frames import Chain, Frame
from generator.symbolic.matter import Matter, matter, moved, nothing
from generator.symbolic.statements import Node
from generator.symbolic.vectors import Array, array, dot, identity, named, zeros
from generator.words import listed, numbered


@dataclass(frozen=True)
class Gauge:
    """Which freedoms to use beyond S33 = MZ = M = 0.

    ``slide`` names joints whose frame moves along the axis to the point next to the antecedent's origin; ``balance``
    names joints that keep a mass at their origin, such that one first moment of their antecedent vanishes; ``unit`` [m]
    is the unit of length, which can make a length of the chain 1.
    """

    slide: frozenset[int] = frozenset()
    balance: frozenset[int] = frozenset()
    unit: Fraction = Fraction(1)

    def __str__(self) -> str:
        one = len(self.balance) == 1
        kept, moments = ("a mass", "a first moment") if one else ("masses", "first moments")
        return (
            slid(self.slide)
            + (
                f", {kept} kept at {listed(f'O{j}' for j in sorted(self.balance))} against {moments}"
                if self.balance
                else ""
            )
            + (f", lengths in units of {float(self.unit):g} m" if self.unit != 1 else "")
        )


def slid(frames: Collection[int]) -> str:
    """``, frame 6 slid along its axis``: what is said of frames that are; empty without any."""
    return (
        f", {numbered('frame', frames)} slid along {'its axis' if len(frames) == 1 else 'their axes'}" if frames else ""
    )


@dataclass(frozen=True)
class Regauged:
    """The bodies after the choice by frame number, the frames' origins in their antecedents, and the free fall.

    Lengths, moments and the free fall are in the unit of length of the choice, with a unit of mass that leaves inertias
    and torques as they are.
    """

    parts: Mapping[int, Matter]
    positions: Mapping[int, Array]
    gravity: Array


def regauge(chain: Chain, bodies: Mapping[int, Body], gauge: Gauge) -> Regauged:
    """Bodies with the same torques on every joint."""
    program = chain.program
    origins = slid_origins(chain, gauge.slide)
    positions = origins.positions
    parts = {j: _about(matter(body), origins.offsets[j]) for j, body in bodies.items()}
    for frame in reversed(chain.frames):
        j = frame.number
        if j not in parts:
            continue
        part = parts[j]
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
    unit = gauge.unit
    scaled = {
        j: Matter(named("S", j, part.sigma), named("MS", j, unit * part.moment), unit * unit * part.mass)
        for j, part in parts.items()
    }
    return Regauged(scaled, {j: position / unit for j, position in positions.items()}, chain.gravity / unit)


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


@dataclass(frozen=True)
class Origins:
    """Where the frames' origins are put: ``positions`` in their antecedents, and for each frame the ``offsets`` along z
    of its own origin from the point put in its place.
    """

    positions: Mapping[int, Array]
    offsets: Mapping[int, Node]


def slid_origins(chain: Chain, slide: Collection[int]) -> Origins:
    """Origins of the frames ``slide`` at the points of their axes next to their antecedents' origins."""
    program = chain.program
    positions: dict[int, Array] = {}
    offsets: dict[int, Node] = {}
    for frame in chain.frames:
        j, z = frame.number, frame.rotation[:, 2]
        position, offset = frame.position, program.zero
        if frame.parent is not None:
            position = position + array(program, [0, 0, offsets[frame.parent.number]])
        if j in slide:
            offset = dot(z, position)
            position = position - offset * z
        positions[j], offsets[j] = position, offset
    return Origins(positions, offsets)


def _about(part: Matter, offset: Node) -> Matter:
    """The body about the point of its axis from which its origin is ``offset`` away."""
    program = part.mass.program
    if offset is program.zero:
        return part
    return moved(part, identity(program, 3), array(program, [0, 0, offset]))


def _balancing_mass(below: Matter, position: Array) -> Node:
    """The mass to keep at ``position`` so that the antecedent's moment along y, else along x, becomes zero."""
    zero = below.mass.program.zero
    component = next((k for k in (1, 0) if position[k].number), None)
    if component is None:
        return zero
    mass: Node = below.moment[component] / position[component]
    return mass
