"""The sections of the review page, one file each; a new file here is a new section.

Each module states ``TITLE``, ``ORDER`` (a number; smaller comes first) and ``render(model) -> Markup | None``, which
returns the section's body, or None where the robot has nothing to show. Formulas are MathML, pictures SVG.
"""
