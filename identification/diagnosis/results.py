"""The content of diagnosis.json."""

from __future__ import annotations

from typing import Any

from generator.version import VERSION
from identification import outcome
from identification.diagnosis.diagnosis import Diagnosis, Where
from identification.diagnosis.finding import Finding
from identification.diagnosis.lack_of_fit import Lack


def document(found: Diagnosis) -> dict[str, Any]:
    """Everything that was found, see docs/diagnosis.md: angles in rad, torques in N m, times in s."""
    count = len(found.roles.train)
    kinds = {"train": found.runs[:count], "validate": found.runs[count:]}
    return {
        "robot": found.robot.name,
        "robot_sha256": found.robot.digest,
        "version": VERSION,
        "mode": found.mode,
        "verdict": found.verdict,
        "where": _where(found.before),
        "findings": [_finding(one) for one in found.findings],
        "unexplained": _where(found.after) if found.after.joint else None,
        "invisible": [
            {"effect": one.effect, "joints": list(one.joints or (one.joint,)), "would_show": one.would_show}
            for one in found.invisible
        ],
        "lack_of_fit": {
            "before": [_lack(one) for one in found.before.lack],
            "after": [_lack(one) for one in found.after.lack],
        },
        "data": {
            kind: [outcome.run(one.sampled.run, one.sampled.filters) for one in runs] for kind, runs in kinds.items()
        },
        "notes": list(found.notes),
    }


def _finding(one: Finding) -> dict[str, Any]:
    shapes = {shape.name: shape.unit for shape in one.hypothesis.shapes}
    return {
        "effect": one.hypothesis.effect,
        "title": one.hypothesis.title,
        "joints": list(one.joints),
        "status": one.status,
        "parameters": {
            **{name: {"value": v.value, "std": v.std, "unit": v.unit} for name, v in one.parameters.items()},
            **{name: {"value": value, "std": None, "unit": shapes.get(name, "")} for name, value in one.shape.items()},
        },
        "amplitude": {str(number): value for number, value in one.amplitude.items()},
        "evidence": {
            "drop": one.evidence.drop,
            "p": one.evidence.p,
            "bic": one.evidence.bic,
            "validation": one.evidence.validation,
            "size": one.evidence.size,
            "homogeneous": one.homogeneous,
        },
        "alternatives": [
            {
                "effect": other.effect,
                "title": other.title,
                "joints": list(other.joints),
                "score": other.score,
                "separating_experiment": other.separating_experiment,
            }
            for other in one.alternatives
        ],
    }


def _where(one: Where) -> dict[str, Any]:
    return {"joint": one.joint or None, "variable": one.variable, "region": one.region, "shares": dict(one.shares)}


def _lack(one: Lack) -> dict[str, Any]:
    burst = None if one.burst is None else {"run": one.burst[0], "time": one.burst[1]}
    return {
        "joint": one.joint,
        "ratio": one.ratio,
        "p": one.p,
        "size": one.size,
        "repeats": one.repeats,
        "event": burst,
    }
