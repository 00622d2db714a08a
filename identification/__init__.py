"""From recorded runs to parameters, drive gains, stiffness, and the effects that a model lacks."""
