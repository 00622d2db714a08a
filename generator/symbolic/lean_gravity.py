"""Torques of the weight with few operations: z . (MS x a) of all matter that a joint carries.

First moments of composite bodies travel towards the base and the upward acceleration towards the tips; no force and no
moment does.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from generator.symbolic.bodies import Body
from generator.symbolic.frames import Chain
from generator.symbolic.gauge import Gauge, regauge
from generator.symbolic.segments import Spun, segments
from generator.symbolic.statements import Node
from generator.symbolic.vectors import Array, named, zeros


@dataclass(frozen=True)
class GravityStrategy:
    """How the torques of the weight are written: the choice of parameters, and whether the bodies are taken by their
    weights (``weighed``) or by their masses, as the inertia matrix takes them.
    """

    gauge: Gauge = field(default_factory=Gauge)
    weighed: bool = True

    def __str__(self) -> str:
        return f"first moments of composite bodies{', as weights' if self.weighed else ''}{self.gauge}"


def gravity(chain: Chain, bodies: Mapping[int, Body], strategy: GravityStrategy) -> Array:
    """Torques of the bodies alone at rest, as ``newton_euler.inverse_dynamics`` gives them."""
    program = chain.program
    spun = segments(chain)
    chosen = regauge(chain, bodies, strategy.gauge)
    scale = _size(chosen.gravity) if strategy.weighed else program.one
    up = _upward(chain, spun, -chosen.gravity / scale)
    own = {j: scale * part.moment for j, part in chosen.parts.items()}
    weights: dict[int, Node] = {j: scale * part.mass for j, part in chosen.parts.items()}
    in_unspun: dict[int, Array] = {}
    torques = zeros(program, chain.dof)
    for frame in reversed(chain.frames):
        j, link = frame.number, spun[frame.number]
        if j in own:
            _add(in_unspun, j, link.to_unspun(own[j]))
        if j not in in_unspun:
            continue
        moment, weight = named("MSc", j, in_unspun[j]), weights[j]
        if frame.coordinate is not None:
            across = moment[0] * up[j][1] - moment[1] * up[j][0]
            torques[frame.coordinate] = across if frame.revolute else weight * up[j][2]
        if frame.parent is None:
            continue
        k, position = frame.parent.number, chosen.positions[j]
        weights[k] = weights.get(k, program.zero) + weight
        if link.continues:
            _add(in_unspun, k, moment + weight * spun[k].to_unspun(position))
        else:
            _add(own, k, link.entry @ moment + weight * position)
    return torques


def _upward(chain: Chain, spun: Mapping[int, Spun], up: Array) -> dict[int, Array]:
    """The acceleration ``up`` of the base in the unspun axes of every frame."""
    result: dict[int, Array] = {}
    for frame in chain.frames:
        link = spun[frame.number]
        if frame.parent is None:
            result[frame.number] = link.entry.T @ up
        elif link.continues:
            result[frame.number] = result[frame.parent.number]
        else:
            k = frame.parent.number
            result[frame.number] = link.entry.T @ spun[k].to_own(result[k])
    return result


def _size(gravity: Array) -> Node:
    """The first component of gravity that is not zero, one if there is none."""
    program = gravity[0].program
    size: Node = next((component for component in gravity if component is not program.zero), program.one)
    return size


def _add(moments: dict[int, Array], j: int, more: Array) -> None:
    moments[j] = moments[j] + more if j in moments else more
