"""The arm drawn from its geometry."""
