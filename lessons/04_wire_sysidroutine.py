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
# *About 35 minutes. You need lesson 3, and you should have written some robot code. You need no
# robot today.*
#
# ![Voltage and speed of the four tests of a routine: slowly forward, slowly in reverse, a step
# forward, a step in reverse.](attachment:picture.png)
#
# **At the end you can**
#
# - build a `SysIdRoutine` from its two parts, a `Config` and a `Mechanism`;
# - write the callback that drives the motors, and say why it must set a *voltage*;
# - write the callback that logs three signals (voltage, position, velocity) in the right units;
# - bind the four test commands to buttons, and protect them with a guard;
# - look at a wrong gain and find the line of code that caused the error.
#
# (A *callback* is a function of yours that the library calls. A *guard* is a condition that must be
# true before a button works.)
#
# The code is for WPILib 2026, in Java and in Python (RobotPy). Open the language that your team
# uses.

# %% [markdown]
# ## 1 Why: every later step depends on the log
#
# A `SysIdRoutine` does two things, fifty times a second: it **sets a voltage**, and it **writes
# down what happened**. You compute the gains later, from the log.
#
# A mistake in this code does not stop the program. The robot moves, the log grows, and the analyzer
# (the SysId window) shows gains. But these gains do not belong to your robot. Today you make such
# mistakes on purpose, on a simulated robot with known gains, and learn to recognize each mistake.

# %%
import math
from dataclasses import replace

import numpy as np
from IPython.display import display

import sim
from grader import ask_question, enable_checkboxes
from sim.bench.duty_cycle import Battery, simulate_duty_cycle
from sim.bench.mechanisms import MECHANISMS
from sim.bench.simulate import simulate
from sim.fit import fit
from sim.plot import plot_time_series, tabulate_fits, tabulate_gains
from sim.plot.animation import (
    Choice,
    Gain,
    Knob,
    Motion,
    Panel,
    Scene,
    TestPlan,
    animate_mechanism,
)
from sim.plot.animation.charts import Chart, animate_charts, compare_values
from sim.plot.animation.of_logs import animate_logs
from sim.teaching.logs import apply_mistake

drivetrain = MECHANISMS["drivetrain"]
truth = drivetrain.gains
print(drivetrain.summary)
tabulate_gains(
    {"our drivetrain": truth},
    caption="The true gains. On a real robot nobody knows them.",
)

# %% [markdown]
# ## 2 The model: what a row of the log must hold
#
# The model from lesson 1 gives the voltage for a motion:
#
# > **V = kS·sgn(v) + kV·v + kA·a**
#
# To find the three gains, the analyzer needs many rows of V, v and a:
#
# | what | where it comes from | what needs it |
# |---|---|---|
# | voltage V | the motor controller | every fit |
# | velocity v | the encoder | every fit |
# | acceleration a | SysId computes it from v and the time | every fit, but you do not log it |
# | position | the encoder | arms: gravity depends on the angle. And drivetrains? |
#
# SysId's window loads a log only if it has position, velocity and voltage. The last cell of this
# section removes the positions and fits again. Do the gains of a drivetrain change?
#
# <details><summary>For mentors: which signals does the regression need?</summary>
#
# > **Lesson says:** log position, velocity and applied voltage, "all three are required for
# > regression".
# >
# > **Source says:** SysId's window requires all three signals before it loads a log. The fit for a
# > drivetrain or a shooter then uses only velocity and voltage. ([WPILib docs: Loading
# > Data](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/system-identification/loading-data.html))
# >
# > **Try it:** the last cell of this section removes the positions and fits again. Do the gains
# > change?
# </details>
#
# The picture shows the log of a correct routine, with a ramp of 0.5 V/s and a step of 3.5 V.

# %%
routine = sim.Routine(ramp=0.5, step=3.5, timeout=10.0)
right = simulate(drivetrain, routine, rng=np.random.default_rng(4))

plot_time_series(right, dynamic_seconds=1.0)

# %% [markdown]
# You see the four runs of lesson 3, with only the first second of each step. Which gains does
# SysId's method find in this log?


# %%
no_positions = replace(
    right, runs=tuple(replace(run, position=np.zeros(len(run))) for run in right.runs)
)
tabulate_fits({"correct": right, "without positions": no_positions}, truth)

# %% [markdown]
# The gains do not change: a drivetrain's fit uses only velocity and voltage. The two **R²** ("R
# squared") are SysId's scores: 1 is perfect. Lesson 7 explains them. In this lesson we only check
# whether R² shows a mistake.

# %% [markdown]
# ## 3 Doing it: the routine, part by part
#
# You need no separate project for SysId. You add the routine as a field to a subsystem that you
# already have, because the subsystem contains the motors and the encoders.
#
# ### Two arguments
#
# The routine takes two arguments: `SysIdRoutine(Config config, Mechanism mechanism)`. `Config` says
# how the tests run. `Mechanism` holds your two callbacks and the subsystem.
#
# <details><summary>For mentors: two arguments or three?</summary>
#
# > **Lesson says:** "The routine takes three things: a Config (…), a Mechanism (…), and a log-name
# > string."
# >
# > **Source says:** the routine takes two arguments: `SysIdRoutine(Config config, Mechanism
# > mechanism)`. The name is an optional *fourth* argument of `Mechanism`. If you leave it out, the
# > log uses the subsystem's name. ([WPILib's source:
# > SysIdRoutine.java](https://github.com/wpilibsuite/allwpilib/blob/v2026.2.2/wpilibNewCommands/src/main/java/edu/wpi/first/wpilibj2/command/sysid/SysIdRoutine.java))
# >
# > **Try it:** count the arguments of `SysIdRoutine` in the code below.
# </details>
#
# ### Config: how hard, how long
#
# `Config` holds the ramp rate (volts per second), the step voltage (volts) and the timeout
# (seconds). For the library's default, write `null` in Java. In Python leave the argument out: for
# these three, `None` is an error.
#
# | setting | default | this lesson's log |
# |---|---|---|
# | ramp rate | 1 V/s | 0.5 V/s |
# | step | 7 V | 3.5 V |
# | timeout | 10 s | 10 s |
#
# **Myth check.** "A step between 3 and 7 V is fine." *It depends on your robot.* A maintainer of
# WPILib calls the default of 7 V "almost always too much". The next cell computes the voltage above
# which the wheels slip, V_slip = `kS + kA·μ·g` (lesson 3), for two drivetrains with the same
# motors. Would a step of 3 V be safe for both?
#
# <details><summary>For mentors: typical steps, with source</summary>
#
# > **Lesson says:** a ramp that is "typically 0.5 V/s", a step that is "typically 3–7V", and "Start
# > with a step voltage of 3–4V, not 7V".
# >
# > **Source says:** the library's default step is 7 V, and one of its maintainers finds it "almost
# > always too much": the wheels slip, and the model does not describe slipping wheels. ([allwpilib
# > issue 7794](https://github.com/wpilibsuite/allwpilib/issues/7794))
# >
# > **Try it:** wheels slip when the motors push harder than the carpet can hold. From standstill,
# > this needs about `kS + kA·μ·g` volts, with grip μ and g = 9.81 m/s². The next cell computes this
# > voltage for two drivetrains with the same motors. Would a step of 3 V be safe for both?
# </details>

# %%
GRIP = 1.1  # wheels on carpet, roughly
for mass in (60.0, 30.0):
    gains = replace(drivetrain, load=mass).gains
    slips = gains["kS"] + gains["kA"] * GRIP * 9.81
    print(f"{mass:.0f} kg, kA = {gains['kA']:.3f} V·s²/m: wheels slip from about {slips:.1f} V")

# %% [markdown]
# The wheels of a strong drivetrain slip at a low voltage. If the drivetrain is also light, they
# slip at an even lower voltage. (Our simulated wheels never slip, so we may use 3.5 V here. For
# your robot, choose the step with the planner of lesson 3.)
#
# How far and how fast does our robot go in 10 s? Try the defaults first.


# %%
def press_button(**volts: Gain) -> Scene:
    """One test of 10 s, with the ramp rate or the step of a slider."""
    robot = Motion("robot", gains=truth, plan=TestPlan(**volts))
    return Scene(np.arange(0.0, 10.0, 0.02), (robot,))


animate_mechanism(
    "drivetrain",
    {("ramp",): press_button(ramp=Gain("ramp")), ("step",): press_button(step=Gain("step"))},
    choices=(Choice("test", ("ramp", "step")),),
    knobs=(
        Knob("ramp", "ramp rate [V/s]", low=0.1, high=1.2, step=0.1, value=1.0),
        Knob("step", "step [V]", low=0.5, high=7.0, step=0.5, value=7.0),
    ),
    panels=(Panel("voltage", "voltage [V]", high=12.0), Panel("velocity", "speed [m/s]")),
    alt="A robot drives for 10 s. You choose the ramp and the step, and see its voltage, its speed "
    "and how far it goes.",
)

# %% [markdown]
# **What `null` means.** The fourth argument of `Config` is a callback for the *state* of the test.
# The state is a word such as `quasistatic-forward`. It tells the analyzer where a test begins and
# ends. With `null` these words go into the **WPILOG file** on the robot (the log that WPILib
# writes). A team with AdvantageKit writes them with `Logger.recordOutput` (lesson 5, section 6).
#
# <details><summary>For mentors: where does the test state go?</summary>
#
# > **Lesson says:** `null` is "use default state consumer (logs to DS)".
# >
# > **Source says:** with `null` the state goes into the **WPILOG file** on the robot. It is a text
# > entry whose name is `sysid-test-state-` plus the mechanism's name. Nothing goes to the Driver
# > Station. ([WPILib docs: Creating a
# > Routine](https://github.com/wpilibsuite/frc-docs/blob/d57699ab3bc9612521fb1cd8edf9db348c3ddbc1/source/docs/software/advanced-controls/system-identification/creating-routine.rst))
# >
# > **Try it:** open any SysId log in AdvantageScope and look for that entry.
# </details>
#
# <details><summary>Want to know more? A name or a logger of your own</summary>
#
# `Mechanism` has an optional fourth argument: the name in the log. If you leave it out, the log
# uses the name of the subsystem.
#
# In Python, a logger of your own must write the state with `SysIdRoutineLog.stateEnumToString`. The
# analyzer looks for the words that this function writes. `str(state)` writes other words.
#
# The log callback of `Mechanism` may be `null` too, but only if another logger records the motors
# for you: CTRE's SignalLogger, URCL for REV, or AdvantageKit. Lesson 5 shows how. In Python, `None`
# fails in the first loop of the test: write `lambda log: None`. In this course you write the log
# callback yourself.
#
# (Source: `commands2/sysid/sysidroutine.py` of [robotpy-commands-v2
# 2026.2.2](https://pypi.org/project/robotpy-commands-v2/2026.2.2/). CTRE's Python example uses a
# state callback and `lambda log: None`: [Plumbing & Running SysId, at one
# commit](https://github.com/CrossTheRoadElec/Phoenix6-Documentation/blob/079a28341bc1ed380f3a4bc6e9fcec300517eabb/source/docs/api-reference/wpilib-integration/sysid-integration/plumbing-and-running-sysid.rst).)
# </details>

# %% [markdown]
# ### Mechanism, first callback: drive
#
# The routine gives your drive callback a voltage. You send it to **every** motor of the mechanism,
# except to followers. A *follower* is a motor that copies another motor, its leader. If you also
# send a voltage to the follower, it stops copying. If the two motors face each other, they then
# push against each other. ([`Follower` of phoenix6
# 26.3.0](https://pypi.org/project/phoenix6/26.3.0/)) There are three rules:
#
# 1. **Open loop.** Nothing may correct the motion. Use no PID, no `VelocityVoltage` and no Motion
#    Magic. If a controller corrects the motion, the gains describe this controller, too.
# 2. **A voltage, not a fraction of the battery voltage.** `set(0.3)` means "30 % of the present
#    battery voltage". The battery voltage drops when motors draw current, so the motor gets less
#    voltage than you expect. You can test this in section 4.
# 3. **Every motor.** If one motor gets no voltage, the other motors have to turn it, too. Then the
#    gains are wrong.
#
# <details><summary>If your code uses voltage compensation</summary>
#
# A SPARK with `voltageCompensation(12)` in its configuration takes a duty cycle as a share of 12 V,
# not of the battery: `set(0.3)` is then 3.6 V, as long as the battery has more. (The setting is for
# all modes: `SparkBaseConfig` of
# [robotpy-rev 2026.0.4](https://pypi.org/project/robotpy-rev/2026.0.4/).) A TalonFX has no such
# setting; its voltage requests do it. ([CTRE docs: Voltage, at one
# commit](https://github.com/CrossTheRoadElec/Phoenix6-Documentation/blob/079a28341bc1ed380f3a4bc6e9fcec300517eabb/source/docs/api-reference/device-specific/talonfx/talonfx-control-intro.rst))
#
# **Do it:** search your code for `voltageCompensation` and for `set(`. Did somebody write
# `set(volts / 12)`? Write `setVoltage(volts)`: it means volts with and without the setting.
# </details>
#
# <details><summary>For mentors: setVoltage or VoltageOut?</summary>
#
# > **Lesson says:** "Use `setVoltage()` directly — not `setControl(new VoltageOut(...))` — so the
# > routine has raw voltage authority during testing".
# >
# > **Source says:** on a TalonFX (Phoenix 6) the two are the same thing: `setVoltage()` *is* a
# > `VoltageOut` request, and CTRE's own SysId example uses `setControl` with one request object.
# > ([CTRE docs: Plumbing & Running SysId](https://github.com/CrossTheRoadElec/Phoenix6-Documentation/blob/079a28341bc1ed380f3a4bc6e9fcec300517eabb/source/docs/api-reference/wpilib-integration/sysid-integration/plumbing-and-running-sysid.rst))
# >
# > What matters is that you set a voltage and not a fraction of the battery voltage. **Try it** in
# > section 4.
# </details>
#
# Let the battery voltage drop: how many volts reach the motor?


# %%
def reach_motor(asked: float, battery: float) -> Chart:
    """The volts at the motor with either method."""
    volts = {"setVoltage(volts)": min(asked, battery), "set(volts / 12)": asked / 12 * battery}
    return compare_values(volts, truth=asked, xlabel="volts at the motor [V] (dashed: volts)")


animate_charts(
    reach_motor,
    knobs=(
        Knob("asked", "volts [V]", low=1.0, high=12.0, step=0.5, value=7.0),
        Knob("battery", "battery [V]", low=7.0, high=13.0, step=0.25, value=12.0),
    ),
)

# %% [markdown]
# ### Mechanism, second callback: log
#
# Once per loop, write down for each motor group: **applied voltage, position, velocity**.
#
# - **Applied** voltage is what reached the motor. A TalonFX reports it as `getMotorVoltage()`. For
#   a simple controller on a PWM port it is `get()` times the battery voltage. The applied voltage
#   is *not* always the voltage that the routine commanded: in a brownout (the battery voltage gets
#   too low), the applied voltage drops to 0 and comes back, again and again (lesson 6).
# - **Units.** A drivetrain or an elevator moves along a line. Log meters and meters per second:
#   include the gear ratio *and* the wheel size. A shooter or an arm turns. Log rotations and
#   rotations per second of the *mechanism*: include the gear ratio.
# - **Direction.** A positive voltage must give a positive velocity. Check the direction first.
# - **Name.** `log.motor("drive-left")`: one name for each motor, or for each pair that shares an
#   encoder. Later you choose this name in the analyzer.
#
# The Java logger accepts any unit of angle, but it always *stores rotations*. So the gains are per
# rotation. If your feedforward uses radians, convert the **gains** after the fit (lesson 1). The
# next cell fits one shooter log and prints kV per rotation and per radian.
#
# <details><summary>For mentors: where to convert to radians</summary>
#
# > **Lesson says:** "Use `Units.rotationsToRadians()` if your feedforward class expects radians."
# >
# > **Source says:** the Java logger takes any unit of angle, and always *stores rotations*. So the
# > gains are per rotation. You convert either the **gains** after the fit, or the velocity that you
# > pass to your feedforward. ([WPILib's source:
# > SysIdRoutineLog.java](https://github.com/wpilibsuite/allwpilib/blob/v2026.2.2/wpilibj/src/main/java/edu/wpi/first/wpilibj/sysid/SysIdRoutineLog.java))
# >
# > **Try it:** the next cell fits one shooter log and prints kV per rotation and per radian.
# </details>

# %%
shooter = MECHANISMS["shooter"]
spun = fit(simulate(shooter, routine, rng=np.random.default_rng(5)), method="sysid")
per_rotation = spun.in_units("rotations").gains["kV"]
per_radian = spun.in_units("radians").gains["kV"]
print(f"kV = {per_rotation:.4f} V·s/rotation = {per_radian:.5f} V·s/radian")
print(f"Their factor is {per_rotation / per_radian:.4f}. 2π is {2 * math.pi:.4f}.")

# %% [markdown]
# If you mix up rotations and radians, your feedforward is wrong by a factor of 2π.
#
# ### All of it, in Java
#
# <details><summary>Open the code in Java</summary>
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
# (The right motor's inversion is set in its TalonFX configuration, so that a positive voltage
# drives forward. A joystick that you push forward gives a *negative* number: change its sign in
# your drive code. [WPILib docs: Coordinate System, at one
# commit](https://github.com/wpilibsuite/frc-docs/blob/171e0ea60c03fb59789a30b8fdfca9a299747af9/source/docs/software/basic-programming/coordinate-system.rst))
# </details>
#
# <details><summary>For WPILib 2027: Commands v3</summary>
#
# **Commands v3** comes with WPILib 2027, for Java. There the class `extends Mechanism`, and the
# parts of the same routine have other names: `Config.useDataLog` takes ramp, step and timeout, and
# `SysIdRoutine.SysIdMechanism` takes the two callbacks and `this`. `null` does not mean "default"
# there: for WPILib's default numbers write `Config.defaults()`. Exercises 4 and 5 accept both
# versions. ([SysIdRoutine of Commands v3, at one commit of the
# branch](https://github.com/wpilibsuite/allwpilib/blob/10171e2f048a8b86ffa82d52b65d09287c342268/commandsv3/src/main/java/org/wpilib/command3/sysid/SysIdRoutine.java))
# </details>

# %% [markdown]
# ### All of it, in Python
#
# <details><summary>Open the code in Python</summary>
#
# This version uses PWM controllers and encoders on the roboRIO, so it needs no vendor library. We
# test this code in WPILib's simulation: the tests press its buttons and fit its log.
#
# ```python
# import commands2
# import wpilib
# from commands2.button import CommandXboxController, Trigger
# from commands2.sysid import SysIdRoutine
# from wpilib.sysid import SysIdRoutineLog
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
# **Where do you write `self.routine = …`?** WPILib's docs show `routine = SysIdRoutine(…,
# Mechanism(self.voltageDrive, …, self))`, but do not say in which method this line belongs. In the
# body of a class there is no `self`, and Python stops with a `NameError`. Write it into `__init__`,
# as in the code above. ([WPILib docs: Creating a
# Routine](https://github.com/wpilibsuite/frc-docs/blob/d57699ab3bc9612521fb1cd8edf9db348c3ddbc1/source/docs/software/advanced-controls/system-identification/creating-routine.rst))
# </details>
#
# In the Java or Python code that you opened, find three lines: the line that sets the voltage, the
# line that logs the voltage, and the line that passes the subsystem (`this` or `self`). If you pass
# the subsystem, no other command can drive it during a test.

# %% [markdown]
# ### Four commands, bound and guarded
#
# The routine makes four commands: `quasistatic(kForward)`, `quasistatic(kReverse)`,
# `dynamic(kForward)`, `dynamic(kReverse)`. Make them public, and bind **each to its own button**
# (to *bind* means: this button starts this command). For each binding you need:
#
# - **`whileTrue`**, so that letting go ends the test. With `onTrue` the test continues after you
#   let go, until the timeout.
# - **A comment on each binding** that names the test *and what it measures*. In six months you will
#   not remember it.
# - **A guard**, so that nobody starts a test in a match. The guard can be Test mode (as here), a
#   separate controller, or two buttons at once.
#
# In Java (the Python code above ends with the same bindings):
#
# ```java
# import edu.wpi.first.wpilibj2.command.sysid.SysIdRoutine.Direction; // at the top of the file
#
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
# <details><summary>If your team uses YAMS: the routine is there</summary>
#
# A motor controller of YAMS makes the routine: `sysId(maxVoltage, stepVoltage, testDuration)`. It
# sets the voltage, and logs voltage, position and velocity, in meters if you gave it the
# mechanism's circumference. But the names mislead: it calls `Config(stepVoltage, maxVoltage,
# testDuration)`. So `maxVoltage` is the *step*, and `stepVoltage` is the *ramp rate* in V/s.
# ([SmartMotorController.java, at one
# commit](https://github.com/Yet-Another-Software-Suite/YAMS/blob/01c4651f449e777dc133ae1cb079390ad352dfc0/yams/java/yams/motorcontrollers/SmartMotorController.java))
#
# **Do it:** find this call in your code. Which step does it ask for? You still bind the four
# commands.
# </details>
#
# <details><summary>For WPILib 2027: other names</summary>
#
# **In WPILib 2027** (not released yet; names as on its development branch) these lines do not
# compile. Test mode is called *utility mode* there. The guard is `RobotModeTriggers.utility()`, or
# `new Trigger(RobotState::isUtilityEnabled)`. The directions are `FORWARD` and `REVERSE`. You set a
# motor's duty cycle with `setThrottle` instead of `set`; `setVoltage` keeps its name.
# ([RobotModeTriggers](https://github.com/wpilibsuite/allwpilib/blob/1676a42fe0522b3fc22593482b19fe5ed536051c/commandsv2/src/main/java/org/wpilib/command2/button/RobotModeTriggers.java)
# and, in C++,
# [MotorController](https://github.com/wpilibsuite/allwpilib/blob/3738b6f682ce731dd8f7a6306fd708b9ed3ed22f/wpilibc/src/main/native/include/wpi/hardware/motor/MotorController.hpp),
# each at one commit of the branch)
# </details>
#
# **Myth check.** "A SysId test *bypasses* all limits: no limit works during a test." *This is only
# partly true.* During a test, the subsystem's other *commands* do not run, nor does their safety
# code. Limits **inside the motor controller** still work if you set them up, and that is your job.
# A limit in the motor controller protects the robot. But while it acts, you measure the limit and
# not the motor.
#
# <details><summary>For mentors: which limits does a test bypass?</summary>
#
# > **Lesson says:** a SysId test runs "bypassing soft limits, current limits, and any command-level
# > safety logic you've written".
# >
# > **Source says:** this is partly true. The safety code in your *commands* does not run, because
# > no other command can use the subsystem during a test. Limits **inside the motor controller**
# > still work if you set them up; WPILib's docs name "soft and hard limits" as a reason to use your
# > own code for the tests, and say that setting them up is your job. ([Creating a
# > Routine](https://github.com/wpilibsuite/frc-docs/blob/d57699ab3bc9612521fb1cd8edf9db348c3ddbc1/source/docs/software/advanced-controls/system-identification/creating-routine.rst),
# > [Running the
# > Routine](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/system-identification/running-routine.html))
# >
# > Two things matter: a limit protects you, *and* while it acts, you measure the limit instead of
# > the motor.
# >
# > **Try it** on your robot, slowly and with a hand on Disable: drive toward a soft limit with a
# > joystick. Does the limit stop the robot?
# </details>

# %% [markdown]
#
# <details><summary>Want to know more? What the loop really does</summary>
#
# The test command starts its timer in one loop, and sets the first voltage in the next. (We saw
# this when we ran the real command in WPILib's simulation.) So the first voltage of a ramp is not
# zero: with a ramp of 0.5 V/s and loops of 20 ms, it is 0.01 V. Our simulated robot waits for one
# more loop: its first voltage is 0.02 V.
# </details>

# %% [markdown]
# ## 4 The virtual robot: one mistake at a time
#
# Now you run seven programs on the simulated robot. Only one of them is correct:
#
# | program | the mistake in the code |
# |---|---|
# | correct | none |
# | share of the battery | `set(volts / 12)`, and the log contains the commanded volts |
# | …but logs applied volts | `set(volts / 12)`, and the log contains `getMotorVoltage()` |
# | turns called meters | `Meters.of(wheelTurns)` |
# | radians taken for turns | `circumference * radians` |
# | encoder inverted | the encoder's `setReverseDirection(true)` forgotten |
# | one motor of each pair | the second motor of each side gets no command |
#
# **Predict** before you run them:

# %%
display(ask_question("lesson4.gain"), ask_question("lesson4.factor"), ask_question("lesson4.score"))

# %%
CIRCUMFERENCE = math.pi * 0.1016  # [m] of a 4 inch wheel
TIRED = Battery(rest=12.2, resistance=0.035)
rng = np.random.default_rng(40)
sagging = simulate_duty_cycle(drivetrain, routine, battery=TIRED, rng=rng)
# Half the motors need twice the volts for the same force, and friction is a force.
half = replace(drivetrain, motor_count=2, friction=2 * drivetrain.friction)
halved = simulate(half, routine, rng=rng)

# program -> (what its log says, what really happened)
programs = {
    "correct": (right, right),
    "share of the battery": (apply_mistake(sagging, commanded=True), sagging),
    "…but logs applied volts": (sagging, sagging),
    "turns called meters": (apply_mistake(right, factor=1 / CIRCUMFERENCE), right),
    "radians taken for turns": (apply_mistake(right, factor=2 * math.pi), right),
    "encoder inverted": (apply_mistake(right, factor=-1.0), right),
    "one motor of each pair": (halved, halved),
}

# %% [markdown]
# Choose a program and a test. (The letter is the button of the controller.) The solid robot shows
# what really happens. The dashed outline shows where the robot is if you believe the log.

# %%
BUTTONS = {f"{button}: {test}": test for button, test in zip("ABXY", routine.tests, strict=True)}
animate_logs(
    "drivetrain",
    programs,
    tests=BUTTONS,
    label="program",
    span=(-11.0, 21.0),
    alt="A robot drives while a button is held. A dashed outline shows where its log says that it "
    "is. With the correct program both are at the same place. With an inverted encoder the log "
    "goes backward, and with wrong units it goes too far or not far enough.",
)

# %% [markdown]
# The next table shows the gains, each divided by the true gain, and both R² for all seven programs:

# %%
tabulate_fits({name: log for name, (log, _) in programs.items()}, truth)

# %% [markdown]
# ### Explain what you saw
#
# - **Share of the battery.** At the start of the step the current is large, so the battery voltage
#   drops. The motors get fewer volts than the log says. The robot looks heavier than it is: **kA**
#   has the largest error. At a steady speed the current is small, so the error of kV is small.
# - **…but logs applied volts.** The gains are right. The robot drove exactly as with the previous
#   program; only the log is different. *Log the applied voltage*: it is no extra work. (Even with
#   `setVoltage`, commanded and applied voltage differ during a brownout, with an empty battery, or
#   while a current limit acts.)
# - **Wrong units** multiply kV and kA by the same factor. They do not change kS, because kS is in
#   volts. You can recognize the factor: it is 2π, a circumference or a gear ratio.
# - **Encoder inverted:** every gain is negative. No real robot has a negative kV.
# - **One motor of each pair:** the log is correct for the motors that drove, but later you will
#   drive with all motors. With half the motors, each volt gives half the force, so kS and kA
#   double. kV stays the same.
# - **R² shows none of these mistakes.** R² cannot show a wrong unit or a wrong sign, because the
#   model fits such a log just as well as it fits a correct log.

# %% [markdown]
# ## 5 From your robot to your computer
#
# 1. Call `DataLogManager.start()` when the robot program starts, if your code does not do it yet.
# 2. Run the four tests (lesson 5 shows how). **One routine per log:** switch the robot off and on
#    before you test another mechanism. WPILib's docs say that otherwise the analysis fails.
#    ([Running the
#    Routine](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/system-identification/running-routine.html))
# 3. Download the `.wpilog` file with WPILib's Data Log Tool or with AdvantageScope (lesson 5,
#    section 5).
# 4. Fit the log on your own computer. In a terminal, type:
#
# ```
# sysid fit FRC_20260214_153000.wpilog --method sysid
# ```
#
# `sysid fit` looks for the word *elevator* or *arm* in the mechanism's name, and uses it as the
# analysis type. Without such a word the type is `simple`. `--type` chooses another one. When
# WPILib's SysId window opens, the type *Elevator* is selected, so check its menu.
#
# <details><summary>For mentors: where the log is</summary>
#
# > **Lesson says:** the default path is `/home/lvuser/logs/`.
# >
# > **Source says:** on a 2026 roboRIO, a FAT32 USB stick comes first: if there is one, the folder
# > is `/u/logs`. Without a USB stick, the folder is `/home/lvuser/logs`. ([WPILib docs: Data
# > Logs](https://docs.wpilib.org/en/stable/docs/software/telemetry/datalog.html)) On a 2027
# > Systemcore without a USB stick, the folder is `/home/systemcore/logs`. This comes from the
# > source code of WPILib 2027, which is not released yet. The docs do not mention it yet.
# >
# > **Try it:** find an old log of your robot before you need a new one.
# </details>

# %% [markdown]
# ## 6 Spot five defects
#
# This code compiles and moves the robot. Find five defects that make the data wrong or put somebody
# in danger.
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
# <details><summary>The five defects, and some more</summary>
#
# 1. `set(voltage / 12)` sets a fraction of the battery voltage, not a voltage. Use `setVoltage`.
# 2. `m_lastRequest` is the *commanded* voltage. Log `getMotorVoltage()`.
# 3. A TalonFX gives **rotations**. If the code calls this number `Radians`, kV is 2π times too
#    large.
# 4. With `onTrue` the test continues after you release the button. Use `whileTrue`.
# 5. The last two lines both say `kForward`, so there is no dynamic reverse test. SysId needs all
#    four tests.
#
# There are three more defects. A step of 7 V is large for a first test. It is dangerous to use the
# driver's controller without a guard that locks the tests. And no comment says which test a button
# starts.
# </details>
#
# **Find one more defect, in Python.** WPILib's docs make the commands like this. Which error stops
# the program?
#
# ```python
# def sysid_dynamic(self, direction: SysIdRoutine.Direction) -> commands2.Command:
#     return SysIdRoutine.dynamic(direction)
# ```
#
# <details><summary>The defect</summary>
#
# `SysIdRoutine` is the class, not your routine. Python uses the direction as `self`, so an argument
# is missing. The program stops with a `TypeError` when it binds the buttons. Call the method of
# *your* routine: `self.routine.dynamic(direction)`. ([source of WPILib's docs, at one
# commit](https://github.com/wpilibsuite/frc-docs/blob/d57699ab3bc9612521fb1cd8edf9db348c3ddbc1/source/docs/software/advanced-controls/system-identification/creating-routine.rst))
# </details>

# %% [markdown]
# ## 7 System check
#
# Before you press the first button, check these five points:
#
# - [ ] The drive callback sets a **voltage** on **every** motor, and nothing corrects the motion.
# - [ ] The log holds **applied** voltage, position and velocity. Position and velocity are those of
#   the mechanism, not of the motor.
# - [ ] When you push the mechanism forward by hand, the position **grows** and the velocity is
#   positive. A positive voltage also moves the mechanism forward, as soon as it is large enough.
# - [ ] Four different commands are on four buttons, with `whileTrue`, and a **guard** locks them.
# - [ ] The limits in the motor controller are set, the timeout fits the room, and somebody has a
#   hand on *Disable*.
#
# ## 8 Knowledge check
#
# Click an answer to the first question; you get feedback at once.

# %%
display(ask_question("lesson4.quick"), enable_checkboxes())

# %% [markdown]
# **1.** The analyzer shows kV = 0.40 V·s/m for a drivetrain that should have about 2.5. What is the
# mistake?
#
# <details><summary>Answer</summary>
#
# Divide: 2.5 / 0.40 is about 6.3, which is 2π. The code uses radians as if they were rotations, so
# the log's velocities are 2π times too large. Check kA as well: it must be wrong by the same
# factor, and kS must be right.
# </details>
#
# **2.** A teammate says: "No limit works during a SysId test, so I set no limits." What do you
# answer?
#
# <details><summary>Answer</summary>
#
# During a test, the safety code in your commands does not run. But limits in the motor controller
# work if you set them up, so set them. If a limit acts during a test, run all four
# tests again with a lower voltage: while the limit acts, you measure the limit and not the motor.
# </details>
#
# **3.** You have two logs of one robot. Both have a simulated velocity R² near 0.99, but one log
# gives twice the kA of the other. Which kA is right?
#
# <details><summary>Answer</summary>
#
# R² does not show which kA is right. Look at the code: does it drive all motors, and does it log
# the applied voltage? Then compute kA from motors and mass (lesson 1), and compare.
# </details>
#
# **4.** Why does the routine belong inside the subsystem, and why does it get `this`?
#
# <details><summary>Answer</summary>
#
# The subsystem contains the motors and the encoders that the callbacks use. With `this`, the test
# commands *require* the subsystem, so no other command can drive it while a test runs.
# </details>

# %% [markdown]
# ## 9 Practice
#
# **Exercise 4** ([exercises/exercise4/README.md](../exercises/exercise4/README.md)). Write the
# routine for a drivetrain. In a terminal, in the course's folder:
#
# ```
# grade exercise4
# ```
#
# This command runs your code on a simulated robot and says what is wrong. Hints cost nothing:
# `grade exercise4 --hint`.
#
# The exercise asks for 0.5 V/s, 3.5 V and 10 s. For a real robot, choose your own numbers (lesson
# 3).
#
# **Exercise 5** ([exercises/exercise5/README.md](../exercises/exercise5/README.md)). Bind four
# tests to buttons, each with a comment, and lock them with a guard:
#
# ```
# grade exercise5
# ```
#
# **While you write code,** leave `grade watch exercise4` running in a terminal next to your editor:
# it grades your code each time you save the file.
#
# **On your own robot:** write the four bindings and the guard, with a comment on each that names
# the test and what it measures. Then ask somebody who does not know your code to find the button
# for the dynamic reverse test.
#
# **Next:** [Lesson 5, pre-flight and the first run](05_preflight_and_run.ipynb). Is everything
# ready?
