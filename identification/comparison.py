"""Two sets of parameter values side by side: relative differences (report eq. 79), and whether they can be noise."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from generator.errors import InputError, Place
from generator.robot.parameter_file import UNSTATED
from identification.parameter_source import Known, Parameters

#: Standard deviations of the difference within which two values agree.
AGREE = 2.0


@dataclass(frozen=True)
class Difference:
    """One parameter: ``a`` is the value compared with, ``b`` the other; None where a side does not have it."""

    name: str
    a: Known | None
    b: Known | None

    @property
    def unit(self) -> str:
        """That of either side."""
        units = [one.unit for one in (self.a, self.b) if one is not None and one.unit != UNSTATED]
        return units[0] if units else ""

    @property
    def both(self) -> bool:
        """Whether both sides know a value."""
        return self.a is not None and self.b is not None and self.a.value is not None and self.b.value is not None

    @property
    def percent(self) -> float | None:
        """100 |b - a| / |a| (report eq. 79); infinite where a alone is zero, None where a side knows no value."""
        if self.a is None or self.b is None or self.a.value is None or self.b.value is None:
            return None
        if self.a.value == self.b.value:
            return 0.0
        return 100 * abs((self.b.value - self.a.value) / self.a.value) if self.a.value else math.inf

    @property
    def deviations(self) -> float | None:
        """|b - a| in standard deviations of the difference of independent estimates; None where no side has one."""
        if self.a is None or self.b is None or self.a.value is None or self.b.value is None:
            return None
        stds = [one.std for one in (self.a, self.b) if one.std is not None]
        if not stds:
            return None
        std, distance = math.hypot(*stds), abs(self.b.value - self.a.value)
        return distance / std if std else (math.inf if distance else 0.0)

    @property
    def agrees(self) -> bool | None:
        """Whether the difference is within ``AGREE`` standard deviations; None where that cannot be told."""
        return None if self.deviations is None else self.deviations <= AGREE


@dataclass(frozen=True)
class Comparison:
    """All parameters that either side has, in the order of ``a``, then of ``b``."""

    a: Parameters
    b: Parameters
    differences: Mapping[str, Difference]

    @property
    def common(self) -> Iterator[Difference]:
        """Those with values on both sides."""
        return (one for one in self.differences.values() if one.both)


def compare(a: Parameters, b: Parameters) -> Comparison:
    """``b`` measured by ``a``, as base parameters where one of them has standard ones alone and the other has not.

    Raises InputError for a parameter in two units, and where nothing is in common.
    """
    a, b = a.beside(b), b.beside(a)
    names = dict.fromkeys([*a.values, *b.values])
    result = {name: Difference(name, a.values.get(name), b.values.get(name)) for name in names}
    for one in result.values():
        if one.a is None or one.b is None or UNSTATED in (one.a.unit, one.b.unit):
            continue
        if one.a.unit != one.b.unit:
            raise InputError(Place(b.file), f"{one.name} is given in {one.b.unit}", f"{one.a.unit}, as in {a.name}")
    found = Comparison(a, b, result)
    if not any(found.common):
        raise InputError(Place(b.file), f"no parameter has a value here and in {a.name}", "parameters of one robot")
    return found
