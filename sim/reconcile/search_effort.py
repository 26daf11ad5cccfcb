"""Limits of the searches: larger values take longer and change few results."""

STEPS = 8
"""Levenberg-Marquardt steps of a search."""

ROUNDS = 3
"""Most repetitions of a search whose result still changes."""

HALVINGS = 5
"""Halvings of the step by which the onset of an effect is refined."""
