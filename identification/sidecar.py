"""What stands beside a run: ``A.yaml`` for ``A.csv`` tells the robot, the payload, and what the columns are called."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from generator import expressions
from generator.command_line import command_line
from generator.errors import InputError, Place
from generator.given_once import given_once
from generator.robot import fields
from generator.robot.document import Entry, Table, Text
from generator.robot.parameters import INERTIAL_STEMS, INERTIAL_UNITS, NOT_NEGATIVE
from generator.robot.readers import document
from identification.formula import Formula, formulas

_UNKNOWN = "unknown"
#: SI units of the ten parameters by stem.
UNITS = dict(zip(INERTIAL_STEMS, INERTIAL_UNITS, strict=True))
#: Name of a payload that nobody named, and letters of one at most.
_UNNAMED, _LONGEST = "L", 8


@dataclass(frozen=True)
class Payload:
    """A body fixed to the tool frame, by a name that its parameters carry: ``ML`` is the mass of payload ``L``.

    ``known`` are exact values by stem [SI], in the tool frame; the other stems of the ten are ``sought``.
    """

    name: str
    known: Mapping[str, float]

    @property
    def sought(self) -> tuple[str, ...]:
        """Stems without a value, in their order."""
        return tuple(stem for stem in UNITS if stem not in self.known)

    def names(self) -> dict[str, str]:
        """Stem -> parameter name, all ten."""
        return {stem: f"{stem}{self.name}" for stem in UNITS}

    @property
    def fixed(self) -> dict[str, float]:
        """The ``known`` values by parameter name [SI], as a fit is given them."""
        names = self.names()
        return {names[stem]: value for stem, value in self.known.items()}


@dataclass(frozen=True)
class Sidecar:
    """All that identification takes from a sidecar; ``robot`` and ``notes`` are empty where it does not say.

    ``empty`` tells that it says there is no payload, which it may leave open. ``since_cold`` is how long before the
    recording the drives were set in motion, cold [s]. What a simulation was made of, under ``simulated``, is for
    people.
    """

    robot: str = ""
    notes: str = ""
    payload: Payload | None = None
    empty: bool = False
    since_cold: float = 0.0
    columns: Mapping[str, Formula] = field(default_factory=dict)


#: How a sidecar's name may end; it is made with the first.
_SUFFIXES = (".yaml", ".yml", ".YAML", ".YML")


def path_of(run: Path) -> Path:
    """Where the sidecar of a run file is, or would be if there were one."""
    if not run.name:
        return run / ".yaml"
    named = [run.with_suffix(suffix) for suffix in _SUFFIXES]
    return next(filter(os.path.lexists, named), named[0])


def read(run: Path) -> Sidecar:
    """The sidecar of a run file, an empty one where there is none.

    Raises InputError, with line and column, for an unknown key and a value with a wrong unit, for what is no file, and
    for two sidecars.
    """
    path = path_of(run)
    if not os.path.lexists(path):
        return Sidecar()
    for suffix in _SUFFIXES:
        other = run.with_suffix(suffix)
        if os.path.exists(other) and not os.path.samefile(path, other):
            raise InputError(Place(str(other)), f"{path.name} is a sidecar of {run.name} too", "one of them")
    root = document(path, "the sidecar of a run")
    if isinstance(root, Table) and "joints" in root.entries:
        problem = f"the robot file of this name would be the sidecar of {run.name}"
        raise InputError(root.place, problem, "another name for the run or for the robot's file")
    keys = fields.table(root, "the sidecar", (), ("robot", "notes", "payload", "since_cold", "columns", "simulated"))
    payload = _payload(keys["payload"]) if "payload" in keys else None
    return Sidecar(
        robot=fields.prose(keys.get("robot"), "robot"),
        notes=fields.prose(keys.get("notes"), "notes"),
        payload=payload,
        empty="payload" in keys and payload is None,
        since_cold=_since_cold(keys["since_cold"]) if "since_cold" in keys else 0.0,
        columns=formulas(keys.get("columns")),
    )


def _since_cold(entry: Entry) -> float:
    """A time [s]; raises InputError for a negative one."""
    what = "the time since the drives were cold"
    value = float(fields.quantity(entry.value, what, "s").value)
    if value < 0:
        raise InputError(entry.value.place, f"{what} is {value:g} s", "0 s or more")
    return value


def _payload(entry: Entry) -> Payload | None:
    """None for the text ``none``; stems that are not given, or are ``unknown``, are sought."""
    if isinstance(entry.value, Text) and entry.value.content == "none":
        return None
    if not isinstance(entry.value, Table):
        expected = "none, or a table such as {M: 150 kg}, of which what is not told is unknown"
        raise InputError(entry.value.place, "payload is no table", expected)
    keys = fields.table(entry.value, "payload", (), ("name", *UNITS))
    name = _UNNAMED
    if "name" in keys:
        name = _name(fields.prose(keys["name"], "name of the payload"), keys["name"].value.place)
    known = {}
    for stem, unit in UNITS.items():
        if stem in keys:
            text = fields.text(keys[stem].value, f"{stem} of the payload", f"a value in {unit}, or {_UNKNOWN}")
            if text.content != _UNKNOWN:
                value = float(fields.quantity(text, f"{stem} of the payload", unit).value)
                known[stem] = _possible(stem, value, text.place)
    return Payload(name, known)


def _name(name: str, place: Place) -> str:
    """``name`` itself; raises InputError for one that parameters' names cannot carry."""
    if not name.isalpha() or len(name) > _LONGEST:
        raise InputError(place, f"payload name {name!r}", "one to eight letters")
    # MXL would be the mass of XL and the first moment of L.
    if name[0] in "XYZ":
        raise InputError(place, f"payload name {name!r} begins with an axis", "one that does not begin with X, Y or Z")
    return name


def _possible(stem: str, value: float, place: Place) -> float:
    """``value`` [SI] itself; raises InputError for a mass or a moment of inertia that is negative."""
    if value < 0 and stem in NOT_NEGATIVE:
        raise InputError(place, f"{stem}={value:g}", "a number that is not negative")
    return value


def given(words: Sequence[str], place: Place) -> Payload:
    """The payload of words such as ``M=150`` [SI] and ``name=L``; raises InputError for anything else, and for a name
    given twice.
    """
    given_once(words, place)
    known: dict[str, float] = {}
    name = _UNNAMED
    for word in words:
        stem, _, value = word.partition("=")
        if stem == "name":
            name = _name(value, place)
        elif stem in UNITS:
            known[stem] = _possible(stem, float(expressions.parse_number(value, place)), place)
        else:
            raise InputError(
                place, f"payload value {word!r}", f"NAME=VALUE with one of {', '.join(UNITS)}, or name=LETTERS"
            )
    return Payload(name, known)


def by_name(carried: Iterable[tuple[Place, Payload | None]]) -> dict[str, Payload]:
    """The payloads ``carried`` by runs, each with its run's place, by name.

    Raises InputError at the place of a run where other values are known of a payload than in a run before.
    """
    result: dict[str, Payload] = {}
    for place, payload in carried:
        if payload is not None and result.setdefault(payload.name, payload).known != payload.known:
            raise InputError(place, f"payload {payload.name} has other values here", "another name for another payload")
    return result


def check_carried(payload: Payload | None, carried: Iterable[Payload | None]) -> None:
    """Raises InputError where the ``payload`` that was given is none of those that runs have ``carried``, because all
    sidecars tell something else.
    """
    if payload is not None and not any(
        one is not None and one.name == payload.name and payload.known.items() <= one.known.items() for one in carried
    ):
        problem = f"no run carries payload {payload.name} with these values: their sidecars tell others, or none"
        raise InputError(command_line("--payload"), problem, "that of a run whose sidecar tells nothing of it")
