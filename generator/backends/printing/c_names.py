"""Names that the C sources of a robot define outside of functions, which no parameter's constant may have."""

from __future__ import annotations

from collections.abc import Iterator

from generator.backends.printing.c_functions import MATHEMATICS
from generator.backends.printing.runge_kutta import METHODS
from generator.symbolic.model import Model

#: Macros and constants, behind the robot's name in capitals.
_MACROS = """
    H NQ NPARAMETERS NSTANDARD USE_FLOAT USE_LIBM LANES STATIC_ASSERT BATCH_H BATCH_SCALAR NBASE NGRAM OBSERVATION_WORK
    STREAM_BYTES SIMULATION_H RIGID_SIZE FLEXIBLE_SIZE CONTACT_FREE CONTACT_SLIDING CONTACT_STUCK
"""
#: Types and functions that templates write out, behind the robot's name.
_WRITTEN = """
    real params prepared prepare size sign directed sines_cosines library_sines_cosines params_has_no_padding
    prepared_has_no_padding has_the_precision_of_casadi selftest batch_filter batch_inverse_dynamics filter
    filtered_count observation_gram observation_matrix_columns observation_matrix_rows observation_qr
    observation_stride lanes bits lane_bits finite contact control controller controller_state integration run_log
    method reference
"""
#: What the type and the functions of a simulation are called, behind the robot's name and what is simulated.
_SIMULATED = ("rigid", "flexible")
_OF_SIMULATION = """
    state start advance simulate accelerations catch hold load located margin rates release rubs search slide
    solve step stick surfaces trial
"""
#: What follows the name of a function of CasADi's external.
_OF_EXTERNAL = ("", "_n_in", "_n_out", "_name_in", "_name_out", "_sparsity_in", "_sparsity_out", "_work")


def taken(model: Model) -> Iterator[str]:
    """Names of macros, types and functions; a robot named in capitals has one prefix for all of them."""
    prefix, functions = model.robot.name, model.functions
    methods = [method.name for method in METHODS]
    yield from (f"{prefix.upper()}_{word}" for word in _MACROS.split())
    yield from (f"{prefix}_{word}" for word in (*_WRITTEN.split(), *MATHEMATICS, *functions))
    yield from (f"{prefix}_{name}_sparsity" for name in functions)
    yield from (size_constant(prefix, name) for name in functions)
    yield from (f"{prefix}_casadi_{name}{end}" for name in functions for end in _OF_EXTERNAL)
    yield from (f"{prefix}_params_{name}" for name in model.robot.parameter_sets)
    yield from (f"{prefix}_{plant}_{word}" for plant in _SIMULATED for word in (*_OF_SIMULATION.split(), *methods))
    yield from (f"{prefix.upper()}_METHOD_{name.upper()}" for name in methods)
    yield f"{prefix}_has_{len(model.parameters)}_parameters"


def size_constant(prefix: str, function: str) -> str:
    """The macro that tells how many entries a packed ``function`` computes."""
    return f"{prefix.upper()}_{function.upper()}_SIZE"
