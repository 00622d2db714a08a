"""Robots with a part of their effects, as measurements of generated code compare them."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

from generator.resources import find_robot
from generator.robot.description import Robot
from generator.robot.readers import read


def variant(name: str, effects: Collection[str] | None = None, flexible: bool = False) -> Robot:
    """The robot ``name`` with those of its effects alone (all, if None), elastic drive trains only if ``flexible``."""
    robot = read(find_robot(name))
    kept = tuple(use for use in robot.effects if effects is None or use.effect in effects)
    return replace(robot, effects=kept, flexible=robot.flexible if flexible else (), parameter_sets={})
