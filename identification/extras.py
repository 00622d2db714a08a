"""Packages that only an extra of the distribution brings."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from generator.errors import InputError, Place


@contextmanager
def needing(place: Place, extra: str = "identification") -> Iterator[None]:
    """Around imports; raises InputError at ``place`` where a package is not installed that ``extra`` would bring."""
    try:
        yield
    except ModuleNotFoundError as error:
        expected = f"make setup or pip install '.[{extra}]' in the checkout"
        raise InputError(place, f"{error.name} is not installed", expected) from None
