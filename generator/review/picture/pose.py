"""A configuration that shows the arm well: bent, above the floor, in one plane as far as it goes, within the limits."""

from __future__ import annotations

import itertools

import numpy as np

from generator.review.picture.skeleton import Array, Placement, Skeleton, place
from generator.robot.description import PRISMATIC, Joint

#: Where a joint without limits is looked at [rad].
_TURN = 2.6
_STEP = np.pi / 12
_STARTS = 300
_SWEEPS = 2
#: Odd steps through the candidates of each joint, so that few starts cover all combinations evenly.
_STRIDES = (1, 3, 7, 5, 11, 13, 17, 9)


def legible(arm: Skeleton) -> Array:
    """Joint positions (n,) [rad, m] on a grid of 15 degrees: the best of a fixed set of starts, improved by pairs of
    joints on a coarse grid and joint by joint on the fine one.
    """
    choices = [_candidates(joint, arm) for joint in arm.robot.moving]
    if not choices:
        return np.zeros(0)
    starts = np.stack(
        [c[(np.arange(_STARTS) // (k + 1) * _STRIDES[k % len(_STRIDES)]) % len(c)] for k, c in enumerate(choices)],
        axis=-1,
    )
    starts[0] = [c[np.argmin(np.abs(c))] for c in choices]
    found = [_climb(arm, start, choices) for start in (starts[0], starts[_first_best(_legibility(arm, starts))])]
    return found[_first_best(_legibility(arm, np.stack(found)))]


def _climb(arm: Skeleton, best: Array, choices: list[Array]) -> Array:
    """The configuration that no change of one joint improves, or the last of a fixed number of sweeps."""
    for _ in range(_SWEEPS):
        before = best
        for k in range(len(choices) - 1):
            pair = np.stack(np.meshgrid(_coarse(choices[k]), _coarse(choices[k + 1]), indexing="ij"), axis=-1).reshape(
                -1, 2
            )
            best = _improved(arm, best, [k, k + 1], pair)
        for k, values in enumerate(choices):
            best = _improved(arm, best, [k], values[:, None])
        if np.array_equal(before, best):
            break
    return best


def _improved(arm: Skeleton, q: Array, joints: list[int], values: Array) -> Array:
    """The best of ``q`` itself and of ``q`` with each of ``values`` (k, joints) put in."""
    trials = np.repeat(q[None, :], len(values) + 1, axis=0)
    trials[1:, joints] = values
    best: Array = trials[_first_best(_legibility(arm, trials))]
    return best


def _coarse(values: Array) -> Array:
    """Every third candidate, counted from the one nearest to zero."""
    chosen: Array = values[int(np.argmin(np.abs(values))) % 3 :: 3]
    return chosen


def _candidates(joint: Joint, arm: Skeleton) -> Array:
    if joint.sigma == PRISMATIC:
        lower, upper = joint.limits or (0.0, 1.5 * arm.size)
        return np.array([lower + 0.6 * (upper - lower)])
    lowest, highest = joint.limits or (-_TURN, _TURN)
    lower, upper = max(lowest, -_TURN), min(highest, _TURN)
    if lower > upper:
        return np.array([lower if lower > 0 else upper])
    first, last = int(np.ceil(lower / _STEP - 1e-9)), int(np.floor(upper / _STEP + 1e-9))
    grid = np.asarray(np.arange(first, last + 1) * _STEP, dtype=float)
    values: Array = grid if len(grid) else np.array([(lower + upper) / 2])
    return values[[np.argmin(np.abs(values))]] if _only_turns_the_picture(joint, arm) else values


def _only_turns_the_picture(joint: Joint, arm: Skeleton) -> bool:
    """Whether a joint turns everything about the vertical, so that the arm looks the same whatever its position."""
    alone = sum(other.antecedent == 0 for other in arm.robot.joints) == 1
    frames = place(arm, np.zeros(len(arm.robot.moving))).frames
    return joint.antecedent == 0 and alone and abs(float(frames[joint.number, :3, 2] @ arm.up)) > 0.99


def _first_best(scores: Array) -> int:
    """Index of the best score; what rounding could reorder counts as equal."""
    return int(np.argmax(np.round(scores, 6)))


def _legibility(arm: Skeleton, q: Array) -> Array:
    """The higher the better, for configurations (k, n)."""
    placement = place(arm, q)
    size = arm.size
    points = placement.corners[:, :, 3, :]
    heights = (points - arm.base[:3, 3]) @ arm.up / size
    floor = np.minimum(heights - 0.35, 0.0).sum(axis=-1)
    centre = points.mean(axis=1, keepdims=True)
    apart = np.minimum(np.linalg.norm(points - centre, axis=-1) / size, 1.5).mean(axis=-1)
    turning = np.array([joint.sigma != PRISMATIC for joint in arm.robot.moving])
    effort = np.abs(np.where(turning, q, 0.0)).sum(axis=-1) / np.pi
    score: Array = 2.0 * floor + 0.6 * apart + 0.15 * heights.mean(axis=-1) - 0.2 * effort
    return score + _bends(arm, placement)


def _bends(arm: Skeleton, placement: Placement) -> Array:
    """How far successive links are from lying in one line or on each other, unlike parts from touching, how well a
    chain keeps to one plane, and how far it ends outward and pointing down, as a working arm does.
    """
    total = np.zeros(len(placement.corners))
    tips = []
    for chain in _chains(arm):
        across = _shoulder_axis(arm, placement, chain)
        for coarse in (0.4, 0.12):
            path = _path(placement, chain, coarse * arm.longest)
            steps = [path[k + 1] - path[k] for k in range(len(path) - 1)]
            steps = [step / np.linalg.norm(step, axis=-1, keepdims=True) for step in steps]
            for before, after in itertools.pairwise(steps):
                total += 1.0 - np.abs(_dot(before, after) - 0.3) ** 1.5
            for step in steps:
                total -= 0.35 * np.abs(_dot(step, across))
            for i in range(len(path)):
                for j in range(i + 2, len(path)):
                    gap = np.linalg.norm(path[j] - path[i], axis=-1) / arm.size
                    total += 0.8 * np.minimum(gap - 0.8, 0.0)
        tip = path[-1] - path[0]
        outward = np.linalg.norm(tip - (tip @ arm.up)[:, None] * arm.up, axis=-1)
        total += (0.5 * outward + 0.2 * tip @ arm.base[:3, 0]) / arm.longest
        if len(steps) > 1:
            total -= 0.6 * steps[-1] @ arm.up
        tips.append(path[-1])
    for first, second in itertools.combinations(tips, 2):
        total += 0.5 * np.minimum(np.linalg.norm(first - second, axis=-1) / arm.longest, 2.0)
    return total


def _shoulder_axis(arm: Skeleton, placement: Placement, chain: list[int]) -> Array:
    """The axis of the second moving joint of a chain, or of its only one: what lies across the plane it works in."""
    moving = [number for number in chain if arm.links[number - 1].coordinate is not None][:2]
    axes: Array = placement.frames[:, moving[-1] if moving else 0, :3, 2]
    return axes


def _dot(a: Array, b: Array) -> Array:
    product: Array = (a * b).sum(axis=-1)
    return product


def _chains(arm: Skeleton) -> list[list[int]]:
    """Joint numbers from the base to each tip."""
    carriers = {link.joint.antecedent for link in arm.links}
    chains = []
    for tip in arm.links:
        if tip.joint.number not in carriers:
            chain = [tip.joint.number]
            while (antecedent := arm.links[chain[-1] - 1].joint.antecedent) != 0:
                chain.append(antecedent)
            chains.append(chain[::-1])
    return chains


def _path(placement: Placement, chain: list[int], least: float) -> list[Array]:
    """The corners along a chain that lie farther apart than ``least`` [m] in every configuration."""
    path = [placement.corners[:, chain[0] - 1, 0]]
    for number in chain:
        for corner in range(1, 4):
            point = placement.corners[:, number - 1, corner]
            if np.linalg.norm(point - path[-1], axis=-1).min() > least:
                path.append(point)
    return path
