"""Output error in open loop: parameters with which the simulated positions follow the measured ones."""
