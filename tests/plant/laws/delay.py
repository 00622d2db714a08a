"""Positions that are logged size later than the currents of the same row."""

from __future__ import annotations

from tests.plant.law import Law

LAW = Law(about="delay between current and position", unit="s", typical=1.5e-3, reading="delay")
