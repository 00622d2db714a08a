"""Effects that the robot's file states with a wrong shape: the right one is found, and the repaired file has it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from generator.robot.readers import read
from identification.diagnosis.columns.hypothesis import SHAPE
from identification.diagnosis.diagnosis import NAMED, NOTHING, UNEXPLAINED, Diagnosis
from identification.diagnosis.mending.addition import Addition, addition
from identification.diagnosis.mending.repair import repaired
from identification.diagnosis.verdict.finding import FIRM
from identification.observation import Regressors
from tests.diagnosis.diagnosed_arm import diagnosis_of
from tests.recorded import TRUTH, TWO_LINKS, Array, as_recorded, fourier, parameters_text

#: Torque [N m] of joint 2 over its position and speed.
Law = Callable[[Array, Array], Array]


def stribeck(q: Array, qd: Array) -> Array:
    del q
    return 5.0 * np.sign(qd) * np.exp(-((qd / 0.15) ** 2))


def ripple(q: Array, qd: Array) -> Array:
    del qd
    return 2.0 * np.cos(31 * q) - 1.5 * np.sin(31 * q)


def two_ripples(q: Array, qd: Array) -> Array:
    return 2 * ripple(q, qd) + 2.5 * np.sin(33 * q)


def with_ripple(q: Array, qd: Array) -> Array:
    return stribeck(q, qd) + ripple(q, qd)


def with_harmonic(q: Array, qd: Array) -> Array:
    return ripple(q, qd) + 0.8 * np.cos(62 * q) + 0.5 * np.sin(62 * q)


def one_way(q: Array, qd: Array) -> Array:
    return stribeck(q, qd) + 3.0 * np.maximum(qd, 0.0)


def stating(effects: str, known: dict[str, float]) -> str:
    text = TWO_LINKS.replace("effects:\n", f"effects:\n{effects}")
    return text + parameters_text({"known": TRUTH | known})


def diagnosed(folder: Path, law: Law, effects: str, known: dict[str, float] | None = None) -> tuple[str, Diagnosis]:
    """The robot file with ``effects``, and what comes of three runs with the ``law`` on joint 2; in a free fit where
    nothing is ``known`` of it.
    """
    path, draw, sources = folder / "true.yaml", np.random.default_rng(7), []
    path.write_text(TWO_LINKS)
    regressors = Regressors(read(path))
    for seed in range(1, 4):
        t, motion = fourier(regressors.model.robot, 20.0, 200.0, seed)
        tau = regressors.torques(TRUTH, motion) + 0.4 * draw.normal(size=motion.q.shape)
        tau[1] += law(motion.q[1], motion.qd[1])
        sources.append(str(as_recorded(regressors, t, motion.q, tau).save(folder / f"{seed}.csv")))
    text = stating(effects, known or {})
    path = folder / "two_links.yaml"
    path.write_text(text)
    return text, diagnosis_of(sources, Regressors(read(path)), "known" if known else None)


@pytest.mark.parametrize(
    ("joints", "known"),
    [
        ("2", None),
        pytest.param("1, 2", {"Fst2": 5.0}, marks=pytest.mark.long),
        pytest.param("1, 2", None, marks=pytest.mark.long),
        pytest.param("2", {"Fst2": 5.0}, marks=pytest.mark.long),
    ],
)
def test_another_stribeck_speed_is_found_and_written(
    joints: str, known: dict[str, float] | None, tmp_path: Path
) -> None:
    effects = f"  - {{effect: stribeck_friction, joints: [{joints}], values: {{vs: 0.6 rad/s}}}}\n"
    more = {"Fst1": 0.0} if known and "1" in joints else {}
    text, found = diagnosed(tmp_path, stribeck, effects, known and {**known, **more})
    assert found.verdict == NAMED
    (one,) = found.findings
    assert (one.hypothesis.kind, one.hypothesis.key, one.status) == (SHAPE, ("stribeck_friction", 2), FIRM)
    assert one.shape["vs"] == pytest.approx(0.15, abs=3 * one.shape_std["vs"])
    amount = one.parameters["Fst2_reshaped"]
    assert amount.value == pytest.approx(5.0, abs=3 * amount.std)
    robot = repaired(text, "x", [addition(one.hypothesis, one.shape, one.known)]).robot
    assert float(robot.use("stribeck_friction", 2).values["vs"].value) == pytest.approx(one.shape["vs"], rel=1e-5)
    if "1" in joints:
        assert float(robot.use("stribeck_friction", 1).values["vs"].value) == 0.6


def shapes_of(found: Diagnosis) -> dict[str, float]:
    """The shape values that were found other than in the file, by name."""
    shapes = [one.shape for one in found.findings if one.hypothesis.kind == SHAPE]
    return {name: value for shape in shapes for name, value in shape.items() if name != "exponent"}


#: Wrong shapes of the file.
SLOW = "  - {effect: stribeck_friction, joint: 2, values: {vs: 0.6 rad/s}}\n"
ORDER = "  - {effect: cycloid_ripple, joint: 2, values: {order: 33}}\n"
RIGHT = "  - {effect: stribeck_friction, joint: 2, values: {vs: 0.15 rad/s}}\n"


@pytest.mark.parametrize(
    ("law", "effects", "wanted"),
    [
        pytest.param(ripple, ORDER, {"order": 31.0}, marks=pytest.mark.long),
        (with_harmonic, ORDER, {"order": 31.0}),
        pytest.param(
            with_ripple, SLOW + ORDER, {"order": 31.0, "vs": pytest.approx(0.15, rel=0.05)}, marks=pytest.mark.long
        ),
        # Of so low a speed the rows hold nothing.
        pytest.param(
            stribeck, SLOW.replace("0.6", "0.002"), {"vs": pytest.approx(0.15, rel=0.05)}, marks=pytest.mark.long
        ),
        pytest.param(stribeck, RIGHT, {}, marks=pytest.mark.long),
        pytest.param(one_way, RIGHT, {}, marks=pytest.mark.long),
    ],
)
def test_wrong_shapes_are_found_and_right_ones_stay(
    law: Law, effects: str, wanted: dict[str, float], tmp_path: Path
) -> None:
    _, found = diagnosed(tmp_path, law, effects)
    assert shapes_of(found) == wanted
    others = {one.hypothesis.effect for one in found.findings if one.hypothesis.kind != SHAPE}
    assert others == ({"asymmetric_viscous"} if law is one_way else set())
    assert found.verdict == (NAMED if found.findings else NOTHING)


def test_more_of_an_effect_is_no_other_shape_of_it(tmp_path: Path) -> None:
    """The ripple of the file is right, and there is another one."""
    _, found = diagnosed(tmp_path, two_ripples, ORDER)
    assert (found.verdict, shapes_of(found)) == (UNEXPLAINED, {})


def test_values_that_stay_are_written_as_they_were() -> None:
    effects = "  - {effect: stribeck_friction, joint: 2, values: {vs: 1/8 rad/s, exponent: 2}}\n"
    found = Addition(SHAPE, "stribeck_friction", (2,), values={"vs": 0.125, "exponent": 1.0})
    text = repaired(stating(effects, {}), "x", [found]).text
    assert "values: {vs: 1/8 rad/s, exponent: 1}" in text
