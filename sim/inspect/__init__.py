"""What can be wrong with a log: faults, made on purpose and found again, and diagnostics."""
