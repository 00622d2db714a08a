"""How recorded signals differ from what the model means: corrections that no generated function holds."""

from __future__ import annotations

from generator.review import stated
from generator.review.markup import Content, Markup, element, join, table
from generator.symbolic.model import Model
from generator.words import minus, unit

TITLE = "Signals"
ORDER = 105


def render(model: Model) -> Markup | None:
    told = stated.signals(model.robot)
    if not told:
        return None
    heads: list[Content] = list(told[0])
    rows = [[unit(minus(cell)) for cell in row] for row in told[1:]]
    note = "For recorded motion; the generated functions take true positions, torques and currents."
    return join(element("p", note), table(heads, rows, class_="numbers"))
