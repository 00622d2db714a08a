"""Friction that falls as oil and housing warm up: friction grows by size at a cold start and returns by two
exponentials.
"""

from __future__ import annotations

from tests.plant.law import Law

LAW = Law(
    about="warm-up of friction",
    unit="1",
    typical=0.4,
    values={"fast": 25.0, "slow": 400.0},
    torque="return size * coldness(t, fast, slow, 0.6) * friction;",
)
