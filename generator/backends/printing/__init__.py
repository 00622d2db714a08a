"""From the nodes of a function to text: what every backend shares, with the facts of a language as data."""
