"""A gain is found beside known parameters as it is, whatever the first fit made of them: one that doubles a torque or
halves it, and one that runs without noise show to the end.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.diagnosis.diagnosed_arm import ARM, TRUTH, diagnosis_of, recorded, rewritten, torque

#: What is known, wrong by about what is said of it.
KNOWN = """\
parameters:
  known:
    values:
      ZZ1: {value: 9.1, unit: kg m2, relative_std: 2}
      MX1: {value: 10.9, unit: kg m, relative_std: 2}
      MY1: {value: 0.6, unit: kg m, relative_std: 5}
      Fv1: {value: 13.7, unit: N m s/rad, relative_std: 5}
      Fc1: {value: 9.2, unit: N m, relative_std: 5}
      Off1: {value: 1.5, unit: N m, relative_std: 5}
"""


@pytest.mark.parametrize(
    ("error", "noise"),
    [
        pytest.param(0.6, 0.4, marks=pytest.mark.long),
        pytest.param(1.2, 0.4, marks=pytest.mark.long),
        pytest.param(1.7, 0.4, marks=pytest.mark.long),
        pytest.param(-0.45, 1.6, marks=pytest.mark.long),
        (-0.6, 0.4),
        pytest.param(0.45, 0.1, marks=pytest.mark.long),
        pytest.param(-0.3, 0.1, marks=pytest.mark.long),
    ],
)
def test_a_gain_is_found_beside_what_is_known(error: float, noise: float, tmp_path: Path) -> None:
    regressors, sources = recorded(tmp_path, [torque("")] * 3, ARM + KNOWN, noise=noise)
    for source in sources:
        rewritten(source, lambda t, q, tau: (t, q, (1 + error) * tau))
    found = diagnosis_of(sources, regressors, "known")
    (gain,) = found.findings
    assert gain.hypothesis.effect == "torque_gain"
    told = gain.parameters["torque_gain_error1"]
    assert told.value is not None
    assert abs(told.value - error) < 3 * told.std < 0.1
    assert found.search.values["MX1"] == pytest.approx(TRUTH["MX1"], rel=0.02)
