"""What is left of a joint that follows how another one moves, which no mean over its own variables shows."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from identification.diagnosis.search.loop import Search
from identification.diagnosis.verdict.lack_of_fit import Lack
from identification.diagnosis.verdict.views import shares_of_others, strongest
from identification.diagnosis.verdict.where import Where

#: Part of the residual's variance that another joint's motion orders at least to be told, and how many times as much as
#: the best of the joint's own variables: two joints that move alike order it alike.
_ORDERED, _MORE = 0.3, 1.5


def following_others(found: Search, last: Where, lacks: Sequence[Lack]) -> Iterator[str]:
    """Of joints of ``lacks``, whose residual ``last`` shows, in words."""
    bank, numbers = found.bank, found.bank.robot.numbers
    for lack in lacks:
        if lack.follows or lack.burst is not None:
            continue
        k = numbers.index(lack.joint)
        _, own = strongest(last.views[lack.joint])
        residuals = [bank.residual(r, k, found.weights, white=False) for r in range(len(bank.runs))]
        others = shares_of_others(bank.runs, bank.scenes, residuals, k, [one[k] for one in bank.colours])
        what = max(others, key=lambda one: others[one], default="")
        if what and others[what] > max(_ORDERED, _MORE * max(own.values(), default=0.0)):
            yield f"{100 * others[what]:.0f} % of what is left of joint {lack.joint} follows {what}"
