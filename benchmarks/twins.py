"""Derives the simulated twins anew: ``python -m benchmarks.twins``.

Prints for each base parameter the printed value, the twin's and the shift in printed standard deviations; writes the
sets ``twin`` and ``twin_flexible`` into the robot files and the tables into docs/parameter_sets.md.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from benchmarks.documents import replaced
from benchmarks.table import table
from benchmarks.twin_recipes import RECIPES, WEIGHT, Twin, twin_of
from generator.resources import find_robot
from generator.symbolic.pseudo_inertia import Matrix, of_body
from identification.robot_file import with_parameter_set

DOCUMENT = Path(__file__).parents[1] / "docs" / "parameter_sets.md"

#: Shifts beyond this many printed standard deviations are listed and marked.
LARGE = 3.0
_MARK = " *"

Rows = list[tuple[str, ...]]


def rows(twin: Twin) -> Rows:
    """Head, then for each base parameter its name, unit, printed value and standard deviation, twin's value, shift."""
    lines: Rows = [("parameter", "unit", "printed", "std", "twin", "shift [std]")]
    shifts = twin.printed.shifts(twin.base)
    for parameter in twin.model.base_parameters:
        name, value = parameter.name, f"{twin.base[parameter.name]:.4g}"
        printed = std = shift = "-"
        if name in shifts:
            printed = f"{twin.printed.values[name]:.4g}" + (" corrected" if name in twin.recipe.corrected else "")
            std = f"{twin.printed.std[name]:.2g}"
            shift = f"{shifts[name]:+z.2f}" + (_MARK if abs(shifts[name]) > LARGE else "")
        elif name in twin.recipe.given:
            printed = "assumed"
        lines.append((name, parameter.unit, printed, std, value, shift))
    return lines


def summary(twin: Twin) -> Iterator[str]:
    """What the table shows, in sentences."""
    count, distance = len(twin.printed.values), twin.printed.distance(twin.base)
    yield (
        f"Distance to the {count} printed values: {distance:.2f} standard deviations (root of the sum of squares), "
        f"{distance / count**0.5:.2f} root mean square. The smallest distance of any physically consistent set: "
        f"{twin.smallest_distance:.2f}. Weight of the assumed bodies: {WEIGHT:g}."
    )
    shifts = sorted(twin.printed.shifts(twin.base).items(), key=lambda item: -abs(item[1]))
    large = ", ".join(f"{name} {shift:+.1f}" for name, shift in shifts if abs(shift) > LARGE)
    yield f"Shifts beyond {LARGE:g} standard deviations: {large or 'none'}."
    masses = [twin.standard[f"M{number}"] for number in twin.recipe.bodies]
    yield f"Masses of the bodies [kg]: {', '.join(f'{mass:.0f}' for mass in masses)}; {sum(masses):.0f} in all."
    spread = [radii_of_gyration(of_body(number, twin.standard)).max() for number in twin.recipe.bodies]
    yield f"Largest radii of gyration [m]: {', '.join(f'{r:.2f}' for r in spread)}."
    least = [np.linalg.eigvalsh(of_body(number, twin.standard)).min() for number in twin.recipe.bodies]
    yield f"Smallest eigenvalues of their pseudo-inertias [SI]: {', '.join(f'{value:.2g}' for value in least)}."


def radii_of_gyration(P: Matrix) -> Matrix:
    """Root mean square distances [m] (3) of the mass from its centre along its principal axes, ascending."""
    centre = P[:3, 3] / P[3, 3]
    return np.sqrt(np.linalg.eigvalsh(P[:3, :3] / P[3, 3] - np.outer(centre, centre)))


def _terminal(rows: Rows) -> str:
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = ("  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)) for row in rows)
    return "\n".join(line.rstrip() for line in lines)


def _markdown(rows: Rows) -> str:
    head, *body = rows
    return table([dict(zip(head, row, strict=True)) for row in body]).replace(_MARK, " **large**")


def _documented(text: str, twin: Twin) -> str:
    """The document with the robot's part made anew."""
    return replaced(text, f"twin of {twin.robot.name}", "\n\n".join([*summary(twin), _markdown(rows(twin))]))


def main() -> None:
    """Derives, prints and writes."""
    document = DOCUMENT.read_text(encoding="utf-8")
    for name, recipe in RECIPES.items():
        twin, path = twin_of(name), find_robot(name)
        print(f"{name}: twin nearest to {recipe.table}", "", _terminal(rows(twin)), "", *summary(twin), "", sep="\n")
        text = path.read_text(encoding="utf-8")
        for one in (twin.rigid_set, twin.flexible_set):
            text = with_parameter_set(text, one)
        path.write_text(text, encoding="utf-8")
        document = _documented(document, twin)
    DOCUMENT.write_text(document, encoding="utf-8")


if __name__ == "__main__":
    main()
