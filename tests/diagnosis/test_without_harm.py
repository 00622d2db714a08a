"""Which tentative findings a new model goes without: those that make it worse than the old one, and no others."""

from __future__ import annotations

from collections.abc import Sequence
from types import SimpleNamespace
from typing import Any

import pytest

from identification.diagnosis.mending.untouched import Untouched
from identification.diagnosis.mending.without_harm import without_harm
from identification.diagnosis.verdict.finding import FIRM, TENTATIVE
from identification.residuals import Residual

#: What the old model leaves of each joint, of a spread of 1.
OLD = 0.1


def finding(
    name: str, joints: Sequence[int], drop: float, status: str = TENTATIVE, on: Sequence[int] | None = None
) -> Any:
    """One on joints, or ``on`` some of those that its torque reaches."""
    return SimpleNamespace(
        name=name,
        status=status,
        joints=tuple(joints if on is None else on),
        amplitude=dict.fromkeys(joints, 1.0),
        evidence=SimpleNamespace(drop=drop),
        hypothesis=SimpleNamespace(named=name),
    )


def left(size: float) -> Residual:
    return Residual(rows=100, norm=size, torque=1.0, spread=1.0)


def kept(found: Sequence[Any], worse: dict[frozenset[str], dict[int, float]]) -> tuple[set[str], list[str]]:
    """Findings by name that stay, where models with some of them leave so much of joints, else as much as the old."""

    def tried(model: Any) -> dict[int, Untouched]:
        now = worse.get(frozenset(one.name for one in model.findings), {})
        return {joint: Untouched(left(OLD), left(now.get(joint, OLD)), 0.01) for joint in (1, 2)}

    model, notes = without_harm(model_of(found), model_of, tried)
    return {one.name for one in model.findings}, notes


def model_of(found: Sequence[Any]) -> Any:
    return SimpleNamespace(findings=tuple(found), fit=SimpleNamespace(contradicted=()))


GAIN, DELAY = finding("gain", [1], 50.0), finding("delay", [1], 90.0)


def test_what_spoils_its_joint_is_left_out_and_told() -> None:
    names, notes = kept([GAIN, DELAY], {frozenset({"gain", "delay"}): {1: 0.2}})
    assert names == {"delay"}
    assert notes == [
        "gain is not in the new model, which is worse with it on joint 1 (20 % of it is left, 10 % without)"
    ]


def test_what_a_link_s_swing_helps_on_its_neighbours_does_not_count() -> None:
    worse = {frozenset({"gain"}): {1: 0.2, 2: 0.08}}
    assert kept([finding("gain", [1, 2], 50.0, on=[1])], worse)[0] == set()
    assert kept([finding("gain", [1, 2], 50.0, on=[2])], worse)[0] == {"gain"}
    assert kept([finding("gain", [1, 2], 50.0, on=[3])], worse)[0] == {"gain"}


def test_what_is_not_the_cause_stays() -> None:
    both, without = frozenset({"gain", "delay"}), frozenset({"delay"})
    assert kept([GAIN, DELAY], {both: {1: 0.2}, without: {1: 0.3}})[0] == {"gain"}
    alone: dict[frozenset[str], dict[int, float]] = {without: {1: 0.3}, frozenset({"gain"}): {1: 0.25}}
    assert kept([GAIN, DELAY], {both: {1: 0.2}, **alone, frozenset(): {1: 0.2}}) == ({"gain", "delay"}, [])


def test_what_spoils_its_joint_together_is_left_out_together() -> None:
    both, alone = frozenset({"gain", "delay"}), {frozenset({one}): {1: 0.3} for one in ("gain", "delay")}
    names, notes = kept(
        [GAIN, DELAY, finding("tilt", [2], 20.0)],
        {both | {"tilt"}: {1: 0.2}, **{k | {"tilt"}: v for k, v in alone.items()}},
    )
    assert names == {"tilt"}
    assert notes == [
        "gain and delay are not in the new model, which is worse with them on joint 1 (20 % of it is left, "
        "10 % without)"
    ]


@pytest.mark.parametrize(
    "one", [finding("gain", [1], 50.0, FIRM), finding("gain", [1, 2], 50.0), finding("gain", [2], 50.0)]
)
def test_what_is_firm_or_helps_elsewhere_stays(one: Any) -> None:
    assert kept([one], {frozenset({"gain"}): {1: 0.2}})[0] == {"gain"}


def test_what_known_values_of_bodies_ask_for_stays() -> None:
    """Without it the runs make other bodies than are known, which explain a test as well."""

    def contradicting(found: Sequence[Any]) -> Any:
        names = ("MX2R",) if GAIN not in found else ()
        return SimpleNamespace(findings=tuple(found), fit=SimpleNamespace(contradicted=names))

    def tried(model: Any) -> dict[int, Untouched]:
        return {1: Untouched(left(OLD), left(0.2 if GAIN in model.findings else OLD), 0.01)}

    model, notes = without_harm(contradicting([GAIN]), contradicting, tried)
    assert model.findings == (GAIN,)
    assert notes == ["without gain the runs make MX2R other than known: the new model has it"]
