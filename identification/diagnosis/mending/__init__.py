"""From what was found to a robot file, its parameters and its code."""
