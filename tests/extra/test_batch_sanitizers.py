"""The batch functions under the address and undefined-behaviour sanitizers: every array ends where its memory does."""

from __future__ import annotations

from pathlib import Path

import pytest

from generator.backends import batch, c
from generator.derivation import derive
from generator.resources import find_robot
from generator.robot.readers import read
from tests.compiled import run, write

_SANITIZERS = ("-g1", "-fsanitize=address,undefined", "-fno-sanitize-recover=all")

#: Every function for sizes around those of a tile, arrays from malloc and of no more than their size.
_PROGRAM = """
#include <stdio.h>
#include <stdlib.h>
#include "ROBOT_batch.h"

static ROBOT_real *array(size_t size)
{
    ROBOT_real *result = malloc((size ? size : 1) * sizeof(ROBOT_real));
    for (size_t i = 0; i < size; ++i) {
        result[i] = (ROBOT_real)((double)(i % 17) / 7.0 - 1.1);
    }
    return result;
}

int main(void)
{
    static const size_t sizes[] = { 0, 1, 7, 8, 9, 31, 129, 300 };
    const ROBOT_real taps[5] = { 1, 2, 3, 2, 1 };
    const ROBOT_filter filters[] = { { taps, 1, 1 }, { taps, 1, 3 }, { taps, 5, 2 }, { taps, 3, 40 } };
    ROBOT_params params;
    ROBOT_prepared model;
    for (int i = 0; i < MACRO_NPARAMETERS; ++i) {
        params.value[i] = 1;
    }
    ROBOT_prepare(&params, &model);
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; ++s) {
        const size_t n = sizes[s], square = (size_t)MACRO_NQ * MACRO_NGRAM * MACRO_NGRAM;
        ROBOT_real *q = array(n * MACRO_NQ), *qd = array(n * MACRO_NQ), *qdd = array(n * MACRO_NQ);
        ROBOT_real *tau = array(n * MACRO_NQ), *G = array(square), *work = array(MACRO_OBSERVATION_WORK);
        ROBOT_batch_inverse_dynamics(&model, n, q, qd, qdd, tau);
        for (size_t f = 0; f <= sizeof filters / sizeof *filters; ++f) {
            const ROBOT_filter *filter = f ? &filters[f - 1] : NULL;
            const size_t kept = ROBOT_filtered_count(filter, n), rows = kept * MACRO_NQ;
            const size_t stride = ROBOT_observation_stride(rows);
            ROBOT_real *W = array(rows * MACRO_NBASE), *C = array(stride * MACRO_NBASE), *y = array(rows);
            ROBOT_observation_matrix_rows(&model, filter, n, q, qd, qdd, W, MACRO_NBASE);
            ROBOT_observation_matrix_columns(&model, filter, n, q, qd, qdd, W, rows);
            ROBOT_observation_matrix_columns(&model, filter, n, q, qd, qdd, C, stride);
            ROBOT_batch_filter(filter, n, tau, y);
            ROBOT_observation_gram(&model, filter, n, q, qd, qdd, tau, G, work);
            ROBOT_observation_qr(&model, filter, n, q, qd, qdd, tau, G, work);
            free(W), free(C), free(y);
        }
        free(q), free(qd), free(qdd), free(tau), free(G), free(work);
    }
    puts("done");
    return 0;
}
"""


@pytest.mark.parametrize("options", [(), ("-DMACRO_STREAM_BYTES=0",), ("-DMACRO_BATCH_SCALAR", "-DMACRO_USE_FLOAT")])
@pytest.mark.parametrize(
    "name", ["scara", *(pytest.param(name, marks=pytest.mark.long) for name in ("kr500", "tree_two_arms"))]
)
def test_no_access_outside_of_the_arrays(name: str, options: tuple[str, ...], tmp_path: Path) -> None:
    model = derive(read(find_robot(name)), check=False)
    write(tmp_path, {**c.library(model, ()), **batch.emit(model)})
    program = _PROGRAM.replace("ROBOT", name).replace("MACRO", name.upper())
    (tmp_path / "main.c").write_text(program)
    defines = [option.replace("MACRO", name.upper()) for option in options]
    sources = [tmp_path / file for file in ("main.c", f"{name}.c", f"{name}_batch.c")]
    run(["gcc", "-std=c99", "-O1", *_SANITIZERS, *defines, *sources, "-o", tmp_path / "main", "-lm"])
    assert run([tmp_path / "main"]) == "done\n"
