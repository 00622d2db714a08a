"""Errors of the generated sine and cosine by range, compiler and contraction."""

from __future__ import annotations

import shutil
from pathlib import Path

from benchmarks.sine_cosine import SineCosine, exact, samples, sources
from benchmarks.study import alone

TITLE = "Errors of sine and cosine"

#: Ranges [rad]; the last one is where the kernel ends.
RANGES = {"double": (0.8, 10.0, 1e3, 1e5), "float": (0.8, 10.0, 1e3)}
_BITS = {"double": 53, "float": 24}
_SIZE = 20000
_MODES = {
    "contracted": ("-ffp-contract=fast", "-march=haswell"),
    "not contracted": ("-ffp-contract=off",),
    "one by one": ("-ffp-contract=off", "-DWHEEL_LANES=1"),
    "libm": ("-DWHEEL_USE_LIBM",),
}


def run(build: Path) -> dict[str, object]:
    """A row for each precision, range, compiler and mode: the largest errors of sine and cosine."""
    sources(build)
    compilers = [name for name in ("gcc", "clang") if shutil.which(name)]
    rows: list[dict[str, object]] = []
    for precision, ranges in RANGES.items():
        macro = ["-DWHEEL_USE_FLOAT"] if precision == "float" else []
        built = {
            (compiler, mode): SineCosine(build, compiler, ("-O2", *flags, *macro))
            for compiler in compilers
            for mode, flags in _MODES.items()
        }
        for limit in ranges:
            x = samples(limit, _SIZE, precision == "float")
            references = exact(x)
            for (compiler, mode), function in built.items():
                pairs = zip(references, function(x), strict=True)
                errors = [reference.errors(values, _BITS[precision]) for reference, values in pairs]
                rows.append(
                    {
                        "precision": precision,
                        "up to [rad]": limit,
                        "compiler": compiler,
                        "mode": mode,
                        "sine [ulp]": round(errors[0][0], 2),
                        "cosine [ulp]": round(errors[1][0], 2),
                        "absolute": float(f"{max(absolute for _, absolute in errors):.2g}"),
                    }
                )
    others = "others of every magnitude and next to multiples of pi/2"
    return {"rows": rows, "notes": [f"{_SIZE} uniform samples, {others}"]}


if __name__ == "__main__":
    import benchmarks.studies.sine_cosine as study

    alone(__file__, study)
