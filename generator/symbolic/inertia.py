"""Inertia matrix by composite bodies (Walker and Orin 1982; Featherstone 2008, ch. 6), in first-moment form."""

from __future__ import annotations

from collections.abc import Mapping

from generator.symbolic.bodies import Body, seen_from_antecedent
from generator.symbolic.frames import Chain, Frame
from generator.symbolic.newton_euler import Wrench, to_antecedent
from generator.symbolic.vectors import Array, array, zeros


def composite_bodies(chain: Chain, matter: Mapping[int, Body]) -> dict[int, Body]:
    """For each frame, the matter it carries: its own body and all bodies beyond, as one body."""
    composite = dict(matter)
    for frame in reversed(chain.frames):
        if frame.parent is None or frame.number not in composite:
            continue
        carried = seen_from_antecedent(composite[frame.number], frame.rotation, frame.position)
        below = composite.get(frame.parent.number)
        composite[frame.parent.number] = carried if below is None else below + carried
    return composite


def inertia_matrix(chain: Chain, matter: Mapping[int, Body]) -> Array:
    """M(q) (n x n, symmetric) of the bodies, without rotor inertias [kg m2, kg m, kg by the joints' kinds]."""
    composite = composite_bodies(chain, matter)
    result = zeros(chain.program, chain.dof, chain.dof)
    for frame in chain.frames:
        if frame.coordinate is None or frame.number not in composite:
            continue
        wrench = _unit_acceleration(composite[frame.number], frame, chain)
        _project(result, frame, wrench)
    return result


def _unit_acceleration(composite: Body, frame: Frame, chain: Chain) -> Wrench:
    """The wrench that gives a composite body a unit acceleration of the joint that carries it."""
    mx, my, _ = composite.moment
    across = array(chain.program, [-my, mx, 0])
    if frame.revolute:
        return Wrench(across, composite.inertia[:, 2])
    return Wrench(array(chain.program, [0, 0, composite.mass]), -across)


def _project(result: Array, frame: Frame, wrench: Wrench) -> None:
    column = frame.coordinate
    for ancestor in frame.path():
        row = ancestor.coordinate
        if row is not None:
            entry = wrench.n[2] if ancestor.revolute else wrench.f[2]
            result[row, column] = result[column, row] = entry
        if ancestor.parent is not None:
            wrench = to_antecedent(ancestor, wrench)
