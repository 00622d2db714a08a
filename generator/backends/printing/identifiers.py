"""Names that a target language accepts, each given once."""

from __future__ import annotations

import keyword
import re
from collections.abc import Iterable, Iterator
from itertools import count

_C = """
    auto break case char const continue default do double else enum extern float for goto if inline int long register
    restrict return short signed sizeof static struct switch typedef union unsigned void volatile while
    bool true false nullptr constexpr typeof asm fortran main errno
"""
_CPP = """
    alignas alignof and and_eq bitand bitor catch char8_t char16_t char32_t class co_await co_return co_yield compl
    concept const_cast consteval constinit decltype delete dynamic_cast explicit export friend mutable namespace new
    noexcept not not_eq operator or or_eq private protected public reinterpret_cast requires static_assert static_cast
    template this thread_local throw try typeid typename using virtual wchar_t xor xor_eq
"""
_MATH = """
    acos acosh asin asinh atan atan2 atanh cbrt ceil copysign cos cosh drem erf erfc exp exp10 exp2 expm1 fabs fdim
    finite floor fma fmax fmin fmod frexp gamma hypot ilogb isinf isnan j0 j1 jn ldexp lgamma log log10 log1p log2 logb
    lrint lround modf nan nearbyint pow remainder rint round scalb significand signgam sin sincos sinh sqrt tan tanh
    tgamma trunc y0 y1 yn
"""
_PREDEFINED = "I NULL NAN INFINITY HUGE_VAL linux unix i386 vax sun"

#: Macros of the templates of C.
_TEMPLATES = """
    AHEAD BLOCK EACH_LANE ENTRIES EVENTS FIRST INLINE LANE LANES LANES_BYTES NBASE NGRAM NQ NUMBER PART
    PARTS PITCH R REAL_BYTES SAMPLE SEARCHES SECOND SIZE SQUARES STREAM STREAM_END THREADS TILE TOLERANCE UNROLL
    WIDTH ZERO
"""

#: What C and C++ reserve, what <math.h> declares (a local of that name would shadow it), what compilers predefine, and
#: what the templates define.
C_RESERVED = frozenset(f"{_C} {_CPP} {_MATH} {_PREDEFINED} {_TEMPLATES}".split())

#: Keywords of Python and the built-in names that generated modules call.
PYTHON_RESERVED = frozenset(keyword.kwlist) | {"_", "tuple", "len", "enumerate", "zip", "float", "dict", "str", "int"}


class Identifiers:
    """The names taken in one scope."""

    def __init__(self, taken: Iterable[str]) -> None:
        self._taken = set(taken)
        self._temporaries = count(1)

    def claim(self, wish: str) -> str:
        """``wish`` if it is free, else ``wish_``, ``wish_v2``, ...; characters that no identifier has become _."""
        name = re.sub(r"\W", "_", wish, flags=re.ASCII)
        name = f"_{name}" if name[:1].isdigit() else name
        return self._first(candidate for candidate in _variants(name))

    def temporary(self) -> str:
        """The next free one of t1, t2, ..."""
        return self._first(f"t{number}" for number in self._temporaries)

    def _first(self, candidates: Iterator[str]) -> str:
        name = next(candidate for candidate in candidates if candidate not in self._taken)
        self._taken.add(name)
        return name


def _variants(name: str) -> Iterator[str]:
    yield name
    yield f"{name}_"
    yield from (f"{name}_v{number}" for number in count(2))
