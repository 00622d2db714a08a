"""Sections of the report of an identification: a module each, found by being here."""
