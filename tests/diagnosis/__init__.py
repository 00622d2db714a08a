"""The diagnosis: on data made by hand, by the plant, and on what neither has."""
