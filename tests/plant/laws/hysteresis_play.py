"""Hysteresis by Prandtl and Ishlinskii: six stops of spread ways, each a spring that slips at its end."""

from __future__ import annotations

from tests.plant.law import Law

LAW = Law(
    about="hysteresis (Prandtl-Ishlinskii)",
    unit="N m",
    typical=lambda robot, j: 0.6 * robot.chain[j].coulomb,
    values={"way": 0.05},
    torque="""
double sum = 0.0;
for (int k = 0; k < 6; ++k) {
    const double before = s[k];
    s[k] = fmax(-1.0, fmin(1.0, s[k] + v * h / (way * 0.4 * (k + 1))));
    sum += 0.5 * (before + s[k]);
}
return size * sum / 6.0;
    """,
    friction=True,
)
