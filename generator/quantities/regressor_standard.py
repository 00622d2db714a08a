"""Regressor of the standard parameters (report eq. 3, 4)."""

from generator.quantities.regressors import dense_regressor

QUANTITY = dense_regressor(
    name="regressor_standard",
    summary="Regressor of the standard parameters: tau = W(q, qd, qdd) chi.",
    details="Report eq. 3 to 5, 31, 32, 37, 38; columns in the order of the standard parameters.",
    columns=lambda model: model.standard_columns,
)
