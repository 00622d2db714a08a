"""What was chosen is challenged with all its coefficients, by what is believed; what falls and what goes astray."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest

from identification.diagnosis.columns.bank import Variant
from identification.diagnosis.columns.hypothesis import Coefficient
from identification.diagnosis.columns.normal_equations import Prior
from identification.diagnosis.search.selection import Choice, Selection
from identification.diagnosis.search.weighing import Weighing
from tests.diagnosis.drawn_data import TRAIN, VALIDATE, Data, fixed, search
from tests.matrices import several


@pytest.mark.parametrize("refines", [False, True])
def test_a_coefficient_that_another_effect_kept_at_its_bound_returns_with_it(refines: bool) -> None:
    data = Data(5)
    first, second, third = data.column(), data.column(), data.column()
    other = third - 0.6 * second
    size = 0.5 if refines else 1.0
    coefficients = [Coefficient("c", "1", 0.0), Coefficient("c2", "1", 0.0, refines=refines)]
    offered = [several("two", coefficients, [first, second]), fixed("other", other)]
    found = {
        one.evidence.variant.hypothesis.effect: one.evidence.coefficients
        for one in search(data.bank(3 * first + size * second + 2 * other, offered))
    }
    assert found["two"] == pytest.approx([3.0, size], abs=0.15)
    assert found["other"] == pytest.approx([2.0], abs=0.15)


def test_what_a_file_states_of_drive_trains_is_no_prior_of_the_model() -> None:
    """A gain that a free fit makes too large is not believed, whatever stiffness the file states."""
    data = Data(3)
    column = data.column()
    gain = several("torque_gain", [Coefficient("g", "1", -0.65, 1.9, believed=0.6)], [column])
    one = data.bank(1.5 * column, [gain])
    stated = Prior(np.zeros(3), np.zeros((3, 3)))
    for prior, free, believed in ((None, False, False), (stated, True, False), (None, True, False)):
        assert Weighing(one, TRAIN, VALIDATE, prior, None, free).of(one.variants[0], []).believed == believed


def test_the_place_of_what_falls_is_taken_before_others_are_judged() -> None:
    """Beside all that the one which falls had explained the other is too small to be named."""
    data = Data(31)
    large, small = data.column(), data.column()
    offered = [fixed("wrong", large, (None, 0.0)), fixed("large", large), fixed("small", small)]
    one = data.bank(5 * large + small, offered)
    wrong, there, beside = one.variants
    selection = Selection(Weighing(one, TRAIN, VALIDATE, None))
    for chosen in ([wrong, beside], [wrong, there, beside], [there, wrong, beside]):
        assert _names(selection.choices(chosen, replacing=True)) == {"large", "small"}
    # As after a finding was taken back.
    assert _names(selection.choices([beside])) == set()


@pytest.mark.parametrize(("more", "named"), [(0.2, "viscous_friction"), (0.6, "rare")])
def test_what_is_common_takes_a_place_before_what_is_rare(more: float, named: str) -> None:
    data = Data(36)
    viscous, law = data.column(), data.column()
    rare = viscous + more * law
    offered = [fixed("wrong", viscous, (None, 0.0)), fixed("viscous_friction", viscous), fixed("rare", rare)]
    one = data.bank(3 * rare, offered)
    selection = Selection(Weighing(one, TRAIN, VALIDATE, None))
    assert _names(selection.choices(one.variants[:1], replacing=True)) == {named}


def test_what_disagrees_with_itself_takes_no_place() -> None:
    data = Data(37)
    large, small = data.column(), data.column()
    soft = replace(fixed("soft", large), agrees=lambda *_: False)
    near = fixed("near", large + 0.05 * data.column())
    one = data.bank(5 * large + small, [fixed("wrong", large, (None, 0.0)), soft, near, fixed("small", small)])
    selection = Selection(Weighing(one, TRAIN, VALIDATE, None))
    assert _names(selection.choices([one.variants[0], one.variants[3]], replacing=True)) == {"near", "small"}


class Astray(Selection):
    """A search that loses everything at its end."""

    def _exchanged(self, chosen: list[Variant], new: Variant | None, rounds: int) -> list[Variant]:
        return []


def test_what_a_search_loses_is_what_it_began_with() -> None:
    data = Data(32)
    column = data.column()
    one = data.bank(3 * column, [fixed("there", column)])
    astray = Astray(Weighing(one, TRAIN, VALIDATE, None))
    assert [each.evidence.variant for each in astray.search(one.variants)] == one.variants
    assert astray.search() == []


@pytest.mark.parametrize("known", [0, 1])
def test_what_passes_is_found_though_it_costs_more_than_it_explains(known: int) -> None:
    """Nothing of what the search begins with is lost."""
    data = Data(41)
    columns, small = [data.column() for _ in range(12)], data.column()
    many = several("many", [Coefficient(f"c{i}", "1") for i in range(12)], columns)
    one = data.bank(0.05 * sum(columns) + 0.2 * small, [fixed("small", small), many])
    weighing = Weighing(one, TRAIN, VALIDATE, None)
    found = {
        each.evidence.variant.hypothesis.effect: each.evidence
        for each in Selection(weighing).search(one.variants[:known])
    }
    assert found.keys() == {"small", "many"}
    assert found["many"].drop < weighing.price(found["many"].variant)


def test_what_only_known_values_show_is_found_though_it_leaves_as_much_of_the_torque() -> None:
    """The model takes up a column: without it values contradict what is known of them, and the torque fits all the
    same.
    """
    data = Data(34)
    column = data.base.sum(axis=1) + 0.01 * data.column()
    prior = Prior(np.array([3.0, -1.0, 0.5]), 30.0 * np.eye(3))
    weighing = Weighing(data.bank(2 * column, [fixed("shown", column)]), TRAIN, VALIDATE, prior)
    (one,) = weighing.bank.variants
    assert weighing.misfit([]) - weighing.misfit([one]) < weighing.price(one)
    assert _names(Selection(weighing).search()) == {"shown"}
    assert _names(Astray(weighing).search([one])) == {"shown"}


@pytest.mark.parametrize(
    ("size", "other", "named"), [(1.5, 1.0, True), (1.5, 2.0, False), (0.3, 0.4, True), (0.3, 0.55, False)]
)
def test_friction_that_a_common_law_may_lack_is_not_named(size: float, other: float, named: bool) -> None:
    """It must explain more than what is left of its joint, unless friction is all that the joint lacks or what is left
    may be noise.
    """
    data = Data(33)
    viscous, gradual, unlike = data.column(), data.column(), data.column()
    every = {"viscous_friction": viscous, "gradual_friction": gradual}
    offered = [replace(fixed(effect, column), variable="qd") for effect, column in every.items()]
    there = size * gradual + other * unlike
    assert ("gradual_friction" in _names(search(data.bank(10 * viscous + there, offered)))) == named
    assert _names(search(data.bank(there, offered))) == {"gradual_friction"}


def _names(choices: Sequence[Choice]) -> set[str]:
    return {one.evidence.variant.hypothesis.effect for one in choices}
