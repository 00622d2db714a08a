"""Units of the values in section ``signals``."""

from __future__ import annotations

from generator.robot.description import Joint

#: Of those that are the same on all joints.
_EVERYWHERE = {
    "torque_gain": "1",
    "torque_delay": "s",
    "link_delay": "s",
    "current_limit": "A",
    "warm_up_time": "s",
    "warm_rise": "K",
}


def signal_unit(key: str, joint: Joint, driven: bool) -> str:
    """Of a joint's value of a key, 1 of a number; ``driven`` tells whether the robot has drives.

    Without, the motor of a slide gives a force.
    """
    if key == "position_offset":
        return joint.position_unit
    if key == "warm_torque":
        return "N m" if driven else joint.torque_unit
    return _EVERYWHERE[key]
