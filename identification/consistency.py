"""What makes standard parameters physically consistent, as terms of a semidefinite program.

Least squares knows nothing of matter: it may find an inertia that no body can have. Here every body's pseudo-inertia P
is positive semidefinite and every drive-train inertia, friction coefficient and stiffness keeps its sign (Sousa and
Cortesao 2014, IJRR 33(6), 931-944; Wensing, Kim and Slotine 2018, IEEE RA-L 3(1), 60-67). What an estimate leaves open
is settled by the divergence of P from a prior body's P0, tr(P0^-1 P) - log det(P0^-1 P) - 4, which is zero at P0 and
grows without bound towards bodies that are flat or without mass (Lee, Wensing and Park 2020, IEEE T-RO 36(2), 348-365).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, TypeAlias

import cvxpy
import numpy as np

from generator.symbolic.model import Model
from generator.symbolic.pseudo_inertia import Matrix, basis

#: The package's own types leave out most of its functions.
cp: Any = cvxpy
Expression: TypeAlias = Any


def grouped(model: Model, standard: Mapping[str, Expression]) -> dict[str, Expression]:
    """Base parameters by name from standard ones, numbers [SI] or expressions of them."""
    groupings = model.grouping.numeric()
    return {base: sum(c * standard[name] for name, c in terms.items()) for base, terms in groupings.items()}


def relative_to(prior: Matrix, ten: Sequence[Expression]) -> Expression:
    """L^-1 P L^-T (4 x 4) of ``ten`` inertial parameters, P0 = L L^T: the identity where the body is the prior one."""
    inverse = np.linalg.inv(np.linalg.cholesky(prior))
    units = [inverse @ unit @ inverse.T for unit in basis()]
    return cp.sum([parameter * unit for parameter, unit in zip(ten, units, strict=True)])


def divergence(relative: Sequence[Expression]) -> Expression:
    """Sum of the bodies' divergences from their prior ones, each given ``relative_to`` it (4 x 4)."""
    return cp.sum([cp.trace(X) - cp.log_det(X) - 4 for X in relative])


def possible(model: Model, s: Mapping[str, Expression], relative: Sequence[Expression]) -> list[Expression]:
    """Constraints: bodies, each given ``relative_to`` any other, can be; standard parameters ``s`` keep their signs."""
    constraints = [X >> 0 for X in relative]
    constraints += [s[p.name] >= p.lower for p in model.standard_parameters if p.lower is not None]
    constraints += [s[p.name] <= p.upper for p in model.standard_parameters if p.upper is not None]
    return constraints
