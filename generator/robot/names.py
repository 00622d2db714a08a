"""Names that can stand in generated C, C++ and Python as they are."""

from __future__ import annotations

import keyword
import re
import sys

from generator.errors import InputError
from generator.robot.document import Text

_MAX_LENGTH = 31  # significant characters of an external identifier in C99

_IDENTIFIER = re.compile(r"[A-Za-z][A-Za-z0-9_]*\Z", re.ASCII)

_C = """auto break case char const continue default do double else enum extern float for goto if inline int long
register restrict return short signed sizeof static struct switch typedef union unsigned void volatile while
alignas alignof bool constexpr false nullptr static_assert thread_local true typeof typeof_unqual asm fortran"""

_CPP = """and and_eq bitand bitor catch char16_t char32_t char8_t class compl concept const_cast consteval
constinit co_await co_return co_yield decltype delete dynamic_cast explicit export friend mutable namespace new
noexcept not not_eq operator or or_eq private protected public reinterpret_cast requires static_cast template
this throw try typeid typename using virtual wchar_t xor xor_eq"""

_MATHEMATICS = """acos acosh asin asinh atan atan2 atanh cbrt ceil copysign cos cosh erf erfc exp exp2 expm1 fabs fdim
floor fma fmax fmin fmod frexp hypot ilogb ldexp lgamma log log10 log1p log2 logb lrint lround modf nan nearbyint
nextafter pow remainder remquo rint round scalbn signbit sin sinh sqrt tan tanh tgamma trunc j0 j1 jn y0 y1 yn
NAN INFINITY HUGE_VAL"""

C_KEYWORDS, CPP_KEYWORDS = frozenset(_C.split()), frozenset(_CPP.split())

#: Functions and macros of <math.h>.
C_MATHEMATICS = frozenset(_MATHEMATICS.split())

#: The other names of the C headers that generated code includes.
_C_LIBRARY = """abs assert errno main math memcpy memset printf size_t strlen float32_t float64_t NULL EOF EXIT_SUCCESS
EXIT_FAILURE"""

_PYTHON = """casadi numpy np math sympy"""

#: Headers of the C library, which a robot's own would hide.
_HEADERS = """complex ctype features fenv float inttypes iso646 limits locale setjmp signal stdalign stdarg stdatomic
stdbool stddef stdint stdio stdlib stdnoreturn string tgmath threads time uchar wchar wctype"""

_HIDDEN = {*_HEADERS.split(), "cffi"} | sys.stdlib_module_names

#: Targets that CMake makes by itself, and a library that the robot's own links.
_CMAKE = "all clean depend edit_cache help install m package rebuild_cache test"

_RESERVED = {
    **dict.fromkeys(_PYTHON.split(), "a module of the generated Python"),
    **dict.fromkeys([*C_MATHEMATICS, *_C_LIBRARY.split()], "a name of the C library"),
    **dict.fromkeys([*keyword.kwlist, *keyword.softkwlist], "a Python keyword"),
    **dict.fromkeys(CPP_KEYWORDS, "a C++ keyword"),
    **dict.fromkeys(C_KEYWORDS, "a C keyword"),
}


def identifier(text: Text, what: str) -> str:
    """The name that ``text`` gives to ``what``.

    Raises InputError unless it is an identifier that no language of the generated code keeps for itself.
    """
    name = text.content
    if not _IDENTIFIER.match(name):
        raise InputError(text.place, f"{what} {name!r} is not an identifier", "letters, digits and _, a letter first")
    if len(name) > _MAX_LENGTH:
        raise InputError(text.place, f"{what} {name!r} is {len(name)} characters long", f"at most {_MAX_LENGTH}")
    if "__" in name:
        raise InputError(text.place, f"{what} {name!r} is reserved in C++", "a name without two _ in a row")
    if name in _RESERVED:
        raise InputError(text.place, f"{what} {name!r} is {_RESERVED[name]}", "another name")
    return name


def robot_name(text: Text) -> str:
    """The name that ``text`` gives to a robot, after which files, functions and a target of CMake are called.

    Raises InputError as ``identifier`` and ``check_name`` do.
    """
    name = identifier(text, "robot name")
    check_name(text)
    return name


def check_name(text: Text) -> None:
    """Raises InputError where code cannot be called after the robot name ``text``: for a _ at the end, a name that a
    language keeps for itself, a target of CMake, a header or a module.
    """
    name = text.content
    if name.endswith("_"):
        raise InputError(text.place, f"robot name {name!r} makes names that are reserved in C++", "no _ at the end")
    if name in _CMAKE.split():
        raise InputError(text.place, f"robot name {name!r} is a target of CMake", "another name")
    if name in _RESERVED:
        raise InputError(text.place, f"robot name {name!r} is {_RESERVED[name]}", "another name")
    if name in _HIDDEN:
        raise InputError(text.place, f"robot name {name!r} is a header of C or a module of Python", "another name")
