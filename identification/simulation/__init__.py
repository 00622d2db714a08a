"""Runs of a simulated robot as its controller would record them."""
