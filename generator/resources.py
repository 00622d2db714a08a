"""Finding the data files: robots, recipes and templates, in a checkout or in an installed package."""

from __future__ import annotations

import difflib
import os
from pathlib import Path

from generator.errors import InputError, Place

#: Names a folder that holds ``robots``, ``recipes`` and ``templates`` and comes before all others.
OVERRIDE = "COUNTERPOISE_DATA"


def data_folder(name: str) -> Path:
    """The folder ``robots``, ``recipes`` or ``templates``: the environment's override, then the checkout, then the
    package's own.

    A folder that the override lacks is taken from the next place.
    """
    package = Path(__file__).resolve().parent
    places = [package / "_data"]
    if (package.parent / "pyproject.toml").is_file() and (package.parent / "robots").is_dir():
        places.insert(0, package.parent)
    if override := os.environ.get(OVERRIDE):
        places.insert(0, Path(override))
    return next((place / name for place in places if (place / name).is_dir()), places[-1] / name)


def templates() -> Path:
    """The folder with one folder of templates per output language."""
    return data_folder("templates")


def robots() -> list[Path]:
    """The robot files that ``find_robot`` knows by name, sorted."""
    endings = _endings()
    files = (path for path in data_folder("robots").glob("*") if path.suffix.lower() in endings)
    return sorted(path for path in files if path.is_file())


def find_robot(name_or_path: str) -> Path:
    """The robot file of a name in ``robots/`` or of a path (with a separator, or with a robot file's ending).

    Raises InputError where there is none.
    """
    path = Path(name_or_path)
    if path.suffix.lower() in _endings() or "/" in name_or_path or os.sep in name_or_path:
        if not os.path.exists(path):
            raise InputError(Place(name_or_path), "there is no such file", "the path of a robot file")
        return path
    known = {robot.stem: robot for robot in robots()}
    if name_or_path in known:
        return known[name_or_path]
    near = difflib.get_close_matches(name_or_path, known, n=1)
    perhaps = f"perhaps {near[0]}, else " if near else ""
    raise InputError(
        Place(name_or_path or "ROBOT"),
        f"there is no robot {name_or_path!r}",
        f"{perhaps}one of {', '.join(known)} or the path of a robot file",
    )


def _endings() -> tuple[str, ...]:
    """The endings of the files' names that a reader takes."""
    # Readers take as long to import as all the rest of a command that reads no robot.
    from generator.robot.readers import endings

    return endings()
