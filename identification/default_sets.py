"""Names of the parameter sets that commands take where none is told: those of a robot as it might be."""

#: With rigid joints, and with elastic drive trains.
RIGID, FLEXIBLE = "twin", "twin_flexible"
