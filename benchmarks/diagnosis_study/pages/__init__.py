"""What the study's results say, as tables, a picture and a page: no result depends on it."""
