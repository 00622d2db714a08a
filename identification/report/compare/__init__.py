"""The report of a comparison of two sets of parameter values."""
