"""Ways to move, one file each: a function that returns a Trajectory."""
