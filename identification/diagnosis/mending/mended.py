"""From what was found to a robot file that holds it: written, refitted, regenerated, played against untouched runs."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from generator.generation import Stage, silent
from generator.robot.description import Robot
from generator.writing import replace
from identification.diagnosis.columns.priors import prior_of
from identification.diagnosis.diagnosis import Diagnosis
from identification.diagnosis.mending.before import Before
from identification.diagnosis.mending.beside_swings import without_findings
from identification.diagnosis.mending.changes import difference, groupings_difference
from identification.diagnosis.mending.flexible_set import SET as FLEXIBLE
from identification.diagnosis.mending.refit import SET, Refit, refit
from identification.diagnosis.mending.untouched import Untouched, hardly_shown, objections, untouched
from identification.diagnosis.mending.without_harm import without_harm
from identification.diagnosis.mending.written_model import WrittenModel, fitted_runs, prepared_runs, written_model
from identification.diagnosis.runs.played import Played, Player, compiled, play, together
from identification.diagnosis.verdict.finding import Finding
from identification.observation import Regressors
from identification.robot_file import with_parameter_set
from identification.sampling import Sampled

#: Folder of the regenerated code, beside the new robot file.
GENERATED = "generated"
_FITTED = "nothing was added to the model: before and after differ by the fit of its parameters near the prior alone"
#: What a model without the findings leaves, in parts of what the new one does, up to which its parameters make up for
#: them.
_HIDDEN = 1.05
_TWO_SETS = f"the set {SET} is the rigid model's, {FLEXIBLE} that of the model with elastic drive trains"


@dataclass(frozen=True, kw_only=True)
class Mended:
    """The new robot file's ``text``, its ``robot`` and parameters, and its code's place in the folder (``generated``).

    ``written`` are the findings in the file, ``tested`` the test runs, ``before`` and ``after`` those as the old and
    the new model play them, ``tried`` what that says of each joint, by its number; ``file_difference`` and
    ``groupings_difference`` are unified diffs.
    """

    text: str
    robot: Robot
    fit: Refit
    written: tuple[Finding, ...]
    tested: tuple[Sampled, ...]
    before: tuple[Played, ...]
    after: tuple[Played, ...]
    tried: Mapping[int, Untouched]
    file_difference: str
    groupings_difference: str
    generated: Path
    notes: tuple[str, ...]


def mended(path: Path, found: Diagnosis, prior: str | None, folder: Path, stage: Stage = silent) -> Mended:
    """The robot file ``path`` with the findings of a diagnosis in it, written to ``folder``, its code beside it.

    With a ``prior`` set the old model plays with that set and the new parameters stay near it; without, both are
    fitted to the runs that the diagnosis fitted and validated with.

    Raises InputError where ``folder`` cannot be written.
    """
    name = f"{found.robot.name}.yaml"
    old_text = path.read_text(encoding="utf-8-sig")
    bank = found.search.bank
    old_regressors = bank.scenes[0].regressors
    with stage("fitting the parameters with what was found"):
        fits = _fits_without(found, old_regressors, prior)

        def model_of(findings: Sequence[Finding]) -> WrittenModel:
            return written_model(old_text, name, found, findings, prior)

        def tried_with(model: WrittenModel) -> dict[int, Untouched]:
            played = _played(found.roles.test, Player(model.regressors), model)
            return untouched(bank, *fits.free.and_after(played, model.swings))

        whole = model_of(found.findings)
        model, harmful = without_harm(whole, model_of, tried_with)
    new, fit = model.repaired, model.fit
    text = with_parameter_set(new.text, fit.parameter_set)
    if model.flexible is not None:
        text = with_parameter_set(text, model.flexible)
    replace(folder, {name: text.encode()})
    player, notes = compiled(folder / name, folder / GENERATED, model.regressors, stage)
    with stage("playing the untouched runs"):
        played = _played(found.roles.test, player, model)
        pair, free, held = (one.and_after(played, model.swings) for one in (fits.old, fits.free, fits.near))
    tried = untouched(bank, *pair)
    left_out = {j for one in found.findings if one not in whole.findings for j in one.amplitude}
    told = [*harmful, *model.notes, *([_TWO_SETS] if model.flexible is not None else []), *notes]
    if prior is not None:
        told += _gain(held[0], free[0], pair[1], found.roles.tested) if model.findings else [_FITTED]
    told += objections(untouched(bank, *free), found.roles.tested, left_out)
    told += hardly_shown(untouched(bank, *held), found.roles.tested, model.findings)
    return Mended(
        text=text,
        robot=new.robot,
        fit=fit,
        written=model.findings,
        tested=tuple(one.sampled for one in fits.old.runs),
        before=pair[0],
        after=pair[1],
        tried=tried,
        file_difference=difference(old_text, text, name),
        groupings_difference=groupings_difference(old_regressors.model, fit.regressors.model),
        generated=Path(GENERATED, found.robot.name),
        notes=tuple(dict.fromkeys(told)),
    )


@dataclass(frozen=True)
class _Fits:
    """The test runs as models without the findings play them: the ``old`` one, one fitted to the runs and ``free`` of a
    prior, and one fitted ``near`` it; without a prior all three are the same.
    """

    old: Before
    free: Before
    near: Before


def _fits_without(found: Diagnosis, regressors: Regressors, prior: str | None) -> _Fits:
    """The fits without what was found, of the model of ``regressors``."""
    known = None if prior is None else prior_of(regressors.model, prior)
    beside, player = without_findings(found.search), Player(regressors)
    runs = [*prepared_runs(found.roles.test, regressors)]
    fitted_to = fitted_runs(found, regressors)

    def fitted(held: bool) -> Before:
        return Before(runs, player, refit(fitted_to, regressors, known, held=held).written, beside)

    free = fitted(held=False)
    if known is None:
        return _Fits(free, free, free)
    values = dict(zip(regressors.names, known.mean.tolist(), strict=True))
    trains = {name: x for name, x in beside.items() if name not in values}
    return _Fits(Before(runs, player, values, trains), free, fitted(held=True))


def _gain(near: Sequence[Played], free: Sequence[Played], after: Sequence[Played], runs: str) -> Iterator[str]:
    """What the findings do on ``runs``, in words, beside fits without them, one ``near`` the prior and one ``free`` to
    leave what the runs contradict: a prior's values alone are further off than what the runs make of them.
    """
    held, away, new = (together(one).total for one in (near, free, after))
    if held.rows and new.rows:
        hidden = held.relative_to_mean <= _HIDDEN * new.relative_to_mean
        moved = ": parameters make up for what was found without going far from the prior" if hidden else ""
        yield (
            f"fitted to the same runs, the model without what was found leaves {held.relative_to_mean:.3g} % of the "
            f"{runs} if its parameters stay near the prior, {away.relative_to_mean:.3g} % if the runs may move them "
            f"far, and the new model {new.relative_to_mean:.3g} %{moved}"
        )


def _played(sources: Sequence[str], player: Player, model: WrittenModel) -> tuple[Played, ...]:
    return tuple(play(one, player, model.played) for one in prepared_runs(sources, player.regressors, model.loads))
