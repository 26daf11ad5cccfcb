"""Logs, units, fixed names, errors and warnings, which all other packages use."""
