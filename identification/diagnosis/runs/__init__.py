"""Runs as the diagnosis sees them: beside the model, in rows, with the drive trains that their logs have, in roles."""
