"""What noise there is: of torques, of positions, of what is recorded in steps."""
