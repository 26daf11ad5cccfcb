"""``sysid watch``: the command, the sources that it follows, and the fit so far."""
