"""A robot that runs its four tests in WPILib's simulation, while `sysid watch` follows it.

    python exercises/exercise6/robot.py logs
    python exercises/exercise6/robot.py logs --pace 4 --step 3.5 --only dynamic-forward

It is a drivetrain as in lesson 4. The bench moves it: motors, battery, carpet and encoders are
those of `sysid simulate drivetrain`. The robot writes its log into the folder ``logs``, and sends
the same signals over NetworkTables. It needs RobotPy: grade doctor says how to install it.
"""

import time
from dataclasses import replace
from pathlib import Path

import click
import numpy as np
from commands2 import CommandScheduler, Subsystem
from commands2.sysid import SysIdRoutine
from ntcore import NetworkTableInstance
from wpilib import DataLogManager, DriverStation, Encoder, PWMSparkMax, RobotController
from wpilib.simulation import DriverStationSim, EncoderSim, pauseTiming, stepTiming
from wpilib.sysid import State as TestState
from wpilib.sysid import SysIdRoutineLog

from sim.bench.mechanism import Mechanism
from sim.bench.mechanisms import MECHANISMS
from sim.bench.sensor_model import read_sensor
from sim.bench.simulate import make_power_path_array
from sim.core.vocabulary import FOUR_TESTS
from sim.physics.engine import State, simulate_run

PERIOD = 0.02  # [s] one loop of the robot program
HELD = {"quasistatic": 6.0, "dynamic": 1.6}  # [s] for which you hold the button
REST = 1.5  # [s] between two tests
METERS_PER_PULSE = 0.000023  # of the encoder


class Drive(Subsystem):
    """Two motors that work together, an encoder, and a routine to test them with."""

    def __init__(self, ramp: float, step: float) -> None:
        super().__init__()
        self.left, self.right = PWMSparkMax(0), PWMSparkMax(1)
        self.right.setInverted(True)  # plus is forward on both sides
        self.encoder = Encoder(0, 1)
        self.encoder.setDistancePerPulse(METERS_PER_PULSE)
        self.routine = SysIdRoutine(
            SysIdRoutine.Config(
                rampRate=ramp, stepVoltage=step, timeout=10.0, recordState=self.record_state
            ),
            SysIdRoutine.Mechanism(self.drive, self.record, self, "Drive"),
        )
        table = NetworkTableInstance.getDefault().getTable("Drive")
        self.published = {
            name: table.getDoubleTopic(name).publish()
            for name in ("VoltageVolts", "PositionMeters", "VelocityMetersPerSec")
        }
        self.published_state = table.getStringTopic("SysIdState").publish()
        self.published_state.set("none")

    def drive(self, voltage: float) -> None:
        """Send the voltage of the test [V] to both motors."""
        self.left.setVoltage(voltage)
        self.right.setVoltage(voltage)

    def applied_voltage(self) -> float:
        """[V] voltage at the motors."""
        return float(self.left.get() * RobotController.getBatteryVoltage())

    def record(self, log: SysIdRoutineLog) -> None:
        """Write down what the motors do: into the log, and over NetworkTables."""
        values = self.applied_voltage(), self.encoder.getDistance(), self.encoder.getRate()
        log.motor("drive").voltage(values[0]).position(values[1]).velocity(values[2])
        for topic, value in zip(self.published.values(), values, strict=True):
            topic.set(value)

    def record_state(self, state: TestState) -> None:
        """Write down which test runs: into the log, and over NetworkTables."""
        self.routine.recordState(state)
        self.published_state.set(SysIdRoutineLog.stateEnumToString(state))


class Bench:
    """The mechanism that the motors move.

    Args:
        drive: the subsystem.
        mechanism: what it is built like.
    """

    def __init__(self, drive: Drive, mechanism: Mechanism) -> None:
        self.drive, self.mechanism = drive, mechanism
        self.state, self.wires = State(), make_power_path_array(mechanism)
        self.encoder = EncoderSim(drive.encoder)
        self.rng = np.random.default_rng(6)

    def step(self) -> None:
        """Let one loop pass, and let the encoder see it."""
        time, voltage = np.array([0.0, PERIOD]), np.full(2, self.drive.applied_voltage())
        track = simulate_run(
            self.mechanism.model, time=time, voltage=voltage, state=self.state, wires=self.wires
        )
        seen = read_sensor(
            self.mechanism.sensor, position=track.position[1:], velocity=track.seen[1:],
            rng=self.rng,
        )  # fmt: skip
        self.encoder.setDistance(float(seen.position[0]))
        self.encoder.setRate(float(seen.velocity[0]))


class Robot:
    """The robot program and the person at its buttons.

    Args:
        bench: what it moves.
        pace: how many times as fast as on a robot.
    """

    def __init__(self, bench: Bench, pace: float) -> None:
        self.bench, self.pace = bench, pace
        self.due = time.monotonic()

    def run(self, duration: float) -> None:
        """Loop for so many seconds of the robot's own time."""
        for _ in range(round(duration / PERIOD)):
            DriverStationSim.notifyNewData()
            DriverStation.refreshData()
            CommandScheduler.getInstance().run()
            self.bench.step()
            stepTiming(PERIOD)
            NetworkTableInstance.getDefault().flush()
            self.due += PERIOD / self.pace
            time.sleep(max(self.due - time.monotonic(), 0.0))

    def hold(self, test: str) -> None:
        """Hold down the button of a test, and let go."""
        kind, _, way = test.partition("-")
        routine = self.bench.drive.routine
        direction = getattr(routine.Direction, f"k{way.capitalize()}")
        command = getattr(routine, kind)(direction)
        click.echo(f"{test} runs")
        command.schedule()
        self.run(HELD[kind])
        command.cancel()
        self.run(REST)


@click.command()
@click.argument("folder", type=click.Path(path_type=Path))
@click.option("--pace", default=1.0, show_default=True, help="Times as fast as on a robot.")
@click.option("--ramp", default=1.0, show_default=True, help="Of the quasistatic tests [V/s].")
@click.option("--step", default=3.5, show_default=True, help="Of the dynamic tests [V].")
@click.option("--only", type=click.Choice(FOUR_TESTS), multiple=True, help="Run this test alone.")
@click.option("--port", default=5810, show_default=True, help="Of NetworkTables.")
@click.option("--wait", default=1.5, show_default=True, help="Seconds before the first test.")
def main(
    *, folder: Path, pace: float, ramp: float, step: float, only: tuple[str, ...], port: int,
    wait: float,
) -> None:  # fmt: skip
    """Run the four tests, or some of them."""
    folder.mkdir(parents=True, exist_ok=True)
    NetworkTableInstance.getDefault().startServer(listen_address="127.0.0.1", port4=port)
    DataLogManager.start(str(folder), f"robot_{time.time_ns()}.wpilog")
    pauseTiming()
    DriverStationSim.setDsAttached(True)
    DriverStationSim.setTest(True)
    DriverStationSim.setEnabled(True)
    mechanism = replace(MECHANISMS["drivetrain"], travel=None)
    robot = Robot(Bench(Drive(ramp, step), mechanism), pace)
    robot.run(wait * pace)
    for test in only or FOUR_TESTS:
        robot.hold(test)
    click.echo("all tests are over")


if __name__ == "__main__":
    main()
