"""Two links with elastic drive trains, to be simulated."""

from __future__ import annotations

import numpy as np

from tests.recorded import TRUTH, TWO_LINKS, parameters_text

#: The motors have what the base parameters ZZ1R and Ia2 hold beside the links.
MOTORS = {"Iam1": 3.0, "Fvm1": 14.0, "Fcm1": 9.0, "Offm1": 1.5, "k1": 4e4}
MOTORS |= {"Iam2": 0.9, "Fvm2": 7.0, "Fcm2": 4.0, "Offm2": -0.8, "k2": 1.5e4}
LINKS = {name: value for name, value in TRUTH.items() if name[:2] in ("ZZ", "MX", "MY")} | {"ZZ1R": 6.0}
N = np.array([[100.0, 0.0], [5.0, -80.0]])
KT = np.array([0.5, 0.4])


def robot_text() -> str:
    """Of their robot file, with the sets ``twin`` and ``twin_flexible``."""
    return f"{TWO_LINKS}flexible: all\n" + parameters_text({"twin": TRUTH, "twin_flexible": LINKS | MOTORS})
