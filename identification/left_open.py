"""What the rows leave open of standard parameters, and the values that it has in a physically consistent set.

What rows leave open of the bodies is settled by their prior ones. Nothing settles it for friction and springs: a solver
may stop at any number. So a parameter of which no row shows anything takes its prior value, or zero, and those that
show only in sums are, of all that make the same torques, the nearest to theirs.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import nnls

from generator.effects.library import names_of_effects
from generator.robot.parameters import INERTIAL_STEMS
from generator.symbolic.model import Model
from generator.words import listed, numbered
from identification.arrays import Array
from identification.rank import nonzero, not_identifiable, silent


@dataclass(frozen=True)
class LeftOpen:
    """Effects' parameters by name that no row shows, ``unseen``, and that rows show in sums alone, ``shared``; numbers
    of the ``bodies`` that act in torques and of which no row shows anything.
    """

    unseen: tuple[str, ...] = ()
    shared: tuple[str, ...] = ()
    bodies: tuple[int, ...] = ()

    @property
    def unknown(self) -> frozenset[str]:
        """Effects' parameters that have no value by themselves."""
        return frozenset((*self.unseen, *self.shared))


def columns_of_standard(model: Model, names: Sequence[str], R: Array) -> dict[str, Array]:
    """Columns (r) of the standard parameters, by name, in rows ``R`` (r x p) of the estimated base parameters ``names``
    (p); those zero that are but rounding.
    """
    place = {name: k for k, name in enumerate(names)}
    columns: dict[str, Array] = {}
    for base, terms in model.grouping.numeric().items():
        for name, coefficient in terms.items() if base in place else ():
            columns[name] = columns.get(name, np.zeros(len(R))) + coefficient * R[:, place[base]]
    unexcited = silent(np.array([np.linalg.norm(column) for column in columns.values()]))
    return {name: 0.0 * one if out else one for (name, one), out in zip(columns.items(), unexcited, strict=True)}


def left_open(model: Model, names: Sequence[str], columns: Mapping[str, Array]) -> LeftOpen:
    """What rows leave open, by the ``columns_of_standard`` parameters in them; what is a part of a base parameter that
    was given, and is none of the estimated ``names``, is not.
    """
    given = _given(model, names)
    effects = names_of_effects(model.robot)
    free = [p.name for p in model.standard_parameters if p.name in effects and p.name not in given]
    zero = {name for name, column in columns.items() if not column.any()}
    bodies = {
        joint.number: [name for stem in INERTIAL_STEMS if (name := f"{stem}{joint.number}") in columns]
        for joint in model.robot.bodies
    }
    seen = [name for name in free if name in columns and name not in zero]
    _, directions = _unseen(_matrix(columns, seen))
    shared = [name for name, out in zip(seen, not_identifiable(directions), strict=True) if out]
    return LeftOpen(
        tuple(name for name in free if name not in seen),
        tuple(shared),
        tuple(number for number, ten in bodies.items() if ten and zero.issuperset(ten) and not given & {*ten}),
    )


def settled(
    model: Model,
    columns: Mapping[str, Array],
    open_: LeftOpen,
    found: Mapping[str, float],
    prior: Mapping[str, float],
) -> dict[str, float]:
    """Effects' parameters that rows leave ``open_``, by name, with the ``columns_of_standard`` parameters in them: the
    values nearest to the ``prior``, or to zero, within their bounds, that make the same torques as those ``found``.
    """
    lower, upper = (
        {p.name: none if bound is None else bound for p in model.standard_parameters for bound in [getattr(p, end)]}
        for end, none in (("lower", -np.inf), ("upper", np.inf))
    )
    result = {name: float(np.clip(prior.get(name, 0.0), lower[name], upper[name])) for name in open_.unseen}
    if not open_.shared:
        return result
    size, V = _unseen(_matrix(columns, open_.shared))
    x, near, least, most = (np.array([of.get(n, 0.0) for n in open_.shared]) for of in (found, prior, lower, upper))
    N = V.T / size[:, None]
    nearest = x - N @ (V @ (size * (x - near)))
    # A bound that a solver missed by rounding stays missed.
    beyond = np.concatenate([np.minimum(least, x) - nearest, nearest - np.maximum(most, x)])
    bounded = np.isfinite(beyond)
    moved = nearest + N @ _shortest(np.concatenate([N, -N])[bounded], beyond[bounded])
    return result | dict(zip(open_.shared, moved.tolist(), strict=True))


def told(open_: LeftOpen, values: Mapping[str, float], prior: bool) -> list[str]:
    """Notes on what is left open and what its consistent ``values`` are, with a ``prior`` or without."""
    notes = []
    zero, kept = ([name for name in open_.unseen if bool(values[name]) == some] for some in (False, True))
    if zero:
        notes.append(f"the physically consistent set is without {listed(zero)}: no motion in the data shows them")
    if kept:
        notes.append(
            f"the physically consistent set has {listed(kept)} from the prior: no motion in the data shows them"
        )
    if open_.bodies:
        some = numbered("body", open_.bodies, "bodies")
        like = "from the prior" if prior else "as a ball"
        notes.append(f"the physically consistent set has {some} {like}: no motion in the data shows them")
    return notes


def _given(model: Model, names: Sequence[str]) -> set[str]:
    """Standard parameters that are parts of base parameters other than ``names``."""
    return {name for base, terms in model.grouping.numeric().items() if base not in names for name in terms}


def _matrix(columns: Mapping[str, Array], names: Sequence[str]) -> Array:
    rows = len(next(iter(columns.values()), np.zeros(0)))
    return np.column_stack([columns[name] for name in names]) if names else np.zeros((rows, 0))


def _unseen(W: Array) -> tuple[Array, Array]:
    """Lengths (e) of columns ``W`` (r x e), none of them zero, and the directions (k x e, of unit length) in parameters
    times these lengths that no row shows.
    """
    size = np.linalg.norm(W, axis=0)
    _, s, Vt = np.linalg.svd(W / size)
    return size, Vt[int(nonzero(s).sum()) :]


def _shortest(G: Array, h: Array) -> Array:
    """The shortest x with G x >= h, by non-negative least squares (Lawson and Hanson 1974, Solving Least Squares
    Problems, chapter 23).
    """
    # Of the order of one, so that no digits are lost of what is far from its bounds.
    length = np.linalg.norm(G, axis=1)
    some = length > 0
    G, h = G[some] / length[some, None], h[some] / length[some]
    scale = np.abs(h).max(initial=0.0)
    if np.all(h <= 0):
        return np.zeros(G.shape[1])
    E = np.concatenate([G.T, h[None] / scale])
    f = np.eye(len(E))[-1]
    r = E @ nnls(E, f)[0] - f
    return np.asarray(-scale * r[:-1] / r[-1])
