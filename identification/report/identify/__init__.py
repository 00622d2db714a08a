"""The report of an identification with the inverse dynamic model."""
