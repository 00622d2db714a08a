"""A finding as it goes into the robot file: the coefficients of a hypothesis made values of the file."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from generator.effects.library import library
from identification.diagnosis.columns.hypothesis import BASE, DRIVE, EFFECT, ELASTIC, LENGTH, SHAPE, SIGNAL, Hypothesis


@dataclass(frozen=True)
class Addition:
    """``kind`` as in ``hypothesis``; ``values`` [SI] of the file, see below.

    - EFFECT: ``effect`` is an id of the library, ``values`` its fixed ones, and the joints' ``warm_up_time`` where the
      file has none.
    - SHAPE: ``values`` replace those of an effect that the file has.
    - SIGNAL: keys of section ``signals`` with their value for the joints: an offset or a delay is added to the file's,
      a gain multiplies it, a limit, time or rise replaces it.
    - DRIVE: ``gear_ratio``, a factor of the joints' ratios; ``torque_drift``, added to the motors'; the rest as SIGNAL.
    - BASE: ``tilt_x``, ``tilt_y``, ``tilt_z`` [rad], the rotation vector in the world that follows the file's rotation.
    - LENGTH: ``d`` or ``r``, how much longer [m] that of the joint is than in the file.
    - ELASTIC: ``gap`` where there is backlash. The joints' drive trains become elastic.
    - BODY: a payload, which base parameters hold; the file's text does not change.
    - LOAD: what runs carry beyond the payload that their sidecars state; the file's text does not change.
    - VALUE: what parameters of the file's effects are beyond what was known; the file's text does not change.

    ``parameters`` [SI] are values of the flexible model's parameters that come with it and that no rigid fit shows.
    ``evidence`` is a line for people, ``amplitude`` the rms of its torque [N m, N] by the joint's number.
    """

    kind: str
    effect: str
    joints: tuple[int, ...]
    values: Mapping[str, float] = field(default_factory=dict)
    parameters: Mapping[str, float] = field(default_factory=dict)
    evidence: str = ""
    amplitude: Mapping[int, float] = field(default_factory=dict)


def addition(
    one: Hypothesis,
    shape: Mapping[str, float],
    coefficients: Mapping[str, float],
    evidence: str = "",
    amplitude: Mapping[int, float] | None = None,
) -> Addition:
    """What a hypothesis becomes with its shape and the values of its coefficients by name."""
    found = [coefficients[each.name] for each in one.coefficients]
    values: dict[str, float] = {}
    parameters: dict[str, float] = {}
    joints = (one.joint,) if one.joint else one.joints
    if one.kind in (EFFECT, SHAPE):
        usual = {each.name: each.default for each in library()[one.effect].shapes}
        values = {name: x for name, x in {**one.given, **shape}.items() if x or usual.get(name) != 0}
    elif one.kind == SIGNAL:
        values = {one.effect: shape[one.effect] if one.effect in shape else found[0]}
        if one.effect == "torque_gain":
            values = {one.effect: 1 / (1 + found[0])}
    elif one.kind == DRIVE:
        values = {one.effect: 1 + found[0]} if one.effect == "gear_ratio" else _drift(found, {**one.given, **shape})
    elif one.kind == BASE:
        values = {name: coefficients[name] for name in ("tilt_x", "tilt_y", "tilt_z") if name in coefficients}
    elif one.kind == LENGTH:
        values = {one.effect.removeprefix("length_"): found[0]}
    elif one.kind == ELASTIC:
        values, parameters = _elastic(one, found[0], {**one.given, **shape})
    else:
        values = dict(coefficients)
    return Addition(one.kind, one.effect, joints, values, parameters, evidence, amplitude or {})


def measured(offered: Sequence[Hypothesis]) -> list[Addition]:
    """What the runs tell without any torque."""
    result = []
    for one in offered:
        known = {name: value for name, value in one.measured.items() if value.value is not None}
        said = ", ".join(f"{value.value:.3g} +- {value.std:.2g} {value.unit}" for value in known.values())
        values = {name: value.value for name, value in known.items() if value.value is not None}
        if values:
            result.append(addition(one, {}, values, f"{one.title}, joint {one.joint}: {said}, measured without torque"))
    return result


def _drift(found: list[float], shape: Mapping[str, float]) -> dict[str, float]:
    """True torque = (1 + start)(1 + drift warmth) recorded; the shape tells the warmth where the file does not."""
    return {"torque_drift": found[0], "torque_gain": 1 + found[1], **shape}


def _elastic(one: Hypothesis, found: float, shape: Mapping[str, float]) -> tuple[dict[str, float], dict[str, float]]:
    train = {f"{name}{one.joint}": shape[name] for name in ("Iam", "k") if name in shape}
    return ({"gap": found} if one.effect == "backlash" else {}), train
