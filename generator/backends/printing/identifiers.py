"""Names that a target language accepts, each given once."""

from __future__ import annotations

import keyword
import re
from collections.abc import Iterable, Iterator
from itertools import count

from generator.robot.names import C_KEYWORDS, C_MATHEMATICS, CPP_KEYWORDS

#: What the GNU library's <math.h> declares beyond the standard.
_GNU_MATHEMATICS = "drem exp10 finite gamma isinf isnan scalb significand signgam sincos"
_PREDEFINED = "I linux unix i386 vax sun"
#: What other headers define.
_DEFINED = "NULL main errno"

#: Macros of the templates of C.
_TEMPLATES = """
    AHEAD BLOCK EACH_LANE ENTRIES EVENTS FIRST INLINE LANE LANES LANES_BYTES NBASE NGRAM NQ NUMBER PART
    PARTS PITCH R REAL_BYTES SAMPLE SEARCHES SECOND SIZE SQUARES STREAM STREAM_END THREADS TILE TOLERANCE UNROLL
    WIDTH ZERO
"""

#: What C and C++ reserve, what <math.h> declares (a local of that name would shadow it), what compilers predefine, and
#: what the templates define.
C_RESERVED = (
    C_KEYWORDS | CPP_KEYWORDS | C_MATHEMATICS | set(f"{_GNU_MATHEMATICS} {_PREDEFINED} {_DEFINED} {_TEMPLATES}".split())
)

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
