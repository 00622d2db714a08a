"""MuJoCo (Todorov et al. 2012), the library of its wheel: the inverse and the direct dynamics that it has."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

import numpy as np

from benchmarks.compiling import SHARED, C, Missing, compiled, compilers, package
from benchmarks.peers.library import SOURCES, Library
from benchmarks.peers.subject import Array, Chain, Link

NAME = "MuJoCo"

#: All that can be switched off and plays no part in free motion.
_OFF = (
    *("constraint", "equality", "frictionloss", "limit", "contact", "spring", "damper"),
    *("actuation", "sensor", "warmstart", "island", "autoreset", "eulerdamp"),
)


def build(subject: Chain, folder: Path) -> list[Library]:
    """The wheel's library behind a few lines of our own."""
    place = package("mujoco", "mujoco")
    library = next(iter(sorted(place.glob("libmujoco.*"))), None)
    if library is None:
        raise Missing("the shared library of the Python package mujoco")
    options = [*SHARED, f"-I{place / 'include'}", str(library), f"-Wl,-rpath,{place}"]
    path = compiled(compilers()[0], C, folder.parent / "mujoco.so", [SOURCES / "mujoco.c"], options)
    data = folder / "mujoco.xml"
    data.write_text("\n".join(_model(subject)) + "\n")
    return [Library(NAME, "as in its wheel", path, data, ("inverse_dynamics", "direct_dynamics"))]


def _model(subject: Chain) -> Iterable[str]:
    gravity = _words([float(g) for g in subject.robot.gravity])
    yield '<mujoco><compiler angle="radian" autolimits="false"/>'
    off = " ".join(f'{name}="disable"' for name in _OFF)
    yield f'<option gravity="{gravity}"><flag {off}/></option>'
    yield "<worldbody>"
    for link in subject.links:
        mass, *others = subject.body(link)
        first, (xx, xy, yy, xz, yz, zz) = np.array(others[:3]), others[3:]
        centre = first / mass
        about_origin = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        tensor = about_origin - mass * (centre @ centre * np.eye(3) - np.outer(centre, centre))
        six = [tensor[i, k] for i, k in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))]
        yield f'<body pos="{_words(link.position)}" quat="{_words(_quaternion(link))}">'
        yield f'<inertial mass="{mass!r}" pos="{_words(centre)}" fullinertia="{_words(six)}"/>'
        kind = "slide" if link.prismatic else "hinge"
        yield f'<joint type="{kind}" axis="0 0 1" armature="{subject.rotor(link)!r}"/>'
    yield "</body>" * len(subject.links)
    yield "</worldbody></mujoco>"


def _words(values: Array | list[float]) -> str:
    return " ".join(repr(float(value)) for value in values)


def _quaternion(link: Link) -> Array:
    """The unit quaternion (w, x, y, z) of a rotation: the eigenvector of Bar-Itzhack's matrix."""
    (a, b, c), (d, e, f), (g, h, i) = link.rotation
    K = np.array(
        [
            [a + e + i, h - f, c - g, d - b],
            [h - f, a - e - i, b + d, c + g],
            [c - g, b + d, e - a - i, f + h],
            [d - b, c + g, f + h, i - a - e],
        ]
    )
    return np.array(np.linalg.eigh(K)[1][:, -1])
