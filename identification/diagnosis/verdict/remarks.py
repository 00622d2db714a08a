"""What is to be told of a diagnosis beside its findings: in words, one sentence each."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence, Set

from generator.words import listed, numbered
from identification.diagnosis.candidates.torque_drift import EFFECT as DRIFT
from identification.diagnosis.candidates.torque_drift import changed_at_start, since_cold
from identification.diagnosis.columns.hypothesis import ELASTIC, Key
from identification.diagnosis.runs.prepared import Prepared
from identification.diagnosis.runs.stated_elasticity import BOUNCING, Stated, stated
from identification.diagnosis.runs.swings import watched
from identification.diagnosis.runs.told_files import told_files
from identification.diagnosis.search.loop import Search
from identification.diagnosis.search.selection import Choice
from identification.diagnosis.search.swings_heard import heard
from identification.diagnosis.verdict.finding import Finding
from identification.diagnosis.verdict.lack_of_fit import Lack
from identification.diagnosis.verdict.stated_swings import stiffer
from identification.diagnosis.verdict.trial import Trial, comparable
from identification.diagnosis.verdict.unexplained import Unexplained

#: Part of a run's rows that hold a motion that repeats, below which that is told.
_WHOLE = 0.98
#: Part of what is unexplained that a drive train must explain to be told without being named.
_MOST = 0.5
#: Change of a torque constant before a run from which it is told.
_WARM = 0.005
#: What a finding is told with, by its effect: what else makes the same torque.
_LIKE = {
    "torque_delay": "a filter of the drive or of the log that lags as long looks like a delay between torque and "
    "position",
    "offset": "dry friction that is not alike both ways makes the torque of an offset wherever a joint moves",
}


def of_tests(found: Search, trial: Trial | None, test: Sequence[Prepared]) -> Iterator[str]:
    """Of joints that move in runs that test alone, and of runs that test and cannot show what was found."""
    moving = found.bank.robot.moving
    unseen = [k for k in range(len(moving)) if k not in found.bank.shown and any(run.kept[k].any() for run in test)]
    if unseen:
        where = numbered("joint", (moving[k].number for k in unseen))
        yield f"no run that is fitted tells of {where}, on which those that test have rows"
    unlike = [run.sampled.run for run in test if not comparable(run, found)]
    for one in unlike:
        yield (
            f"{one.file} is logged at {one.rate:.4g} Hz, the fitted runs are not: their noise is not its own, and it "
            "does not check the findings"
        )
    if test and trial is None and len(unlike) < len(test):
        yield "the runs that test cannot show what was found: they do not check the findings"


def of_elasticity(found: Search) -> list[str]:
    """Of drive trains that the file says are elastic."""
    trains = stated(found.bank.robot)
    if not trains:
        return []
    notes = [
        f"{_drive_trains(trains)} elastic in the robot's file: what that adds to the torques is taken from its "
        "stiffnesses, beside the inverse dynamics of rigid joints"
    ]
    if (shown := stiffer(found)) is not None:
        notes.append(f"the runs show {100 * shown:.0f} % of that torque: these drive trains are stiffer than stated")
    column = {one: found.bank.base.index(f"{BOUNCING}{one.number}") for one in trains if one.gap}
    if fast := [one for one, at in column.items() if not found.weighing.all.gram[at, at]]:
        notes.append(f"{_drive_trains(fast)} too stiff for the samples to follow, and taken as rigid")
    return notes


def _drive_trains(trains: Sequence[Stated]) -> str:
    """Those of some joints, in words, as what a sentence is about."""
    are = "drive train of {} is" if len(trains) == 1 else "drive trains of {} are"
    return f"the {are.format(numbered('joint', (one.number for one in trains)))}"


def of_swings(found: Search, lacking: Set[int]) -> Iterator[str]:
    """Of drive trains that would explain most of what joints are ``lacking``, by number, and are not named because the
    recorded torques hardly hold their swings.
    """
    weighing = found.weighing
    missing = weighing.unexplained(found.variants)
    told: set[Key] = set()
    for one in weighing.evidence(found.variants) if lacking else ():
        variant = one.variant
        if variant.hypothesis.kind != ELASTIC or not one.passes or variant.key in told:
            continue
        most = one.drop > _MOST * missing and not lacking.isdisjoint(variant.hypothesis.numbers)
        if most and not heard(found.bank, found.train, variant, one.coefficients):
            told.add(variant.key)
            share = 100 * min(one.drop / missing, 1.0)
            yield (
                f"{variant.hypothesis.named} would explain {share:.0f} % of what is left; the recorded torque hardly "
                "holds such a swing, as where noise of the positions pretends it: a motion that repeats tells the two "
                "apart"
            )


def of_links(found: Search, lacking: Collection[int]) -> list[str]:
    """Of joints, among those that are ``lacking`` something, by number, on which no elasticity is looked for."""
    bank = found.bank
    seen = [number for k, number in enumerate(bank.robot.numbers) if number in lacking and watched(bank.scenes, k)]
    if not seen:
        return []
    return [
        f"elasticity is not looked for on {numbered('joint', seen)}: counterpoise stiffness --link-encoders tells it "
        "from the link-side encoders"
    ]


def of_motion(runs: Sequence[Prepared], small: bool) -> list[str]:
    """Of runs whose periods are not compared, and of those that hold more than a motion that repeats; ``small`` tells
    that a finding may be too small to be firm without periods.
    """
    unlike: dict[str, list[str]] = {}
    files = told_files([run.sampled.run for run in runs])
    for run, file in zip(runs, files, strict=True):
        if run.unlike:
            unlike.setdefault(run.unlike, []).append(file)
    more = ", and what is small beside it is not firm" if small else ""
    parts = [
        f"the motion of {file} repeats for {run.repeating / run.rate:.3g} s: the other "
        f"{(len(run.t) - run.repeating) / run.rate:.3g} s are left out"
        for run, file in zip(runs, files, strict=True)
        if run.repeating < _WHOLE * len(run.t)
    ]
    return [
        f"the motion of {listed(dict.fromkeys(names))} {why}: noise is told from the model's faults less well{more}"
        for why, names in unlike.items()
    ] + parts


def of_warmth(found: Search) -> Iterator[str]:
    """Of fitted runs without the temperature that the robot's file tells warmth by, where others have it."""
    scenes = [found.bank.scenes[r] for r in found.train]
    coordinates = range(len(found.bank.robot.moving))
    untold = {k: [one for one in scenes if not one.warmth_is_stated(k)] for k in coordinates}
    for k, without in untold.items():
        if 0 < len(without) < len(scenes):
            files = listed(dict.fromkeys(one.sampled.run.file for one in without))
            yield (
                f"{files}: how warm the drive of joint {found.bank.robot.numbers[k]} was is not recorded, as it is in "
                "other runs: friction that warms up and a torque that drifts are not looked for on that joint"
            )


def of_warm_starts(found: Search) -> Iterator[str]:
    """Of runs that began with a warm drive, by the drift of its torque constant that was found."""
    drifts = {one.evidence.variant.key for one in found.choices}
    scenes = found.bank.scenes
    files = told_files([scene.sampled.run for scene in scenes])
    for k, joint in enumerate(found.bank.robot.moving):
        if (DRIFT, joint.number) not in drifts:
            continue
        parts = [changed_at_start(k, scene) for scene in scenes]
        began = [
            f"{file} ({100 * part:+.2g} %{_as_after(since_cold(k, scene))})"
            for file, part, scene in zip(files, parts, scenes, strict=True)
            if abs(part) > _WARM
        ]
        if began:
            yield (
                f"the torque constant of joint {joint.number} had drifted already when {listed(began)} began, beyond "
                "what since_cold of its sidecar tells: the search takes that into account, the new set is fitted "
                "without it"
            )


def _as_after(time: float | None) -> str:
    return "" if time is None else f", as {time:.0f} s after a cold start"


def of_findings(found: Sequence[Finding], gone: Sequence[Choice]) -> Iterator[str]:
    """Of findings whose amplitude does not hold, and of those that runs that test took back (``gone``)."""
    for one in found:
        if one.disagreement:
            yield f"{one.hypothesis.named} {one.disagreement}: it drifts, or something else makes it"
    for each in gone:
        hypothesis = each.evidence.variant.hypothesis
        yield f"{hypothesis.named} is taken back: the runs that test contradict it, or what it stood beside"
    named = {one.hypothesis.effect for one in found}
    yield from (text for effect, text in _LIKE.items() if effect in named)
    tilts = [one for one in found if one.hypothesis.effect == "base_tilt"]
    unseen = [each.name for one in tilts for each in one.hypothesis.coefficients if not each.essential]
    if unseen:
        yield f"{listed(unseen)}: what an upright base does not show of the bodies' first moments, times the tilt"


def of_lacks(lacks: Sequence[Lack], left: Unexplained, named: bool) -> list[str]:
    """Of what the last model leaves on each joint: what happens there, what it follows, why it counts as explained."""
    if left.lacks:
        shown = None if left.where is None else left.where.joint
        events = [
            f"something happens on joint {one.joint} {one.event}"
            for one in left.lacks
            if one.joint != shown and one.event
        ]
        follows = [f"what is left on joint {one.joint} follows {one.follows}" for one in left.lacks if one.follows]
        return list(dict.fromkeys([*events, *follows]))
    return [*_hardly(lacks), *(_little(lacks, left.bouncing) if named else ())]


def _hardly(lacks: Sequence[Lack]) -> list[str]:
    """What is told of joints of ``lacks`` that keep more than chance, though not more than noise that is not known may
    be.
    """
    where = [f"{one.size:.2g} times the noise on joint {one.joint}" for one in lacks if one.hardly]
    if not where:
        return []
    return [f"more than chance is left, {listed(where)}: too small to be told from noise without a motion that repeats"]


def _little(lacks: Sequence[Lack], bouncing: Collection[int]) -> Iterator[str]:
    """What is told of joints of ``lacks`` that keep more than noise, though little beside what was explained there, or
    no more than a link that is ``bouncing`` leaves.
    """
    sizes = {one.joint: f"{one.size:.2g} times the noise on joint {one.joint}" for one in lacks if one.told}
    little, bounced = ([text for joint, text in sizes.items() if (joint in bouncing) == does] for does in (False, True))
    if little:
        yield (
            f"the fitted runs keep more than noise, little beside what was explained there: {listed(little)}; a "
            "diagnosis of the new robot file may show what it is"
        )
    if bounced:
        yield (
            "the fitted runs keep more than noise where a link bounces in a gap, in an order that the smallest error "
            f"changes: {listed(bounced)}"
        )
