"""Files with nothing but parameter values, in JSON or YAML.

A value is a number in the parameter's SI unit, a number with its unit as in a robot file, or a table with both:
``{"ZZ1R": 5.2e3, "Fv1": {"value": 8.76, "unit": "kN m s/rad"}}``.
"""

from __future__ import annotations

from pathlib import Path

from generator.expressions import has_unit
from generator.robot import fields
from generator.robot.description import ParameterValue
from generator.robot.document import Entry, Table
from generator.robot.readers import document
from generator.robot.sections.parameter_sets import in_size, parameter_value, relative_std

#: Unit of a value that the file gives as a number alone: the parameter's own, in SI.
UNSTATED = ""


def read(path: Path) -> dict[str, ParameterValue]:
    """The values by parameter name, in SI; JSON is read as the YAML that it is.

    Raises InputError, with line and column, for what is not a table of finite numbers, for a relative_std below
    zero and for a source or note that is no text.
    """
    root = document(path, "a file of parameter values")
    return {name: _value(name, entry) for name, entry in fields.named(root, "the parameter file").items()}


def _value(name: str, entry: Entry) -> ParameterValue:
    what = f"value of {name}"
    if not isinstance(entry.value, Table):
        scalar = fields.text(entry.value, what, "a number, with a unit or without")
        if has_unit(scalar.content):
            return parameter_value(name, entry)
        value = in_size(name, fields.number(scalar, what), scalar.place)
        return ParameterValue(value, UNSTATED, place=entry.key)
    if "unit" in entry.value.entries:
        return parameter_value(name, entry)
    keys = fields.table(entry.value, what, ("value",), ("unit", "relative_std", "source", "note"))
    return ParameterValue(
        value=in_size(name, fields.number(keys["value"].value, what), keys["value"].value.place),
        unit=UNSTATED,
        relative_std=relative_std(keys.get("relative_std"), name),
        source=fields.prose(keys.get("source"), f"source of {name}"),
        note=fields.prose(keys.get("note"), f"note on {name}"),
        place=entry.key,
    )
