"""The robot file of a simulated robot, as docs/robot_file.md has it: what is known of it before a run, written from
its data alone.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from math import isclose, pi

from tests.plant.effect import Effect
from tests.plant.known_effects import Entry, entry
from tests.plant.robot import BODY, Robot

#: The name of the parameter set in the file.
PRIOR = "known"


def robot_file(
    robot: Robot,
    leave_out: Collection[str | tuple[str, int]] = (),
    known: Collection[Effect] | None = None,
    told: Callable[[str, float], tuple[float, float | None]] = lambda name, value: (value, None),
) -> str:
    """YAML with the geometry, the drives, rotor inertia, friction, offset and the robot's own effects.

    ``leave_out`` are ids of the generator's effects, or such with a joint (from 1). ``known`` are effects beside the
    simple ones, the robot's own if None. ``told`` turns a parameter's name and true value into the value in the file
    and its relative standard deviation [%], None for none. Elastic drive trains are not written.
    """
    lines = [f"name: {robot.name}", "gravity: [0 m/s2, 0 m/s2, -9.81 m/s2]"]
    if any(robot.base):
        lines.append(
            f"base: {{rotation: [{', '.join(f'{angle} rad' for angle in robot.base)}], translation: [0 m, 0 m, 0 m]}}"
        )
    lines.append("joints:")
    for j, joint in enumerate(robot.chain, 1):
        alpha, d, theta, r = joint.dh
        angle, along = (
            (_angle(theta), _plus(f"q{j}", r, "m")) if joint.prismatic else (_turn(f"q{j}", theta), _length(r))
        )
        unit = "m" if joint.prismatic else "rad"
        limits = f"[{joint.range[0]!r} {unit}, {joint.range[1]!r} {unit}]"
        lines.append(
            f"  - {{j: {j}, sigma: {int(joint.prismatic)}, alpha: {_angle(alpha)}, d: {_length(d)}, theta: {angle}, "
            f"r: {along}, limits: {limits}}}"
        )
    n = robot.joints
    lines.append(f"  - {{j: {n + 1}, sigma: 2, alpha: 0, d: 0, theta: 0, r: {_length(robot.tool)}, tool: true}}")
    lines += ["drives:", f"  gear_ratios: [{', '.join(joint.ratio for joint in robot.chain)}]"]
    if robot.coupling:
        elements = ", ".join(f"N{motor}{joint}: {text}" for motor, joint, text in robot.coupling)
        lines.append(f"  coupling: {{convention: direct, {elements}}}")
    constants = ", ".join(repr(joint.constant) for joint in robot.chain)
    lines.append(f"  torque_constants: {{unit: N m/A, use: data, data: [{constants}]}}")
    simple = {"rotor_inertia": "Ia", "viscous_friction": "Fv", "coulomb_friction": "Fc", "offset": "Off"}
    kept = {name: stem for name, stem in simple.items() if name not in leave_out}
    there = {name: [j for j in range(1, n + 1) if (name, j) not in leave_out] for name in kept}
    uses = [f"  - {{effect: {name}, joints: {joints}}}" for name, joints in there.items() if joints]
    values = _standard(robot, {kept[name]: joints for name, joints in there.items()})
    for one in _entries(robot.own if known is None else known, robot):
        if one.effect not in leave_out and (one.effect, one.joint) not in leave_out:
            uses.append(one.line)
            for stem, (value, unit) in one.parameters.items():
                name = f"{stem}{one.joint}"
                values[name] = (values.get(name, (0.0, unit))[0] + value, unit)
    lines += ["effects:", *uses] if uses else ["effects: []"]
    lines += ["parameters:", f"  {PRIOR}:", "    description: values of the simulation", "    values:"]
    for name, (value, unit) in values.items():
        shown, relative = told(name, value)
        spread = "" if relative is None else f", relative_std: {relative:g}"
        lines.append(f"      {name}: {{value: {shown!r}, unit: {unit}{spread}}}")
    return "\n".join(lines) + "\n"


def _standard(robot: Robot, kept: Mapping[str, Collection[int]]) -> dict[str, tuple[float, str]]:
    """Values and units of bodies, and of the simple effects by their stems on joints that have them."""
    values: dict[str, tuple[float, str]] = {}
    for j, joint in enumerate(robot.chain, 1):
        for name, value in zip(BODY, joint.body, strict=True):
            unit = "kg" if name == "M" else ("kg m" if name[0] == "M" else "kg m2")
            values[f"{name}{j}"] = (float(value), unit)
        inertia, viscous, force = ("kg", "N s/m", "N") if joint.prismatic else ("kg m2", "N m s/rad", "N m")
        drive = {
            "Ia": (joint.rotor, inertia),
            "Fv": (joint.viscous, viscous),
            "Fc": (joint.coulomb, force),
            "Off": (joint.offset, force),
        }
        values |= {f"{stem}{j}": drive[stem] for stem, joints in kept.items() if j in joints}
    return values


def _entries(effects: Collection[Effect], robot: Robot) -> list[Entry]:
    """One entry for each effect of a robot file and joint."""
    entries: dict[tuple[str, int], Entry] = {}
    for effect in effects:
        one = entry(effect, robot)
        if one is not None:
            key = (one.effect, one.joint)
            entries[key] = entries[key].merged(one) if key in entries else one
    return list(entries.values())


def _angle(value: float) -> str:
    quarters = round(2 * value / pi)
    if isclose(value, quarters * pi / 2, abs_tol=1e-15):
        return "0" if quarters == 0 else f"{quarters}*pi/2"
    return f"{value!r} rad"


def _turn(variable: str, value: float) -> str:
    return variable if value == 0 else f"{variable} + {_angle(value)}"


def _length(value: float) -> str:
    return "0" if value == 0 else f"{value!r} m"


def _plus(variable: str, value: float, unit: str) -> str:
    return variable if value == 0 else f"{variable} + {value!r} {unit}"
