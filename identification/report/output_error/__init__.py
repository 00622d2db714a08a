"""The report of an identification by output error."""
