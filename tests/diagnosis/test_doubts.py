"""What is not named beside something else, and what is told as not determined, on matrices whose answer is known."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from identification.diagnosis.columns.hypothesis import (
    BODY,
    EFFECT,
    ELASTIC,
    SIGNAL,
    Coefficient,
    Hypothesis,
    ShapeRange,
)
from identification.diagnosis.columns.payload_body import COEFFICIENTS as PAYLOAD
from identification.diagnosis.verdict import named
from identification.diagnosis.verdict.alternatives import OTHER_BODY
from identification.diagnosis.verdict.doubts import beside_drive_trains, beside_warming, doubted
from identification.diagnosis.verdict.finding import FIRM, TENTATIVE, Finding
from identification.outcome import Value
from tests.diagnosis.drawn_data import RUNS, Data, fixed, names, search
from tests.matrices import Array


@pytest.mark.parametrize(
    ("taken", "size", "said"),
    [
        (True, 0.6, ""),
        (True, 0.4, "it is smaller than 0.5 of the noise's rms: no motion repeats, so noise is not told from what the"),
        (
            False,
            0.6,
            "it is smaller than the noise's rms: no motion repeats and rows are few, so noise is not told from",
        ),
        (False, 1.1, ""),
    ],
)
def test_what_is_small_beside_noise_that_no_motion_tells_apart_is_doubtful(
    taken: bool, size: float, said: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(named, "maps_taken", lambda *_: taken)
    found: Any = SimpleNamespace(repeats=False, bank=None, maps=())
    one: Any = SimpleNamespace(size=size, variant=SimpleNamespace(coordinates=(0,)))
    doubts = named._small(found, one)
    assert [doubt[: len(said)] for doubt in doubts] == ([said] if said else [])
    found.repeats = True
    assert named._small(found, one) == []


def test_a_drive_train_is_elastic_or_loose() -> None:
    """A file says one of both of a joint; on another joint the other one may be."""
    data = Data(51)
    soft, loose = data.column(), data.column()
    both = [fixed("joint_elasticity", soft), fixed("backlash", loose)]
    assert names(search(data.bank(0.9 * soft + 0.5 * loose, both))) == {"joint_elasticity"}
    elsewhere = [both[0], replace(both[1], joint=2)]
    assert names(search(data.bank(0.9 * soft + 0.5 * loose, elsewhere))) == {"joint_elasticity", "backlash"}


@pytest.mark.parametrize(
    ("variable", "size", "found"),
    [("frequency", 0.4, True), ("load", 0.4, False), ("load", 0.6, True), ("frequency", 0.2, False)],
)
def test_how_much_of_another_law_may_be_what_it_lacks(variable: str, size: float, found: bool) -> None:
    """Of what shows over the position 2.9 explains 8.4: 3 % are 0.25, a rms of 0.5, and 1 % a rms of 0.29."""
    data = Data(52)
    large, small = data.column(), data.column()
    offered = [replace(fixed("large", large), variable="q"), replace(fixed("small", small), variable=variable)]
    assert ("small" in names(search(data.bank(2.9 * large + size * small, offered)))) == found


def waves(q: Array, orders: tuple[float, ...]) -> Hypothesis:
    """A wave of a whole order of positions q (RUNS x COUNT), refined by one of twice the order."""
    shape = ShapeRange("order", "1", 1.0, max(orders), points=orders, whole=True)

    def columns(scene: Any, given: Mapping[str, float]) -> Array:
        phase = given["order"] * q[scene.number]
        return np.stack([np.cos(phase), np.cos(2 * phase)])[:, None]

    both = (Coefficient("c", "1"), Coefficient("c2", "1", refines=True))
    return Hypothesis("wave", "wave", 1, both, columns, shapes=(shape,))


@pytest.mark.parametrize(("way", "apart"), [(3.0, True), (0.1, False)])
def test_orders_that_do_as_well_are_not_apart(way: float, apart: bool) -> None:
    """Order 2 is the second harmonic of order 1, which the runs do not ask for; a short way shows no order."""
    data = Data(53)
    q = data.draw.uniform(-way, way, size=(RUNS, 1500))
    (found,) = search(data.bank(2.0 * np.cos(2 * q), [waves(q, (1.0, 2.0, 3.0))]))
    assert found.apart == apart
    if apart:
        assert found.evidence.variant.shape["order"] == 2.0


@pytest.mark.parametrize(
    ("mass", "std", "status", "other"),
    [(2.0, 0.1, FIRM, []), (2.0, 1.5, TENTATIVE, []), (0.0, 0.0, TENTATIVE, [OTHER_BODY])],
)
def test_a_payload_without_mass_may_be_less_of_a_known_body(
    mass: float, std: float, status: str, other: list[str]
) -> None:
    data = Data(54)
    there = data.column()
    (choice,) = search(data.bank(0.9 * there, [fixed("payload", there)]))
    hypothesis = Hypothesis("payload", "payload", 0, PAYLOAD, lambda *_: there, kind=BODY, joints=(1, 2))
    values = {one.name: Value(0.0, 0.0, one.unit) for one in PAYLOAD}
    values |= {"M": Value(mass, std, "kg"), "MX": Value(2.0, 0.1, "kg m")}
    one = doubted(Finding(hypothesis, (1, 2), {}, values, choice.evidence, (), {}, {}), 0.0, (), True)
    assert (one.status, [each.effect for each in one.alternatives]) == (status, other)


@pytest.mark.parametrize(
    ("effect", "variable", "drop", "joint", "firm"),
    [
        ("position_friction", "q by direction", 40.0, 2, False),
        ("position_friction", "q by direction", 60.0, 2, True),
        ("position_friction", "q by direction", 40.0, 1, True),
        ("cable_spring", "q", 40.0, 2, True),
        ("warm_friction", "time", 40.0, 1, True),
    ],
)
def test_what_is_little_beside_friction_that_warms_is_tentative(
    effect: str, variable: str, drop: float, joint: int, firm: bool
) -> None:
    warm, other = (
        SimpleNamespace(
            hypothesis=SimpleNamespace(effect=name, kind=EFFECT),
            variable=over,
            evidence=SimpleNamespace(drop=explained),
            joints=(on,),
            doubted=lambda why: why,
        )
        for name, over, explained, on in (("warm_friction", "time", 1000.0, 2), (effect, variable, drop, joint))
    )
    told: list[Any] = [warm, other]
    first, second = beside_warming(told)
    assert first is warm
    assert (second is other) == firm


@pytest.mark.parametrize(
    ("status", "joints", "firm"),
    [(TENTATIVE, (1, 2), False), (TENTATIVE, (1,), True), (FIRM, (1, 2), True)],
)
def test_a_delay_is_as_sure_as_a_drive_train_of_its_joints(status: str, joints: tuple[int, ...], firm: bool) -> None:
    train, delay = (
        SimpleNamespace(
            hypothesis=SimpleNamespace(effect=effect, kind=kind), status=how, joints=on, doubted=lambda why: why
        )
        for effect, kind, how, on in (
            ("backlash", ELASTIC, status, (2,)),
            ("torque_delay", SIGNAL, FIRM, joints),
        )
    )
    told: list[Any] = [train, delay]
    first, second = beside_drive_trains(told)
    assert first is train
    assert (second is delay) == firm
