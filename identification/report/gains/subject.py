"""What the sections of a report on drive gains are made of."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from identification.drive_gains import DriveGains


@dataclass(frozen=True)
class Subject:
    """Drive gains, and ``results`` as in results.json."""

    found: DriveGains
    results: Mapping[str, Any]
