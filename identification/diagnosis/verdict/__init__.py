"""What is said of what was found, and of what was not."""
