"""Design of motions that show a robot's parameters: limits, criterion, search, and what will be known afterwards."""
