"""A drivetrain with one motor on each side, ready to be characterized."""

from commands2 import Subsystem

# --- answer: 1. Import SysIdRoutine; it lives in commands2.sysid.
from commands2.sysid import SysIdRoutine

# --- end
from wpilib import Encoder, PWMSparkMax
from wpilib.sysid import SysIdRoutineLog

METERS_PER_PULSE = 0.000156  # wheel circumference over the encoder's pulses per turn


class ExampleSubsystem(Subsystem):
    """Two motors, two encoders that count meters, and a routine to test them with."""

    def __init__(self) -> None:
        super().__init__()
        self.left = PWMSparkMax(0)
        self.right = PWMSparkMax(1)
        self.right.setInverted(True)  # plus is forward on both sides
        self.left_encoder = Encoder(0, 1)
        self.right_encoder = Encoder(2, 3, reverseDirection=True)
        self.left_encoder.setDistancePerPulse(METERS_PER_PULSE)
        self.right_encoder.setDistancePerPulse(METERS_PER_PULSE)
        # --- answer: 2. Make self.routine, a SysIdRoutine. Its Config says 0.5 V/s, 3.5 V and
        # ---   10 s; its Mechanism knows the two methods below, drive and record, and self.
        self.routine = SysIdRoutine(
            SysIdRoutine.Config(rampRate=0.5, stepVoltage=3.5, timeout=10.0),
            SysIdRoutine.Mechanism(self.drive, self.record, self),
        )
        # --- end

    def drive(self, voltage: float) -> None:
        """Called in every loop of a test with the voltage the test wants [V]."""
        # --- answer: 3. Send this voltage to both motors.
        self.left.setVoltage(voltage)
        self.right.setVoltage(voltage)
        # --- end

    def record(self, log: SysIdRoutineLog) -> None:
        """Called right after drive: write down what the motors did."""
        # --- answer: 4. For each motor: its name, the voltage it got, its position [m] and its
        # ---   velocity [m/s]. The motor knows getVoltage(), the encoder getDistance(), getRate().
        log.motor("left").voltage(self.left.getVoltage()).position(
            self.left_encoder.getDistance()
        ).velocity(self.left_encoder.getRate())
        log.motor("right").voltage(self.right.getVoltage()).position(
            self.right_encoder.getDistance()
        ).velocity(self.right_encoder.getRate())
        # --- end
