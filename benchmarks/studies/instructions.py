"""Instructions per call of the functions that have a limit."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from benchmarks.instructions import FLAGS, instructions
from benchmarks.study import alone
from benchmarks.variants import variant
from generator.robot.description import Robot

TITLE = "Instructions per call"

ROTORS = ("rotor_inertia",)
FRICTION = ("rotor_inertia", "viscous_friction", "coulomb_friction")


@dataclass(frozen=True)
class Limit:
    """``function`` of the robot with those ``effects`` (None: all) may take ``most`` instructions."""

    function: str
    effects: tuple[str, ...] | None
    flexible: bool
    most: int

    @property
    def of(self) -> str:
        """What the robot has, in words."""
        return ", ".join(self.effects or ("all",)) + (", elastic axes" if self.flexible else "")

    def robot(self, name: str) -> Robot:
        return variant(name, self.effects, self.flexible)


LIMITS = (
    Limit("inverse_dynamics", ROTORS, False, 850),
    Limit("inertia_matrix", ROTORS, False, 553),
    Limit("direct_dynamics", FRICTION, False, 1227),
    Limit("regressor", ROTORS, False, 1305),
    Limit("flexible_direct_dynamics", FRICTION, True, 1294),
    Limit("inverse_dynamics", None, False, 958),
)


def run(build: Path) -> dict[str, object]:
    """A row for each limit and robot: what is counted with the code's own sine and cosine, and with <math.h>'s."""
    rows = []
    for number, limit in enumerate(LIMITS):
        robot, folder = limit.robot("kr500"), build / str(number)
        own = instructions(robot, [limit.function], folder)[limit.function]
        libm = instructions(robot, [limit.function], folder, flags=(*FLAGS, "-DKR500_USE_LIBM"))[limit.function]
        rows.append(
            {
                "function": limit.function,
                "effects": limit.of,
                "limit": limit.most,
                "own sine": own,
                "libm": libm,
            }
        )
    return {"rows": rows, "notes": [f"gcc {' '.join(FLAGS)}"]}


if __name__ == "__main__":
    import benchmarks.studies.instructions as study

    alone(__file__, study)
