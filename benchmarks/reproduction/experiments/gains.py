"""KR270-2F: drive gains and parameters at once, from a run without and one with a payload of 175 kg (section 5.1)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from benchmarks.reproduction.experiment import Estimate, Found, saved
from benchmarks.reproduction.experiments.idim_ls import RECIPE
from generator.resources import find_robot
from generator.robot.readers import read
from identification.drive_gains import drive_gains
from identification.drive_train import coupling
from identification.observation import Regressors
from identification.sidecar import UNITS, Payload
from identification.simulation.machine import compiled
from identification.simulation.settings import Settings
from identification.simulation.simulate import noisy, simulate

TITLE = "KR270-2F, drive gains by total least squares with a known payload mass"
COVERING = ("gains",)

MOTION = Settings(
    trajectory_settings={"frequency": 0.1, "harmonics": 5, "speed": 1.5, "acceleration": 4.0},
    duration=40.0,
    seed=1,
    resolution=(1e-4,),
)
#: Rms of the currents' noise [A] with which the residuals are those of Table 8.
NOISE = (3.1, 3.9, 2.3, 1.1, 1.9, 3.25)
#: Mass and MZ of Table 7; the rest is assumed. On the axis of joint 6 no mass would show the sixth gain: it is 0.15 m
#: beside it.
PAYLOAD = {"XX": 13.3, "XZ": 5.7, "YY": 17.3, "ZZ": 7.9, "MX": 26.3, "MZ": -38.2, "M": 175.0}
#: Of the payload's mass [kg], as weighed.
WEIGHED = 0.1


def play(seeds: Sequence[int], folder: Path) -> Iterator[Found]:
    """Gains, and base parameters with the payload's."""
    robot = read(find_robot("kr270"))
    regressors = Regressors(robot)
    with compiled(robot) as machine:
        empty = simulate(machine, MOTION)
        loaded = simulate(machine, replace(MOTION, payload=Payload("L", PAYLOAD)))
    # What the sidecar would tell of the payload is what is sought.
    loaded = replace(loaded, settings=MOTION)
    ratios = np.diag(coupling(robot))
    units = {parameter.name: parameter.unit for parameter in regressors.model.base_parameters}
    units |= {f"{stem}L": unit for stem, unit in UNITS.items()}
    truth = {**empty.parameters, **{f"{stem}L": PAYLOAD.get(stem, 0.0) for stem in UNITS}}
    for seed in seeds:
        runs = [
            saved(noisy(run, NOISE, seed=2 * seed + k), robot, folder / f"{name}.csv")
            for k, (name, run) in enumerate({"empty": empty, "loaded": loaded}.items())
        ]
        weighed = PAYLOAD["M"] + WEIGHED * np.random.default_rng([seed, 3]).normal()
        payload = Payload("L", {"M": float(weighed)})
        found = drive_gains(robot, runs[:1], runs[1:], payload, {"M": WEIGHED}, RECIPE, regressors)
        gains = tuple(
            Estimate(f"g_tau{m + 1}", "N m/A", float(ratios[m]) * empty.parameters[f"kt{m + 1}"], *found.gain(m))
            for m in found.constants
        )
        parameters = tuple(
            Estimate(name, units[name], truth[name], value, std)
            for name, (value, std) in found.parameters.items()
            if np.isfinite(std)
        )
        each = tuple(one.relative_to_mean for one in found.residuals.per_joint.values())
        yield Found({"gains": gains, "parameters": parameters}, {"gains": each})
