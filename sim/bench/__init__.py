"""The simulated mechanism: the truth. Nothing that fits may import from here."""
