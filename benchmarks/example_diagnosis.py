"""The worked example of docs/diagnosis.md: a simulated KR500 with two effects that its robot file lacks.

``python -m benchmarks.example_diagnosis`` simulates four runs, diagnoses them, writes the numbers and pictures of the
page and the README anew. The report's screenshot needs a Chromium; without one the old picture stays.
"""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

from benchmarks.binned import Curve, binned
from benchmarks.chart import Group, chart
from benchmarks.documents import README, ROOT, replaced
from benchmarks.table import table
from generator.progress import stage
from generator.resources import find_robot
from generator.robot.description import ParameterSet, ParameterValue
from generator.robot.readers import read
from identification.cli.diagnose import summary, tested
from identification.diagnosis.columns.hypothesis import EFFECT
from identification.diagnosis.command import Request, diagnosed
from identification.diagnosis.diagnosis import Diagnosis
from identification.diagnosis.mending.addition import Addition
from identification.diagnosis.mending.mended import Mended
from identification.diagnosis.mending.repair import repaired
from identification.diagnosis.noise.noise_floor import noise_floor
from identification.diagnosis.runs.played import together
from identification.report.diagnose.report import report
from identification.report.page import REPORT
from identification.robot_file import with_parameter_set
from identification.simulation.machine import compiled
from identification.simulation.run_file import save
from identification.simulation.settings import Settings
from identification.simulation.simulate import simulate
from tests.extra.browser import COMMANDS

ROBOT = "kr500"
FOLDER = ROOT / "build" / "example_diagnosis"
PAGE, PICTURES = Path("docs/diagnosis.md"), Path("docs/images")

#: What the simulated robot has and its file lacks, with parameters [1, N m].
HIDDEN = (
    Addition(EFFECT, "load_friction", (2,), {"rotor": 6000.0}),
    Addition(EFFECT, "stribeck_friction", (3,), {"vs": 0.05, "exponent": 1.0}),
)
PARAMETERS = {"Fl2": ParameterValue(0.08, "1"), "Fst3": ParameterValue(900.0, "N m")}
SET = "machine"
#: Two runs are fitted, one validates, one stays untouched; four periods of 5 s each.
RUNS = ("A", "B", "C", "D")

_WIDTH, _HEIGHT = 1100, 1500


def machine_file() -> Path:
    """The file of the robot as it is: that of robots/ with what is hidden."""
    text = find_robot(ROBOT).read_text(encoding="utf-8")
    twin = read(find_robot(ROBOT)).parameter_sets["twin"]
    one = ParameterSet(SET, "the twin with friction of its own", "made up", {**twin.values, **PARAMETERS})
    path = FOLDER / f"{SET}.yaml"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(with_parameter_set(repaired(text, path.name, HIDDEN).text, one), encoding="utf-8")
    return path


def record() -> list[str]:
    """Runs of the machine; their paths."""
    robot = read(machine_file())
    paths = []
    with stage(f"simulating {len(RUNS)} runs"), compiled(robot) as machine:
        for seed, name in enumerate(RUNS, 1):
            settings = Settings(
                trajectory_settings={"frequency": 0.2},
                parameters=SET,
                duration=20.0,
                seed=seed,
                log_rate=250.0,
                resolution=[1e-5],
                noise=[0.1],
            )
            paths.append(str(save(simulate(machine, settings), robot.name, robot.digest, FOLDER / f"{name}.csv")[0]))
    return paths


def pictures(found: Diagnosis, new: Mended) -> dict[Path, str]:
    """By their paths in the repository."""
    before, after = (together(played).per_joint for played in (new.before, new.after))
    rate = 1 / float(new.after[0].t[1] - new.after[0].t[0])
    groups = []
    for k, joint in enumerate(found.robot.moving):
        floor = noise_floor(found.search.bank, k, rate)
        bars = {name: one[k].norm / one[k].rows ** 0.5 / floor for name, one in (("before", before), ("after", after))}
        groups.append(Group(f"joint {joint.number}", bars))
    drawn = {PICTURES / "diagnosis_gap.svg": chart("Residual on the untouched run, rms", groups, "the noise's rms")}
    for one in found.findings:
        joint, variable = one.joints[0], one.hypothesis.variable
        drawn[PICTURES / f"diagnosis_{one.hypothesis.effect}.svg"] = _view(found, joint, variable)
    return drawn


def _view(found: Diagnosis, joint: int, variable: str) -> str:
    curves, band, unit = [], [], ""
    for where, after in ((found.before, False), (found.after, True)):
        for i, one in enumerate(view for view in where.views[joint] if view.variable == variable):
            way = {-1: "backward ", 0: "", 1: "forward "}[one.direction]
            curves.append(Curve(f"{way}{'after' if after else 'before'}", one.centre, one.mean, i, after))
            if not band:
                band, unit = one.band.tolist(), one.unit
    title = f"Residual of joint {joint} over {variable}"
    return binned(title, f"{variable} [{unit}]", "residual [N m]", curves, band)


def numbers(found: Diagnosis) -> str:
    """What was found beside what was hidden."""
    rows: list[dict[str, object]] = []
    truth = {name: one.value for name, one in PARAMETERS.items()}
    truth |= {name: value for one in HIDDEN for name, value in one.values.items()}
    for one in found.findings:
        rows += [
            {
                "effect": one.hypothesis.title,
                "parameter": each.name,
                "hidden": f"{truth[each.name]:g}" if each.name in truth else "",
                "found": f"{each.value:.4g}",
                "std": "" if each.std is None else f"{each.std:.2g}",
            }
            for each in one.told
        ]
    return table(rows)


def screenshot(report: Path, picture: Path) -> bool:
    """The report's first page as a picture; False without a browser."""
    browser = next((path for name in COMMANDS if (path := shutil.which(name))), None)
    if browser is None:
        return False
    flags = ("--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--virtual-time-budget=10000")
    place = (f"--window-size={_WIDTH},{_HEIGHT}", f"--screenshot={picture}", f"--user-data-dir={FOLDER / 'profile'}")
    subprocess.run([browser, *flags, *place, report.as_uri()], check=True, capture_output=True, timeout=120)
    return True


def main() -> None:
    """Simulates, diagnoses, writes the pages."""
    a, b, c, d = record()
    path = find_robot(ROBOT)
    found, new, files = diagnosed(
        path, read(path), Request([a, b], [c], [d]), FOLDER / "out", lambda *about: {REPORT: report(*about)}
    )
    assert new is not None
    printed = [*summary(found), *tested(new), f"files            {', '.join(files)} in build/example_diagnosis/out/"]
    output = "\n".join(["```text", *printed, "```"])
    readme, page = (
        replaced((ROOT / name).read_text(encoding="utf-8"), "example output", output) for name in (README, PAGE)
    )
    page = replaced(page, "example numbers", numbers(found))
    for name, content in ({README: readme, PAGE: page} | pictures(found, new)).items():
        (ROOT / name).write_text(content, encoding="utf-8")
    if not screenshot(FOLDER / "out" / REPORT, ROOT / PICTURES / "diagnosis_report.png"):
        print("no browser: docs/images/diagnosis_report.png stays as it was")
    print("\n".join(printed))


if __name__ == "__main__":
    main()
