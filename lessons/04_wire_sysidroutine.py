# ---
# jupyter:
#   jupytext:
#     text_representation:
#       extension: .py
#       format_name: percent
#   kernelspec:
#     display_name: Python 3
#     language: python
#     name: python3
# ---

# %% [markdown]
# # Lesson 4: Wire a SysIdRoutine
#
# *About 45 minutes. You need a subsystem in mind: a drivetrain, a shooter, anything with a motor
# and an encoder. No robot is needed today.*
#
# **At the end you can**
#
# - build a `SysIdRoutine` from its two parts, a `Config` and a `Mechanism`;
# - write the callback that drives the motors, and say why it must ask for a *voltage*;
# - write the callback that logs, with the right three signals in the right units;
# - hand out the four test commands, bind them to buttons, and guard them;
# - look at a wrong gain and name the line of code that made it.
#
# Code is shown in Java and in Python (RobotPy), for WPILib 2026. Read the one your team uses. From
# 2027 on, the names of packages and of some methods differ (section 3); the ideas do not.

# %% [markdown]
# ## 1 Why: everything later believes the log
#
# A `SysIdRoutine` does two things, fifty times a second: it **asks for a voltage**, and it **writes
# down what happened**. Nothing more. The gains are computed later, from what was written down.
#
# So a slip in the wiring does not crash. The robot moves, the log fills, the analyzer prints
# numbers. They are just the numbers of another robot. Today we make such slips on purpose, on a
# simulated robot whose true gains we know, and learn what each of them looks like.
#
# We call that simulated robot *the bench*. Run the next cell to set it up.

# %%
import math
from dataclasses import replace

import ipywidgets as widgets
import numpy as np
from IPython.display import display

import sim
from sim.bench.duty_cycle import Battery, simulate_duty_cycle
from sim.bench.mechanisms import MECHANISMS
from sim.bench.simulate import simulate
from sim.fit import fit
from sim.plot import Picture, Table, plot_choices, plot_time_series, show_interactive
from sim.teaching.prediction import Prediction

drivetrain = MECHANISMS["drivetrain"]
truth = drivetrain.gains
print(drivetrain.summary)
Table(
    ("gain", "true value", "unit"),
    (("kS", truth["kS"], "V"), ("kV", truth["kV"], "V·s/m"), ("kA", truth["kA"], "V·s²/m")),
    caption="The truth about our drivetrain. On a real robot nobody knows it.",
)

# %% [markdown]
# ## 2 The model: what a row of the log must hold
#
# The model you know from lesson 1 says which voltage a motion costs:
#
# > **V = kS·sgn(v) + kV·v + kA·a**
#
# (sgn(v) is the direction: +1 forward, −1 backward. v is velocity, a is acceleration.)
#
# To find the three gains, the analyzer needs many rows with V, v and a in them:
#
# | what | where it comes from | who needs it |
# |---|---|---|
# | voltage V | the motor controller | every fit |
# | velocity v | the encoder | every fit |
# | acceleration a | SysId computes it from v and the time | nobody logs it |
# | position | the encoder | arms (gravity depends on the angle); finding when motion starts |
#
# > **Lesson says:** log position, velocity and applied voltage, "all three are required for
# > regression".
# >
# > **Source says:** SysId's window wants all three before it loads a log. The arithmetic for a
# > drivetrain or a shooter then uses only velocity and voltage.
# > ([WPILib docs: Loading Data](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/system-identification/loading-data.html))
# >
# > **Try it:** the last cell of this section throws the positions away and fits again. Do the gains
# > change?
#
# Here is the log of a routine that is wired right. Its settings are those of the source lesson.

# %%
routine = sim.Routine(ramp=0.5, step=3.5, timeout=10.0)
right = simulate(drivetrain, routine, rng=np.random.default_rng(4))

plot_time_series(right, dynamic_seconds=1.0)

# %% [markdown]
# Two slow ramps (*quasistatic*, "almost standing still") and two sudden steps (*dynamic*), each
# forward and in reverse. Only the first second of the steps is drawn: the rest is flat.
#
# What does SysId's recipe make of it?


# %%
def row(name: str, log: sim.Log) -> tuple[str | float, ...]:
    """One row of a table: what SysId's recipe finds in a log, and its two R²."""
    found = fit(log, method="sysid")
    gains = (found.gains["kS"], found.gains["kV"], found.gains["kA"])
    return (name, *gains, found.acceleration_r2, found.simulated_velocity_r2)


HEADER = ("log", "kS [V]", "kV [V·s/m]", "kA [V·s²/m]", "acceleration R²", "simulated velocity R²")

no_positions = replace(
    right, runs=tuple(replace(run, position=np.zeros(len(run))) for run in right.runs)
)
Table(HEADER, (row("wired right", right), row("positions thrown away", no_positions)))

# %% [markdown]
# The two **R²** ("R squared") are SysId's scores: 1 is perfect. There are two of them, and they
# mean different things. Lesson 7 takes them apart; here we only watch whether they notice anything.

# %% [markdown]
# ## 3 Doing it: the routine, part by part
#
# SysId needs no project of its own. The routine is one more field of a subsystem that you have,
# because the subsystem owns the motors and the encoders.
#
# ### Two arguments
#
# > **Lesson says:** "The routine takes three things: a Config (…), a Mechanism (…), and a log-name
# > string."
# >
# > **Source says:** two: `SysIdRoutine(Config config, Mechanism mechanism)`. The name is an
# > optional *fourth* argument of `Mechanism`; left out, it is the subsystem's own name.
# > ([WPILib Java docs: SysIdRoutine](https://github.wpilib.org/allwpilib/docs/release/java/edu/wpi/first/wpilibj2/command/sysid/SysIdRoutine.html))
# >
# > **Try it:** count the arguments in the code below.
#
# ### Config: how hard, how long
#
# `Config` holds the ramp rate (volts per second), the step (volts) and the timeout (seconds). In
# Java, `null` means "take the library's default". The bench has the same defaults:

# %%
defaults = sim.Routine()
Table(
    ("setting", "default", "source lesson", "unit"),
    (
        ("ramp rate", defaults.ramp, routine.ramp, "V/s"),
        ("step", defaults.step, routine.step, "V"),
        ("timeout", defaults.timeout, routine.timeout, "s"),
    ),
)

# %% [markdown]
# > **Lesson says:** a ramp that is "typically 0.5 V/s", a step that is "typically 3–7V", and "Start
# > with a step voltage of 3–4V, not 7V".
# >
# > **Source says:** the library's default step is what the table shows, and one of its maintainers
# > finds it "almost always too much": wheels slip, and slipping data is not what the model
# > describes.
# > ([allwpilib issue 7794](https://github.com/wpilibsuite/allwpilib/issues/7794))
# >
# > **Try it:** wheels slip when the motors push harder than the carpet can hold. That takes about
# > `kS + kA·μ·g` volts from standstill, with grip μ and g = 9.81 m/s². The next cell computes it
# > for two drivetrains with the same motors. Would 3 V be safe?

# %%
GRIP = 1.1  # wheels on carpet, roughly
for mass in (60.0, 30.0):
    gains = replace(drivetrain, load=mass).gains
    slips = gains["kS"] + gains["kA"] * GRIP * 9.81
    print(f"{mass:.0f} kg, kA = {gains['kA']:.3f} V·s²/m: wheels slip from about {slips:.1f} V")

# %% [markdown]
# A strong drivetrain slips early, and the lighter the robot, the earlier. (Our bench's wheels never
# slip, so we may keep the source lesson's step. Your robot's wheels do: choose the step from your
# own kA. Lesson 3 has the planner.)
#
# **What `null` means.** The fourth thing in a `Config` is a callback for the test's *state*, the
# words `quasistatic-forward` and so on, which tell the analyzer where a test begins and ends.
#
# > **Lesson says:** `null` is "use default state consumer (logs to DS)".
# >
# > **Source says:** with `null` the state goes into the **WPILOG file** on the robot, as a text
# > entry named `sysid-test-state-` and the mechanism's name. Nothing goes to the Driver Station.
# > ([WPILib docs: Creating a Routine](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/system-identification/creating-routine.html))
# >
# > **Try it:** open any SysId log in AdvantageScope and look for that entry.
#
# Python differs in one point: there, `None` is *not* "the default" but an error. Leave the argument
# out instead. If you hand the state to a logger of your own, `SysIdRoutineLog.stateEnumToString`
# makes the word of it that the analyzer looks for; `str(state)` does not.
#
# (`Mechanism`'s log callback may be `null` too, but only if another logger records the motors for
# you: CTRE's SignalLogger, or URCL for REV. Lesson 5 shows how. In Python, `None` fails in the
# first loop of the test: write `lambda log: None`. In this course you write the callback.)

# %% [markdown]
# ### Mechanism, first callback: drive
#
# The routine hands you a voltage; you hand it to **every** motor of the mechanism. Three rules:
#
# 1. **Open loop.** Nothing corrects the motion: no PID, no `VelocityVoltage`, no Motion Magic. A
#    controller that corrects the motion would be in the data, and SysId would measure it, too.
# 2. **A voltage, not a share of the battery.** `set(0.3)` means "30 % of whatever the battery gives
#    now". The battery gives less when motors draw current, so the voltage is not what you think.
# 3. **Every motor.** Or you measure a robot that drags dead motors along.
#
# > **Lesson says:** "Use `setVoltage()` directly — not `setControl(new VoltageOut(...))` — so the
# > routine has raw voltage authority during testing".
# >
# > **Source says:** on a TalonFX (Phoenix 6) the two are the same thing: `setVoltage()` *is* a
# > `VoltageOut` request, and CTRE's own SysId example uses `setControl` with one request object.
# > ([CTRE docs: Plumbing & Running SysId](https://v6.docs.ctr-electronics.com/en/stable/docs/api-reference/wpilib-integration/sysid-integration/plumbing-and-running-sysid.html))
# >
# > The rule worth keeping is rule 2. **Try it** in section 4.
#
# ### Mechanism, second callback: log
#
# Once per loop, write down for each motor group: **applied voltage, position, velocity**.
#
# - **Applied** voltage is what reached the motor. A TalonFX reports it as `getMotorVoltage()`. For
#   a simple PWM controller it is `get()` times the battery voltage. It is *not* the number that the
#   routine asked for. In a brownout the applied voltage drops to 0 and comes back, again and again.
#   The asked-for voltage goes on as if nothing had happened (lesson 6).
# - **Units.** A drivetrain or an elevator moves along a line: meters and meters per second, after
#   gear ratio *and* wheel size. A shooter or an arm turns: rotations and rotations per second of
#   the *output*, after the gear ratio.
# - **Direction.** A positive voltage must give a positive velocity. Check this before all else.
# - **Name.** `log.motor("drive-left")`: one name for each motor or pair that shares an encoder. It
#   becomes part of the entries' names, and you will look for it in a long list.
#
# > **Lesson says:** "Use `Units.rotationsToRadians()` if your feedforward class expects radians."
# >
# > **Source says:** the Java logger takes any unit of angle, and always *stores rotations*. The
# > gains come out per rotation. What you convert is the **gain**, at the end, or the number you
# > hand to your feedforward.
# > ([WPILib Java docs: SysIdRoutineLog](https://github.wpilib.org/allwpilib/docs/release/java/edu/wpi/first/wpilibj/sysid/SysIdRoutineLog.html))
# >
# > **Try it:** the next cell fits one shooter log and prints kV per rotation and per radian.

# %%
shooter = MECHANISMS["shooter"]
spun = fit(simulate(shooter, routine, rng=np.random.default_rng(5)), method="sysid")
per_rotation = spun.in_units("rotations").gains["kV"]
per_radian = spun.in_units("radians").gains["kV"]
print(f"kV = {per_rotation:.4f} V·s/rotation = {per_radian:.5f} V·s/radian")
print(f"Their ratio is {per_rotation / per_radian:.4f}, and 2π is {2 * math.pi:.4f}.")

# %% [markdown]
# Same shooter, same log, same physics. Mix the two up and your feedforward is wrong by that factor.
#
# ### All of it, in Java
#
# ```java
# package frc.robot.subsystems;
#
# import static edu.wpi.first.units.Units.Meters;
# import static edu.wpi.first.units.Units.MetersPerSecond;
# import static edu.wpi.first.units.Units.Second;
# import static edu.wpi.first.units.Units.Seconds;
# import static edu.wpi.first.units.Units.Volts;
#
# import com.ctre.phoenix6.hardware.TalonFX;
# import edu.wpi.first.wpilibj2.command.Command;
# import edu.wpi.first.wpilibj2.command.SubsystemBase;
# import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine;
#
# public class Drive extends SubsystemBase {
#   // A TalonFX counts turns of the motor (if no SensorToMechanismRatio is set):
#   // divide by the gear ratio, multiply by the wheel's circumference.
#   private static final double METERS_PER_TURN = Math.PI * 0.1016 / 6.75;
#
#   private final TalonFX m_left = new TalonFX(1);
#   private final TalonFX m_right = new TalonFX(2);
#
#   private final SysIdRoutine m_sysIdRoutine =
#       new SysIdRoutine(
#           new SysIdRoutine.Config(
#               Volts.of(1.0).per(Second), // ramp rate
#               Volts.of(2.0), // step
#               Seconds.of(8.0), // timeout
#               null), // state: into the WPILOG
#           new SysIdRoutine.Mechanism(
#               voltage -> {
#                 m_left.setVoltage(voltage.in(Volts));
#                 m_right.setVoltage(voltage.in(Volts));
#               },
#               log -> {
#                 log.motor("drive-left")
#                     .voltage(Volts.of(m_left.getMotorVoltage().getValueAsDouble()))
#                     .linearPosition(Meters.of(meters(m_left.getPosition().getValueAsDouble())))
#                     .linearVelocity(
#                         MetersPerSecond.of(meters(m_left.getVelocity().getValueAsDouble())));
#                 log.motor("drive-right")
#                     .voltage(Volts.of(m_right.getMotorVoltage().getValueAsDouble()))
#                     .linearPosition(Meters.of(meters(m_right.getPosition().getValueAsDouble())))
#                     .linearVelocity(
#                         MetersPerSecond.of(meters(m_right.getVelocity().getValueAsDouble())));
#               },
#               this)); // the test commands need this subsystem for themselves
#
#   private static double meters(double turns) {
#     return turns * METERS_PER_TURN;
#   }
#
#   public Command sysIdQuasistatic(SysIdRoutine.Direction direction) {
#     return m_sysIdRoutine.quasistatic(direction);
#   }
#
#   public Command sysIdDynamic(SysIdRoutine.Direction direction) {
#     return m_sysIdRoutine.dynamic(direction);
#   }
# }
# ```
#
# (The right motor's inversion is set in its TalonFX configuration, so that plus is forward.)
#
# **Commands v3** comes with WPILib 2027, for Java. There the class `extends Mechanism`, and the
# parts of the same routine have other names: `Config.useDataLog` takes ramp, step and timeout, and
# `SysIdRoutine.SysIdMechanism` takes the two callbacks and `this`. `null` is no default there: for
# WPILib's own numbers write `Config.defaults()`. Exercises 4 and 5 take either.
# ([SysIdRoutine of Commands v3, at one commit of the branch](https://github.com/wpilibsuite/allwpilib/blob/10171e2f048a8b86ffa82d52b65d09287c342268/commandsv3/src/main/java/org/wpilib/command3/sysid/SysIdRoutine.java))

# %% [markdown]
# ### All of it, in Python
#
# This one drives PWM controllers and reads encoders on the roboRIO, so that it needs no vendor's
# library. The course's own tests run it in WPILib's simulation, press its buttons, and fit the log
# that it writes.
#
# ```python
# import commands2
# import wpilib
# from commands2.button import CommandXboxController, Trigger
# from commands2.sysid import SysIdRoutine
# from wpilib.sysid import SysIdRoutineLog
#
#
# class Drive(commands2.Subsystem):
#     def __init__(self) -> None:
#         super().__init__()
#         self.left = wpilib.PWMSparkMax(0)
#         self.right = wpilib.PWMSparkMax(1)
#         self.right.setInverted(True)  # plus is forward on both sides
#         self.left_encoder = wpilib.Encoder(0, 1)
#         self.right_encoder = wpilib.Encoder(2, 3, True)
#         for encoder in (self.left_encoder, self.right_encoder):
#             encoder.setDistancePerPulse(3.14159 * 0.1016 / 2048)  # meters
#         self.routine = SysIdRoutine(
#             SysIdRoutine.Config(rampRate=1.0, stepVoltage=2.0, timeout=8.0),
#             SysIdRoutine.Mechanism(self.drive_volts, self.log_motors, self, "drive"),
#         )
#
#     def drive_volts(self, voltage: float) -> None:
#         self.left.setVoltage(voltage)
#         self.right.setVoltage(voltage)
#
#     def log_motors(self, log: SysIdRoutineLog) -> None:
#         battery = wpilib.RobotController.getBatteryVoltage()
#         for name, motor, encoder in (
#             ("drive-left", self.left, self.left_encoder),
#             ("drive-right", self.right, self.right_encoder),
#         ):
#             frame = log.motor(name)
#             frame.voltage(motor.get() * battery)  # what reached the motor
#             frame.position(encoder.getDistance())  # meters
#             frame.velocity(encoder.getRate())  # meters per second
#
#     def sysid_quasistatic(self, direction: SysIdRoutine.Direction) -> commands2.Command:
#         return self.routine.quasistatic(direction)
#
#     def sysid_dynamic(self, direction: SysIdRoutine.Direction) -> commands2.Command:
#         return self.routine.dynamic(direction)
#
#
# class RobotContainer:
#     def __init__(self) -> None:
#         self.drive = Drive()
#         self.sysid_controller = CommandXboxController(2)  # not the one used in matches
#         self.bind_sysid()
#
#     def bind_sysid(self) -> None:
#         forward, reverse = SysIdRoutine.Direction.kForward, SysIdRoutine.Direction.kReverse
#         # The guard: nothing below runs unless the Driver Station is in Test mode.
#         test_mode = Trigger(wpilib.DriverStation.isTestEnabled)
#         pad = self.sysid_controller
#         # Quasistatic forward, a slow ramp: kS (when it starts to move), kV (volts per speed).
#         test_mode.and_(pad.a()).whileTrue(self.drive.sysid_quasistatic(forward))
#         # Quasistatic reverse, the same backward: is friction the same both ways?
#         test_mode.and_(pad.b()).whileTrue(self.drive.sysid_quasistatic(reverse))
#         # Dynamic forward, a sudden step: kA (volts per acceleration).
#         test_mode.and_(pad.x()).whileTrue(self.drive.sysid_dynamic(forward))
#         # Dynamic reverse, the step backward: kA again, and the robot is back where it was.
#         test_mode.and_(pad.y()).whileTrue(self.drive.sysid_dynamic(reverse))
# ```
#
# **Spot the defect.** WPILib's docs show `routine = SysIdRoutine(…, Mechanism(self.voltageDrive,
# …, self))` and do not say where it stands. In the body of a class there is no `self`, and Python
# stops with a `NameError`. It belongs into `__init__`, as `self.routine = …` above.
# ([WPILib docs: Creating a Routine](https://docs.wpilib.org/en/latest/docs/software/advanced-controls/system-identification/creating-routine.html))

# %% [markdown]
# ### Four commands, bound and guarded
#
# The routine makes four commands: `quasistatic(kForward)`, `quasistatic(kReverse)`,
# `dynamic(kForward)`, `dynamic(kReverse)`. Make them public, and bind **each to its own button**.
#
# - **`whileTrue`**, so that letting go ends the test. With `onTrue` the test goes on after you let
#   go, until the timeout.
# - **A comment on each binding** that names the test *and what it measures*. You will read it in
#   six months, tired, in a gym.
# - **A guard**, so that nobody starts a test in a match: Test mode (as here), a separate
#   controller, or a chord of two buttons.
#
# In Java:
#
# ```java
# Trigger testMode = new Trigger(DriverStation::isTestEnabled); // the guard
# // Quasistatic forward, a slow ramp: kS (when it starts to move), kV (volts per speed).
# testMode.and(m_sysIdController.a()).whileTrue(m_drive.sysIdQuasistatic(Direction.kForward));
# // Quasistatic reverse, the same backward: is friction the same both ways?
# testMode.and(m_sysIdController.b()).whileTrue(m_drive.sysIdQuasistatic(Direction.kReverse));
# // Dynamic forward, a sudden step: kA (volts per acceleration).
# testMode.and(m_sysIdController.x()).whileTrue(m_drive.sysIdDynamic(Direction.kForward));
# // Dynamic reverse, the step backward: kA again, and the robot is back where it was.
# testMode.and(m_sysIdController.y()).whileTrue(m_drive.sysIdDynamic(Direction.kReverse));
# ```
#
# **In WPILib 2027** (not released yet; names as on its development branch) these lines do not
# compile. Test mode is called *utility mode* there. The guard is `RobotModeTriggers.utility()`, or
# `new Trigger(RobotState::isUtilityEnabled)`. The directions are `FORWARD` and `REVERSE`. A motor's
# duty cycle is set with `setThrottle` instead of `set`; `setVoltage` keeps its name.
# ([RobotModeTriggers, at one commit of the branch](https://github.com/wpilibsuite/allwpilib/blob/1676a42fe0522b3fc22593482b19fe5ed536051c/commandsv2/src/main/java/org/wpilib/command2/button/RobotModeTriggers.java))
#
# > **Lesson says:** a SysId test runs "bypassing soft limits, current limits, and any command-level
# > safety logic you've written".
# >
# > **Source says:** partly. Your *command-level* logic is bypassed: the test command has the
# > subsystem for itself. Limits **inside the motor controller** still work if you set them up;
# > WPILib's docs name "soft and hard limits" as a reason to use your own code for the tests, and
# > say that setting them up is your job.
# > ([Creating a Routine](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/system-identification/creating-routine.html),
# > [Running the Routine](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/system-identification/running-routine.html))
# >
# > Both sides matter: a limit protects you, *and* when it engages, the data show the limit instead
# > of the motor.
# >
# > **Try it** on your robot, slowly and with a hand on Disable: drive toward a soft limit with a
# > joystick, and see whether it holds.

# %% [markdown]
# ### What the loop really does
#
# A detail for the curious, and for whoever compares this bench with a robot. The test command
# starts its timer in one loop, and drives for the first time two loops later. (That is what we saw
# when we ran the real command in WPILib's simulation.) So the first voltage of a ramp is not zero:

# %%
ramp = right.runs_of_test("quasistatic-forward")[0]
print(f"rows in {routine.timeout:.0f} s: {len(ramp)}")
print(f"first voltage: {ramp.voltage[0]:.3f} V, two loops of 20 ms into a {routine.ramp} V/s ramp")

# %% [markdown]
# ## 4 The virtual robot: one slip at a time
#
# Seven programs, one of them right. Before you look, **predict**. Nobody grades this; you will see
# your guess again below. (No buttons on your screen? Type `guess_gain.value = "kA"` in a cell.)

# %%
guess_gain = Prediction(
    "1. The drive callback says motor.set(volts / 12), the log holds the volts that were asked "
    "for, and the battery is tired. Which gain is off the most?",
    "kS",
    "kV",
    "kA",
    "none of them",
)
guess_factor = Prediction(
    "2. Somebody logs turns of the wheel and calls them meters. The wheel measures 4 inches "
    "across. What happens to kV?",
    "it is right anyway",
    "3.1 times too small",
    "6.3 times too small",
    "2 times too big",
)
guess_score = Prediction(
    "3. Will the simulated velocity R² fall below 0.9, so that you notice?",
    "yes, for all of them",
    "for some",
    "for none",
)
display(guess_gain, guess_factor, guess_score)

# %% [markdown]
# How the bench makes the seven logs:
#
# | program | the slip, in code | what the bench does |
# |---|---|---|
# | right | none | simulates it |
# | share of the battery | `set(volts / 12)`, logs the volts asked for | lets the battery sag |
# | …but logs what arrived | `set(volts / 12)`, logs `getMotorVoltage()` | same run, true volts |
# | turns called meters | `Meters.of(wheelTurns)` | divides by the wheel's circumference |
# | radians taken for turns | `circumference * radians` | multiplies by 2π |
# | encoder the wrong way | `setInverted` forgotten | flips the sign of what the sensor says |
# | one motor of each pair | the second one gets no command | half the motors, same friction |
#
# The sag is computed, not drawn: each motor's current follows from its speed and voltage, all
# currents flow through the battery's resistance, and what is left is what the motors get.

# %%
CIRCUMFERENCE = math.pi * 0.1016  # [m] of a 4 inch wheel
TIRED = Battery(rest=12.2, resistance=0.035)


def rescaled(log: sim.Log, factor: float) -> sim.Log:
    """The same runs, but the encoder's numbers multiplied: a wrong unit, or a wrong sign."""
    runs = (
        replace(r, position=factor * r.position, velocity=factor * r.velocity) for r in log.runs
    )
    return replace(log, runs=tuple(runs))


def as_asked(log: sim.Log) -> sim.Log:
    """The same runs, but the log holds the voltage that was asked for."""
    runs = (replace(run, voltage=12.0 * run.voltage / run.bus_voltage) for run in log.runs)
    return replace(log, runs=tuple(runs))


rng = np.random.default_rng(40)
sagging = simulate_duty_cycle(drivetrain, routine, battery=TIRED, rng=rng)
# Half the motors need twice the volts for the same force, and friction is a force.
half = replace(drivetrain, motor_count=2, friction=2 * drivetrain.friction)
halved = simulate(half, routine, rng=rng)

# program -> (what its log says, what really happened)
programs = {
    "right": (right, right),
    "share of the battery": (as_asked(sagging), sagging),
    "…but logs what arrived": (sagging, sagging),
    "turns called meters": (rescaled(right, 1 / CIRCUMFERENCE), right),
    "radians taken for turns": (rescaled(right, 2 * math.pi), right),
    "encoder the wrong way": (rescaled(right, -1.0), right),
    "one motor of each pair": (halved, halved),
}

# %% [markdown]
# Now choose a program. The upper picture shows what its log says, and as a thin dotted line what
# really happened. The lower one shows each gain it leads to, divided by the true one: 1 is right.


# %%
def virtual_robot(program: str) -> list[Picture]:
    """The log that a program leaves, and the gains that come of it."""
    logged, happened = programs[program]
    found = fit(logged, method="sysid").gains
    ratios = {gain: found[gain] / truth[gain] for gain in ("kS", "kV", "kA")}
    return [
        plot_time_series(logged, beside=happened, dynamic_seconds=1.0),
        plot_choices(ratios, truth=1.0, name="found ÷ true"),
    ]


show_interactive(
    virtual_robot, program=widgets.Dropdown(options=list(programs), description="program")
)

# %% [markdown]
# No menu on your screen? Change the name in this cell and run it:

# %%
display(*virtual_robot("share of the battery"))

# %% [markdown]
# And all seven at once:

# %%
Table(HEADER, tuple(row(name, log) for name, (log, _) in programs.items()))

# %%
asked, arrived = (fit(programs[name][0], method="sysid") for name in list(programs)[1:3])
off = {gain: 100 * (asked.gains[gain] / truth[gain] - 1) for gain in truth}
turns = fit(programs["turns called meters"][0], method="sysid").gains["kV"] / truth["kV"]
worst = min(fit(log, method="sysid").simulated_velocity_r2 for log, _ in programs.values())
print(f"1. You said: {guess_gain}.")
print(
    f"   Asked volts logged: kS {off['kS']:+.0f} %, kV {off['kV']:+.0f} %, kA {off['kA']:+.0f} %."
)
print(f"2. You said: {guess_factor}.")
print(
    f"   kV is {1 / turns:.2f} times too small: the circumference is 1/{1 / CIRCUMFERENCE:.2f} m."
)
print(f"3. You said: {guess_score}.")
print(f"   The lowest simulated velocity R² of all seven is {worst:.3f}.")

# %% [markdown]
# ### Explain what you saw
#
# - **Share of the battery.** When the step comes, the current is large, the battery sags, and the
#   motors get less than the log says. The fit sees a sluggish robot and blames inertia: **kA** is
#   off the most. At steady speed the current is small, so kV hardly suffers.
# - **Logging what arrived repairs it.** The robot drove by a share of the battery in both rows;
#   only the log differs. *Log the applied voltage* is the cheapest insurance there is.
#   (`setVoltage` plus an asked-for log also looks fine, until a current limit, an empty battery or
#   a brownout makes the two differ. Then you have the same error, and no warning.)
# - **Wrong units** scale kV and kA by one clean factor and leave kS alone, since kS has no distance
#   in it. The factor is the fingerprint: 2π, a circumference, a gear ratio.
# - **Encoder the wrong way** turns every gain negative. No real robot has a negative kV.
# - **One motor of each pair**: the log is honest, but it is of a robot that you will not drive.
#   kS and kA double, because each volt now pushes half as hard. kV stays.
# - **R² notices none of it.** For wrong units and signs it cannot: the log is a perfect log of a
#   robot with other units. Compare in the table above.
#
# Not in the list: a PID in the drive callback. Then the voltage depends on the motion it is
# supposed to explain, and the fit measures your PID.

# %% [markdown]
# ## 5 From your robot to this bench
#
# 1. Call `DataLogManager.start()` when the robot program starts, if it does not already.
# 2. Run the four tests (lesson 5 walks you through it). **One routine per log:** power-cycle before
#    you test another mechanism. WPILib's docs say that analysis fails otherwise.
#    ([Running the Routine](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/system-identification/running-routine.html))
# 3. Fetch the `.wpilog` file with WPILib's Data Log Tool or with AdvantageScope.
#
# > **Lesson says:** the default path is `/home/lvuser/logs/`.
# >
# > **Source says:** on a 2026 roboRIO, a FAT32 USB stick comes first: `/u/logs`. Without one, it is
# > `/home/lvuser/logs`.
# > ([WPILib docs: Data Logs](https://docs.wpilib.org/en/stable/docs/software/telemetry/datalog.html))
# > A 2027 Systemcore without a stick has `/home/systemcore/logs`: that is from the source code of
# > WPILib 2027, which is not released yet, and no page of the docs says it so far.
# >
# > **Try it:** find yesterday's log of your robot before you need today's.
#
# 4. Fit it, on your own computer. In a terminal:
#
# ```
# sysid fit FRC_20260214_153000.wpilog --method sysid
# ```
#
# The type is `simple` unless you say `--type elevator` or `--type arm`. In WPILib's SysId window
# look at that menu twice: it starts on *Elevator*, whatever your mechanism is.

# %% [markdown]
# ## 6 Spot five defects
#
# This compiles, and it moves the robot. Find five things that spoil the data or the day.
#
# ```java
# private final SysIdRoutine m_routine =
#     new SysIdRoutine(
#         new SysIdRoutine.Config(null, Volts.of(7.0), null, null),
#         new SysIdRoutine.Mechanism(
#             voltage -> m_leader.set(voltage.in(Volts) / 12.0),
#             log ->
#                 log.motor("shooter")
#                     .voltage(m_lastRequest) // saved in another method
#                     .angularPosition(Radians.of(m_leader.getPosition().getValueAsDouble()))
#                     .angularVelocity(
#                         RadiansPerSecond.of(m_leader.getVelocity().getValueAsDouble())),
#             this));
#
# // in RobotContainer
# m_driver.a().onTrue(m_shooter.sysIdQuasistatic(Direction.kForward));
# m_driver.b().onTrue(m_shooter.sysIdQuasistatic(Direction.kReverse));
# m_driver.x().onTrue(m_shooter.sysIdDynamic(Direction.kForward));
# m_driver.y().onTrue(m_shooter.sysIdDynamic(Direction.kForward));
# ```
#
# <details><summary>Five, and then some</summary>
#
# 1. `set(voltage / 12)` asks for a share of the battery, not for a voltage. Use `setVoltage`.
# 2. `m_lastRequest` is what was *asked for*. Log `getMotorVoltage()`.
# 3. A TalonFX gives **rotations**. Wrapping the number in `Radians` makes kV 2π times too large.
# 4. `onTrue`: the test goes on after the button is released. Use `whileTrue`.
# 5. `kForward` twice: there is no dynamic reverse test, and SysId asks for all four.
#
# And: 7 V is a lot for a first step; the driver's own controller without any guard is an accident
# in waiting; and no comment says which button does what.
# </details>

# %% [markdown]
# ## 7 System check
#
# Before you press the first button, all five:
#
# - [ ] The drive callback asks **every** motor for a **voltage**, and nothing corrects it.
# - [ ] The log holds **applied** voltage, position and velocity, in the mechanism's own unit.
# - [ ] Push the mechanism forward by hand: position and velocity **grow**. A small positive voltage
#   moves it the same way.
# - [ ] Four different commands on four buttons, `whileTrue`, behind a **guard**.
# - [ ] Limits of the motor controller are set, the timeout fits the room, and somebody has a hand
#   on *Disable*.
#
# ## 8 Knowledge check
#
# First one to click; you are told at once. (No buttons on your screen? Type
# `quick.answer("none")`, or another of the answers, in a cell.)

# %%
from grader import QuickCheck

quick = QuickCheck(
    (
        "A drive callback calls motor.set(volts / 12), and the log holds volts. Which gains are "
        "wrong when the battery gives 11 V all the time?"
    ),
    {
        "none": "A share of 11 V is not the same share of 12 V.",
        "only kA": (
            "That is a battery that sags for a moment. Here the voltage is off in every row, also "
            "at a steady speed."
        ),
        "all three": "The log says more volts than the motors got, in every row.",
    },
    right="all three",
)
quick

# %% [markdown]
# **1.** The analyzer says kV = 0.40 V·s/m for a drivetrain that should have about 2.5. Which slip?
#
# <details><summary>Answer</summary>
#
# Divide: 2.5 / 0.40 is about 6.3, which is 2π. Somewhere radians were taken for rotations, so
# the log's velocities are 2π times too large. Check kA as well: it must be off by the same factor,
# and kS must be right.
# </details>
#
# **2.** A teammate says: "SysId bypasses limits anyway, so I left them out." What do you say?
#
# <details><summary>Answer</summary>
#
# Only the command-level logic is bypassed. Limits in the motor controller work if they are set
# up, so set them up. And if one engages during a test, run that test again: the data after it
# describe the limit.
# </details>
#
# **3.** Two logs of one robot, both with a simulated velocity R² near 0.99. One has twice the kA of
# the other. Which one is right?
#
# <details><summary>Answer</summary>
#
# R² cannot tell. Look at the wiring: were all motors driven, was the applied voltage logged? Then
# compare kA with what the motors and the mass predict (lesson 1).
# </details>
#
# **4.** Why does the routine belong inside the subsystem, and why does it get `this`?
#
# <details><summary>Answer</summary>
#
# The subsystem owns the motors and the encoders that the callbacks use. With `this`, the test
# commands *require* the subsystem: whatever else drove it is interrupted while a test runs.
# </details>

# %% [markdown]
# ## 9 Practice
#
# **Exercise 4.** Write the routine for the mechanism you were given. In a terminal, in the course's
# folder:
#
# ```
# grade exercise4
# ```
#
# It reads your code without running it, and says what it found. Hints cost nothing:
# `grade exercise4 --hint`.
#
# The exercise wants the source lesson's numbers: 0.5 V/s, 3.5 V, 10 s. It accepts `setVoltage` and
# a `VoltageOut` request alike.
#
# **Exercise 5.** Bind four tests to buttons, each with a comment, behind a guard
# (`exercises/exercise5/README.md`):
#
# ```
# grade exercise5
# ```
#
# **On your own robot:** write the four bindings and the guard, with a comment on each that names
# the test and what it measures. Then let somebody who was not here find the dynamic reverse button.
#
# Next: lesson 5, pre-flight and the first run.
