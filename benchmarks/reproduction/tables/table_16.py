"""Table 16: torque constants of motors 1 to 3 of the KR500-2MT by steps of force."""

from __future__ import annotations

from benchmarks.reproduction.results import Results
from benchmarks.reproduction.rows import Row, parameter_rows, printed_set
from generator.resources import find_robot
from generator.robot.readers import read

TITLE = "Table 16: KR500-2MT, torque constants by steps of force"


def rows(results: Results) -> list[Row]:
    """With the difference to the maker's, a priori, as the report gives it."""
    drives = read(find_robot("kr500")).drives
    assert drives is not None
    maker = [float(kt) for kt in drives.torque_constants["warm"]]
    found = results.estimates("force_steps", "torque constants")
    printed = printed_set("kr500", "report_table_16")
    result = []
    for row in parameter_rows(found, printed):
        name = str(row["parameter"])
        a_priori = maker[int(name.removeprefix("kt")) - 1]
        both = {"printed": printed[name].value, "ours": found[name].value}
        differences = {f"{who}, to the maker's [%]": f"{100 * (kt / a_priori - 1):+.1f}" for who, kt in both.items()}
        result.append({**row, **differences})
    return result
