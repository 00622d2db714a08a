"""What the sections of a diagnosis' report are made of."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

from generator.quantities import signals
from identification.diagnosis.diagnosis import Diagnosis
from identification.diagnosis.mending.mended import Mended
from identification.diagnosis.mending.untouched import Untouched
from identification.diagnosis.runs.played import Played
from identification.report.titles import titles


@dataclass(frozen=True)
class Subject:
    """A diagnosis, and the mended robot with the untouched runs played through it, None after a dry run."""

    found: Diagnosis
    mended: Mended | None = None

    @property
    def numbers(self) -> tuple[int, ...]:
        """The joints' numbers."""
        return self.found.robot.numbers

    @property
    def leading(self) -> str:
        """The joint that is looked at first, as it is named on buttons."""
        return str(self.found.before.joint or self.numbers[0])

    @cached_property
    def torque_units(self) -> dict[int, str]:
        """By the joint's number."""
        model = self.found.search.bank.scenes[0].regressors.model
        return dict(zip(self.numbers, signals.torque_units(model), strict=True))

    @property
    def tested(self) -> list[tuple[str, Played, Played]]:
        """Untouched runs by name, as the model before and the one after play them."""
        if self.mended is None:
            return []
        return list(zip(titles(self.found.roles.test), self.mended.before, self.mended.after, strict=True))

    @property
    def tried(self) -> Mapping[int, Untouched]:
        """Untouched runs together, by the joint's number."""
        return {} if self.mended is None else self.mended.tried
