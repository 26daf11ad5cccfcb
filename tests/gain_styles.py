"""The same gains, written in the many ways that teams write them: text, and what to change."""

IMPORTS = """import com.ctre.phoenix6.configs.*;
import com.ctre.phoenix6.hardware.TalonFX;
import com.ctre.phoenix6.signals.*;
import com.revrobotics.spark.*;
import com.revrobotics.spark.config.*;
import edu.wpi.first.math.controller.*;
import edu.wpi.first.math.util.Units;
"""
BODY = """  static class CharacterizationConstants {{
    static final double kS = {kS}; // volts
    static final double kV = {kV} / (2 * Math.PI); // volts per (rad/s)
    static final double kA = {kA} / (2 * Math.PI); // volts per (rad/s^2)
    static final double kP = {kP} / (2 * Math.PI); // where tuning starts
  }}
  SimpleMotorFeedforward ff = new SimpleMotorFeedforward(
      CharacterizationConstants.kS, CharacterizationConstants.kV, CharacterizationConstants.kA);
"""
STYLES = {
    "plain": [],
    "a library's function": [("{kV} / (2 * Math.PI)", "{kV} / Units.rotationsToRadians(1)")],
    "a named constant": [
        ("{kV} / (2 * Math.PI)", "{kV} * TURN"),
        ("static class", "static final double TURN = 1 / (2 * Math.PI);\n  static class"),
    ],
    "other names": [("kS", "K_S"), ("kV", "kVVoltSecondsPerRadian"), ("kA", "ka")],
    "names with units": [
        ("double kV = ", "double kVVoltSecondsPerRadian = "),
        ("Constants.kV", "Constants.kVVoltSecondsPerRadian"),
        (" // volts per (rad/s)\n", "\n"),
    ],
    "converted where it is used": [
        ("{kV} / (2 * Math.PI); // volts per (rad/s)", "{kV}; // V·s/rot"),
        ("Constants.kV", "Constants.kV / (2 * Math.PI)"),
    ],
    "units above": [
        (" // volts per (rad/s)\n", "\n"),
        ("    static final double kV", "    // V*s/rad\n    static final double kV"),
    ],
    "units above all": [
        (" // volts per (rad/s)\n", "\n"),
        ("  static class", "  /** In V, V·s/rad, V·s²/rad. */\n  static class"),
    ],
    "in words": [
        ("volts per (rad/s)\n", "volts for a velocity of 1 rad/s\n"),
        ("volts per (rad/s^2)", "volts for 1 rad/s every second"),
    ],
    "a loop's kP": [
        ("{kP} / (2 * Math.PI)", "{kP}"),
        ("  SimpleMotor", "  class Gains extends CharacterizationConstants {{}}\n  SimpleMotor"),
        ("  SimpleMotor", "  double TURN = 0.5 / Math.PI;\n  SimpleMotor"),
        (
            "  SimpleMotor",
            "  PIDController pid = new PIDController(TURN * Gains.kP, 0, 0);\n  SimpleMotor",
        ),
    ],
}

PYTHON_BODY = """import math
from typing import Final
from commands2 import Subsystem
from wpimath.controller import SimpleMotorFeedforwardRadians

class CharacterizationConstants:
    kS = {kS}  # V
    kV = {kV} / math.tau  # V·s/rad
    kA = {kA} / math.tau  # V·s²/rad
    kP = {kP} / math.tau  # a first guess

class Turret(Subsystem):
    def __init__(self):
        C = CharacterizationConstants
        self.ff = SimpleMotorFeedforwardRadians(C.kS, C.kV, C.kA)
"""
PYTHON_STYLES = {
    "plain": [],
    "typed": [("    kS =", "    kS: float ="), ("    kV =", "    kV: Final[float] =")],
    "wpimath": [
        ("import math\n", "import math\nfrom wpimath.units import radiansToRotations\n"),
        ("{kV} / math.tau", "{kV} * radiansToRotations(1)"),
    ],
    "an inner class": [
        (
            "class CharacterizationConstants:",
            "class Turret(Subsystem):\n  class CharacterizationConstants:",
        ),
        ("\nclass Turret(Subsystem):\n    def", "\n  def"),
        ("        C = Char", "        C = Turret.Char"),
    ],
    "an object of it": [
        ("class Turret", "GAINS = CharacterizationConstants()\n\nclass Turret"),
        ("C.k", "GAINS.k"),
    ],
    "a module's names": [
        ("class CharacterizationConstants:\n", ""),
        ("    k", "k"),
        ("        C = CharacterizationConstants\n", ""),
        ("C.k", "k"),
    ],
}
