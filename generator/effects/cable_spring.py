"""Hoses and cables along the arm that pull a joint back to where they hang free."""

from __future__ import annotations

from generator.effects.effect import Column, Effect, LinearParameter, Shape, Site


def _columns(at: Site) -> tuple[Column, ...]:
    return (at.on_joint(at.q - at.values["neutral"]),)


EFFECT = Effect(
    id="cable_spring",
    title="cable spring",
    parameters=(LinearParameter("kc", ("N m/rad", "N/m"), "stiffness of hoses and cables", 0.0),),
    columns=_columns,
    potential_energy=lambda at: (at.q * (at.q / 2 - at.values["neutral"]),),
    shapes=(
        Shape(
            "neutral",
            "rad",
            "position where nothing pulls",
            prismatic="m",
            tried=(-2.0, -1.0, 0.0, 1.0, 2.0),
            relative="position",
        ),
    ),
    needs=("q",),
    on_link=True,
    sign_convention="the motor supplies kc (q - neutral) against the pull",
    assumptions="linear, massless, without friction of its own",
    source="Hooke's law",
    rank=65,
)
