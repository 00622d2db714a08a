"""Link-side encoders that are logged size late."""

from __future__ import annotations

from tests.plant.law import Law

LAW = Law(about="latency of the link encoder", unit="s", typical=3e-3, reading="link_latency")
