"""Section ``parameters``: named sets of parameter values, each value with its unit and source."""

from __future__ import annotations

import sympy

from generator.errors import InputError, Place
from generator.expressions import has_unit, is_finite
from generator.robot import fields
from generator.robot.description import ParameterSet, ParameterValue
from generator.robot.document import Entry, Table, Text
from generator.robot.names import identifier
from generator.units import parse_unit


def parameter_sets(entry: Entry | None) -> dict[str, ParameterSet]:
    """The sets by name.

    Raises InputError for a value that is not a finite number with a known unit; whether the model has the parameters
    is checked against the model, not here.
    """
    given = fields.named(entry.value, "parameters") if entry else {}
    return {key: _set(identifier(Text(key, one.key), "parameter set"), one) for key, one in given.items()}


def _set(name: str, entry: Entry) -> ParameterSet:
    keys = fields.table(entry.value, f"parameter set {name}", ("values",), ("description", "source", "other_values"))
    source = fields.prose(keys.get("source"), f"source of {name}")
    return ParameterSet(
        name=name,
        description=fields.prose(keys.get("description"), f"description of {name}"),
        source=source,
        values=_values(keys["values"], source),
        other_values=_values(keys["other_values"], source) if "other_values" in keys else {},
        place=entry.key,
    )


def _values(entry: Entry, source: str) -> dict[str, ParameterValue]:
    return {key: parameter_value(key, one, source) for key, one in fields.named(entry.value, "values").items()}


def parameter_value(name: str, entry: Entry, source: str = "") -> ParameterValue:
    """The value of a parameter in SI, of the ``source`` unless it names its own.

    Raises InputError for what is not a number with a known unit and in size, a relative_std below zero
    and a source or note that is no text.
    """
    node = entry.value
    if not isinstance(node, Table):
        short = fields.quantity(node, f"value of {name}", None)
        if not has_unit(fields.text(node, f"value of {name}").content):
            raise InputError(short.place, f"value of {name} has no unit", "a unit, or {value: .., unit: 1}")
        return ParameterValue(in_size(name, short.value, short.place), short.unit, source=source, place=entry.key)
    keys = fields.table(node, f"value of {name}", ("value", "unit"), ("relative_std", "source", "note"))
    unit_text = fields.text(keys["unit"].value, f"unit of {name}", "a unit")
    unit = parse_unit(unit_text.content, unit_text.place)
    value = fields.number(keys["value"].value, f"value of {name}") * unit.factor
    return ParameterValue(
        value=in_size(name, value, keys["value"].value.place),
        unit=unit.si,
        relative_std=relative_std(keys.get("relative_std"), name),
        source=fields.prose(keys.get("source"), f"source of {name}") or source,
        note=fields.prose(keys.get("note"), f"note on {name}"),
        place=entry.key,
    )


def in_size(name: str, value: sympy.Expr, place: Place) -> float:
    """The ``value`` of a parameter; raises InputError where it is too large (``fields.check_size``)."""
    if not is_finite(value):
        raise InputError(place, f"value of {name} is too large", "a finite number")
    fields.check_size(place, f"value of {name}", value, any_small=True)
    return float(value)


def relative_std(entry: Entry | None, name: str) -> float | None:
    """The relative standard deviation [%] of a parameter, None without an entry; raises InputError below zero."""
    if entry is None:
        return None
    value = fields.number(entry.value, f"relative_std of {name}")
    if value < 0:
        raise InputError(entry.value.place, f"relative_std of {name} is negative", "a percentage from 0")
    return float(value)
