"""Structure of the base regressor: which parameter loads which joint."""

from __future__ import annotations

from collections.abc import Iterator

from generator.review.formula import Name
from generator.review.markup import Markup, element, join
from generator.review.svg import pixel, subscripted, svg, text
from generator.robot.parameters import INERTIAL_STEMS, Parameter
from generator.symbolic.model import Model
from generator.words import unit

TITLE = "Structure of the regressor"
ORDER = 60

_WIDTH = 1070.0
#: Narrower than this the grid scrolls instead of shrinking [px].
_LEGIBLE = 740.0
_SMALLEST, _LARGEST = 13.0, 22.0
_LEFT, _TOP = 34.0, 62.0
_KINDS = (
    dict.fromkeys(INERTIAL_STEMS[:6], "tensor")
    | dict.fromkeys(INERTIAL_STEMS[6:9], "moment")
    | {INERTIAL_STEMS[9]: "mass"}
)
_NAMES = {"tensor": "inertia tensor", "moment": "first moments", "mass": "mass", "effect": "effects"}


def render(model: Model) -> Markup | None:
    function = model.functions.get("regressor")
    if function is None or not model.base_parameters:
        return None
    (output,) = function.outputs
    rows, columns = output.signal.shape
    filled = [
        (i, k) for i in range(rows) for k in range(columns) if output.nodes[i * columns + k] is not model.program.zero
    ]
    present = {_kind(parameter) for parameter in model.base_parameters}
    kinds = [kind for kind in _NAMES if kind in present]
    share = f"{len(filled)} of {rows * columns} entries ({100 * len(filled) / (rows * columns):.0f} %)"
    return join(
        element("p", f"τ = W(q, q̇, q̈) χ. {share} are not zero by structure; the packed regressor holds these alone."),
        element("div", _grid(model, rows, columns, filled), class_="wide"),
        element("p", [[element("i", class_=f"key {kind}"), f" {_NAMES[kind]} "] for kind in kinds], class_="legend"),
    )


def _grid(model: Model, rows: int, columns: int, filled: list[tuple[int, int]]) -> Markup:
    cell = float(min(max(_WIDTH // columns, _SMALLEST), _LARGEST))
    width, height = _LEFT + columns * cell + 2, _TOP + rows * cell + 2
    paper = _rectangle("paper", _LEFT, _TOP, columns * cell, rows * cell)
    drawn = [paper, *_heads(model, cell, height - 2), *_sides(model, cell), *_cells(model, cell, filled)]
    description = (
        f"{rows} joint torques by {columns} base parameters; a filled cell is an entry that is not always zero."
    )
    picture = svg(
        width, height, "Structure of the base regressor", description, join(*drawn, by="\n"), kind="regressor"
    )
    return element("div", picture, style=f"max-width:{pixel(width)}px;min-width:{pixel(min(width, _LEGIBLE))}px")


def _heads(model: Model, cell: float, bottom: float) -> Iterator[Markup]:
    """Names of the parameters over their columns, and lines down to ``bottom`` between those of two joints."""
    parameters = model.base_parameters
    for k, parameter in enumerate(parameters):
        x, y = _LEFT + (k + 0.5) * cell + 4, _TOP - 5
        label = subscripted([Name(parameter.name)])
        yield text(x, y, label, kind="column", anchor="start", transform=f"rotate(-90 {pixel(x)} {pixel(y)})")
        if k and parameters[k - 1].joint != parameter.joint:
            at = pixel(_LEFT + k * cell)
            yield element("path", class_="divider", d=f"M {at} {pixel(_TOP - 52)} V {pixel(bottom)}")


def _sides(model: Model, cell: float) -> Iterator[Markup]:
    """Names of the joints' torques before their rows."""
    for i, number in enumerate(model.robot.numbers):
        label = subscripted([Name(f"tau{number}")])
        yield text(_LEFT - 6, _TOP + (i + 0.72) * cell, label, kind="row", anchor="end")


def _cells(model: Model, cell: float, filled: list[tuple[int, int]]) -> Iterator[Markup]:
    """The filled cells, each with its torque and its parameter for those who point at it."""
    for i, k in filled:
        parameter = model.base_parameters[k]
        title = f"τ{model.robot.numbers[i]}, {parameter.name} [{unit(parameter.unit)}]"
        x, y = _LEFT + k * cell + 1, _TOP + i * cell + 1
        yield _rectangle(f"cell {_kind(parameter)}", x, y, cell - 2, cell - 2, element("title", title))


def _rectangle(kind: str, x: float, y: float, width: float, height: float, *content: Markup) -> Markup:
    sides = {"x": pixel(x), "y": pixel(y), "width": pixel(width), "height": pixel(height)}
    return element("rect", *content, class_=kind, **sides)


def _kind(parameter: Parameter) -> str:
    return _KINDS.get(Name(parameter.name).parts[0], "effect")
