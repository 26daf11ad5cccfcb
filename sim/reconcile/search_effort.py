"""How far and how finely searches go: larger values take longer and change few results."""

STEPS = 8
"""Levenberg-Marquardt steps of a full search, and sizes at which a threshold is tried."""

ROUNDS = 3
"""Rounds of searches that take turns, and steps of a search that the next one goes on with."""

KEPT = 4
"""Starts or candidates that are kept for the longer search after a shorter one."""

HALVINGS = 5
"""Halvings of a value that no slope leads to: a moment, free play, an effect's size."""
