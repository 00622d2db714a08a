"""Experiments of the report, found by being in this folder.

One has a ``TITLE``, ``COVERING`` (the models of which the stated uncertainty must hold) and ``play(seeds, folder)``,
which simulates its runs once and yields for each seed of the noise what is found.
"""
