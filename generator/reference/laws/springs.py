"""Springs on joints, and the work against them from position zero."""

from __future__ import annotations

from collections.abc import Mapping

from generator.reference.law import At, Columns, Law


def _cable(at: At) -> Columns:
    bent = at.q - at.shape["neutral"]
    return bent, bent**3


def _cable_energy(at: At) -> Columns:
    return tuple(((at.q - at.shape["neutral"]) ** n - at.shape["neutral"] ** n) / n for n in (2, 4))


#: By the effects' ids.
LAWS: Mapping[str, Law] = {
    "joint_spring": Law(("ks",), lambda at: (at.q,), potential=lambda at: (at.q * at.q / 2,), loads=True),
    "cable_spring": Law(("kc", "kch"), _cable, potential=_cable_energy, loads=True, ranges={"kc": (5.0, 50.0)}),
}
