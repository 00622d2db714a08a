"""Laws of effects, one file each: LAW, a Law, and a docstring that says what it is."""
