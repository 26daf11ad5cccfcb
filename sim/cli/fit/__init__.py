"""``sysid fit``: the command, and what it adds to a fit."""
