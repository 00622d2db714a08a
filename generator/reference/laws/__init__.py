"""Laws of the effects on joints: a file of this folder gives ``LAWS`` by the effects' ids."""
