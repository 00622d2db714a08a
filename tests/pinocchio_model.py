"""The same robot in Pinocchio, for every term that bodies and rotors make (Carpentier et al. 2019)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np
import pinocchio as pin
import sympy
from numpy.typing import NDArray

from generator.robot.description import FIXED, REVOLUTE, Joint, Robot
from tests.bodies import PINOCCHIO, STEMS

Vector = NDArray[np.float64]


class PinocchioArm:
    """A robot with ``values`` of its standard parameters and lengths by name; vectors are in the robot's own order.

    Rotor inertias are Pinocchio's armatures; other effects are not modelled.
    """

    def __init__(self, robot: Robot, values: Mapping[str, float]) -> None:
        self.robot = robot
        self.model = pin.Model()
        self.model.gravity.linear = np.array([float(g) for g in robot.gravity])
        lengths = {length.name: float(length.value) for length in robot.lengths} | dict(values)
        base = np.array(robot.base.tolist(), dtype=float)
        joint_of = {0: 0}
        place_of = {0: pin.SE3(base[:3, :3], base[:3, 3])}
        for joint in _depth_first(robot):
            number = joint.number
            parent, place = joint_of[joint.antecedent], place_of[joint.antecedent] * _at_rest(joint, lengths)
            if joint.sigma == FIXED:
                joint_of[number], place_of[number] = parent, place
            else:
                kind = pin.JointModelRZ() if joint.sigma == REVOLUTE else pin.JointModelPZ()
                joint_of[number] = self.model.addJoint(parent, kind, place, f"joint {number}")
                place_of[number] = pin.SE3.Identity()
            frame = pin.Frame(f"frame {number}", joint_of[number], place_of[number], pin.FrameType.OP_FRAME)
            self.model.addFrame(frame, False)
            if not joint.tool:
                self.model.appendBodyToJoint(joint_of[number], _inertia(number, values), place_of[number])
        self._at = np.array([self.model.idx_vs[joint_of[joint.number]] for joint in robot.moving])
        self.model.armature = self._sent([values.get(f"Ia{joint.number}", 0.0) for joint in robot.moving])
        self._data = self.model.createData()

    def add_payload(self, payload: Sequence[float]) -> None:
        """Attach ten inertial parameters in the tool frame, in the order XX XY XZ YY YZ ZZ MX MY MZ M."""
        frame = self.model.frames[self._frame(self.robot.tool.number)]
        named = dict(zip((f"{stem}0" for stem in STEMS), payload, strict=True))
        self.model.appendBodyToJoint(frame.parentJoint, _inertia(0, named), frame.placement)
        self._data = self.model.createData()

    def inverse_dynamics(self, q: Vector, qd: Vector, qdd: Vector) -> Vector:
        """Recursive Newton-Euler in spatial vectors."""
        return self._received(pin.rnea(self.model, self._data, *map(self._sent, (q, qd, qdd))))

    def direct_dynamics(self, q: Vector, qd: Vector, tau: Vector) -> Vector:
        """Articulated-body algorithm."""
        return self._received(pin.aba(self.model, self._data, *map(self._sent, (q, qd, tau))))

    def inertia_matrix(self, q: Vector) -> Vector:
        """Composite-rigid-body algorithm."""
        upper = np.triu(pin.crba(self.model, self._data, self._sent(q)))
        return (upper + np.triu(upper, 1).T)[np.ix_(self._at, self._at)]

    def bias(self, q: Vector, qd: Vector) -> Vector:
        """H(q, qd) without effects."""
        return self._received(pin.nonLinearEffects(self.model, self._data, self._sent(q), self._sent(qd)))

    def gravity(self, q: Vector) -> Vector:
        """Torques that hold the weight."""
        return self._received(pin.computeGeneralizedGravity(self.model, self._data, self._sent(q)))

    def kinetic_energy(self, q: Vector, qd: Vector) -> float:
        """Of bodies and rotors [J]."""
        return float(pin.computeKineticEnergy(self.model, self._data, self._sent(q), self._sent(qd)))

    def potential_energy(self, q: Vector) -> float:
        """Of the weight [J], zero at q = 0."""
        energy, start = (pin.computePotentialEnergy(self.model, self._data, x) for x in (self._sent(q), 0.0 * q))
        return float(energy - start)

    def pose(self, number: int, q: Vector) -> Vector:
        """Pose (4 x 4) of a frame in the world."""
        pin.framesForwardKinematics(self.model, self._data, self._sent(q))
        return self._data.oMf[self._frame(number)].homogeneous

    def jacobian(self, number: int, q: Vector) -> Vector:
        """Jacobian (6 x n): velocity of the frame's origin, then angular velocity, in world axes."""
        axes = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
        J = pin.computeFrameJacobian(self.model, self._data, self._sent(q), self._frame(number), axes)
        return J.reshape(6, -1)[:, self._at]

    def columns(self, q: Vector, qd: Vector, qdd: Vector) -> dict[str, Vector]:
        """Torques per unit of each inertial parameter of the bodies that stand in a moving joint's own frame."""
        W = pin.computeJointTorqueRegressor(self.model, self._data, *map(self._sent, (q, qd, qdd)))
        W = W.reshape(len(q), -1)[self._at]
        names = [(joint.number, k, m) for joint, k in zip(self.robot.moving, self._at, strict=True) for m in range(10)]
        return {f"{PINOCCHIO[m]}{number}": W[:, 10 * k + m] for number, k, m in names}

    def _frame(self, number: int) -> int:
        return int(self.model.getFrameId(f"frame {number}"))

    def _sent(self, ours: Sequence[float] | Vector) -> Vector:
        theirs = np.empty(len(ours))
        theirs[self._at] = ours
        return theirs

    def _received(self, theirs: Vector) -> Vector:
        return np.array(theirs)[self._at]


def _depth_first(robot: Robot) -> Iterator[Joint]:
    """The composite-rigid-body algorithm wants the joints of a branch next to each other."""

    def behind(number: int) -> Iterator[Joint]:
        for joint in robot.joints:
            if joint.antecedent == number:
                yield joint
                yield from behind(joint.number)

    return behind(0)


def _at_rest(joint: Joint, lengths: Mapping[str, float]) -> pin.SE3:
    """The frame in its antecedent with the joint variable at zero, as a product of elementary motions."""

    def number(expression: sympy.Expr) -> float:
        symbols = expression.free_symbols - {joint.variable}
        return float(expression.subs({joint.variable: 0, **{s: lengths[s.name] for s in symbols}}))

    def about(axis: str, angle: sympy.Expr) -> pin.SE3:
        return pin.SE3(pin.utils.rotate(axis, number(angle)), np.zeros(3))

    def along(*position: sympy.Expr) -> pin.SE3:
        return pin.SE3(np.eye(3), np.array([number(p) for p in position]))

    zero = sympy.Integer(0)
    before = about("z", joint.gamma) * along(zero, zero, joint.b) * about("x", joint.alpha) * along(joint.d, zero, zero)
    return before * about("z", joint.theta) * along(zero, zero, joint.r)


def _inertia(number: int, values: Mapping[str, float]) -> pin.Inertia:
    parameters = np.array([values.get(f"{stem}{number}", 0.0) for stem in PINOCCHIO])
    if parameters[0]:
        return pin.Inertia.FromDynamicParameters(parameters)
    # Without mass there is no centre to convert to.
    xx, xy, yy, xz, yz, zz = parameters[4:]
    return pin.Inertia(0.0, np.zeros(3), np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]))
