"""Inspect a log: faults, which can be added and detected, and diagnostics."""
