"""What is left beside something large: it is named where its law is known, and told where it is not."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from identification.diagnosis.diagnosis import NAMED, Diagnosis
from tests.diagnosis.diagnosed_arm import ARM, Hidden, bumps, diagnosis_of, recorded
from tests.recorded import Array

#: Of an arm whose Coulomb friction is not in its file.
BARE = ARM.replace("  - {effect: coulomb_friction, joint: 1}\n", "")
TRUTH = {"ZZ1": 9.0, "MX1": 11.0, "MY1": 0.6, "Fv1": 14.0, "Off1": 1.5}


def diagnosed(folder: Path, hidden: Hidden) -> Diagnosis:
    def with_friction(q: Array, qd: Array) -> Array:
        return 25.0 * np.sign(qd) + hidden(q, qd)

    regressors, sources = recorded(folder, [with_friction] * 2, BARE, TRUTH)
    return diagnosis_of(sources, regressors)


def test_friction_is_named_beside_far_more_friction(tmp_path: Path) -> None:
    found = diagnosed(tmp_path, lambda q, qd: 6.0 * np.sign(qd) * np.exp(-((qd / 0.15) ** 2)))
    assert found.verdict == NAMED
    told = {name: value for one in found.findings for name, value in one.parameters.items()}
    assert set(told) == {"Fc1", "Fst1"}
    for name, true in (("Fc1", 25.0), ("Fst1", 6.0)):
        assert abs((told[name].value or 0.0) - true) < 3 * (told[name].std or 0.0)
        assert (told[name].std or 0.0) < 0.4
    assert not found.notes


def test_what_has_no_name_is_told(tmp_path: Path) -> None:
    found = diagnosed(tmp_path, bumps(5.0, 0.05))
    assert found.verdict == NAMED
    assert [one.hypothesis.effect for one in found.findings] == ["coulomb_friction"]
    (note,) = found.notes
    assert "times the noise on joint 1; a diagnosis of the new robot file may show what it is" in note


def test_what_does_not_repeat_is_large_all_the_same(tmp_path: Path) -> None:
    """Friction that warms up explains far more than a bump does, though no period has it in common with the others."""

    def warming(q: Array, qd: Array) -> Array:
        warmth = 1 - np.exp(-0.01 * np.arange(len(q)) / 25.0)
        return np.asarray(-warmth * (12.0 * qd + 6.0 * np.sign(qd)) + bumps(1.7, 0.1)(q, qd))

    regressors, sources = recorded(tmp_path, [warming] * 3)
    found = diagnosis_of(sources, regressors)
    assert found.verdict == NAMED
    assert "warm_friction" in [one.hypothesis.effect for one in found.findings]
    assert found.after.lack[0].p < 1e-4
    assert found.after.lack[0].size > max(0.2, found.before.lack[0].size / 2)
