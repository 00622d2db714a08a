"""Parameter values to compare: of a results file, or of a parameter set of a robot file."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from generator.derivation import derive
from generator.errors import InputError, Place
from generator.resources import find_robot
from generator.robot.description import ParameterSet, ParameterValue, Robot
from generator.robot.readers import read
from generator.symbolic.parameter_sets import resolved
from identification.named_set import named_set
from identification.recording import digest
from identification.set_values import told

#: How the name of a results file ends.
JSON = ".json"
#: Names of a result's models, by how they are asked for; their place in the file.
_MODELS = {"full": (), "essential": ("essential",), "consistent": ("consistent",)}
_EXPECTED = "RESULTS.json, RESULTS.json:essential, RESULTS.json:consistent, or ROBOT:SET"


@dataclass(frozen=True)
class Known:
    """A value [``unit``] with its standard deviation; both None where they are not known."""

    value: float | None
    std: float | None
    unit: str


@dataclass(frozen=True)
class Parameters:
    """Values by name, and where they come from: ``name`` as asked for, ``file`` with its ``sha256``.

    ``base`` are the base parameters that standard ones make, None where ``values`` are base parameters themselves.
    """

    name: str
    file: str
    sha256: str
    values: Mapping[str, Known]
    base: Mapping[str, Known] | None = None

    def beside(self, other: Parameters) -> Parameters:
        """With base parameters in place of standard ones where ``other`` has no standard ones."""
        return self if self.base is None or other.base is not None else replace(self, values=self.base)


def parameters(source: str) -> Parameters:
    """What ``source`` names: ``results.json``, a model of it (``results.json:essential``), or ``ROBOT:SET``.

    ROBOT is a name in robots/ or the path of a robot file. Raises InputError for anything else.
    """
    if source.endswith(JSON):
        return _of_results(source, Path(source), "full")
    left, colon, right = source.rpartition(":")
    if not colon:
        raise InputError(Place(source), "this names no parameter values", _EXPECTED)
    if left.endswith(JSON):
        return _of_results(source, Path(left), right)
    return _of_robot(source, left, right)


def _of_results(source: str, path: Path, model: str) -> Parameters:
    place = Place(str(path))
    if model not in _MODELS:
        raise InputError(place, f"results have no model {model!r}", ", ".join(_MODELS))
    found: Any = _json(path)
    for key in _MODELS[model]:
        found = found.get(key) if isinstance(found, dict) else None
    values, base = (_entries(found, key, place) for key in ("parameters", "base_parameters"))
    if values is None:
        raise InputError(place, f"there are no parameters of the {model} model", "results.json of an identification")
    return Parameters(source, str(path), digest(path), values, base)


def _entries(found: Any, key: str, place: Place) -> dict[str, Known] | None:
    entries = found.get(key) if isinstance(found, dict) else None
    if not isinstance(entries, dict):
        return None
    return {str(name): _entry(one, str(name), place) for name, one in entries.items()}


def _json(path: Path) -> Any:
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise InputError(Place(str(path)), f"cannot be read: {error.strerror}", "a results file") from None
    except UnicodeDecodeError:
        raise InputError(Place(str(path)), "not UTF-8", "a results file") from None
    except RecursionError:
        raise InputError(Place(str(path)), "not JSON: too many brackets within brackets", "a results file") from None
    except json.JSONDecodeError as error:
        place = Place(str(path), error.lineno, error.colno)
        raise InputError(place, f"not JSON: {error.msg}", "a results file") from None
    except ValueError:
        raise InputError(Place(str(path)), "a number has too many digits", "a results file") from None


def _entry(one: Any, name: str, place: Place) -> Known:
    entry = one if isinstance(one, dict) else {"value": ""}
    value, std = (_number(entry.get(key), name, place) for key in ("value", "std"))
    if std is not None and not std >= 0:
        raise InputError(place, f"{name} has the std {std:g}", "a number from 0, or null where it is not known")
    # What was given is not known exactly: its std of zero is that of the fit alone.
    std = None if entry.get("fixed") is True else std
    unit = str(entry.get("unit", ""))
    return Known(None, None, unit) if value is None or not math.isfinite(value) else Known(value, std, unit)


def _number(value: Any, name: str, place: Place) -> float | None:
    if value is None:
        return None
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise InputError(place, f"{name} has no value", "a number, or null where it is not known")
    try:
        return float(value)
    except OverflowError:
        raise InputError(place, f"{name} is too large", "a number of double precision") from None


def _of_robot(source: str, name: str, wanted: str) -> Parameters:
    path = find_robot(name)
    robot = read(path)
    one = named_set(robot, wanted, robot.place)
    values = {key: _known(value) for key, value in {**one.values, **one.other_values}.items()}
    return Parameters(source, str(path), digest(path), values, _base(robot, one, values))


def _base(robot: Robot, one: ParameterSet, values: Mapping[str, Known]) -> dict[str, Known] | None:
    """The ``values`` of a set with its standard parameters made base ones; None where it has none to make.

    A parameter that is grouped has no standard deviation: those of its parts depend on each other.
    """
    model = derive(robot, names=(), check=False)
    names = {parameter.name for parameter in model.all_parameters}
    if names.issuperset(one.values):
        return None
    numbers = resolved(model, one.values)
    base = {
        parameter.name: values.get(parameter.name, Known(numbers[parameter.name], None, parameter.unit))
        for parameter in model.base_parameters
    }
    return base | {name: value for name, value in values.items() if name in one.other_values}


def _known(one: ParameterValue) -> Known:
    std = None if one.relative_std is None or not told(one) else abs(one.value) * one.relative_std / 100
    return Known(one.value, std, one.unit)
