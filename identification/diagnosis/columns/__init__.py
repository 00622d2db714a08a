"""Columns that may explain what the model leaves, and least squares on them."""
