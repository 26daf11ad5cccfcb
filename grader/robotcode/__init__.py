"""Robot code in, facts out: Java and RobotPy are parsed, never executed."""
