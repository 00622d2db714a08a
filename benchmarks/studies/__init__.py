"""Studies, one module each: ``TITLE`` and ``run(build)``, which returns rows of a table and notes about it."""
