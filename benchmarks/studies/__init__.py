"""Studies of the generated code, found by being in this folder.

A study has ``TITLE`` and ``run(build)``, which builds what it needs in the folder ``build``, measures, and returns
``{"rows": [{column: value}], "notes": [str]}`` for JSON. It raises ``Missing`` where the machine lacks a tool.
``python -m benchmarks.studies.NAME`` runs one alone.
"""
