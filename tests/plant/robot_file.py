"""The robot file of a simulated robot, as docs/robot_file.md has it: what is known of it before a run, written from
its data alone.
"""

from __future__ import annotations

from collections.abc import Callable, Collection
from math import isclose, pi

from tests.plant.robot import BODY, Robot

#: The name of the parameter set in the file.
PRIOR = "known"


def robot_file(robot: Robot, leave_out: Collection[str] = ()) -> str:
    """YAML with the geometry, the drives, rotor inertia, friction, offset and the balancer, and their true values.

    ``leave_out`` are ids of the generator's effects. The coupling of a wrist's rotors and elastic drive trains are
    not written.
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
    lines.append("effects:" if kept else "effects: []")
    lines += [f"  - {{effect: {name}, joints: all}}" for name in kept]
    values = _standard(robot, kept)
    for effect in robot.own:
        if effect.law == "spring_balancer" and effect.law not in leave_out:
            stiffness = effect.amount(robot)
            values[f"Kr{effect.joint}"] = (stiffness, "N/m")
            values[f"K0{effect.joint}"] = (-stiffness * effect.value("free_length", robot), "N")
            lines.append(_balancer("spring_balancer", effect.joint, _crank(effect.value, robot)))
        elif effect.law in ("gas_isotherm", "gas_polytrope") and "gas_balancer" not in leave_out:
            exponent = 1.0 if effect.law == "gas_isotherm" else effect.value("exponent", robot)
            values[f"F0{effect.joint}"] = (effect.amount(robot), "N")
            shape = f"{_crank(effect.value, robot)}, l0: {effect.value('l0', robot)!r} m, exponent: {exponent:g}"
            lines.append(_balancer("gas_balancer", effect.joint, shape))
    lines += ["parameters:", f"  {PRIOR}:", "    description: true values of the simulation", "    values:"]
    lines += [f"      {name}: {{value: {value!r}, unit: {unit}}}" for name, (value, unit) in values.items()]
    return "\n".join(lines) + "\n"


def _standard(robot: Robot, kept: dict[str, str]) -> dict[str, tuple[float, str]]:
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
        values |= {f"{stem}{j}": drive[stem] for stem in kept.values()}
    return values


def _crank(value: Callable[[str, Robot], float], robot: Robot) -> str:
    return ", ".join(
        f"{name}: {value(name, robot)!r} {unit}" for name, unit in (("d21", "m"), ("d22", "m"), ("phi", "rad"))
    )


def _balancer(name: str, joint: int, values: str) -> str:
    return f"  - {{effect: {name}, joint: {joint}, values: {{{values}}}}}"


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
