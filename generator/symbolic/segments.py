"""Chains read as segments of parallel axes, each with one frame that does not spin.

Frame j follows from its antecedent by a constant rotation (about x by alpha), then by the spin about z_j. Between the
two stands the *unspun* frame: its z axis is z_j, and joints with parallel axes in a row share it, their angles adding
up. What is constant along z_j, and every sum over a segment, is cheapest there.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import sympy

from generator.symbolic.frames import Chain, Frame, cosine_sine
from generator.symbolic.statements import Node
from generator.symbolic.vectors import Array


@dataclass(frozen=True)
class Spun:
    """Frame j between its unspun frame and its own: ``cosine`` and ``sine`` of the sum of angles of its segment.

    ``continues`` tells that the frame shares the unspun frame of its antecedent; ``entry`` (3 x 3) holds the axes of
    the unspun frame in the antecedent's own frame (the identity where it continues). ``quarter`` tells that ``entry``
    only permutes axes and signs.
    """

    frame: Frame
    continues: bool
    entry: Array
    quarter: bool
    cosine: Node
    sine: Node

    def to_own(self, vector: Array) -> Array:
        """A vector from unspun to own axes."""
        c, s = self.cosine, self.sine
        return np.array([c * vector[0] + s * vector[1], c * vector[1] - s * vector[0], vector[2]], dtype=object)

    def to_unspun(self, vector: Array) -> Array:
        """A vector from own to unspun axes."""
        c, s = self.cosine, self.sine
        return np.array([c * vector[0] - s * vector[1], s * vector[0] + c * vector[1], vector[2]], dtype=object)


def segments(chain: Chain) -> dict[int, Spun]:
    """Every frame of the chain as part of a segment, by number."""
    result: dict[int, Spun] = {}
    angle: dict[int, sympy.Expr] = {}
    for frame in chain.frames:
        joint = frame.joint
        continues = (
            frame.parent is not None
            and frame.revolute
            and frame.parent.revolute
            and joint.alpha == 0
            and joint.gamma == 0
        )
        before = angle[joint.antecedent] if continues else sympy.Integer(0)
        angle[frame.number] = before + joint.theta
        cosine, sine = cosine_sine(angle[frame.number], chain.program, chain.values)
        quarter = all(node.number in (-1, 0, 1) for node in frame.entry.ravel())
        result[frame.number] = Spun(frame, continues, frame.entry, quarter, cosine, sine)
    return result
