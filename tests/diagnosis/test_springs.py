"""Springs that pull a link back: by their stiffness, where they rest, and how they harden."""

from __future__ import annotations

from itertools import product
from pathlib import Path

import pytest

from identification.diagnosis.diagnosis import NAMED
from tests.diagnosis.diagnosed_arm import ARM, diagnosis_of, recorded
from tests.recorded import Array

#: Without weight or offset, of which a cable could be a part.
BARE = ARM.replace("-9.81 m/s2", "0 m/s2").replace("  - {effect: offset, joint: 1}\n", "")
TRUTH, STIFFNESS = {"ZZ1": 9.0, "Fv1": 14.0, "Fc1": 9.0}, 12.0


#: Springs of ``make test``; it takes too long for all.
SHORT = {(-0.2, 12.0), (0.0, 0.0), (0.1, 40.0), (0.17, 12.0), (0.28, 0.0)}
SPRINGS = [
    pytest.param(*one, marks=() if one in SHORT else pytest.mark.long)
    for one in product((-0.2, 0.0, 0.1, 0.17, 0.28), (0.0, 12.0, 40.0))
]


@pytest.mark.parametrize(("neutral", "hardening"), SPRINGS)
def test_a_spring_is_told_by_rest_and_hardening(neutral: float, hardening: float, tmp_path: Path) -> None:
    def spring(q: Array, qd: Array) -> Array:
        return STIFFNESS * (q - neutral) + hardening * (q - neutral) ** 3

    regressors, sources = recorded(tmp_path, [spring] * 2, BARE, TRUTH)
    found = diagnosis_of(sources, regressors)
    assert found.verdict == NAMED
    (one,) = found.findings
    told = {name: (value.value, value.std) for name, value in one.parameters.items()}
    if not neutral and not hardening:
        assert one.hypothesis.effect == "joint_spring"
        assert told["ks1"][0] == pytest.approx(STIFFNESS, abs=4 * told["ks1"][1])
        return
    assert one.hypothesis.effect == "cable_spring"
    assert one.shape["neutral"] == pytest.approx(neutral, abs=0.01)
    for name, true in (("kc1", STIFFNESS), ("kch1", hardening)):
        assert told[name][0] == pytest.approx(true, abs=4 * told[name][1])
