"""CasADi's generated C as a library of the comparison: its pointer arrays behind the common signatures."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

_HEAD = """\
#include "{header}"
#include "peer.h"

static casadi_real parameters[{count} + 1];

int peer_load(const char *file)
{{
    return peer_read(file, parameters, {count} + 1) != {count};
}}
"""
_FUNCTION = """
void {function}(const double *q, const double *qd, const double *third, double *out)
{{
    static casadi_int iw[casadi_{function}_SZ_IW + 1];
    static casadi_real w[casadi_{function}_SZ_W + 1];
    const casadi_real *arg[casadi_{function}_SZ_ARG + 1] = {{ {arguments} }};
    casadi_real *res[casadi_{function}_SZ_RES + 1] = {{ out }};
    (void)q;
    (void)qd;
    (void)third;
    casadi_{function}(arg, res, iw, w, 0);
}}
"""


def wrapper(header: str, functions: Mapping[str, Sequence[str]], count: int) -> str:
    """The C that exports ``functions``, given with their arguments; ``count`` parameters are read from the file."""
    text = _HEAD.format(header=header, count=count)
    for function, arguments in functions.items():
        text += _FUNCTION.format(function=function, arguments=", ".join(arguments))
    return text
