"""Sections 5 and 6 of the report, played on the simulated twins: experiments, tables, and how often intervals hold."""
