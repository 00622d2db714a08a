"""Reports for engineers: one self-contained page with charts, from sections found in a folder."""
