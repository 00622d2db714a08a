"""What the runs tell of a payload: its mass, first moments, and inertia about the origin of the tool's frame.

Ten inertial parameters are often more than a run tells. What its weight and its swing show first are M, MX, MY and MZ;
of its inertia first one number I, the same about all axes, and what differs from that only where the runs ask for it:
far from the flange no body is round.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from generator.robot.parameters import INERTIAL_STEMS
from identification.arrays import Array
from identification.diagnosis.columns.hypothesis import Coefficient
from identification.diagnosis.runs.scene import Scene
from identification.sidecar import Payload

#: Those of a payload [SI].
COEFFICIENTS = (
    Coefficient("M", "kg", 0.0),
    Coefficient("MX", "kg m"),
    Coefficient("MY", "kg m"),
    Coefficient("MZ", "kg m"),
    Coefficient("I", "kg m2", 0.0),
    *(Coefficient(name, "kg m2", refines=True) for name in ("XX-I", "YY-I", "XY", "XZ", "YZ")),
)

#: The mass [kg] that sidecars state of it.
STATED_MASS = "stated_mass"

#: What the names of those end with that add to what sidecars state.
_BEYOND = "_beyond"

#: Those that are not called as the one inertial parameter, in the tool frame, of which they are so much.
_OTHERS = {"I": ("XX", "YY", "ZZ"), "XX-I": ("XX",), "YY-I": ("YY",)}

#: Inertial parameters, in the tool frame, of each of which a coefficient is so much, by the coefficient's name.
PARAMETERS: Mapping[str, tuple[str, ...]] = {one.name: _OTHERS.get(one.name, (one.name,)) for one in COEFFICIENTS}


def columns(scene: Scene) -> Array:
    """Torques (k x n x N) [N m, N] per unit of each coefficient along a scene."""
    per_joint = np.stack(scene.regressors.payload(scene.motion), axis=1)
    by_name = dict(zip(INERTIAL_STEMS, per_joint, strict=True))
    return np.stack([np.sum([by_name[name] for name in names], axis=0) for names in PARAMETERS.values()])


def beyond(name: str) -> str:
    """How a coefficient is called that adds to what sidecars state."""
    return f"{name}{_BEYOND}"


def within(name: str) -> str:
    """The coefficient that is called so, or so ``beyond`` what sidecars state."""
    return name.removesuffix(_BEYOND)


def states(payload: Payload | None, shape: Mapping[str, float]) -> bool:
    """Whether a run's sidecar states the payload of which a ``shape`` has the mass."""
    return payload is not None and payload.known.get("M") == shape.get(STATED_MASS)


def corrected(stated: Payload, found: Mapping[str, float]) -> Payload:
    """A payload that sidecars state, with what was ``found`` ``beyond`` it [SI], of which a shape is its mass."""
    if not states(stated, found):
        return stated
    known = dict(stated.known)
    for name, stems in PARAMETERS.items():
        for stem in stems:
            known[stem] += found.get(beyond(name), 0.0)
    return Payload(stated.name, known)
