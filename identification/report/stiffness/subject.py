"""What the sections of a report on stiffness are made of."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from identification.force_steps import ForceSteps
from identification.locked_output import LockedOutput


@dataclass(frozen=True)
class Subject:
    """Stiffness by either method, and ``results`` as in results.json."""

    found: LockedOutput | ForceSteps
    results: Mapping[str, Any]
