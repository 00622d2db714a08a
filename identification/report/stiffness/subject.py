"""What the sections of a report on stiffness are made of."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from identification.stiffness_results import Found


@dataclass(frozen=True)
class Subject:
    """Stiffness by one of the methods, and ``results`` as in results.json."""

    found: Found
    results: Mapping[str, Any]
