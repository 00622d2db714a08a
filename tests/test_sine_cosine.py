"""The sine and cosine of the generated C: error bounds, symmetries, range, and where <math.h> takes over."""

from __future__ import annotations

import re
from pathlib import Path
from platform import machine

import numpy as np
import pytest

from benchmarks import sine_cosine_constants
from benchmarks.sine_cosine import SineCosine, exact, near_multiples, samples, sources
from generator import resources

#: Bounds that the header states: range [rad], units in the last place, absolute error.
BOUNDS = {"double": ((1e3, 2.0, 2.2e-16), (1e5, None, 2.2e-16)), "float": ((1e3, 2.0, 1.2e-7),)}
BITS = {"double": 53, "float": 24}
MODES = (
    ("-O2", "-ffp-contract=off"),
    ("-O3", "-ffp-contract=fast"),
    ("-O2", "-ffp-contract=fast", "-DWHEEL_LANES=1"),
    ("-O0",),
)


@pytest.fixture(scope="module")
def build(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return sources(tmp_path_factory.mktemp("wheel"))


@pytest.fixture(scope="module", params=["double", "float"])
def precision(request: pytest.FixtureRequest) -> str:
    return str(request.param)


def compiled(build: Path, precision: str, *flags: str) -> SineCosine:
    return SineCosine(build, flags=[*flags, *(["-DWHEEL_USE_FLOAT"] if precision == "float" else [])])


def test_errors_keep_their_bounds(build: Path, precision: str) -> None:
    functions = [compiled(build, precision, *flags) for flags in MODES]
    for limit, places, absolute in BOUNDS[precision]:
        x = samples(limit, 8000, precision == "float")
        references = exact(x)
        for function in functions:
            for reference, values in zip(references, function(x), strict=True):
                ulp, error = reference.errors(values, BITS[precision])
                assert error <= absolute
                assert places is None or ulp <= places


def test_next_to_multiples_of_half_pi_no_digit_is_lost(build: Path) -> None:
    x = near_multiples(1e3, single=False)
    sines, cosines = compiled(build, "double", "-O2")(x)
    smallest = np.minimum(np.abs(sines), np.abs(cosines))
    assert smallest.min() < 1e-16
    for reference, values in zip(exact(x), (sines, cosines), strict=True):
        assert reference.errors(values, 53)[0] <= 2.0


def test_zero_keeps_its_sign(build: Path, precision: str) -> None:
    sines, cosines = compiled(build, precision, "-O2")(np.array([0.0, -0.0]))
    assert (sines.tolist(), cosines.tolist()) == ([0.0, 0.0], [1.0, 1.0])
    assert np.signbit(sines).tolist() == [False, True]


def test_sine_is_odd_and_cosine_even_to_the_bit(build: Path, precision: str) -> None:
    function = compiled(build, precision, "-O2")
    x = samples(1e3, 4000, precision == "float")
    (sines, cosines), (mirrored_sines, mirrored_cosines) = function(x), function(-x)
    np.testing.assert_array_equal(mirrored_sines, -sines)
    np.testing.assert_array_equal(mirrored_cosines, cosines)


@pytest.mark.parametrize("quadrant", range(-9, 10))
def test_quadrants(build: Path, precision: str, quadrant: int) -> None:
    x = quadrant * np.pi / 2 + np.array([-0.7, 0.0, 0.7])
    sines, cosines = compiled(build, precision, "-O1")(x)
    tolerance = 1e-5 if precision == "float" else 1e-14
    np.testing.assert_allclose(sines, np.sin(x), rtol=0, atol=tolerance)
    np.testing.assert_allclose(cosines, np.cos(x), rtol=0, atol=tolerance)


def test_beyond_its_range_it_is_that_of_the_library(build: Path, precision: str) -> None:
    limit = BOUNDS[precision][-1][0]
    x = np.array([np.nextafter(np.float32(limit), np.float32(np.inf)), 1.5 * limit, -1e7, 3e22, 1e37], np.float64)
    for flags in (("-O2",), ("-O2", "-DWHEEL_LANES=1")):
        own, library = compiled(build, precision, *flags)(x), compiled(build, precision, "-O2", "-DWHEEL_USE_LIBM")(x)
        np.testing.assert_array_equal(own, library)


def test_the_limit_itself_is_within_the_range(build: Path, precision: str) -> None:
    """It differs from <math.h> somewhere below the limit: the guard does not send everything there."""
    x = samples(BOUNDS[precision][-1][0], 4000, precision == "float")
    own, library = compiled(build, precision, "-O2")(x), compiled(build, precision, "-O2", "-DWHEEL_USE_LIBM")(x)
    assert (np.array(own) != np.array(library)).any()


def test_infinities_and_nan_give_nan(build: Path, precision: str) -> None:
    sines, cosines = compiled(build, precision, "-O2")(np.array([np.inf, -np.inf, np.nan]))
    assert np.isnan(sines).all()
    assert np.isnan(cosines).all()


@pytest.mark.parametrize(
    "flag",
    [
        *("-ffast-math", "-D_M_FP_FAST", "-D__INTEL_COMPILER=2021", "-Dwheel_sin=sin", "-Dwheel_cos=cos"),
        pytest.param("-mfpmath=both", marks=pytest.mark.skipif(machine() != "x86_64", reason="a flag of x86-64")),
    ],
)
def test_where_sums_may_be_reordered_or_widened_or_one_is_given_the_library_is_taken(build: Path, flag: str) -> None:
    x = samples(1e3, 4000, single=False)
    taken = compiled(build, "double", "-O2", flag)(x)
    np.testing.assert_array_equal(taken, compiled(build, "double", "-O2", "-DWHEEL_USE_LIBM")(x))


def test_arithmetic_that_widens_half_precision_alone_is_good(build: Path) -> None:
    x = samples(1e3, 4000, single=False)
    widened = compiled(build, "double", "-O2", "-U__FLT_EVAL_METHOD__", "-D__FLT_EVAL_METHOD__=16")(x)
    np.testing.assert_array_equal(widened, compiled(build, "double", "-O2")(x))


def test_no_unsigned_number_is_negated(build: Path) -> None:
    """MSVC warns of it (C4146), and refuses it under /sdl."""
    assert not re.search(r"[&|^(=] -\(?number", (build / "wheel.c").read_text())


def test_a_sine_of_ones_own_leaves_the_cosine_alone(build: Path) -> None:
    sines, cosines = compiled(build, "double", "-O2", "-Dwheel_sin=-")(np.array([0.5, 2.0]))
    assert sines.tolist() == [-0.5, -2.0]
    np.testing.assert_allclose(cosines, np.cos([0.5, 2.0]), rtol=1e-15)


@pytest.mark.long
def test_constants_are_the_computed_ones() -> None:
    text = (resources.templates() / "c" / "sine_cosine.c.jinja").read_text()
    for precision in sine_cosine_constants.PRECISIONS:
        section = text.split(f'"{precision.name}": {{', 1)[1].split("\n    },", 1)[0]
        for name, literals in sine_cosine_constants.constants(precision).items():
            written = re.search(rf'"{name}": (\[.*?\]|".*?"),', section, re.DOTALL)
            assert written, name
            numbers = re.findall(r"\d\.\d+(?:e-\d+)?F?", written[1])
            assert numbers == [literal.removeprefix("-") for literal in literals]
