"""What each generated function costs."""

from __future__ import annotations

from generator.review.markup import Markup, element, join, table
from generator.symbolic.counts import HEADS
from generator.symbolic.function import Function
from generator.symbolic.model import Model

TITLE = "Operation counts"
ORDER = 130


def render(model: Model) -> Markup | None:
    if not model.functions:
        return None
    largest = max(function.count.total for function in model.functions.values()) or 1
    rows = [_row(function, largest) for function in model.functions.values()]
    heads = ("function", *HEADS, "mul + add + div", "prepare", "inputs")
    return join(
        element(
            "p",
            "Per call, after dead code is removed; a unary minus is free, a square root or a power counts as other. "
            "Work that depends on parameters alone is done once, in prepare.",
        ),
        table(heads, rows, class_="numbers"),
        *_strategies(model),
    )


def _strategies(model: Model) -> list[Markup]:
    """How the equations of the bodies were written, and what that saved against the textbook recursion."""
    if not model.strategies.choices:
        return [element("p", "The equations are those of the textbook recursion.")]
    rows: list[list[Markup | str]] = [
        [kind, str(choice.operations), str(choice.textbook), f"{100 * choice.saved:.0f} %", choice.way]
        for kind, choice in model.strategies.choices.items()
    ]
    heads = ("equations of the bodies", "mul + add + div", "textbook recursion", "saved", "written with")
    return [table(heads, rows)]


def _row(function: Function, largest: int) -> list[Markup | str]:
    count = function.count
    prepare = function.prepare_count
    total = join(
        element("span", style=f"width:{100 * count.total / largest:.1f}%", class_="bar"),
        element("b", str(count.total)),
    )
    inputs = ", ".join(signal.name for signal in function.inputs)
    name = element("code", function.name, title=function.summary)
    numbers = [str(n) if n else "·" for n in count.as_dict().values()]
    work = prepare.total + prepare.trig + prepare.other
    return [name, *numbers, element("div", total, class_="barred"), str(work) if work else "·", inputs]
