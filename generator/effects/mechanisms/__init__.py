"""Mechanisms that turn a force along a line into a joint torque."""
