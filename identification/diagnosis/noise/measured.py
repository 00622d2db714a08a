"""The noise of each joint in each run: what is left when everything that may act has been taken away.

Base parameters and all hypotheses together explain more than the truth can, so that what they leave is noise and not a
missing effect; those that hold the record's own noise stay away, and columns of positions that are not exact explain no
more than they would of exact ones. Where a motion repeats, what its periods have in common is taken away too: only what
differs between them is noise, whatever the model lacks. Both take noise with them, more of it where they are rich: what
is left at a frequency is divided by its part that is free there.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import uniform_filter1d

from identification.arrays import Array
from identification.diagnosis.columns.bank import Bank
from identification.diagnosis.columns.normal_equations import directions
from identification.diagnosis.columns.whitening import (
    ORDER,
    Colour,
    alike,
    at_rate,
    colour,
    mixed,
    recoloured,
    stretches,
)
from identification.diagnosis.noise.clear_directions import clear
from identification.diagnosis.noise.errors_in_variables import Redrawn
from identification.diagnosis.noise.may_act import (
    Rows,
    allowed,
    have_room,
    known_to_act,
    with_maps,
    with_noise,
    without_record,
)
from identification.diagnosis.noise.outstanding import outstanding
from identification.diagnosis.runs.phases import between_periods, by_period
from identification.side_by_side import side_by_side

#: Eigenvalues of the scaled columns' products below this part of the largest are no directions of their own.
_RANK = 1e-7
#: Rows of the parts of a run whose spectra tell where noise is taken away, and the least part that counts as left.
_PART, _LEAST = 256, 0.1
#: Rows of the usual noise that every run, and all runs at one rate, are taken to have beside their own; and the
#: standard deviations beyond which a run's power is another one by more than chance.
_DOUBT, _CHANCE = 200, 2.0
#: Times that the colour is estimated again, each from rows made white by the last.
_AGAIN = 1
#: Power of the noise that columns leave from which that of positions is looked at; beyond which it is only believed if
#: the model alone leaves as much, as columns that take so much have to hold nothing else; and times what is left there
#: that it may be.
_NOISY, _ABSURD, _AS_MUCH = 0.05, 30.0, 2.0


def colours(
    bank: Bank,
    rounded: Sequence[Array] = (),
    maps: Sequence[Sequence[Array]] = (),
    redrawn: Mapping[int, Redrawn] | None = None,
) -> list[list[Colour]]:
    """The colour of every joint's noise, run by run: the form is that of all runs alike, which a short one could not
    tell.

    ``rounded`` (n x rows each) counts as noise too, though periods may have it in common. ``maps`` are, by joint and
    run, rows (m x rows) of what may act beside all hypotheses, if there are any. Runs whose positions are noisy are
    ``redrawn``, by number.
    """

    def of_joint(k: int) -> list[Colour]:
        return _of_joint(bank, k, [one[k] for one in rounded], maps[k] if maps else (), redrawn or {})

    every = side_by_side(of_joint, range(bank.dof))
    return [[colours[r] for colours in every] for r in range(len(bank.runs))]


def _of_joint(
    bank: Bank, joint: int, rounded: Sequence[Array], maps: Sequence[Array], redrawn: Mapping[int, Redrawn]
) -> list[Colour]:
    """The colour of a joint's noise in each run."""
    plain = [without_record(bank, r, joint) for r in range(len(bank.runs))]
    blurred = bool(maps) and not have_room(bank, maps, joint)
    apart = outstanding(plain, bank, joint) if blurred and known_to_act(plain, bank) else []
    found = _joint(with_maps(plain, bank, joint, maps), bank, rounded, apart)
    torques = [found[r].white(one.torque[[joint]], bank.runs[r].kept[joint]) for r, one in redrawn.items()]
    power = sum(float(np.sum(x**2)) for x in torques) / max(sum(x.size for x in torques), 1)
    if power < _NOISY or (power > _ABSURD and not _left_by_model(plain, bank, joint, redrawn, found)):
        return found
    noisy = with_noise(plain, bank, joint, redrawn)
    return _joint(with_maps(noisy, bank, joint, maps), bank, rounded, apart)


def _left_by_model(
    parts: Sequence[Rows], bank: Bank, joint: int, redrawn: Mapping[int, Redrawn], colours: Sequence[Colour]
) -> bool:
    """Whether the model's columns leave of a joint's torque as much as noise of the positions would make there."""
    p = len(bank.base)
    gram = np.zeros((p + 2, p + 2))
    for r, one in redrawn.items():
        base = [i for i, number in enumerate(parts[r].numbers) if number < p]
        places = [*(parts[r].numbers[i] for i in base), p, p + 1]
        rows = np.concatenate([parts[r].columns[base], parts[r].tau[None], one.torque[[joint]]])
        white = _white(colours[r], rows, parts[r].kept)
        gram[np.ix_(places, places)] += white @ white.T
    taken = gram[p:, :p] @ directions(gram[:p, :p])
    left, noise = np.diag(gram)[p:] - np.sum(taken**2, axis=1)
    return bool(noise <= _AS_MUCH * left)


def _joint(parts: Sequence[Rows], bank: Bank, rounded: Sequence[Array], apart: Sequence[int]) -> list[Colour]:
    """The colour of a joint's noise in each run, columns number ``apart`` taken away whole."""
    taken = [*known_to_act(parts, bank), *apart]
    kinds = [(run.rate, run.factor) for run in bank.runs]
    left = _left(parts, bank, [None] * len(parts), rounded, taken)
    for _ in range(_AGAIN):
        left = _left(parts, bank, _usual(left, kinds), rounded, taken)
    return [_scaled(known, one) for known, one in zip(_usual(left, kinds), left, strict=True)]


def _usual(left: Sequence[_Left], kinds: Sequence[tuple[float, int]]) -> list[Colour]:
    """The colour of the noise of each run as all have it: those with as many rows a second, each of as many samples,
    have one form; few rows of them take it from the others, in hertz.
    """
    groups = alike(kinds)
    own = [_colour([left[r] for r in group]) for group in groups]
    rows = np.array([sum(left[r].rows for r in group) for group in groups], dtype=float)
    result: dict[int, Colour] = {}
    for g, group in enumerate(groups):
        weights = rows * min(_DOUBT / max(rows.sum() - rows[g], 1.0), 1.0)
        weights[g] = rows[g]
        rate = kinds[group[0]][0]
        there = [at_rate(one, kinds[each[0]][0], rate) for one, each in zip(own, groups, strict=True)]
        usual = mixed([*zip(there, weights.tolist(), strict=True)]) if len(groups) > 1 else own[g]
        result |= dict.fromkeys(group, usual)
    return [result[r] for r in range(len(kinds))]


def _colour(left: Sequence[_Left]) -> Colour:
    """The colour of the noise of runs alike."""
    lost = _smooth(np.sum([one.lost for one in left], axis=0))
    free = np.maximum(1 - lost / max(sum(one.rows for one in left), 1), _LEAST)
    return recoloured(colour([part for one in left for part in one.parts]), free)


@dataclass(frozen=True)
class _Left:
    """What is left of the noise of a run, in stretches ``parts`` of so many ``rows`` together; of these as many as are
    ``lost`` by frequency.
    """

    parts: list[Array]
    rows: int
    lost: Array

    @property
    def free(self) -> float:
        """The part of its power that is left."""
        return _free(self.lost, self.rows)


def _free(lost: Array, rows: int) -> float:
    return max(1 - float(lost.mean()) / max(rows, 1), _LEAST)


def _left(
    parts: Sequence[Rows],
    bank: Bank,
    known: Sequence[Colour | None],
    rounded: Sequence[Array],
    taken: Sequence[int],
) -> list[_Left]:
    """What is left of the noise of each run. All columns number ``taken`` are taken away, and of the others the
    strongest directions that rows allow.
    """
    numbers = [*taken, *sorted({number for part in parts for number in part.numbers}.difference(taken))]
    place = {number: i for i, number in enumerate(numbers)}
    places = [np.array([place[number] for number in part.numbers], dtype=int) for part in parts]
    gram = np.zeros((len(numbers) + 1, len(numbers) + 1))
    pretended = np.zeros(len(numbers))
    white, noisy = [], []
    for at, part, one in zip(places, parts, known, strict=True):
        white.append(_white(one, np.concatenate([part.columns, part.tau[None]]), part.kept))
        gram[np.ix_([*at, -1], [*at, -1])] += white[-1] @ white[-1].T
        if part.noise is not None:
            noise = _white(one, part.noise, part.kept)
            pretended[at] -= noise[:-1] @ noise[-1]
            noisy.append((at, noise[:-1]))
    rows = sum(x.shape[1] for x in white)
    acting = sum(number >= 0 for number in taken)
    along = _directions(gram[:-1, :-1], len(taken), max(allowed(rows) - acting, 0))
    unblurred = clear(along, noisy)
    weights = along @ (along.T @ gram[:-1, -1]) - unblurred @ (unblurred.T @ pretended)
    inside = along @ along.T
    result = []
    for r, (at, x, part, run) in enumerate(zip(places, white, parts, bank.runs, strict=True)):
        kept = part.kept
        noise_left = between_periods(part.tau - weights[at] @ part.columns, kept, run.period)
        whole = np.zeros(part.columns.shape)
        whole[:, kept] = x[:-1]
        taken_away = _power(between_periods(whole, kept, run.period), inside[np.ix_(at, at)])
        lost = taken_away + _common(kept, run.period)
        # Nothing of the rounding is lost, and it counts as what is left.
        steps = np.sqrt(_free(lost, x.shape[1])) * rounded[r] if rounded else 0.0
        result.append(_Left(stretches(noise_left + steps, kept), x.shape[1], lost))
    return result


def _white(known: Colour | None, x: Array, kept: NDArray[np.bool_]) -> Array:
    """Kept rows (k x N), white where the colour of their noise is known."""
    return x[:, kept] if known is None else known.white(x, kept)


def _scaled(known: Colour, left: _Left) -> Colour:
    """The colour with the power of one run's noise, as far as its rows tell it.

    The logarithm of runs' powers spreads about the usual one by as much as ``_DOUBT`` rows leave it uncertain, or by as
    much as this run's does beyond chance.
    """
    white = [known.white(part[None], np.ones(len(part), dtype=bool))[0] for part in left.parts]
    squares, rows = sum(float(e @ e) for e in white) / left.free, left.rows
    if not squares:
        return known
    beyond = np.log(squares / rows) ** 2 - _CHANCE**2 * 2 / (left.free * rows)
    doubt = min(2 / max(beyond, 1e-9), _DOUBT)
    power = (squares + doubt) / (rows + doubt)
    return Colour(known.filters, tuple(float(x) * float(np.sqrt(power)) for x in known.deviations))


def _directions(gram: Array, base: int, most: int) -> Array:
    """The directions (k x m) that are taken away of columns (k) with these products, each of unit length along the
    rows: all of the first ``base`` columns, and ``most`` of the others.
    """
    D = directions(gram[:base, :base])
    T = np.concatenate([-D @ (D.T @ gram[:base, base:]), np.eye(len(gram) - base)])
    S = gram[base:, base:] + gram[base:, :base] @ T[:base]
    V = directions((S + S.T) / 2, _RANK, gram.diagonal()[base:])
    first = np.vstack([D, np.zeros((len(gram) - base, D.shape[1]))])
    return np.hstack([first, T @ V[:, max(V.shape[1] - most, 0) :]])


def _common(kept: NDArray[np.bool_], period: int) -> float:
    """Rows' worth of noise that is in what periods have in common."""
    return float(by_period(kept, period).any(axis=0).sum()) if period else 0.0


def _power(x: Array, inside: Array) -> Array:
    """Power, by frequency, of white noise in what columns (k x N) explain."""
    parts = -(-x.shape[1] // _PART)
    whole = np.pad(x, ((0, 0), (0, parts * _PART - x.shape[1]))).reshape(len(x), parts, _PART)
    X = np.fft.rfft(whole).reshape(len(x), -1)
    power = np.einsum("ks,ks->s", X.conj(), inside @ X).real
    return np.asarray(power.reshape(parts, -1).sum(axis=0))


def _smooth(power: Array) -> Array:
    """As fine as a colour tells frequencies apart."""
    return np.asarray(uniform_filter1d(power, len(power) // ORDER, mode="mirror"))
