"""Numbers of the languages' own libraries: π, and the functions that turn one unit into another."""

import math

_TURN, _DEGREE, _INCH, _FOOT = 2.0 * math.pi, math.pi / 180.0, 0.0254, 0.3048

# Math.PI, math.tau: by the class or module and the name.
NUMBERS = {
    ("Math", "PI"): math.pi,
    ("Math", "TAU"): math.tau,
    ("Math", "E"): math.e,
    ("math", "pi"): math.pi,
    ("math", "tau"): math.tau,
    ("math", "e"): math.e,
    ("np", "pi"): math.pi,
    ("numpy", "pi"): math.pi,
}

# What one becomes: of edu.wpi.first.math.util.Units, wpimath.units, Math and math.
FACTORS = {
    "rotationsToRadians": _TURN,
    "turnsToRadians": _TURN,
    "radiansToRotations": 1.0 / _TURN,
    "radiansToTurns": 1.0 / _TURN,
    "degreesToRadians": _DEGREE,
    "toRadians": _DEGREE,
    "radians": _DEGREE,
    "radiansToDegrees": 1.0 / _DEGREE,
    "toDegrees": 1.0 / _DEGREE,
    "degrees": 1.0 / _DEGREE,
    "degreesToRotations": 1.0 / 360.0,
    "degreesToTurns": 1.0 / 360.0,
    "rotationsToDegrees": 360.0,
    "turnsToDegrees": 360.0,
    "rotationsPerMinuteToRadiansPerSecond": _TURN / 60.0,
    "radiansPerSecondToRotationsPerMinute": 60.0 / _TURN,
    "inchesToMeters": _INCH,
    "metersToInches": 1.0 / _INCH,
    "feetToMeters": _FOOT,
    "metersToFeet": 1.0 / _FOOT,
}
