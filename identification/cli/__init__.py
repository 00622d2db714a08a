"""The commands of identification, one module each."""
