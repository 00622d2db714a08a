"""The report of an identification of stiffness."""
