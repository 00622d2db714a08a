"""A payload on a simulated robot: it moves as part of the body that carries the tool."""

from __future__ import annotations

from typing import Any

import numpy as np

from generator.command_line import command_line
from generator.errors import InputError
from generator.robot.parameters import INERTIAL_STEMS
from generator.symbolic.pseudo_inertia import pseudo_inertia
from identification.arrays import Array
from identification.sidecar import Payload

#: States at which the payload's torques are compared with those of base parameters, and what may be left of them.
_STATES, _LEFT = 200, 1e-9


def whole(payload: Payload) -> Payload:
    """The payload with all ten parameters: moments that are not known are zero, inertias those of a point mass.

    Raises InputError for what no body can have.
    """
    known = payload.known
    M, *c = (known.get(stem, 0.0) for stem in ("M", "MX", "MY", "MZ"))
    if not M > 0:
        raise InputError(command_line("--payload"), f"a mass of {M:g} kg", "M=MASS above 0 in kg")
    with np.errstate(over="ignore"):
        second = np.outer(c, c) / M
    if not np.isfinite(second).all():
        raise InputError(command_line("--payload"), f"a mass of {M:g} kg", "one that its first moments do not dwarf")
    point = np.trace(second) * np.eye(3) - second
    stems = ("XX", "XY", "XZ", "YY", "YZ", "ZZ")
    inertias = dict(zip(stems, point[np.triu_indices(3)].tolist(), strict=True))
    values = inertias | {"MX": c[0], "MY": c[1], "MZ": c[2]} | dict(known)
    P = pseudo_inertia([values[stem] for stem in INERTIAL_STEMS])
    if np.linalg.eigvalsh(P)[0] < -1e-9 * np.abs(P).max():
        problem = "inertias that are too small for its moments, or break the triangle inequality"
        raise InputError(command_line("--payload"), problem, "XX .. ZZ in the tool frame, about its origin")
    return Payload(payload.name, {stem: values[stem] for stem in INERTIAL_STEMS})


def carried(module: Any, model: Any, payload: Payload) -> dict[str, float]:
    """Base parameters by name [SI] of ``model`` with a whole payload on its tool.

    Its torques are those of changed base parameters of the body that carries it, whatever the motion.
    """
    draw = np.random.default_rng(0)
    n = module.NQ
    p = np.array([payload.known[stem] for stem in INERTIAL_STEMS])
    W, Y = [], []
    for q, qd, qdd in draw.uniform(-2, 2, (_STATES, 3, n)):
        Y.append(model.payload_regressor(q, qd, qdd) @ p)
        W.append(_unpacked(module, model.regressor_packed(q, qd, qdd)))
    rows, torques = np.concatenate(W), np.concatenate(Y)
    size = np.linalg.norm(rows, axis=0)
    size[size == 0] = 1.0
    change = np.linalg.lstsq(rows / size, torques, rcond=None)[0] / size
    if np.linalg.norm(torques - rows @ change) > _LEFT * np.linalg.norm(torques):
        raise InputError(command_line("--payload"), "the tool is on no moving body", "a robot that moves its tool")
    names = module.BASE_PARAMETERS
    own = model.parameters[: len(names)]
    return {name: float(value + d) for name, value, d in zip(names, own, change, strict=True)}


def _unpacked(module: Any, entries: Array) -> Array:
    """The regressor (n x p) from its entries that are not always zero."""
    W = np.zeros((module.NQ, module.NBASE))
    W[tuple(np.array(one) for one in module.SPARSITY["regressor_packed"])] = entries
    return W
