"""The report of a designed motion."""
