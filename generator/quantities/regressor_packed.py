"""Structural nonzeros of the regressor of the base parameters."""

from generator.quantities.regressors import packed_regressor

QUANTITY = packed_regressor(
    name="regressor_packed",
    summary="Structural nonzeros of the base regressor, row by row.",
    details="Report eq. 3 to 5, 31, 37, 41; zeros that the robot's structure makes are not stored.",
    columns=lambda model: model.base_columns,
)
