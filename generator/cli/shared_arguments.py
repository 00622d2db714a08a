"""Arguments that several commands take, so that each has one name and one help text."""

from __future__ import annotations

import argparse
from pathlib import Path


def takes_robot(parser: argparse.ArgumentParser) -> None:
    """ROBOT, as ``find_robot`` takes it."""
    parser.add_argument("robot", metavar="ROBOT", help="a name in robots/ or the path of a robot file")


def takes_out(parser: argparse.ArgumentParser, text: str, metavar: str = "DIR", default: Path | None = None) -> None:
    """--out, where files go."""
    parser.add_argument("--out", metavar=metavar, type=_path, default=default, help=text)


def _path(given: str) -> Path:
    """A path that is not empty, which would be the folder at hand."""
    if not given:
        raise argparse.ArgumentTypeError("it is empty; . is the folder at hand")
    return Path(given)
