"""The report's experiments on the twins: intervals hold, residuals are the report's, the page says what was found."""

from __future__ import annotations

from pathlib import Path

import pytest
from scipy.stats import binomtest

import benchmarks.reproduction.experiments
import benchmarks.reproduction.tables
from benchmarks.reproduce import main, played
from benchmarks.reproduction.coverage import coverage, share, worst
from benchmarks.reproduction.experiment import Estimate, Found
from benchmarks.reproduction.page import PAGE, page
from benchmarks.reproduction.results import Results, read
from benchmarks.reproduction.rows import printed_numbers
from generator.discovery import modules

EXPERIMENTS = {one.__name__.rpartition(".")[2]: one for one in modules(benchmarks.reproduction.experiments)}
#: Experiments short enough to be played here, with their draws of the noise.
PLAYED = {"idim_ls": 2, "locked_output": 10, "gains": 2}
#: Parts of all estimates that must be inside, and that of each parameter at least [%].
POOLED, LEAST = (92.0, 98.0), 86.0
#: Draws of the noise that count.
DRAWS = 100
#: Standard deviations beyond which no estimate of some draws may be: few draws say nothing of a share.
FARTHEST = 6.0
#: Tables of residuals, and the models whose they are.
RESIDUALS = {"table_8": ("gains", "gains"), "table_12": ("idim_ls", "full")}


@pytest.fixture(scope="module")
def results() -> Results:
    return read()


# -- what was found and is kept ---------------------------------------------------------------------------------------


def test_the_page_says_what_was_found(results: Results) -> None:
    wrong = "`python -m benchmarks.reproduction.page` writes it anew"
    assert PAGE.read_text(encoding="utf-8") == page(results), wrong


def test_every_experiment_was_played_often_enough(results: Results) -> None:
    draws = {name: one["draws"] for name, one in results.experiments.items()}
    assert set(draws) == set(EXPERIMENTS)
    assert all(count >= DRAWS for count in draws.values()), draws


@pytest.mark.parametrize("name", EXPERIMENTS)
def test_true_values_are_inside_as_often_as_stated(results: Results, name: str) -> None:
    """All models of a method together, and each parameter of each model."""
    counted = [results.coverage(name, model) for model in EXPERIMENTS[name].COVERING]
    pooled = {key: sum(one[key] for one in counted) for key in ("inside", "count")}
    assert POOLED[0] <= share(pooled) <= POOLED[1]
    for one in counted:
        for parameter, its in one["parameters"].items():
            # Of those that few draws show, chance alone may keep some outside.
            rare = binomtest(its["inside"], its["count"], LEAST / 100, alternative="less").pvalue < 0.01
            assert share(its) >= LEAST or (its["count"] < DRAWS and not rare), parameter


@pytest.mark.parametrize("table", RESIDUALS)
def test_residuals_are_those_of_the_report(results: Results, table: str) -> None:
    found = results.residuals(*RESIDUALS[table])
    assert found == pytest.approx(list(printed_numbers(table).values()), rel=0.2)


def test_every_table_has_its_rows(results: Results) -> None:
    tables = list(modules(benchmarks.reproduction.tables))
    assert tables
    for module in tables:
        assert module.rows(results), module.TITLE


# -- played anew ------------------------------------------------------------------------------------------------------


@pytest.fixture(
    scope="module",
    params=["idim_ls", *(pytest.param(name, marks=pytest.mark.long) for name in ("locked_output", "gains"))],
)
def fresh(request: pytest.FixtureRequest) -> tuple[str, list[Found]]:
    return request.param, played(request.param, range(PLAYED[request.param]))


def test_what_is_kept_is_found_again(fresh: tuple[str, list[Found]], results: Results) -> None:
    name, founds = fresh
    for model, estimates in founds[0].models.items():
        kept = results.estimates(name, model)
        for one in estimates:
            # Rounding moves a robot that sticks and slips by more than its last digits.
            assert one.value == pytest.approx(kept[one.name].value, abs=0.05 * one.std)
            assert one.std == pytest.approx(kept[one.name].std, rel=0.02)


def test_residuals_and_coverage_of_some_draws(fresh: tuple[str, list[Found]]) -> None:
    """Exact binomial bounds on what is independent, the draws of each parameter; none of them is far off."""
    name, founds = fresh
    for table, (experiment, model) in RESIDUALS.items():
        if experiment == name:
            for found in founds:
                assert found.residuals[model] == pytest.approx(list(printed_numbers(table).values()), rel=0.25)
    for model in EXPERIMENTS[name].COVERING:
        counted = coverage(founds)[model]
        assert share(counted) > 80.0
        assert max(abs(one.deviations) for found in founds for one in found.models[model]) < FARTHEST
        for one in counted["parameters"].values():
            assert binomtest(one["inside"], one["count"], 0.92, alternative="less").pvalue > 1e-4


# -- counting ---------------------------------------------------------------------------------------------------------


def test_coverage_counts_what_is_inside() -> None:
    def found(*deviations: float) -> Found:
        return Found({"full": tuple(Estimate(f"p{k}", "m", 1.0, 1.0 + d, 1.0) for k, d in enumerate(deviations))})

    counted = coverage([found(0.0, 2.5), found(-1.9, 0.5), found(2.1, -3.0)])["full"]
    assert (counted["inside"], counted["count"]) == (3, 6)
    assert counted["parameters"]["p0"] == {"inside": 2, "count": 3, "bias": 0.067, "spread": 1.634}
    assert worst(counted) == "p1"
    assert share(counted["parameters"]["p1"]) == pytest.approx(100 / 3)


def test_wrong_words_are_one_line(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    for word, error in (
        ("only=gain", "error: benchmarks/reproduction/experiments:1:1: there is no experiment 'gain', expected one of"),
        ("seeds=x", "error: seeds:1:1: 'x', expected a number of draws"),
    ):
        assert main([word]) == 2
        assert capsys.readouterr().err.startswith(error)
