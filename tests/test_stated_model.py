"""The header's comment says what the review says: where the robot stands, its table, its groupings."""

from __future__ import annotations

import pytest

from generator.backends.printing.stated_model import stated_model
from generator.review import documents
from tests.conftest import derived


def squeezed(text: str) -> str:
    return " ".join(text.split())


@pytest.mark.parametrize(
    ("name", "stands", "row"),
    [
        ("kr500", "(0, 0, -9.81) m/s2 in the world frame, which is frame 0.", "5 4 0 pi/2 0 q5 0 -118 to 118 deg"),
        ("tilted_two_link", "frame 0 has the pose 0.9063078 0 0.4226183 0.1", "2 1 0 0 d2 q2 0 -150 to 150 deg"),
        ("tree_two_arms", "which is frame 0.", "6 2 0 -pi/2 0 -tilt d3 q6 0 -90 to 90 deg"),
    ],
)
def test_a_header_states_the_model_that_was_reviewed(name: str, stands: str, row: str) -> None:
    model = derived(name).model
    lines, review = stated_model(model), documents.markdown(model)
    text = squeezed(" ".join(lines))
    assert stands in text
    assert row in text
    for said in (*review.symbolic, *review.lengths):
        assert said in text
    assert max(map(len, lines)) <= 100
