"""What everything speaks of: logs, units, fixed names, errors and doubts."""
