"""Sections of the report: a module each, found by being here."""
