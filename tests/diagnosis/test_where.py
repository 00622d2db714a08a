"""The joint and the variable that a diagnosis points at."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from identification.diagnosis.columns.hypothesis import BASE, EFFECT, ELASTIC
from identification.diagnosis.verdict import remarks
from identification.diagnosis.verdict.burst import Burst
from identification.diagnosis.verdict.lack_of_fit import Lack
from identification.diagnosis.verdict.remarks import of_lacks, of_links
from identification.diagnosis.verdict.unexplained import Unexplained
from identification.diagnosis.verdict.views import View
from identification.diagnosis.verdict.where import Where, late, led, located


def view(joint: int, variable: str, share: float) -> View:
    """Means of which one stands out, at 0.5."""
    mean = np.array([0.0, 0.0, 3.0, 0.0])
    centre = np.array([-0.5, 0.0, 0.5, 1.0])
    return View(joint, variable, "rad", 0, centre, mean, np.ones(4), np.full(4, 50), share)


def seen(*lacks: Lack) -> Where:
    shown = {one.joint: (view(one.joint, "q", 0.27), view(one.joint, "qd", 0.12), view(one.joint, "load", 0.04),
                          view(one.joint, "time", 0.0))
             for one in lacks}  # fmt: skip
    return Where(0, "", "", {}, lacks, shown)


BY_CHANCE = Lack(1, 1.4, 0.01, 0.6, True)
SIGNIFICANT = Lack(2, 1.2, 1e-9, 0.4, True)
EVENT = Lack(3, 1.0, 0.5, 0.0, True, Burst("A.csv", 12.4))


def test_the_largest_of_those_that_count_is_told() -> None:
    found = located(seen(BY_CHANCE, SIGNIFICANT, EVENT), [SIGNIFICANT, EVENT])
    assert (found.joint, found.variable) == (2, "q")
    assert found.region == "q about 0.5 rad"
    assert found.shares == {"q": 0.27, "qd": 0.12, "load": 0.04, "time": 0.0}
    assert found.lack == (BY_CHANCE, SIGNIFICANT, EVENT)


def test_stretches_of_the_motion_are_told_apart() -> None:
    bins = np.linspace(-1.0, 1.0, 9)
    excess = np.array([5.0, 4.0, 0.0, 0.0, 0.0, 0.0, 3.0, 3.0, -4.0])
    one = View(2, "qd", "rad/s", 0, bins, excess, np.ones(9), np.full(9, 50), 0.3)
    found = located(Where(0, "", "", {}, (SIGNIFICANT,), {2: (one,)}), [SIGNIFICANT])
    assert found.region == "qd -1 to -0.75 and about 1 rad/s"
    many = replace(one, mean=np.array([9.0, 0.0, 8.0, 0.0, 7.0, 0.0, 6.0, 0.0, 10.0]))
    found = located(Where(0, "", "", {}, (SIGNIFICANT,), {2: (many,)}), [SIGNIFICANT])
    assert found.region == "qd about -1, about -0.5 and about 1 rad/s"


def test_where_none_counts_it_is_nowhere() -> None:
    found = located(seen(BY_CHANCE, SIGNIFICANT), [])
    assert (found.joint, found.variable, found.region, found.shares) == (0, "", "", {})


def test_an_event_is_told_with_its_time_where_nothing_orders_the_residual() -> None:
    one = Where(0, "", "", {}, (EVENT,), {3: (view(3, "q", 0.01),)})
    found = located(one, [EVENT])
    assert (found.joint, found.variable, found.region) == (3, "time", "once, at 12.40 s of A.csv")


def test_a_large_event_goes_before_what_the_fit_made_of_it() -> None:
    pulse, smooth = replace(EVENT, size=0.9), replace(SIGNIFICANT, size=1.1)
    assert located(seen(smooth, pulse), [smooth, pulse]).joint == 3
    large = replace(smooth, size=2.0)
    assert located(seen(large, pulse), [large, pulse]).joint == 2


def test_events_of_other_joints_are_told() -> None:
    pulse = replace(EVENT, size=0.9, follows="its place")
    where = located(seen(SIGNIFICANT, pulse), [SIGNIFICANT])
    said = of_lacks([SIGNIFICANT, pulse], Unexplained((SIGNIFICANT, pulse), where), False)
    assert said == [
        "something happens on joint 3 once, at 12.40 s of A.csv",
        "what is left on joint 3 follows its place",
    ]
    assert of_lacks([pulse], Unexplained((pulse,), located(seen(pulse), [pulse])), False) == said[1:]


def test_what_a_link_leaves_that_bounces_is_told_apart_from_what_is_little() -> None:
    other = replace(SIGNIFICANT, joint=1, size=0.3)
    little, bounced = of_lacks([SIGNIFICANT, other], Unexplained((), None, bouncing=(2,)), True)
    assert "little beside what was explained there: 0.3 times the noise on joint 1;" in little
    assert bounced.endswith(
        "bounces in a gap, in an order that the smallest error changes: 0.4 times the noise on joint 2"
    )
    assert of_lacks([SIGNIFICANT], Unexplained((), None), False) == []


def test_elasticity_that_is_not_looked_for_is_told_where_something_is_missing() -> None:
    """On joint 2, whose link has an encoder; so has joint 1, which lacks nothing."""
    moving = [SimpleNamespace(number=number) for number in (1, 2, 3)]
    run = SimpleNamespace(others={"qs1": 0, "qs2": 0})
    scene = SimpleNamespace(robot=SimpleNamespace(moving=moving), sampled=SimpleNamespace(run=run))
    found: Any = SimpleNamespace(bank=SimpleNamespace(robot=SimpleNamespace(numbers=(1, 2, 3)), scenes=[scene]))
    (note,) = of_links(found, {2, 3})
    assert note.startswith("elasticity is not looked for on joint 2: counterpoise stiffness --link-encoders")
    assert of_links(found, {3}) == []


@pytest.mark.parametrize(
    ("drop", "hears", "lacking", "told"),
    [
        (80.0, False, {2}, True),
        (40.0, False, {2}, False),
        (80.0, True, {2}, False),
        (80.0, False, {1}, False),
        (80.0, False, set(), False),
    ],
)
def test_a_drive_train_that_is_not_heard_is_told(
    drop: float, hears: bool, lacking: set[int], told: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(remarks, "heard", lambda *_: hears)
    hypothesis = SimpleNamespace(kind=ELASTIC, numbers=(2,), named="elasticity on joint 2")
    variant = SimpleNamespace(hypothesis=hypothesis, key=("joint_elasticity", 2))
    one = SimpleNamespace(variant=variant, passes=True, drop=drop, coefficients=np.ones(1))
    weighing = SimpleNamespace(unexplained=lambda chosen: 100.0, evidence=lambda chosen: [one, one])
    found: Any = SimpleNamespace(weighing=weighing, variants=[], bank=None, train=(0,))
    notes = [*remarks.of_swings(found, lacking)]
    assert [note.startswith("elasticity on joint 2 would explain 80 % of what is left") for note in notes] == [
        True
    ] * told


def finding(variable: str, joints: tuple[int, ...] = (2,)) -> Any:
    hypothesis = SimpleNamespace(joint=2, kind=EFFECT)
    return SimpleNamespace(amplitude={2: 1.0}, hypothesis=hypothesis, variable=variable, joints=joints)


@pytest.mark.parametrize(
    ("variable", "told"), [("qd", "qd"), ("load", "q"), ("time", "time"), ("frequency", "frequency"), ("", "q")]
)
def test_a_finding_leads_unless_another_variable_orders_far_more(variable: str, told: str) -> None:
    found = led(located(seen(BY_CHANCE, SIGNIFICANT), [SIGNIFICANT]), finding(variable), seen(BY_CHANCE, SIGNIFICANT))
    assert (found.joint, found.variable) == (2, told)
    # Of time the means order next to nothing, of a frequency there are none.
    assert bool(found.region) == (told in ("q", "qd"))


def test_what_follows_two_joints_leads_by_its_own_variable() -> None:
    where = located(seen(BY_CHANCE, SIGNIFICANT), [SIGNIFICANT])
    found = led(where, finding("load", joints=(2, 1)), seen(BY_CHANCE, SIGNIFICANT))
    assert (found.variable, found.region) == ("load", "of joints 1 and 2 together")
    assert found.words == "over load, of joints 1 and 2 together"


def test_what_sits_on_no_joint_leads_where_most_was_missing() -> None:
    """Its torque is largest on joint 1, in N m, where next to nothing of it was missing."""
    leaning: Any = SimpleNamespace(
        amplitude={1: 30.0, 2: 1.0}, hypothesis=SimpleNamespace(joint=0, kind=BASE), variable="q", joints=(1, 2)
    )
    where = replace(seen(BY_CHANCE, SIGNIFICANT), views={1: (), 2: seen(SIGNIFICANT).views[2]})
    assert led(where, leaning, seen(SIGNIFICANT)).joint == 2


@pytest.mark.parametrize(("of_speed", "told"), [(0.1, "q"), (0.3, "qd")])
def test_time_that_orders_a_motion_says_nothing_of_a_weight(of_speed: float, told: str) -> None:
    """Motion that does not repeat is ordered by time, whatever makes the torque."""
    views = view(2, "q", 0.05), view(2, "qd", of_speed), view(2, "time", 0.6)
    found = led(Where(2, "time", "", {}, (SIGNIFICANT,), {2: views}), finding("q"), seen(SIGNIFICANT))
    assert found.variable == told
    assert found.shares == {"q": 0.05, "qd": of_speed, "time": 0.6}


@pytest.mark.parametrize("happens", [True, False])
def test_what_a_finding_explains_did_not_happen_once(happens: bool) -> None:
    """The largest of a spring's torque looks like an event until it is taken away."""
    pulse = replace(SIGNIFICANT, burst=Burst("A.csv", 12.4))
    after = seen(BY_CHANCE, pulse if happens else SIGNIFICANT)
    found = led(located(seen(BY_CHANCE, pulse), [pulse]), finding("q"), after)
    assert (found.event != "") == happens


def test_a_jump_between_two_samples_may_come_late() -> None:
    """By half a sample: a torque that jumps by 8 over two of them by 2, one that swings slowly by next to nothing."""
    period, count = 0.01, 400
    jump = np.where(np.arange(count) < count // 2, 0.0, 8.0)
    slow = 8 * np.sin(2 * np.pi * 0.25 * period * np.arange(count))
    scene = SimpleNamespace(period=period, torque=np.stack([jump, slow]), derivative=lambda x: np.gradient(x, period))
    bank = SimpleNamespace(
        runs=[SimpleNamespace(decimated=lambda x: x)], scenes=[scene], whitened=lambda run, joint, rows: rows
    )
    found: Any = SimpleNamespace(bank=bank)
    assert late(found, 0, 0).max() == pytest.approx(2.0)
    assert np.abs(late(found, 0, 1)).max() < 0.1
