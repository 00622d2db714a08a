"""A simulated robot whose first drive train may be soft: its compliance [rad/(N m)] and its rotor [kg m2]."""

from __future__ import annotations

from tests.plant.effect import Effect
from tests.plant.robots import ROBOTS

NAME = "scara_like"
COMPLIANCE = Effect("joint_flexibility", 1).amount(ROBOTS[NAME])
ROTOR = ROBOTS[NAME].chain[0].rotor
