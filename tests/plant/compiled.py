"""The C core: put together from c/ and the laws, compiled once per content into a folder for temporary files, and
bound.
"""

from __future__ import annotations

import ctypes
import hashlib
import os
import subprocess
import tempfile
from functools import cache
from pathlib import Path

from tests.plant.library import LAWS, TORQUES

JOINTS, EFFECTS, VALUES, STATES = 8, 64, 12, 12
_C = Path(__file__).resolve().parent / "c"
# Contraction is off so that every compiler rounds alike.
_FLAGS = ("-std=c99", "-O3", "-ffp-contract=off", "-fno-math-errno", "-Wall", "-Wextra", "-shared", "-fPIC")

_Real, _Whole = ctypes.c_double, ctypes.c_int
_Each = _Real * JOINTS
_Square = _Each * JOINTS


class CEffect(ctypes.Structure):
    """struct effect of c/plant.h."""

    _fields_ = (
        *((name, _Whole) for name in ("law", "joint", "other", "unused")),
        ("weight", _Each),
        ("size", _Real),
        ("value", _Real * VALUES),
        ("state", _Real * STATES),
        ("torque", _Real),
    )


class CPlant(ctypes.Structure):
    """struct plant of c/plant.h."""

    _fields_ = (
        ("n", _Whole),
        ("effects", _Whole),
        ("prismatic", _Whole * JOINTS),
        ("flexible", _Whole * JOINTS),
        ("dh", (_Real * 4) * JOINTS),
        ("body", (_Real * 10) * JOINTS),
        ("gravity", _Real * 3),
        ("rotor", _Square),
        *((name, _Each) for name in ("stiffness", "damping", "gap")),
        *((name, _Square) for name in ("ratio", "inverse")),
        *((name, _Each) for name in ("constant", "gain", "limit", "heat_drop", "heat_time", "heat_current", "heat")),
        *((name, _Each) for name in ("encoder_step", "encoder_scale", "encoder_offset")),
        *((name, _Each) for name in ("inertia", "position_gain", "speed_gain", "integral_gain")),
        *((name, _Real) for name in ("lag", "speed_filter", "start_time")),
        ("effect", CEffect * EFFECTS),
    )


def laws_in_c() -> str:
    """The laws' torques as one C file."""
    functions, cases = [], []
    for number, name in enumerate(TORQUES):
        law = LAWS[name]
        values = "".join(f"    const double {value} = e->value[{k}];\n" for k, value in enumerate(law.values))
        unused = " ".join(f"(void){name};" for name in law.values)
        functions.append(f"static double {name}(SEEN)\n{{\n{values}    SEEN_UNUSED {unused}\n{law.torque}\n}}\n")
        cases.append(f"    case {number}: return {name}(GIVEN);")
    friction, links = (
        ", ".join(str(int(getattr(LAWS[name], key))) for name in TORQUES) for key in ("friction", "of_links")
    )
    template = (_C / "laws.c.in").read_text(encoding="utf-8")
    parts = {"FUNCTIONS": "\n".join(functions), "CASES": "\n".join(cases), "FRICTION": friction, "LINKS": links}
    for key, text in parts.items():
        template = template.replace(f"@{key}@", text)
    return template


@cache
def library() -> ctypes.CDLL:
    """The compiled core; raises CalledProcessError, with the compiler's words, where it does not compile."""
    sources = {path.name: path.read_text(encoding="utf-8") for path in sorted(_C.glob("*.[ch]"))} | {
        "laws.c": laws_in_c()
    }
    compiler = os.environ.get("CC", "cc")
    content = "\0".join([compiler, *_FLAGS, *(part for item in sources.items() for part in item)])
    key = hashlib.sha256(content.encode()).hexdigest()[:24]
    place = Path(tempfile.gettempdir()) / f"counterpoise-plant-{os.getuid()}"
    place.mkdir(mode=0o700, exist_ok=True)
    target = place / f"{key}.so"
    if not target.exists():
        with tempfile.TemporaryDirectory(dir=place) as folder:
            for name, text in sources.items():
                (Path(folder) / name).write_text(text, encoding="utf-8")
            units = [name for name in sources if name.endswith(".c") and name != "parts.c"]
            subprocess.run([compiler, *_FLAGS, *units, "-o", "plant.so", "-lm"], cwd=folder, check=True)
            # In one move, so that no other process loads half a file.
            (Path(folder) / "plant.so").replace(target)
    loaded = ctypes.CDLL(str(target))
    loaded.plant_state.restype = _Real
    return loaded
