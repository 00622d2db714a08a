"""Structural nonzeros of the regressor of the standard parameters."""

from generator.quantities.regressors import packed_regressor

QUANTITY = packed_regressor(
    name="regressor_standard_packed",
    summary="Structural nonzeros of the standard regressor, row by row.",
    details="Report eq. 3 to 5, 31, 32, 37, 38; zeros that the robot's structure makes are not stored.",
    columns=lambda model: model.standard_columns,
)
