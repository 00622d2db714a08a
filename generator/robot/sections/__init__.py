"""The sections of a robot file, one module each: from the tree that a reader made to parts of the description."""
