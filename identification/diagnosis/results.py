"""The content of diagnosis.json."""

from __future__ import annotations

from typing import Any

from generator.version import VERSION
from identification import outcome
from identification.diagnosis.diagnosis import LOCATED, UNEXPLAINED, Diagnosis
from identification.diagnosis.mending.mended import GENERATED, Mended
from identification.diagnosis.noise.noise_floor import noise_floor
from identification.diagnosis.runs.played import together
from identification.diagnosis.verdict.finding import Finding
from identification.diagnosis.verdict.lack_of_fit import Lack
from identification.diagnosis.verdict.where import Where


def document(found: Diagnosis, new: Mended | None = None) -> dict[str, Any]:
    """Everything that was found, see docs/diagnosis.md: angles in rad, torques in N m, times in s."""
    count = len(found.roles.train)
    kinds = {
        "train": [one.sampled for one in found.runs[:count]],
        "validate": [one.sampled for one in found.runs[count:]],
        "test": () if new is None else new.tested,
    }
    return {
        "robot": found.robot.name,
        "robot_sha256": found.robot.digest,
        "version": VERSION,
        "mode": found.mode,
        "verdict": found.verdict,
        "where": _where(found.before),
        "findings": [_finding(one, new) for one in found.findings],
        "unexplained": _where(found.after) if found.verdict == UNEXPLAINED else None,
        "contradicted": None
        if found.verdict == LOCATED
        else [
            {"parameter": one.name, "value": one.found, "known": one.known, "known_std": one.std}
            for one in found.contradicted
        ],
        "invisible": [
            {"effect": one.effect, "joints": list(one.numbers), "would_show": one.would_show} for one in found.invisible
        ],
        "residual": None if new is None else _residual(found, new),
        "robot_file": None if new is None else f"{found.robot.name}.yaml",
        "generated": None if new is None else f"{GENERATED}/{found.robot.name}",
        "difference": None
        if new is None
        else {"robot_file": new.file_difference, "groupings": new.groupings_difference},
        "lack_of_fit": {
            "before": [_lack(one) for one in found.before.lack],
            "after": [_lack(one) for one in found.after.lack],
        },
        "data": {kind: [outcome.run(one.run, one.filters) for one in runs] for kind, runs in kinds.items()},
        "notes": [*found.notes, *(() if new is None else new.notes)],
    }


def _residual(found: Diagnosis, new: Mended) -> dict[str, Any]:
    """Of the untouched runs by joint: before, after, and what noise alone would leave [N m, N rms]."""
    numbers = found.robot.numbers
    rate = new.after[0].rate
    result: dict[str, Any] = {}
    for kind, played in (("before", new.before), ("after", new.after)):
        each = together(played)
        result[kind] = outcome.norms({numbers[k]: one for k, one in each.per_joint.items()}, each.total)
    bank = found.search.bank
    floors = [(number, noise_floor(bank, k, rate) if k in bank.shown else None) for k, number in enumerate(numbers)]
    result["noise_floor"] = {"per_joint": [{"joint": number, "rms": floor} for number, floor in floors]}
    return result


def _finding(one: Finding, new: Mended | None) -> dict[str, Any]:
    return {
        "effect": one.hypothesis.effect,
        "title": one.hypothesis.title,
        "joints": list(one.joints),
        "status": one.status,
        "doubts": list(one.doubts),
        "written": None if new is None else one in new.written,
        "parameters": {each.name: {"value": each.value, "std": each.std, "unit": each.unit} for each in one.told},
        "determined": one.determined,
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
    burst = None if one.burst is None else {"run": one.burst.run, "time": one.burst.time, "count": one.burst.count}
    return {
        "joint": one.joint,
        "ratio": one.ratio,
        "p": one.p,
        "size": one.size,
        "repeats": one.repeats,
        "follows": one.follows or None,
        "event": burst,
    }
