"""Which columns the runs ask for."""
