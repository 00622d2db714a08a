"""The libraries that the generated C is measured beside, found by being in this folder.

A module with ``NAME`` and ``build(subject, folder)``, a list of ``Library``, is a peer. ``build`` raises ``Missing``
where the machine or the environment lacks what it needs.
"""
