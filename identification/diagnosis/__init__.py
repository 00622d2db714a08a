"""Where model and measurement disagree, which effect is missing, and whether the gap closes once it is added."""
