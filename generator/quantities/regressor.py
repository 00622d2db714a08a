"""Regressor of the base parameters (report eq. 3 to 5, 31, 37, 41)."""

from generator.quantities.regressors import dense_regressor

QUANTITY = dense_regressor(
    name="regressor",
    summary="Regressor of the base parameters: tau = W(q, qd, qdd) chi.",
    details="Report eq. 3 to 5, 31, 37, 41; columns in the order of the base parameters.",
    columns=lambda model: model.base_columns,
)
