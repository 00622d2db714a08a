"""Tables 7 to 16 of the report beside what is found on the twins, found by being in this folder.

One has a ``TITLE`` and ``rows(results)``.
"""
