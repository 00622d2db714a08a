"""All that a designed motion depends on beside the robot."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from generator.robot.description import Robot
from identification import recipes
from identification.default_sets import RIGID
from identification.excitation.criterion import DETERMINANT
from identification.excitation.noise import PART
from identification.recipes import Recipe


@dataclass(frozen=True)
class Request:
    """What is asked for of one motion.

    ``parameters`` names the set of the robot file that torques are computed from. The lowest of so many ``harmonics``
    has about ``frequency`` [Hz]; the run is logged for so many ``periods`` at ``rate`` [Hz]. ``speed`` [rad/s, m/s] and
    ``acceleration`` [rad/s2, m/s2] limit every joint beside what the file says.

    ``noise`` is the rms of the logged efforts' noise, one value or one a motor [A; N m or N without torque constants],
    none where it is empty; ``noise_part`` that of the model's error in parts of usual torques, which is ``PART`` where
    neither is given. ``recipe`` is the robot's own where None. So many ``evaluations`` by ``criterion`` are drawn by
    ``seed``.
    """

    parameters: str = RIGID
    frequency: float = 0.1
    harmonics: int = 5
    periods: int = 2
    rate: float = 1000.0
    speed: float | None = None
    acceleration: float | None = None
    noise: Sequence[float] = ()
    noise_part: float | None = None
    recipe: Recipe | None = None
    criterion: str = DETERMINANT
    evaluations: int = 20000
    seed: int = 0

    def filters_of(self, robot: Robot) -> Recipe:
        """How the run of a ``robot`` is to be filtered. Raises InputError for a recipe of its own that is wrong."""
        return self.recipe or recipes.recipe_of(robot.name)

    @property
    def rows(self) -> int:
        """Samples of a period, the nearest whole number: only then do logs repeat sample by sample."""
        return round(self.rate / self.frequency)

    @property
    def samples(self) -> int:
        """Of the run; the last one is the end of the last period, at rest again."""
        return self.periods * self.rows + 1

    @property
    def lowest(self) -> float:
        """The frequency [Hz] whose period is a whole number of samples."""
        return self.rate / self.rows

    @property
    def unexplained(self) -> float:
        """The model's error in parts of usual torques."""
        if self.noise_part is not None:
            return self.noise_part
        return 0.0 if self.noise else PART
