"""What the simulated twins of the report's robots are made from, and the twins themselves.

A twin is a possible robot, as near to a printed table as matter allows: each body can exist, each friction coefficient
is a loss. docs/parameter_sets.md tells what was completed and why.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from benchmarks.nearest_consistent import BaseValues, Knowledge, nearest
from generator.derivation import derive
from generator.resources import find_robot
from generator.robot.description import ParameterSet, ParameterValue, Robot
from generator.robot.readers import read
from generator.symbolic.model import Model
from generator.symbolic.pseudo_inertia import Matrix, of_body, uniform_bar
from identification.consistency import grouped
from identification.robot_file import rounded

#: What a unit of divergence from the assumed bodies costs, in squared standard deviations: the smallest, to one digit,
#: that leaves the KR500-2MT's first motor no lighter a rotor than the lightest that its table identifies.
WEIGHT = 0.3

#: Smaller amounts [SI] are the solver's rounding errors.
_NOISE = 5e-4

_DRIVE_TRAIN = ("Ia", "Fv", "Fc", "Off")


@dataclass(frozen=True)
class Recipe:
    """What a robot's twin is made from.

    ``table`` names the set that it is nearest to; ``corrected`` replaces misprints there, ``given`` is assumed exactly,
    and ``bodies`` [m, kg] are assumed where the table says nothing. ``stiffness`` names the sets with measured k; the
    other axes get the frequency sqrt(k/Iam) of axis ``like``. With ``gains`` the torque constants follow from the drive
    gains that were identified together with the table.
    """

    table: str
    bodies: Mapping[int, Matrix]
    stiffness: tuple[str, ...]
    like: int
    gains: bool = False
    corrected: Mapping[str, float] = field(default_factory=dict)
    given: Mapping[str, float] = field(default_factory=dict)


RECIPES = {
    "kr500": Recipe(
        table="report_table_13",
        bodies={
            1: uniform_bar(600, (0, 0, -0.3), (0.5, 0, 0.3), 0.4),
            2: uniform_bar(450, (0, 0, 0), (1.3, 0, 0), 0.3),
            3: uniform_bar(400, (0, 0.4, 0), (-0.055, -0.6, 0), 0.3),
            4: uniform_bar(120, (0, 0, 0.7), (0, 0, 0), 0.2),
            5: uniform_bar(80, (0, -0.15, 0), (0, 0.15, 0), 0.2),
            6: uniform_bar(40, (0, 0, 0), (0, 0, 0.1), 0.15),
        },
        stiffness=("report_table_15",),
        like=3,
        given={"MX2R": 1.0e3},
    ),
    "kr270": Recipe(
        table="report_table_7",
        bodies={
            1: uniform_bar(300, (0, 0, -0.2), (0.35, 0, 0.2), 0.3),
            2: uniform_bar(200, (0, 0, 0), (1.25, 0, 0), 0.2),
            3: uniform_bar(200, (0, 0.3, 0), (0.055, -0.5, 0), 0.2),
            4: uniform_bar(60, (0, 0, 0.7), (0, 0, 0), 0.15),
            5: uniform_bar(40, (0, -0.1, 0), (0, 0.1, 0), 0.15),
            6: uniform_bar(20, (0, 0, 0), (0, 0, 0.1), 0.1),
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
    def printed(self) -> BaseValues:
        """The table, its misprints corrected; a corrected value keeps its relative standard deviation."""
        table = self.robot.parameter_sets[self.recipe.table].values
        values = {name: self.recipe.corrected.get(name, one.value) for name, one in table.items()}
        std = {name: abs(value) * (table[name].relative_std or 0.0) / 100 for name, value in values.items()}
        return BaseValues(values, std)

    @cached_property
    def completed(self) -> BaseValues:
        """The table, and zero for what it leaves out as not essential, to the widest deviation printed in that unit."""
        units = {parameter.name: parameter.unit for parameter in self.model.base_parameters}
        widest: dict[str, float] = {}
        for name, std in self.printed.std.items():
            widest[units[name]] = max(std, widest.get(units[name], 0.0))
        settled = {*self.printed.values, *self.recipe.given}
        absent = {name: widest[unit] for name, unit in units.items() if name not in settled}
        return BaseValues({**self.printed.values, **dict.fromkeys(absent, 0.0)}, {**self.printed.std, **absent})

    @cached_property
    def standard(self) -> dict[str, float]:
        """Standard parameters by name [SI], rounded as they are written.

        Raises ArithmeticError where the rounding has made a body impossible.
        """
        knowledge = Knowledge(self.recipe.bodies, WEIGHT, self.recipe.given)
        solved = nearest(self.model, self.completed, knowledge)
        found = {name: rounded(value) for name, value in solved.items() if abs(value) > _NOISE}
        found = {name: found.get(name, 0.0) for name in solved}
        impossible = [n for n in self.recipe.bodies if np.linalg.eigvalsh(of_body(n, found)).min() <= 0]
        if impossible:
            raise ArithmeticError(f"bodies {impossible} of {self.robot.name} are not possible once rounded")
        return found

    @cached_property
    def base(self) -> dict[str, float]:
        """Base parameters by name [SI]."""
        return grouped(self.model, self.standard)

    @cached_property
    def smallest_distance(self) -> float:
        """Distance from the table to the nearest consistent set of all, whatever its bodies look like."""
        knowledge = Knowledge(self.recipe.bodies, 0.0, self.recipe.given)
        return self.printed.distance(grouped(self.model, nearest(self.model, self.printed, knowledge)))

    @property
    def rigid_set(self) -> ParameterSet:
        """The set ``twin``: standard parameters and torque constants."""
        return ParameterSet(
            "twin",
            f"simulated twin in standard parameters: the {self._nearness}, completed as docs/parameter_sets.md tells; "
            "not measured",
            self._nearness,
            {**self._standard_values, **self._torque_constants},
        )

    @property
    def flexible_set(self) -> ParameterSet:
        """The set ``twin_flexible``: the drive trains' parameters on the motor side, none on the links'."""
        links = {name: one for name, one in self._standard_values.items() if not self._of_drive_train(name)}
        stiffness = ", ".join(self.robot.parameter_sets[name].source for name in self.recipe.stiffness)
        return ParameterSet(
            "twin_flexible",
            "simulated twin for the model with elastic drive trains: the bodies and the balancer of twin, the inertia, "
            "friction and offset of its drive trains on the motor side; not measured",
            f"{self._nearness}; stiffness: {stiffness}",
            {**links, **self._motor_values, **self._torque_constants},
        )

    @property
    def _nearness(self) -> str:
        return f"nearest physically consistent set to {self.robot.parameter_sets[self.recipe.table].source}"

    @cached_property
    def _standard_values(self) -> dict[str, ParameterValue]:
        grouped_in = {name for base in self.model.grouping.base if not base.alone for _, name in base.terms}
        values = {}
        for parameter in self.model.standard_parameters:
            note = ""
            if parameter.name in grouped_in and self._of_drive_train(parameter.name):
                note = "assumed: identified only in sum with the bodies"
            values[parameter.name] = ParameterValue(self.standard[parameter.name], parameter.unit, note=note)
        return values

    @property
    def _motor_values(self) -> dict[str, ParameterValue]:
        values = {}
        for joint in self.robot.flexible:
            for stem in _DRIVE_TRAIN:
                values[f"{stem}m{joint}"] = self._standard_values[f"{stem}{joint}"]
            values[f"k{joint}"] = self._stiffness(joint)
        return values

    def _stiffness(self, joint: int) -> ParameterValue:
        """The measured k, or the one that gives the drive train the frequency of the axis that it is like."""
        sets = (self.robot.parameter_sets[name].values for name in self.recipe.stiffness)
        measured = {name: value for values in sets for name, value in values.items()}
        if f"k{joint}" in measured:
            return replace(measured[f"k{joint}"], relative_std=None, note="")
        like = self.recipe.like
        k = measured[f"k{like}"].value * self.standard[f"Ia{joint}"] / self.standard[f"Ia{like}"]
        return ParameterValue(float(f"{k:.3g}"), "N m/rad", note=f"assumed: the frequency sqrt(k/Iam) of axis {like}")

    @property
    def _torque_constants(self) -> dict[str, ParameterValue]:
        """Those that turn the table's torques into the currents they were made from."""
        drives = self.robot.drives
        assert drives is not None
        if self.recipe.gains:
            gains = self.robot.parameter_sets[self.recipe.table].other_values
            values = [gains[f"g_tau{j}"].value / float(ratio) for j, ratio in enumerate(drives.ratios, start=1)]
            notes = [f"g_tau{j} over the ratio N{j}" for j in range(1, len(values) + 1)]
        else:
            values = [float(kt) for kt in drives.torque_constants[drives.torque_constant]]
            notes = [f"the maker's, {drives.torque_constant}"] * len(values)
        return {
            f"kt{j}": ParameterValue(rounded(value), "N m/A", note=note)
            for j, (value, note) in enumerate(zip(values, notes, strict=True), start=1)
        }

    @staticmethod
    def _of_drive_train(name: str) -> bool:
        return re.fullmatch(rf"(?:{'|'.join(_DRIVE_TRAIN)})\d+", name) is not None


def twin_of(name: str) -> Twin:
    """The twin of the robot ``name`` of robots/."""
    return Twin(derive(read(find_robot(name)), names=()), RECIPES[name])
