"""Robots for the tests: every file in robots/ (a new one is tested by being there) and random chains."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from random import Random

import pytest
from hypothesis import HealthCheck, settings

from generator.resources import robots
from generator.robot.description import Robot
from generator.robot.readers import read
from identification.observation import Regressors
from identification.simulation.machine import Machine, compiled
from tests.chains import every_effect, random_robot
from tests.commands import PENDULUM
from tests.diagnosis.diagnosed import Known, known
from tests.elastic_links import robot_text
from tests.libraries import built_once
from tests.plant.robots import ROBOTS
from tests.recorded import TRUTH, Recorded, recorded, two_links
from tests.simulated import Make, maker
from tests.subject import Subject, subject


def _on_cores_of_its_own() -> None:
    """Of several processes that test, each has its share of the cores: what one shares among processes stays there."""
    if "PYTEST_XDIST_WORKER" in os.environ and hasattr(os, "sched_setaffinity"):
        number = int(os.environ["PYTEST_XDIST_WORKER"].removeprefix("gw"))
        if cores := sorted(os.sched_getaffinity(0))[number :: int(os.environ["PYTEST_XDIST_WORKER_COUNT"])]:
            os.sched_setaffinity(0, cores)


_on_cores_of_its_own()

# What these assert is told as what a test asserts.
pytest.register_assert_rewrite("tests.core_quantities", "tests.regressor_rank")

FILES = {path.stem: path for path in robots()}
EVERY = "every_effect"
#: Robots whose generic tests are of make test-long: further arms of six turning joints, and the chains of twelve joints
#: of report Table 5.
FURTHER = ("kr270_calibrated", "kr270_table5", "kr300", "kr500_table5", "puma560", "tx40")
ALL = [*(pytest.param(name, marks=pytest.mark.long) if name in FURTHER else name for name in FILES), EVERY]
CHAINS = {f"chain{seed}": seed for seed in range(6)}

# The suite must say the same twice; HYPOTHESIS_PROFILE=explore looks for new chains.
_COMMON = {"deadline": None, "suppress_health_check": [HealthCheck.too_slow], "print_blob": True}
settings.register_profile("steady", derandomize=True, max_examples=8, **_COMMON)
settings.register_profile("explore", max_examples=300, **_COMMON)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "steady"))


@cache
def derived(name: str) -> Subject:
    """A robot file, or the robot with every effect, with all of its quantities."""
    return subject(every_effect() if name == EVERY else read(FILES[name]))


@cache
def _chain(name: str) -> Subject:
    return subject(random_robot(Random(CHAINS[name])))


@pytest.fixture(scope="session", autouse=True)
def _libraries(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """Robots that many tests simulate or diagnose are compiled by one of them, whichever process it is of."""
    own = tmp_path_factory.getbasetemp()
    kept = (own.parent if "PYTEST_XDIST_WORKER" in os.environ else own) / "libraries"
    kept.mkdir(exist_ok=True)
    with pytest.MonkeyPatch.context() as patch:
        for user in ("simulation.machine", "diagnosis.runs.played"):
            patch.setattr(f"identification.{user}.build_library", built_once(kept))
        yield


@pytest.fixture(scope="session", params=[*ALL, *CHAINS])
def arm(request: pytest.FixtureRequest) -> Subject:
    """Each robot file, the robot with every effect and each random chain, derived."""
    name = request.param
    return _chain(name) if name in CHAINS else derived(name)


@pytest.fixture(scope="session", params=ALL)
def robot_arm(request: pytest.FixtureRequest) -> Subject:
    """Each robot file and the robot with every effect, derived."""
    return derived(request.param)


@pytest.fixture(scope="session")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The robot file of two elastic links, for modules without a ``file`` of their own."""
    path = tmp_path_factory.mktemp("elastic_links") / "two_links.yaml"
    path.write_text(robot_text())
    return path


@pytest.fixture
def pendulum(tmp_path: Path) -> Path:
    """The robot file of one link, for modules without a ``pendulum`` of their own."""
    path = tmp_path / "pendulum.yaml"
    path.write_text(PENDULUM)
    return path


@pytest.fixture(scope="session")
def links(tmp_path_factory: pytest.TempPathFactory) -> Regressors:
    """Two links with drives, for modules without ``links`` of their own."""
    return two_links(tmp_path_factory.mktemp("two_links"))


@pytest.fixture(scope="session")
def robot(links: Regressors) -> Robot:
    """What their file says, for modules without a ``robot`` of their own."""
    return links.model.robot


@pytest.fixture(scope="session")
def good(links: Regressors) -> Recorded:
    """A run of theirs in which nothing is wrong."""
    return recorded(links, TRUTH, duration=8.0)


@pytest.fixture(scope="session")
def known_robots(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Known]:
    """Simulated robots by name, each beside its model."""
    folder = tmp_path_factory.mktemp("known_robots")
    return cache(lambda name: known(ROBOTS[name], folder))


@pytest.fixture(scope="session")
def make(tmp_path_factory: pytest.TempPathFactory) -> Make:
    """Compiles simulations of subjects."""
    return maker(tmp_path_factory.mktemp("simulations"))


@pytest.fixture(scope="session")
def machine(file: Path) -> Iterator[Machine]:
    """Their compiled simulation."""
    with compiled(read(file)) as made:
        yield made
