"""Joint torques that hold a wrench of the tool (report eq. 73)."""

from generator.quantities import signals
from generator.quantities.inverse_dynamics_loaded import tool_wrench
from generator.quantities.quantity import Quantity
from generator.symbolic.newton_euler import joint_torques

QUANTITY = Quantity(
    name="wrench_torque",
    summary="Joint torques J^T wrench that exert a wrench with the tool.",
    details="Report eq. 73.",
    inputs=signals.together(signals.q, signals.wrench),
    outputs=signals.together(signals.tau),
    build=lambda model: (joint_torques(model.chain, {model.chain.tool.number: tool_wrench(model)}),),
)
