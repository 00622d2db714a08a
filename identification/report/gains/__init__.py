"""The report of an identification of drive gains."""
