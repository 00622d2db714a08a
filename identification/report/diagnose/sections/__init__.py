"""Sections of the report of a diagnosis: a module each, found by being here."""
