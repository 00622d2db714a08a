"""What the report says of its two robots beside its tables: poses, signs, order, blocked links, static forces."""

from __future__ import annotations

import numpy as np
import pytest

from tests.conftest import derived
from tests.subject import close

KUKAS = ("kr270", "kr500")
JOINT = ("XX", "XY", "XZ", "YY", "YZ", "ZZ", "MX", "MY", "MZ", "M", "Ia", "Fv", "Fc", "Off")
BALANCER = {"kr270": ("Kr2", "K02"), "kr500": ("F02",)}


@pytest.mark.parametrize(
    ("name", "reach", "height"),
    [("kr270", 0.350 + 1.250 + 1.100 + 0.230, 0.750 - 0.055), ("kr500", 0.500 + 1.300 + 1.025 + 0.290, 1.045 + 0.055)],
)
def test_the_arm_is_stretched_out_level_where_every_q_is_zero(name: str, reach: float, height: float) -> None:
    pose = derived(name).output("tool_transform", q=np.zeros(6))
    assert close(pose[:3, 3], [reach, 0, height])
    # z6 points back at the wrist: rl6 is negative.
    assert close(pose[:3, 2], [-1, 0, 0])


@pytest.mark.parametrize("name", KUKAS)
def test_upper_arm_stands_where_q2_is_minus_90_degrees(name: str) -> None:
    shoulder, elbow = derived(name).output("transforms", q=[0, -np.pi / 2, 0, 0, 0, 0])[1:3, :3, 3]
    d3 = next(float(length.value) for length in derived(name).robot.lengths if length.name == "d3")
    assert close(elbow - shoulder, [0, 0, d3])


@pytest.mark.parametrize("name", KUKAS)
def test_axis_1_points_down(name: str) -> None:
    assert close(derived(name).output("transforms", q=np.zeros(6))[0][:3, 2], [0, 0, -1])


@pytest.mark.parametrize("name", KUKAS)
def test_weight_and_balancer_are_opposed_where_the_arm_is_level(name: str) -> None:
    arm = derived(name)
    weight = arm.with_values({"MX2": 1.0}).output("gravity", q=np.zeros(6))
    assert close(weight, [0, -9.81, 0, 0, 0, 0])
    pull = arm.with_values({"Kr2": 1.0, "F02": 1.0}).generated("balancer", {"q": np.zeros(6)})
    assert pull["force"] > 0
    assert pull["torque"] > 0


@pytest.mark.parametrize("name", KUKAS)
def test_standard_parameters_are_in_the_order_of_equations_4_32_and_38(name: str) -> None:
    expected = []
    for joint in range(1, 7):
        expected += [f"{stem}{joint}" for stem in JOINT]
        expected += BALANCER[name] if joint == 2 else ()
    assert derived(name).standard == expected


@pytest.mark.parametrize("name", KUKAS)
def test_base_parameters_keep_that_order(name: str) -> None:
    arm = derived(name)
    assert arm.heads == sorted(arm.heads, key=arm.standard.index)
    names = [parameter.name for parameter in arm.model.parameters]
    assert names[: len(arm.heads)] == list(arm.base_values)
    motors = [f"{stem}{joint}" for joint in range(1, 7) for stem in ("Iam", "Fvm", "Fcm", "Offm", "k")]
    assert names[len(arm.heads) :] == motors + [f"kt{joint}" for joint in range(1, 7)]


@pytest.mark.parametrize("name", KUKAS)
def test_gains_multiply_currents_as_in_equation_49(name: str) -> None:
    arm = derived(name)
    assert arm.robot.drives is not None
    N = np.array([[float(entry) for entry in row] for row in arm.robot.drives.coupling])
    gains = np.diag(N) * [arm.values[f"kt{joint}"] for joint in range(1, 7)]
    current = np.array([4.0, -3.0, 2.5, -6.0, 5.0, 1.5])
    matrix = np.diag(current)
    matrix[3, 4], matrix[3, 5] = N[4, 3] * current[4] / N[4, 4], N[5, 3] * current[5] / N[5, 5]
    matrix[4, 5] = N[5, 4] * current[5] / N[5, 5]
    assert close(arm.output("joint_torque_from_current", current=current), matrix @ gains, 1e-13)


@pytest.mark.parametrize("name", KUKAS)
def test_a_motor_against_a_blocked_link_obeys_equation_71(name: str) -> None:
    arm = derived(name)
    qm, qmd, qmdd = (
        np.array([0.02, -0.01, 0.03, 0.01, -0.02, 0.04]),
        np.array([0.3, -0.2, 0.1, 0.5, -0.4, 0.2]),
        arm.state(1)[2],
    )
    # The links stand still at q_a = 0.
    W = arm.output(
        "flexible_regressor", **{n: np.concatenate([x, -x]) for n, x in {"q": qm, "qd": qmd, "qdd": qmdd}.items()}
    )
    motors = W[:6, len(arm.heads) :]
    for j in range(6):
        expected = np.zeros((5, 6))
        expected[:, j] = qmdd[j], qmd[j], np.sign(qmd[j]), 1.0, qm[j]
        assert close(motors[:, 5 * j : 5 * j + 5], expected.T)
    assert not W[:6, : len(arm.heads)].any()


@pytest.mark.parametrize("name", KUKAS)
def test_the_balancer_is_taken_off_axis_2_as_in_equation_72(name: str) -> None:
    arm = derived(name)
    q, qd, qdd = arm.state(2)
    full = arm.output("inverse_dynamics", q=q, qd=qd, qdd=qdd)
    without = arm.without("Kr", "K0", "F0").output("inverse_dynamics", q=q, qd=qd, qdd=qdd)
    torque = float(arm.generated("balancer", {"q": q})["torque"])
    assert close(full - without, [0, torque, 0, 0, 0, 0])


@pytest.mark.parametrize("name", KUKAS)
def test_force_steps_at_rest_show_stiffness_and_gains_as_in_equations_76_to_78(name: str) -> None:
    # Links held still by their environment: motors follow the wrench's change, the springs between them tell k.
    arm = derived(name).without("Ia", "Fv", "Fc", "Off", "Offm")
    qa = arm.state(3)[0]
    stiffness = np.array([arm.values[f"k{joint}"] for joint in range(1, 7)])
    wrenches = np.array([[0, 0, 900.0, 0, 0, 0], [150.0, -300.0, 1400.0, 20.0, 0, -30.0]])
    at_rest = {"qd": np.zeros(6), "qdd": np.zeros(6), "payload": np.zeros(10)}
    tau = [arm.output("inverse_dynamics_loaded", q=qa, wrench=wrench, **at_rest) for wrench in wrenches]
    qm = [qa + torque / stiffness for torque in tau]
    of_motors = []
    for position in qm:
        q = np.concatenate([position, qa - position])
        of_motors.append(arm.generated("flexible_inverse_dynamics", {"q": q, "qd": 0 * q, "qdd": 0 * q})["tau_mdi"])
    step = of_motors[1] - of_motors[0]
    T, J = arm.output("tool_transform", q=qa), arm.output("tool_jacobian", q=qa)
    change = (wrenches[1] - wrenches[0]).reshape(2, 3) @ T[:3, :3].T
    assert close(step, J.T @ change.ravel())
    assert close(step, stiffness * (qm[1] - qm[0]))
    current = [arm.output("motor_current", tau=torque) for torque in of_motors]
    assert close(arm.output("joint_torque_from_current", current=current[1] - current[0]), step)
