"""The parameter sets ``twin`` and ``twin_flexible``: possible robots, as near to the report's tables as matter allows.

``python -m benchmarks.twins`` derives them, prints for each base parameter the printed value, the twin's and the shift in
printed standard deviations, and writes the sets into the robot files and the tables into docs/parameter_sets.md. With
``--check`` it writes nothing and fails where what is written differs.
"""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

import numpy as np

from generator.derivation import derive
from generator.resources import find_robot
from generator.robot.description import ParameterSet, ParameterValue, Robot
from generator.robot.readers import read
from generator.symbolic.model import Model
from identification.consistency import Estimate, Knowledge, grouped, nearest
from identification.pseudo_inertia import Matrix, of_body, uniform_bar
from identification.robot_file import rounded, with_parameter_set

DOCUMENT = Path(__file__).parents[1] / "docs" / "parameter_sets.md"

#: What a unit of divergence from the assumed bodies costs, in squared standard deviations.
WEIGHT = 0.3
#: Shifts beyond this many printed standard deviations are listed.
LARGE = 3.0


@dataclass(frozen=True)
class Recipe:
    """What a robot's twin is made from.

    ``table`` is the set that it is nearest to, ``corrected`` replaces misprints there, ``given`` is assumed exactly.
    ``bodies`` are assumed where the table says nothing. ``stiffness`` names the sets with measured k; the other axes get the
    frequency sqrt(k/Iam) of axis ``like``. ``gains`` tells whether the table identified drive gains, whose torque constants
    are then the twin's.
    """

    table: str
    bodies: Mapping[int, Matrix]
    stiffness: tuple[str, ...]
    like: int
    gains: bool
    corrected: Mapping[str, float] = field(default_factory=dict)
    given: Mapping[str, float] = field(default_factory=dict)


RECIPES = {
    "kr500": Recipe(
        table="report_table_13",
        bodies={
            1: uniform_bar(600, (0, 0, -0.3), (0.5, 0, 0.3), 0.5),
            2: uniform_bar(450, (0, 0, 0), (1.3, 0, 0), 0.35),
            3: uniform_bar(400, (0, 0.4, 0), (-0.055, -0.6, 0), 0.35),
            4: uniform_bar(120, (0, 0, 0.7), (0, 0, 0), 0.25),
            5: uniform_bar(80, (0, -0.15, 0), (0, 0.15, 0), 0.25),
            6: uniform_bar(40, (0, 0, 0), (0, 0, 0.1), 0.2),
        },
        stiffness=("report_table_15",),
        like=3,
        gains=False,
        given={"MX2R": 1.0e3},
    ),
    "kr270": Recipe(
        table="report_table_7",
        bodies={
            1: uniform_bar(300, (0, 0, -0.2), (0.35, 0, 0.2), 0.4),
            2: uniform_bar(200, (0, 0, 0), (1.25, 0, 0), 0.25),
            3: uniform_bar(200, (0, 0.3, 0), (0.055, -0.5, 0), 0.25),
            4: uniform_bar(60, (0, 0, 0.7), (0, 0, 0), 0.2),
            5: uniform_bar(40, (0, -0.1, 0), (0, 0.1, 0), 0.2),
            6: uniform_bar(20, (0, 0, 0), (0, 0, 0.1), 0.15),
        },
        stiffness=("report_table_9", "report_table_10"),
        like=2,
        gains=True,
        corrected={"K02": -7.38e3, "Fc6": 3.03e2},
    ),
}


@dataclass(frozen=True)
class Twin:
    """A robot's twin, derived by its recipe."""

    model: Model
    recipe: Recipe

    @property
    def robot(self) -> Robot:
        return self.model.robot

    @cached_property
    def printed(self) -> Estimate:
        """The table with its misprints corrected; a corrected value keeps its relative standard deviation."""
        table = self.robot.parameter_sets[self.recipe.table].values
        values = {name: self.recipe.corrected.get(name, one.value) for name, one in table.items()}
        return Estimate(values, {name: abs(v) * (table[name].relative_std or 0) / 100 for name, v in values.items()})

    @cached_property
    def completed(self) -> Estimate:
        """What the table leaves out as not essential is zero, to the widest standard deviation printed in its unit."""
        units = {parameter.name: parameter.unit for parameter in self.model.base_parameters}
        widest = {units[name]: max(s for n, s in self.printed.std.items() if units[n] == units[name]) for name in self.printed.std}
        absent = [
            name for name, unit in units.items()
            if unit in widest and name not in self.printed.values and name not in self.recipe.given
        ]
        return Estimate(
            dict(self.printed.values) | dict.fromkeys(absent, 0.0),
            dict(self.printed.std) | {name: widest[units[name]] for name in absent},
        )

    @cached_property
    def standard(self) -> dict[str, float]:
        """Standard parameters by name [SI], as they are written."""
        knowledge = Knowledge(self.recipe.bodies, WEIGHT, self.recipe.given)
        found = {name: rounded(value) for name, value in nearest(self.model, self.completed, knowledge).items()}
        flat = [n for n in self.recipe.bodies if np.linalg.eigvalsh(of_body(n, found)).min() <= 0]
        if flat:
            raise ArithmeticError(f"bodies {flat} are not possible once rounded")
        return found

    @cached_property
    def base(self) -> dict[str, float]:
        return grouped(self.model, self.standard)

    @cached_property
    def smallest_distance(self) -> float:
        """Distance of the nearest consistent set of all, whatever its bodies look like."""
        knowledge = Knowledge(self.recipe.bodies, 0.0, self.recipe.given)
        return self.printed.distance(grouped(self.model, nearest(self.model, self.printed, knowledge)))

    # -- the sets ---------------------------------------------------------------------------------------------------

    @property
    def sets(self) -> tuple[ParameterSet, ParameterSet]:
        """The rigid twin and the one with elastic drive trains."""
        table = self.robot.parameter_sets[self.recipe.table].source
        near = f"nearest physically consistent set to {table}"
        told = "completed as docs/parameter_sets.md tells; not measured"
        rigid = ParameterSet("twin", f"simulated twin, standard parameters: {near}, {told}", near, self._rigid())
        flexible = ParameterSet(
            "twin_flexible",
            "simulated twin with elastic drive trains, for the flexible model: the bodies and the balancer of twin, whose "
            "drive-train inertia, friction and offset sit on the motor side here; not measured",
            f"{near}; stiffness: {', '.join(self.robot.parameter_sets[name].source for name in self.recipe.stiffness)}",
            self._flexible(),
        )
        return rigid, flexible

    def _rigid(self) -> dict[str, ParameterValue]:
        units = {parameter.name: parameter.unit for parameter in self.model.standard_parameters}
        grouped_only = {name: "not identified apart from the bodies" for name in ("Ia1", "Ia2")}
        values = {
            name: ParameterValue(value, units[name], note=grouped_only.get(name, ""))
            for name, value in self.standard.items()
        }
        return values | self._torque_constants()

    def _flexible(self) -> dict[str, ParameterValue]:
        drive = re.compile(r"(Ia|Fv|Fc|Off)\d+")
        links = {name: value for name, value in self._rigid().items() if not drive.fullmatch(name) and name[:2] != "kt"}
        units = {parameter.name: parameter.unit for parameter in self.model.motor_parameters}
        motors = {}
        for joint in self.robot.flexible:
            for stem in ("Ia", "Fv", "Fc", "Off"):
                name = f"{stem}m{joint}"
                motors[name] = ParameterValue(self.standard[f"{stem}{joint}"], units[name])
            motors[f"k{joint}"] = self._stiffness(joint)
        return links | motors | self._torque_constants()

    def _stiffness(self, joint: int) -> ParameterValue:
        """The measured k, or the one that gives the drive train the frequency of the axis that it is like."""
        measured = {name: v for one in self.recipe.stiffness for name, v in self.robot.parameter_sets[one].values.items()}
        if f"k{joint}" in measured:
            return ParameterValue(measured[f"k{joint}"].value, "N m/rad")
        like = self.recipe.like
        k = measured[f"k{like}"].value * self.standard[f"Ia{joint}"] / self.standard[f"Ia{like}"]
        return ParameterValue(rounded(k), "N m/rad", note=f"assumed: the frequency sqrt(k/Iam) of axis {like}")

    def _torque_constants(self) -> dict[str, ParameterValue]:
        """Those with which the table's torques were made from currents."""
        drives = self.robot.drives
        assert drives is not None
        if not self.recipe.gains:
            constants = drives.torque_constants[drives.torque_constant]
            return {f"kt{j}": ParameterValue(float(kt), "N m/A") for j, kt in enumerate(constants, start=1)}
        gains = self.robot.parameter_sets[self.recipe.table].other_values
        return {
            f"kt{j}": ParameterValue(rounded(gains[f"g_tau{j}"].value / float(ratio)), "N m/A", note=f"g_tau{j} / N{j}{j}")
            for j, ratio in enumerate(drives.ratios, start=1)
        }


def twin_of(name: str) -> Twin:
    """The twin of the robot ``name`` of robots/."""
    return Twin(derive(read(find_robot(name)), names=()), RECIPES[name])


# -- what is printed --------------------------------------------------------------------------------------------------


def rows(twin: Twin) -> Iterator[tuple[str, ...]]:
    """Base parameter, unit, printed, its standard deviation, twin, shift; large shifts are starred."""
    yield "parameter", "unit", "printed", "std", "twin", "shift [std]"
    shifts = twin.printed.shifts(twin.base)
    for parameter in twin.model.base_parameters:
        name, value = parameter.name, f"{twin.base[parameter.name]:.4g}"
        if name in shifts:
            star = " *" if abs(shifts[name]) > LARGE else ""
            mark = " (corrected)" if name in twin.recipe.corrected else ""
            printed, std = f"{twin.printed.values[name]:.4g}{mark}", f"{twin.printed.std[name]:.2g}"
            yield name, parameter.unit, printed, std, value, f"{shifts[name]:+.2f}{star}"
        else:
            yield name, parameter.unit, "assumed" if name in twin.recipe.given else "-", "-", value, "-"


def summary(twin: Twin) -> Iterator[str]:
    """The distance, the large shifts, the bodies."""
    distance, smallest = twin.printed.distance(twin.base), twin.smallest_distance
    count = len(twin.printed.values)
    yield (
        f"Distance to the {count} printed values: {distance:.2f} standard deviations, {distance / count**0.5:.2f} root mean "
        f"square; the smallest of any physically consistent set is {smallest:.2f}."
    )
    shifts = sorted(twin.printed.shifts(twin.base).items(), key=lambda item: -abs(item[1]))
    large = [f"{name} {shift:+.1f}" for name, shift in shifts if abs(shift) > LARGE]
    yield f"Shifts beyond {LARGE:g} standard deviations: {', '.join(large) or 'none'}."
    masses = {n: twin.standard[f"M{n}"] for n in twin.recipe.bodies}
    yield f"Masses [kg]: {', '.join(f'body {n} {mass:.0f}' for n, mass in masses.items())}; {sum(masses.values()):.0f} in all."
    least = {n: np.linalg.eigvalsh(of_body(n, twin.standard)).min() for n in twin.recipe.bodies}
    yield f"Smallest eigenvalue of each pseudo-inertia: {', '.join(f'{value:.2g}' for value in least.values())}."


def _terminal(table: list[tuple[str, ...]]) -> str:
    widths = [max(len(row[k]) for row in table) for k in range(len(table[0]))]
    return "\n".join("  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip() for row in table)


def _markdown(twin: Twin) -> str:
    head, *body = rows(twin)
    lines = [f"| {' | '.join(head)} |", f"| {' | '.join('---' for _ in head)} |"]
    lines += [f"| {' | '.join(cell.replace(' *', ' **large**') for cell in row)} |" for row in body]
    return "\n\n".join([*summary(twin), "\n".join(lines)])


def _in_document(text: str, twin: Twin) -> str:
    """``text`` with the robot's part, between its two marks, made anew."""
    begin, end = f"<!-- begin {twin.robot.name} -->", "<!-- end -->"
    before, found, after = text.partition(begin)
    if not found:
        raise ValueError(f"{DOCUMENT.name} has no mark {begin}")
    return f"{before}{begin}\n\n{_markdown(twin)}\n\n{end}{after.partition(end)[2]}"


def main() -> int:
    """Derives, prints and writes; the exit status is 1 where --check finds a difference."""
    parser = argparse.ArgumentParser(description="derive the simulated twins of the report's robots")
    parser.add_argument("--check", action="store_true", help="write nothing, fail where what is written differs")
    check = parser.parse_args().check
    document = old_document = DOCUMENT.read_text(encoding="utf-8")
    changed = []
    for name in RECIPES:
        twin = twin_of(name)
        path = find_robot(name)
        text = old = path.read_text(encoding="utf-8")
        for one in twin.sets:
            text = with_parameter_set(text, one)
        print(f"\n{name}: twin nearest to {twin.recipe.table}\n\n{_terminal(list(rows(twin)))}\n")
        print("\n".join(summary(twin)))
        document = _in_document(document, twin)
        if text != old:
            changed.append(path)
            if not check:
                path.write_text(text, encoding="utf-8")
    if document != old_document:
        changed.append(DOCUMENT)
        if not check:
            DOCUMENT.write_text(document, encoding="utf-8")
    for path in changed:
        print(f"{'differs' if check else 'written'}: {path}")
    return int(check and bool(changed))


if __name__ == "__main__":
    sys.exit(main())
