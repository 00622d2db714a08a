"""Every quantity once more, as plain numbers and by another road: Lagrange's equations in homogeneous coordinates.

Nothing here knows the symbolic recursions: the generated code's self-test takes its expected values from this package.
Functions take and return object arrays of Decimal (see ``arithmetic``) in SI units; ``quantities.reference`` is the
door for callers who have and want floats.
"""
