"""The new parameters for the model with elastic drive trains: what turns with a motor counts on its side alone."""

from __future__ import annotations

from collections.abc import Mapping

from generator.effects.library import motor_side
from generator.robot.description import ParameterSet, ParameterValue
from generator.symbolic.model import Model
from generator.symbolic.parameter_sets import shifted
from identification.diagnosis.runs.rotor import told

#: Name of the set in the robot file.
SET = "diagnosed_flexible"
_FOUND = "found with the effect, not refitted"
_ASSUMED = "assumed, or found with the effect: no base parameter tells it from the link's"


def flexible_set(model: Model, rigid: ParameterSet, found: Mapping[str, float]) -> ParameterSet:
    """The set ``rigid`` of base parameters for elastic drive trains: with stiff springs both sets move alike.

    Rotors, friction and offsets go to the motors' side (Iam, Fvm, ...), stiffnesses come with them. ``found`` are
    values [SI] of such parameters by name, before those of the file's sets; what neither tells stays on the link.
    """
    values = dict(rigid.values)
    units = {one.name: one.unit for one in model.parameters}
    for one in motor_side(model.robot):
        for name, own in zip(one.names, one.on_joint, strict=True):
            known = told(model.robot, own, name)
            value = found.get(name, known)
            if one.suffix and own in values:
                values[name] = values.pop(own)
            elif value is not None and one.suffix and (links := shifted(model, values, own, -value)):
                values |= links
                values[name] = ParameterValue(value, units[name], note=_source(value, known))
            elif value is not None and not one.suffix:
                values[name] = ParameterValue(value, units[name], note=_FOUND if name in found else "")
    description = f"{rigid.description}; for the model with elastic drive trains"
    return ParameterSet(SET, description, rigid.source, values)


def _source(value: float, known: float | None) -> str:
    """Where a rotor's inertia comes from that the file's sets say to be ``known``."""
    if known is None:
        return _ASSUMED
    return "" if value == known else _FOUND
