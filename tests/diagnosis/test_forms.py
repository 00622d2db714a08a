"""Effects of several forms, and of coefficients that refine others, on matrices whose answer is known."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest

from identification.diagnosis.columns.hypothesis import Coefficient, Hypothesis, ShapeRange
from tests.diagnosis.drawn_data import COUNT, RUNS, Data, search
from tests.matrices import Array


def fall(speed: Array) -> Hypothesis:
    """What falls with the speed (RUNS x COUNT), as a bell or as an exponential; the speed of its grid is coarse."""
    within = ShapeRange("vs", "rad/s", 0.05, 2.0, points=(0.05, 0.4, 1.6))
    form = ShapeRange("exponent", "1", 0.0, 5.0, points=(1.0, 2.0))

    def columns(scene: Any, given: Mapping[str, float]) -> Array:
        return np.exp(-((np.abs(speed[scene.number]) / given["vs"]) ** given["exponent"]))[None, None]

    return Hypothesis("fall", "fall", 1, (Coefficient("F", "N m"),), columns, shapes=(within, form))


@pytest.mark.parametrize("exponent", [1.0, 2.0])
@pytest.mark.parametrize("vs", [0.2, 0.3, 0.5])
def test_a_form_is_chosen_with_its_own_width(exponent: float, vs: float) -> None:
    """On the coarse grid the other form may be nearer."""
    data = Data(61)
    speed = data.draw.uniform(-1.5, 1.5, size=(RUNS, COUNT))
    effect = 4.0 * np.exp(-((np.abs(speed) / vs) ** exponent))
    (found,) = search(data.bank(effect, [fall(speed)]))
    assert found.evidence.variant.shape["exponent"] == exponent
    assert found.evidence.variant.shape["vs"] == pytest.approx(vs, rel=0.1)
    assert found.evidence.coefficients == pytest.approx([4.0], rel=0.1)


@pytest.mark.parametrize(("stiffness", "hardening"), [(0.0, 2.0), (1.0, 2.0), (2.0, 0.0)])
def test_a_spring_may_be_all_hardening(stiffness: float, hardening: float) -> None:
    """Its stiffness where nothing pulls cannot be negative, as chance would have it where it is none."""
    data = Data(62)
    q = data.draw.uniform(-1.2, 1.2, size=(RUNS, COUNT))
    both = (Coefficient("k", "N m/rad", 0.0), Coefficient("h", "N m/rad3", 0.0, refines=True))
    where = ShapeRange("neutral", "rad", -2.0, 2.0, points=(-0.5, 0.0, 0.5), log=False)

    def columns(scene: Any, given: Mapping[str, float]) -> Array:
        way = q[scene.number] - given["neutral"]
        return np.stack([way, way**3])[:, None]

    spring = Hypothesis("spring", "spring", 1, both, columns, shapes=(where,))
    way = q - 0.1
    (found,) = search(data.bank(stiffness * way + hardening * way**3, [spring]))
    values = dict(zip([c.name for c in found.evidence.variant.coefficients], found.evidence.coefficients, strict=True))
    assert values.get("k", 0.0) == pytest.approx(stiffness, abs=0.2)
    assert values.get("h", 0.0) == pytest.approx(hardening, abs=0.2)
