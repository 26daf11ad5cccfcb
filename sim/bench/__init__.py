"""Simulated mechanisms with known gains. Code that fits must not import from here."""
