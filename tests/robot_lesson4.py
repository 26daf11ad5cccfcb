"""Runs the Python code that lesson 4 shows in RobotPy's simulation, buttons and all.

    python robot_lesson4.py CODE.py FOLDER NAME KS KV KA

writes FOLDER/NAME. It holds down each of the four buttons in Test mode, each for a while, and lets
go. Before that it presses one in Teleop, where the guard must keep the robot still.
"""

import math
import runpy
import sys

from commands2 import CommandScheduler
from wpilib import DataLogManager, DriverStation, RobotController
from wpilib.simulation import (
    DriverStationSim,
    EncoderSim,
    XboxControllerSim,
    pauseTiming,
    stepTiming,
)

PERIOD = 0.02  # [s] one loop
SLOW, FAST, REST = 6.0, 2.0, 1.5  # [s] a ramp, a step, and the pause after either
ROUGH = 0.01  # [share of the battery] a PWM signal comes in steps
PORT = 2  # where the lesson plugs in the controller for these tests


class Plant:
    """A drivetrain that follows the left motor: V = kS·sgn(v) + kV·v + kA·a."""

    def __init__(self, drive, gains):
        self.ks, self.kv, self.ka = gains
        self.drive = drive
        self.encoders = [EncoderSim(drive.left_encoder), EncoderSim(drive.right_encoder)]
        self.position = self.velocity = 0.0

    def step(self):
        """Let one loop pass."""
        sides = self.drive.left.get(), self.drive.right.get()
        if abs(sides[0] - sides[1]) > ROUGH:
            raise SystemExit(f"the two sides are told different things: {sides}")
        volts = sides[0] * RobotController.getBatteryVoltage()
        way = self.velocity or volts
        after = 0.0
        if self.velocity or abs(volts) > self.ks:
            final = (volts - math.copysign(self.ks, way)) / self.kv
            share = -math.expm1(-PERIOD * self.kv / self.ka)
            after = self.velocity + (final - self.velocity) * share
            after = 0.0 if after * self.velocity < 0.0 else after
        self.position += (self.velocity + after) / 2.0 * PERIOD
        self.velocity = after
        for encoder in self.encoders:
            encoder.setDistance(self.position)
            encoder.setRate(self.velocity)


def loops(plant, duration):
    """Run the robot for so long."""
    for _ in range(round(duration / PERIOD)):
        DriverStationSim.notifyNewData()
        DriverStation.refreshData()
        CommandScheduler.getInstance().run()
        plant.step()
        stepTiming(PERIOD)


def main(code, folder, name, gains):
    """Press the buttons."""
    DataLogManager.start(folder, name)
    pauseTiming()
    DriverStationSim.setDsAttached(True)
    DriverStationSim.setEnabled(True)
    container = runpy.run_path(code)["RobotContainer"]()
    plant = Plant(container.drive, gains)
    pad = XboxControllerSim(PORT)
    pad.setAButton(True)
    loops(plant, REST)
    if plant.position or plant.velocity:
        raise SystemExit("a test ran in Teleop")
    pad.setAButton(False)
    DriverStationSim.setTest(True)
    loops(plant, REST)
    for press, duration in (
        (pad.setAButton, SLOW),
        (pad.setBButton, SLOW),
        (pad.setXButton, FAST),
        (pad.setYButton, FAST),
    ):
        press(True)  # noqa: FBT003 - RobotPy takes it by position
        loops(plant, duration)
        press(False)  # noqa: FBT003 - the same
        loops(plant, REST)


if __name__ == "__main__":
    main(*sys.argv[1:4], tuple(map(float, sys.argv[4:])))
