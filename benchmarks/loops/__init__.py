"""Loops over many samples that the batch functions are measured beside."""
