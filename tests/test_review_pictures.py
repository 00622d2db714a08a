"""The pictures of the review: curves of the balancers and the arm, against the model's own numbers."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from dataclasses import replace
from itertools import pairwise
from math import degrees, pi
from pathlib import Path

import numpy as np
import pytest
import sympy

from generator.derivation import derive
from generator.review.formula import formula
from generator.review.picture.arm import draw
from generator.review.picture.skeleton import place, skeleton
from generator.review.plain import plain
from generator.review.plot import Curve, plot
from generator.robot.description import PRISMATIC, REVOLUTE
from generator.robot.readers import read
from generator.symbolic.interpret import evaluate
from tests import chains
from tests.plant.robot_file import robot_file
from tests.plant.robots import ROBOTS
from tests.reviewed import SVG, files, model, page
from tests.subject import Subject, close


@pytest.mark.parametrize(
    ("name", "angle"), [("kr500", -pi + 1.6293), pytest.param("kr270", -pi + 1.6148, marks=pytest.mark.long)]
)
def test_the_dead_centre_stands_where_the_lever_arm_ends(name: str, angle: float) -> None:
    plots = [p for p in page(model(name)).iter(f"{SVG}svg") if p.attrib.get("class") == "plot"]
    assert len(plots) == 3
    joint = model(name).robot.joints[1]
    assert joint.lower is not None
    assert joint.upper is not None
    low, high = degrees(float(joint.lower)), degrees(float(joint.upper))
    for picture in plots:
        (curve, *_) = (line for line in picture.iter(f"{SVG}polyline") if "curve" in line.attrib["class"])
        track = [tuple(map(float, pair.split(","))) for pair in curve.attrib["points"].split()]
        left, right = track[0][0], track[-1][0]
        (marker,) = (line for line in picture.iter(f"{SVG}path") if line.attrib["class"] == "marker")
        at = float(marker.attrib["d"].split()[1])
        assert low + (at - left) / (right - left) * (high - low) == pytest.approx(degrees(angle), abs=0.05)


@pytest.mark.parametrize("name", ["kr500", pytest.param("kr270", marks=pytest.mark.long)])
def test_balancer_curves_are_the_generated_functions_values(name: str) -> None:
    of = model(name)
    pictures = [p for p in page(of).iter(f"{SVG}svg") if p.attrib.get("class") == "plot"]
    sets = [one for one in of.robot.parameter_sets.values() if {"F02", "Kr2"} & set(one.values)]
    assert sets
    joint = of.robot.joints[1]
    q = np.zeros((2, of.dof))
    assert joint.lower is not None
    assert joint.upper is not None
    q[:, 1] = float(joint.lower), float(joint.upper)
    parameters = of.default_parameters()
    for k, parameter in enumerate(of.parameters):
        if parameter.name in sets[0].values:
            parameters[k] = sets[0].values[parameter.name].value
    ends = evaluate(of.functions["balancer"], {"q": q, "parameters": parameters})
    for picture, (quantity, (first, last)) in zip(pictures, ends.items(), strict=True):
        assert quantity in (picture.findtext(f"{SVG}title") or "")
        ticks = [
            (float(label.attrib["y"]) - 4, float((label.text or "").replace("−", "-")))
            for label in picture.iter(f"{SVG}text")
            if label.attrib["class"] == "tick" and label.attrib["text-anchor"] == "end" and label.text != "dead centre"
        ]
        slope, zero = np.polyfit([at for at, _ in ticks], [shown for _, shown in ticks], 1)
        curve = next(line for line in picture.iter(f"{SVG}polyline") if "curve-0" in line.attrib["class"])
        track = [tuple(map(float, pair.split(","))) for pair in curve.attrib["points"].split()]
        assert slope * track[0][1] + zero == pytest.approx(first, abs=abs(0.2 * slope))
        assert slope * track[-1][1] + zero == pytest.approx(last, abs=abs(0.2 * slope))


def test_a_plot_stays_in_its_frame() -> None:
    across = [float(k) for k in range(11)]
    picture = ElementTree.fromstring(plot("t", "x [m]", "y [N]", across, [Curve("square", [k * k for k in across])]))
    _, _, width, height = map(float, picture.attrib["viewBox"].split())
    curve = picture.find(f".//{SVG}polyline")
    assert curve is not None
    track = [tuple(map(float, pair.split(","))) for pair in curve.attrib["points"].split()]
    assert all(0 < a < width and 0 < b < height for a, b in track)
    assert all(b > a for (a, _), (b, _) in pairwise(track))
    assert all(d < c for (_, c), (_, d) in pairwise(track))
    flat = plot("t", "x", "y", across, [Curve("flat", [2.0] * 11)])
    assert ElementTree.fromstring(flat).find(f".//{SVG}polyline") is not None


def test_the_drawn_frames_are_the_models(arm: Subject) -> None:
    q, _, _ = arm.state(3)
    robot = replace(
        arm.robot,
        lengths=tuple(
            replace(length, value=sympy.Float(arm.values[length.name])) if length.symbolic else length
            for length in arm.robot.lengths
        ),
    )
    placement = place(skeleton(robot), q)
    assert close(placement.frames[1:], arm.generated("transforms", {"q": q})["T"])
    for link, corners in zip(skeleton(robot).links, placement.corners, strict=True):
        assert close(corners[0], placement.frames[link.joint.antecedent, :3, 3])
        assert close(corners[3], placement.frames[link.joint.number, :3, 3])


def test_the_arm_is_drawn_within_its_limits(arm: Subject) -> None:
    drawing = draw(arm.robot)
    for joint, position in zip(arm.robot.moving, drawing.q, strict=True):
        assert joint.lower is None or position >= float(joint.lower) - 1e-9
        assert joint.upper is None or position <= float(joint.upper) + 1e-9


@pytest.mark.parametrize("ends", [(180, 360), (-350, -170)])
def test_limits_far_from_zero_are_kept(ends: tuple[int, int]) -> None:
    lower, upper = (sympy.Rational(one, 180) * sympy.pi for one in ends)
    far = replace(chains.joint(2, REVOLUTE, sympy.pi / 2, sympy.Rational(1, 2)), lower=lower, upper=upper)
    assert (
        float(lower) - 1e-9 <= draw(chains.robot("far", (chains.joint(1, REVOLUTE), far))).q[1] <= float(upper) + 1e-9
    )


def test_the_arm_shows_its_joints_lengths_and_frames(robot_arm: Subject) -> None:
    drawing = draw(robot_arm.robot)
    texts = []
    for _, markup in drawing.views:
        picture = ElementTree.fromstring(markup)
        _, _, width, height = map(float, picture.attrib["viewBox"].split())
        for label in picture.iter(f"{SVG}text"):
            assert 0 < float(label.attrib["x"]) < width
            assert 0 < float(label.attrib["y"]) < height
            texts += "".join(label.itertext()).replace("\u200b", "").split(", ")
        symbols = [title.text or "" for title in picture.iter(f"{SVG}title")]
        for joint in robot_arm.robot.moving:
            kind = "prismatic" if joint.sigma == PRISMATIC else "revolute"
            assert f"joint {joint.number}, {kind}" in symbols
    assert {f"q{joint.number}" for joint in robot_arm.robot.moving} <= set(texts)
    for number in range(len(robot_arm.robot.joints) + 1):
        assert {f"x{number}", f"z{number}"} <= set(texts)
    written = {
        plain(formula(expression))
        for joint in robot_arm.robot.joints
        for expression in (joint.b, joint.d, joint.r)
        if expression != 0 and joint.variable not in expression.free_symbols
    }
    assert written <= set(texts)


def test_a_balancer_that_is_grouped_with_the_bodies_has_no_curves(tmp_path: Path) -> None:
    """A spring on the first axis of a leaning arm pulls as a weight does; the one on joint 2 is drawn."""
    path = tmp_path / "leaning.yaml"
    spring = "{effect: spring_balancer, joint: 1, values: {d21: 1 m, d22: 0.25 m, phi: 0.3 rad}}"
    path.write_text(robot_file(ROBOTS["three_axis"]).replace("effects:\n", f"effects:\n  - {spring}\n"))
    of = derive(read(path), ("balancer", "inverse_dynamics"))
    assert not {"Kr1", "K01"} <= {one.name for one in of.parameters}
    text = files(of)["review.html"]
    assert "The spring balancer on joint 2, over its range." in text
    assert "The spring balancer on joint 1" not in text
