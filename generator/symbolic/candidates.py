"""Ways of writing a chain's equations that are worth a try."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from generator.symbolic.frames import Chain, Frame
from generator.symbolic.gauge import Gauge, is_last, slid_origins
from generator.symbolic.lean_newton_euler import Strategy, is_second
from generator.symbolic.segments import Spun, segments
from generator.symbolic.vectors import dot

#: Joints tried to keep a mass, and frames tried as the place where screws and wrenches meet, from the base.
_TRIED = 8


def unspun_candidates(chain: Chain) -> list[frozenset[int]]:
    """Bodies that may gain from unspun axes: those inside a segment, on a first frame, at the tips, unions, none."""
    spun = segments(chain)
    carriers = {frame.parent.number for frame in chain.frames if frame.parent is not None and frame.has_body()}
    inside = _inside(chain, spun)
    tips = frozenset(frame.number for frame in chain.frames if frame.revolute and frame.number not in carriers)
    second = frozenset(frame.number for frame in chain.frames if is_second(frame))
    return list(dict.fromkeys(near | far for far in (tips, frozenset()) for near in (frozenset(), inside, second)))


def slides(chain: Chain) -> list[frozenset[int]]:
    """Frames to slide: none, those at the tips, all that can."""
    able = _able_to_slide(chain)
    tips = frozenset(j for j in able if is_last(chain, chain.frames[j - 1]))
    return list(dict.fromkeys([frozenset(), tips, able]))


def _able_to_slide(chain: Chain) -> frozenset[int]:
    """Revolute joints whose frame does not stand next to its antecedent's origin."""
    zero = chain.program.zero
    return frozenset(
        f.number for f in chain.frames if f.revolute and f.has_body() and dot(f.rotation[:, 2], f.position) is not zero
    )


def slid_otherwise(chain: Chain, best: Strategy) -> list[Strategy]:
    """The same with one frame slid more or less."""
    gauges = [replace(best.gauge, slide=best.gauge.slide ^ {j}) for j in sorted(_able_to_slide(chain))]
    return [replace(best, gauge=gauge) for gauge in gauges]


def balanced(chain: Chain, best: Strategy) -> list[Strategy]:
    """The same with a mass kept behind a joint, whose frame then stays where it is."""
    joints = [frame.number for frame in chain.frames if _balances(frame)][:_TRIED]
    return [replace(best, gauge=Gauge(best.gauge.slide - {j}, frozenset({j}))) for j in joints]


def in_units(chain: Chain, gauge: Gauge) -> list[Gauge]:
    """The same in units of each fixed length of the chain; a prismatic joint's force would have to be turned back."""
    if any(frame.prismatic for frame in chain.frames):
        return []
    positions = slid_origins(chain, gauge.slide).positions
    # From the tips, whatever the lengths are, so that the choice belongs to the structure.
    entries = [entry for frame in reversed(chain.frames) for entry in reversed(positions[frame.number])]
    lengths = dict.fromkeys(abs(entry.number) for entry in entries if entry.number)
    return [replace(gauge, unit=length) for length in lengths]


def _balances(frame: Frame) -> bool:
    """Whether a mass behind a joint can balance its antecedent: the joint turns and stands away from it, across z."""
    if not frame.revolute or frame.parent is None:
        return False
    return any(entry.number for entry in frame.position[:2])


def meetings(chain: Chain) -> list[int]:
    """Last frames of the segments, from the base."""
    inside = _inside(chain, segments(chain))
    return [frame.number for frame in chain.frames if frame.number not in inside and frame.has_body()][:_TRIED]


def before_last(chain: Chain) -> frozenset[int]:
    """The frames that carry the last moving segments, as far as they end segments themselves.

    Nearer to the base most chains' columns get longer. Where they do not, less of them is a product that is added at
    once, which costs instructions where the processor has a fused multiply-add.
    """
    spun, moving = segments(chain), [frame for frame in chain.frames if frame.coordinate is not None]
    carriers = {below.number for frame in moving for below in frame.path() if below is not frame}
    tips = [frame for frame in moving if frame.number not in carriers]
    first = [next(one for one in tip.path() if not spun[one.number].continues) for tip in tips]
    return frozenset(one.parent.number for one in first if one.parent is not None) - _inside(chain, spun)


def _inside(chain: Chain, spun: Mapping[int, Spun]) -> frozenset[int]:
    """Frames behind which their segments go on."""
    return frozenset(f.parent.number for f in chain.frames if spun[f.number].continues and f.parent is not None)
