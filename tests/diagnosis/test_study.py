"""The study of the diagnosis in short: a simulated robot gives nothing to name, or one clear effect; and the study's
own measures of size, drawing and scoring.
"""

from __future__ import annotations

import json
import re
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from benchmarks.diagnosis_study.archive import archived, asked, restore, store
from benchmarks.diagnosis_study.baselines import named_by_baselines
from benchmarks.diagnosis_study.case import FREE, KNOWN, Case, Hidden, case
from benchmarks.diagnosis_study.drawing import cases, cells, has_place, shares_coulomb
from benchmarks.diagnosis_study.making import file_of, invisible, made
from benchmarks.diagnosis_study.pages.intervals import Share
from benchmarks.diagnosis_study.pages.page import JSON, PAGE, page, tables
from benchmarks.diagnosis_study.pages.power_curve import power_curve
from benchmarks.diagnosis_study.runner import MISMATCH, Plan, result
from benchmarks.diagnosis_study.scoring import NAMED, NOTHING, UNEXPLAINED, scored
from benchmarks.diagnosis_study.sizing import Fit, Size
from benchmarks.diagnosis_study.study import STUDY
from tests.plant.effect import Effect
from tests.plant.library import LAWS
from tests.plant.robots import ROBOTS
from tests.plant.simulate import make_run, own_effects
from tests.plant.size import effect_torque
from tests.plant.trajectories.fourier import fourier

ARM = ROBOTS["three_axis"]
TRUTH = {
    "hidden": [
        {"law": "stribeck", "joint": 2, "joints": [2], "size": 30.0, "invisible": False},
        {"law": "payload", "joint": 1, "joints": [1, 2, 3], "size": 2.0, "invisible": True},
    ]
}


def told(effect: str, joints: list[int], value: float = 30.0, **more: Any) -> dict[str, Any]:
    parameters = {f"Fst{joints[0]}": {"value": value, "std": 1.0, "unit": "N m"}}
    return {"effect": effect, "joints": joints, "status": "firm", "parameters": parameters, **more}


def answer(*findings: dict[str, Any], verdict: str = NAMED, **more: Any) -> dict[str, Any]:
    where = {"joint": 2, "variable": "qd"}
    return {"verdict": verdict, "findings": list(findings), "where": where, "invisible": [], **more}


def test_a_name_is_right_on_its_joint_alone() -> None:
    right = scored(TRUTH, answer(told("stribeck_friction", [2]), invisible=[{"effect": "payload", "joints": []}]))
    assert (right.found, right.first, right.extra, right.within) == (1, True, 0, True)
    assert (right.invisible, right.invisible_told) == (1, 1)
    elsewhere = scored(TRUTH, answer(told("stribeck_friction", [3])))
    assert (elsewhere.found, elsewhere.first, elsewhere.extra) == (0, False, 1)
    assert scored(TRUTH, answer(told("stribeck_friction", [2], 33.0))).within is False
    more = scored(TRUTH, answer(told("offset", [1]), told("stribeck_friction", [2])))
    assert (more.found, more.first, more.extra) == (1, False, 1)


def test_an_equal_alternative_is_listed_and_a_tentative_name_is_none() -> None:
    other = [{"effect": "stribeck_friction", "joints": [2]}]
    listed = scored(TRUTH, answer(told("dahl_friction", [2], alternatives=other)))
    assert (listed.found, listed.listed, listed.extra) == (0, 1, 0)
    unseen = told("torque_gain", [1], alternatives=[{"effect": "payload", "joints": [1]}])
    beside = scored(TRUTH, answer(told("stribeck_friction", [2]), unseen))
    assert (beside.found, beside.listed, beside.extra) == (1, 0, 0)
    weak = told("dahl_friction", [2]) | {"status": "tentative"}
    assert scored(TRUTH, answer(weak, verdict=UNEXPLAINED)).named == ()
    assert scored({"hidden": []}, answer(verdict=NOTHING)).named == ()


def test_a_further_harmonic_is_a_further_effect() -> None:
    """An effect holds two harmonics."""
    ripple = {"law": "ripple_motor", "joint": 2, "joints": [2], "size": 3.0, "invisible": False}
    first, second = told("motor_ripple", [2]), told("wave_generator_ripple", [2])
    assert scored({"hidden": [ripple]}, answer(first)).extra == 0
    assert scored({"hidden": [ripple]}, answer(first, second)).extra == 1


def test_the_share_of_the_gap_that_closed() -> None:
    norms = {"before": (1.0, 5.0, 1.0), "after": (1.0, 2.0, 1.0)}
    residual: dict[str, Any] = {
        kind: {"per_joint": [{"joint": j, "norm": 10 * rms, "rows": 100} for j, rms in enumerate(values, 1)]}
        for kind, values in norms.items()
    }
    residual["noise_floor"] = {"per_joint": [{"joint": j, "rms": 1.0} for j in (1, 2, 3)]}
    score = scored(TRUTH, answer(told("stribeck_friction", [2]), residual=residual))
    assert score.closed == pytest.approx((25 - 4) / (25 - 1))


def test_wilson_intervals() -> None:
    """Against the values that Newcombe (Statistics in Medicine 17, 1998, table I) prints."""
    for hits, count, low, high in ((81, 263, 0.2553, 0.3662), (15, 148, 0.0624, 0.1605), (0, 20, 0.0, 0.1611)):
        assert Share(hits, count).interval == pytest.approx((low, high), abs=5e-5)


def test_every_law_of_the_plant_has_its_answer() -> None:
    assert set(STUDY.outside) == {name for name, law in LAWS.items() if law.outside}
    # What a fit takes up by definition, and what no torque shows, is in no case.
    assert set(LAWS) - set(STUDY.laws) - set(STUDY.outside) == {"rotor_inertia", "link_latency"}
    assert len(STUDY.reserved) >= 6
    assert set(STUDY.reserved) <= set(LAWS)
    assert len(STUDY.laws) >= 24


def test_cases_are_drawn_from_the_seed_alone() -> None:
    for cell in cells():
        for mode in (FREE, KNOWN):
            first, again = (list(islice(cases(cell, mode), 5)) for _ in range(2))
            assert first == again
            assert [case(json.loads(json.dumps(one.record()))) for one in first] == first
    spared = islice(cases("one_3x", FREE, reserved=False), 100)
    assert not {one.law for drawn in spared for one in drawn.hidden} & set(STUDY.reserved)


def test_sizes_are_what_projection_leaves() -> None:
    """A weight on the tool is all but taken up by a free fit, and not by known parameters; friction is by neither."""
    way = fourier(3, period=5.0, periods=2, harmonics=4)
    sizes = {}
    for law in ("payload", "position_friction"):
        effect = Effect(law, 2)
        run = make_run(ARM, way, [effect])
        for known in (False, True):
            sizes[law, known] = Fit([run], effect, known).size([run], [effect_torque(run, effect)])
    assert invisible(sizes["payload", False])
    assert not invisible(sizes["payload", True])
    for known in (False, True):
        size = sizes["position_friction", known]
        assert size.joints == (2,)
        assert 0.3 * size.raw < size.left < size.raw


def test_a_case_holds_what_it_says(tmp_path: Path) -> None:
    drawn = Case("single", "three_axis", FREE, 5, (Hidden("stribeck", 2, 3.0),), "short")
    done = made(drawn)
    done.write(tmp_path)
    truth = json.loads((tmp_path / "truth.json").read_text())
    assert truth["mismatch"] <= MISMATCH
    assert truth["hidden"][0]["left"] == pytest.approx(3.0, rel=0.05)
    assert "stribeck" not in (tmp_path / "robot.yaml").read_text()
    header, row = (tmp_path / "fit1.csv").read_text().splitlines()[:2]
    assert header == "t,qm1,qm2,qm3,i1,i2,i3"
    assert len(row.split(",")) == 7


def test_nothing_is_named_where_nothing_is_hidden(tmp_path: Path) -> None:
    """Where a held-out gate alone names something."""
    nothing = Case("single", "three_axis", FREE, 1, motion="short")
    found = result(nothing, keep=tmp_path)
    assert found["truth"]["mismatch"] <= MISMATCH
    assert found["score"]["named"] == ()
    assert found["score"]["verdict"] == NOTHING
    simpler = named_by_baselines(tmp_path, nothing)
    assert set(simpler) == {"stepwise BIC", "stepwise BIC, white rows", "held-out gate", "STLSQ"}
    assert simpler["held-out gate"]


@pytest.mark.long
@pytest.mark.parametrize(
    "hidden", [Hidden("stribeck", 2, 3.0), Hidden("ripple_motor", 3, 3.0), Hidden("cable_spring", 3, 3.0)], ids=str
)
def test_a_clear_effect_is_found(hidden: Hidden, tmp_path: Path) -> None:
    found = result(Case("single", "three_axis", FREE, 4, (hidden,), "short"), keep=tmp_path)
    assert found["score"]["first"], found["answer"]["findings"]
    assert found["score"]["extra"] == 0
    assert found["score"]["joint_right"]


def test_what_the_robot_has_none_of_is_not_in_its_file() -> None:
    scara = ROBOTS["scara_like"]
    assert "offset" not in file_of(scara, own_effects(scara), 1)
    assert "effect: offset, joints: [1, 2]" in file_of(ARM, [Effect("offset", j, 3.0) for j in (1, 2)], 1)


def test_no_law_is_hidden_where_no_effect_may_stand_for_it() -> None:
    """Joint 3 is a slide: what repeats with a joint's turn is not there, the wave generator turns with the motor."""
    laws = ("ripple_cycloid", "position_friction", "ripple_wave_generator", "offset")
    assert [has_place(law, "scara_like", 3) for law in laws] == [False, False, True, True]
    assert all(has_place(law, "scara_like", 4) for law in laws)
    there = {**record("one_3x", [], [Hidden("ripple_cycloid", 3, 3.0)]), "code": "abc"}
    there["case"]["robot"] = "scara_like"
    found = tables([there], [there])
    assert found["counts"]["misplaced"] == 1
    assert not found["cells"]


def test_no_two_laws_share_the_coulomb_friction_of_a_joint() -> None:
    """Where they take more than there is, friction pushes."""
    coulomb, dahl, elsewhere = (
        Hidden("coulomb", 2, 3.0),
        Hidden("presliding_dahl", 2, 3.0),
        Hidden("gradual_rise", 1, 3.0),
    )
    assert shares_coulomb([coulomb, dahl])
    assert shares_coulomb([dahl, Hidden("gradual_rise", 2, 3.0)])
    assert not shares_coulomb([coulomb, elsewhere])
    assert not shares_coulomb([dahl, elsewhere, Hidden("viscous", 2, 3.0)])
    there = {**record("two", [], [coulomb, dahl]), "code": "abc"}
    assert tables([there], [there])["counts"]["misplaced"] == 1


def test_what_never_acts_need_not_be_called_unexplained() -> None:
    stop = [Hidden("soft_stop", 3, 3.0)]
    unseen = record("outside", [], stop, NOTHING)
    unseen["truth"]["hidden"][0]["invisible"] = True
    unseen["score"] = scored(unseen["truth"], answer(verdict=NOTHING)).record()
    results = [{**one, "code": "abc"} for one in (unseen, record("outside", [], stop, UNEXPLAINED))]
    text = page(tables(results, results))
    assert f"| outside the library | free fit | nothing firmly named | all | {Share(2, 2)} |" in text
    assert f"| outside the library | free fit | called unexplained | 95 % | {Share(1, 1)} |" in text


def test_two_in_the_place_of_one_finding_are_not_both_found() -> None:
    springs = [Hidden("spring_balancer", 2, 3.0), Hidden("gas_isotherm", 2, 3.0)]
    other = [{"effect": "gas_balancer", "joints": [2]}]
    one = told("spring_balancer", [2], alternatives=other)
    results = [{**record("two", named, springs), "code": "abc"} for named in ([one], [one, told("offset", [1])])]
    asked = {row[""]: row["cases"] for row in tables(results, results)["cells"]}
    assert asked["all named"] == str(Share(0, 2))
    assert asked["all named, or listed as equal alternatives"] == str(Share(1, 2))


def record(cell: str, named: list[dict[str, Any]], hidden: list[Hidden], verdict: str = NAMED) -> dict[str, Any]:
    """A result as the runner makes it."""
    drawn = Case(cell, "three_axis", FREE, 1, tuple(hidden))
    acting = [
        {"law": one.law, "joint": one.joint, "joints": [one.joint], "size": 30.0, "torque": 12.0, "invisible": False}
        for one in hidden
    ]
    truth = {"case": drawn.record(), "mismatch": 0.0, "hidden": acting}
    score = scored(truth, answer(*named, verdict=verdict)).record()
    return {
        "case": drawn.record(),
        "truth": truth,
        "seconds": 1.0,
        "score": score,
        "baselines": {"way": [["offset", 2]]},
    }


def test_the_page_says_what_the_results_say() -> None:
    stribeck = [Hidden("stribeck", 2, 3.0)]
    right, wrong = [told("stribeck_friction", [2])], [told("dahl_friction", [2])]
    unseen = record("power_1x", [], stribeck, NOTHING)
    unseen["truth"]["hidden"][0]["invisible"] = True
    results = [
        *(record("one_3x", right, stribeck) for _ in range(3)),
        record("one_3x", wrong, stribeck),
        record("null", [], [], NOTHING),
        record("power_1x", right, stribeck),
        unseen,
        {"case": Case("null", "three_axis", FREE, 2).record(), "skipped": "no size"},
        {"case": Case("null", "three_axis", FREE, 3).record(), "failed": "exit status 1"},
    ]
    before = [{**record("null", right, []), "code": "abc"}, *({**one, "code": "def"} for one in results)]
    found = tables(results, before)
    assert found["counts"] == {"scored": 7, "out of reach": 1, "failed": 1, "scored apart": 0, "misplaced": 0}
    text = page(found)
    assert f"| one effect, 3 x noise | free fit | right effect and joint first | 95 % | {Share(3, 4)} |" in text
    assert f"| nothing hidden | free fit | nothing named | 99 % | {Share(1, 1)} |" in text
    assert f"| nothing hidden | free fit | nothing named | 99 % | {Share(1, 2)} |" in text
    assert (found["every"]["scored"], found["every"]["codes"]) == (8, 2)
    assert "| dahl_friction |" in text
    assert found["power"] == {"stribeck": [{"size": 1.0, "hits": 1, "count": 1}]}
    assert "| stribeck | 1 | 12 |" in text


def test_the_committed_page_is_of_the_committed_results() -> None:
    committed = json.loads(JSON.read_text(encoding="utf-8"))
    assert PAGE.read_text(encoding="utf-8") == page(committed)
    every = archived()
    found = tables([one for one in every if one["code"] == committed["code"]], every)
    assert {key: committed[key] for key in found} == json.loads(json.dumps(found))


def test_a_study_goes_on_from_the_archive_of_the_same_code(tmp_path: Path) -> None:
    archive = tmp_path / "cases.jsonl"
    whole = json.loads(json.dumps(record("null", [], [], NOTHING)))
    name = f"{case(whole['case']).name}.json"
    store("abc", [whole | {"answer": {"verdict": NOTHING}}], archive)
    short = whole | {"code": "abc", "truth": {key: whole["truth"][key] for key in ("mismatch", "hidden")}}
    assert archived(archive) == [short]
    for code, there in (("abc", [name]), ("def", [])):
        restore(tmp_path / code, archive)
        assert [file.name for file in tmp_path.glob(f"{code}/*")] == there


def test_the_archive_keeps_the_last_answer_to_each_case(tmp_path: Path) -> None:
    """Of earlier codes not the draws that were out of reach; what broke off is no less an answer."""
    archive = tmp_path / "cases.jsonl"
    one, other = (Case("null", "three_axis", FREE, seed).record() for seed in (1, 2))
    store("abc", [{"case": one, "score": {}}, {"case": other, "skipped": "no size"}], archive)
    store("def", [{"case": other, "failed": "exit status 1"}], archive)
    assert [(kept["code"], kept["case"]["seed"]) for kept in archived(archive)] == [("abc", 1), ("def", 2)]
    store("ghi", [{"case": one, "score": {"named": []}}], archive)
    again, broken = archived(archive)
    assert again == {"code": "ghi", "case": json.loads(json.dumps(one)), "score": {"named": []}}
    assert (broken["code"], broken["failed"]) == ("def", "exit status 1")
    store("jkl", [{"case": one, "skipped": "no size"}], archive)
    assert [(kept["code"], kept["case"]["seed"]) for kept in archived(archive)] == [("jkl", 1), ("def", 2)]


def test_new_draws_begin_behind_those_that_were_asked(tmp_path: Path) -> None:
    archive, key = tmp_path / "cases.jsonl", ("null", FREE)
    every = list(Plan((key,), 2, 0).draws(*key))
    store("abc", [{"case": every[k].record(), "score": {}} for k in (0, 3)], archive)
    assert asked(archive) == {every[0].name, every[3].name}
    assert list(Plan((key,), 2, 0, asked=asked(archive)).draws(*key)) == every[4:]
    assert list(Plan((key,), 2, 0, asked=frozenset({"another"})).draws(*key)) == every
    assert list(Plan((key,), 2, 0, asked=asked(tmp_path / "none.jsonl")).draws(*key)) == every


def test_the_power_curve_is_drawn() -> None:
    sizes = np.geomspace(0.1, 10, 5)
    curve = power_curve("Power", {"stribeck": [(float(size), Share(k, 4)) for k, size in enumerate(sizes)]})
    assert curve.startswith("<svg")
    assert curve.count('class="band"') == 5


def test_names_of_curves_stand_beside_their_ends() -> None:
    ends = {"low": 0, "high": 4, "highest": 4, "middle": 2}
    curve = power_curve("Power", {name: [(0.1, Share(0, 4)), (10.0, Share(hits, 4))] for name, hits in ends.items()})
    at = {name: float(re.findall(rf'y="([\d.]+)"[^>]*>{name}<', curve)[0]) for name in ends}
    assert sorted(at, key=lambda name: at[name]) == ["high", "highest", "middle", "low"]
    assert max(at.values()) < 310
    assert at["high"] < 60


def test_an_effect_is_invisible_where_it_adds_nothing() -> None:
    assert invisible(Size(1e-4, 1e-4, 1.0, (1,), 0.0))
    assert not invisible(Size(1.0, 0.5, 0.5, (1,), 0.0))
