"""The blind study of the diagnosis: simulated robots with effects that their robot files do not have.

``make study-diagnosis [cases=N]`` makes the cases of ``study.json`` with the plant of ``tests/plant``, gives robot
file and runs to ``counterpoise diagnose``, holds its ``diagnosis.json`` against the truth, and writes
``benchmarks/diagnosis_cases.jsonl``, ``benchmarks/diagnosis.json`` and ``docs/diagnosis_study.md``. Nothing but what a
user would have is given to the command.
"""
