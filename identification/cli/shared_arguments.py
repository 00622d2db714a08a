"""Arguments that several commands of identification take, so that each has one name and one help text."""

from __future__ import annotations

import argparse
from pathlib import Path


def takes_data(parser: argparse.ArgumentParser) -> None:
    """--data, the runs that parameters are identified from."""
    parser.add_argument("--data", metavar="RUN", nargs="+", required=True, help="runs to identify from")


def takes_test(parser: argparse.ArgumentParser) -> None:
    """--test, the runs that are held out."""
    parser.add_argument("--test", metavar="RUN", nargs="+", default=[], help="runs to try the result on")


def takes_recipe(parser: argparse._ActionsContainer) -> None:
    """--recipe, in the place of the robot's or the command's own."""
    parser.add_argument("--recipe", metavar="FILE", type=Path, help="a YAML file with the filters' settings")
