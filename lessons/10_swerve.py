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
# # Lesson 10: Swerve
#
# *About 40 minutes. You need lessons 3, 6 and 8. This lesson is for teams with a swerve drive.*
#
# ![Four wheels from above, twice. To go straight, all of them point the same way. To turn on the
# spot, each points along a circle.](attachment:picture.png)
#
# **At the end you can**
#
# - say what CTRE's three swerve routines measure, and in which units;
# - fit each module alone and all of them together, and find a worn wheel;
# - find the radius of a wheel from a slow spin;
# - find the **moment of inertia** from two tests, with the right lever;
# - find the **slip current** and the **grip** from a push against a wall;
# - put these numbers into PathPlanner and Choreo.

# %% [markdown]
# ## 1 Why: a planner uses the numbers that you give it
#
# A swerve drive has four **modules**. Each module has a wheel, a **drive motor** that rolls the
# wheel, and a **steer motor** that sets its direction. A swerve robot can drive in any direction
# and turn at the same time. PathPlanner and Choreo plan such paths for you. But they know only what
# you tell them: mass, moment of inertia, wheel radius, current limit.
#
# If you tell a planner that your robot is easier to turn than it really is, the planner plans turns
# that the wheels cannot do. Then the robot turns too late. So today you measure what the planners
# ask for.
#
# <details><summary>For mentors: what the planners ask for, with source</summary>
#
# > **Lesson says:** "Required for accurate path following with PathPlanner or Choreo. kV accuracy
# > directly determines how well trajectories track."
# >
# > **Source says:** neither planner asks for kV. PathPlanner asks for mass, moment of inertia,
# > wheel radius, gearing, true top speed, wheel friction and current limit. Choreo asks for mass,
# > moment of inertia, wheel radius, wheel friction, gearing, and the speed and torque of a motor.
# > kV and kA belong in your drive code, which has to follow the plan. ([PathPlanner docs: Robot
# > Config, at one
# > commit](https://github.com/mjansen4857/pathplanner/blob/207d36a66b09c96673428cddd62785b56fb29fee/Writerside/topics/Robot-Config.md);
# > [Choreo docs: Robot Configuration, at one
# > commit](https://github.com/SleipnirGroup/Choreo/blob/05c89476612291b458a7971b6c61f665d0fe1244/docs/document-settings/robot-configuration.md))
# >
# > **Try it:** open your planner's settings. Which numbers did you measure, and which did you
# > guess?
# </details>
#
# Our robot has four Kraken X60, 4 inch wheels and a mass of 60 kg. Its wheels form a square.

# %%
from textwrap import fill

import numpy as np
from IPython.display import display

import sim
from grader import ask_question, enable_checkboxes
from sim.bench.simulate import simulate
from sim.bench.slip import compute_slip_voltage
from sim.bench.swerve import SwerveDrive
from sim.bench.swerve_logs import record_modules, record_spin, record_wall_push
from sim.fit import fit
from sim.fit.physics.inertia import compute_moment_of_inertia
from sim.fit.pooled import pool_fits
from sim.physics.motors import find_motor
from sim.plot import Table
from sim.plot.animation import Choice, Knob, Motion, Panel, Scene, animate_mechanism
from sim.plot.animation.charts import Chart, animate_charts, chart_curves, compare_values
from sim.teaching.answers import read_answer
from sim.teaching.swerve_gaps import check_formulas

robot = SwerveDrive(
    motor=find_motor("krakenX60"),
    ratio=6.75,
    wheel_radius=0.0508,  # [m]
    trackwidth=0.6,  # [m] between two neighboring wheels
    mass=60.0,  # [kg]
    inertia=5.0,  # [kg·m²] the team does not know this number yet
    wheel_inertia=0.0015,  # [kg·m²] of one wheel, with gears and rotor
    friction=0.15,  # [V]
)
print(f"A square robot: {robot.trackwidth} m wide, {robot.mass:.0f} kg.")

# %% [markdown]
# ## 2 The model: three routines, three loads
#
# CTRE's Tuner X writes a program for your swerve drive. It contains three SysId routines. Only one
# is active. You choose it in the code.
#
# | routine | what moves | the "voltage" | gives |
# |---|---|---|---|
# | translation | the robot, wheels **locked straight** | volts of the drive motors | kS, kV, kA |
# | steer | the wheels, in place | volts of the steer motors | gains of the steering |
# | rotation | the robot, on the spot | **a rate in rad/s** | heading control, inertia |
#
# ([CommandSwerveDrivetrain.java, at one commit](https://github.com/CrossTheRoadElec/Phoenix6-Examples/blob/53fa17baa4abc0105a03b9ea602a6af730353939/java/SwerveWithPathPlanner/src/main/java/frc/robot/subsystems/CommandSwerveDrivetrain.java))
#
# Look at the third line. SysId knows only volts, so the program writes "volts". But the number is a
# rate: how fast the robot should turn. The program does not control this rate. It computes a
# voltage from this rate and gives it to the drive motors. Section 5 shows what that means for the
# log.
#
# <details><summary>Want to know more? From the rate to the voltage</summary>
#
# The program computes the voltage like this: rate · distance of the module from the middle / top
# speed · 12 V. The top speed is `kSpeedAt12Volts` in your constants. So the test is open loop, as a
# SysId test must be, and the drive motors get a ramp or a step of *volts*. (`SysIdSwerveRotation`
# in `phoenix6/swerve/requests.py` of [Phoenix 6, release
# 26.3.0](https://pypi.org/project/phoenix6/26.3.0/))
# </details>
#
# <details><summary>Want to know more? The steer routine</summary>
#
# It turns the four wheels in place, with the default ramp of 1 V/s and a step of 7 V (the same
# file). The load is only gears, rotors and wheels, so kA is small, and a log with 20 ms between
# rows hardly shows it (lesson 1, section 6). On carpet the tires rub, so kS is larger than on
# blocks: test where you drive. A module steers to a *position*: from this fit it needs kS, and a
# kP.
#
# **Do it:** run it with a step of 3 V, and fit `MotorVoltage`, `Position` and `Velocity` of one
# steer motor. Compare kV with the theoretical kV (lesson 1, section 5). If it is wrong by the gear
# ratio, the log is in turns of the motor, and not of the module.
# </details>
#
# The same motors move the robot in both tests, translation and rotation. Only the **load** differs:
#
# - straight, the wheels push the **mass**;
# - on the spot, they push against the **moment of inertia**. It says how hard it is to turn the
#   robot. Mass far from the middle counts more.

# %%
short = sim.Routine(step=1.5, timeout=2.0, kinds=("dynamic",))
ahead, around = (
    simulate(one, short, rng=np.random.default_rng(5)).runs[0]
    for one in (robot.translation, robot.rotation)
)
animate_mechanism(
    "swerve",
    {
        ("translation",): Scene(
            ahead.time - ahead.time[0], (Motion("robot", velocity=ahead.velocity),)
        ),
        ("rotation",): Scene(
            around.time - around.time[0],
            (
                Motion(
                    "robot",
                    position=np.zeros(len(around)),
                    velocity=around.velocity,
                    heading=around.position - around.position[0],
                    turns=True,
                ),
            ),
        ),
    },
    choices=(Choice("routine", ("translation", "rotation")),),
    panels=(Panel("velocity", "velocity [m/s, rad/s]"),),
    alt="A swerve robot from above. In the translation test its four wheels point forward, and the "
    "robot drives ahead. In the rotation test the wheels point at right angles to the diagonals, "
    "and the robot turns on the spot.",
)

# %% [markdown]
# ## 3 Going straight: each module, and all
#
# In the translation test all four wheels point forward. A log of this test has four voltage
# signals, four positions and four velocities. You can fit each module alone. You can also **pool**
# the modules: fit each one, then take the mean.
#
# On the back left module of our robot the wheel's rubber is worn, so that wheel is smaller. The
# code still uses the old radius. All wheels roll on the same floor, and all motors get the same
# voltage.
#
# **Predict:**

# %%
ask_question("lesson10.worn")

# %%
gentle = sim.Routine(ramp=0.5, step=1.8, timeout=8.0)
modules = record_modules(robot, gentle, rng=np.random.default_rng(1), radii={"back-left": 0.0484})
fits = {name: fit(log) for name, log in modules.items()}
pooled = pool_fits(fits)
Table(
    ("module", "kS [V]", "kV [V·s/m]", "kA [V·s²/m]"),
    (
        *((name, *one.gains.values()) for name, one in fits.items()),
        ("all, pooled", *pooled.gains.values()),
    ),
)

# %% [markdown]
# ### Explain
#
# A smaller wheel turns more often over the same distance. The code multiplies these turns by the
# radius of a *new* wheel, so this module reports more meters than the robot drove. The voltage is
# the same, but the reported speed is larger, so kV is smaller.
#
# The gains of the three other modules are almost equal. There is a reason: all motors get the same
# voltage, and the floor forces all wheels to the same speed. If one module rubs, it slows down
# *all* modules, and its fit looks like the other fits. To find a module that rubs, lift the robot
# and turn each wheel by hand, or compare the currents.
#
# So **compare the modules first, then pool them**. The mean of three good wheels and a worn wheel
# is wrong for all four. `sysid fit` compares the modules for you. If a gain differs too
# much, it names the module with the smallest and the one with the largest.

# %% [markdown]
# ## 4 A slow spin: how large is a wheel?
#
# The rubber of a wheel gets thinner with use, and the wheel sinks into the carpet. Both make the
# radius smaller. A tape measure does not show that, but a spin shows it. Turn the robot slowly on
# the spot, several full turns. The gyro measures the angle, and each drive motor counts its turns.
#
# Each wheel rolls on a circle around the middle of the robot:
#
# > distance that a wheel rolls = angle of the robot [rad] · distance of the wheel from the middle
#
# The same distance is 2π · radius · turns of the wheel. The wheels of a square robot are at its
# corners. With trackwidth T, the distance from the middle is half of the diagonal: **T/√2**.
#
# Find the four radii by hand: with the right radius, a wheel has rolled as far as the gyro says.

# %%
distance = robot.trackwidth / np.sqrt(2.0)
spin = record_spin(robot, turns=6.0, rng=np.random.default_rng(2), radii={"back-left": 0.0484})
print(f"The gyro turned {np.degrees(spin.turned):.0f}°, which is {spin.turned:.2f} rad.")


def roll(radius: float) -> Chart:
    """How far each wheel has rolled, if this is its radius [mm]."""
    way = 2 * np.pi * radius / 1000 / robot.ratio
    rolled = {name: way * turns for name, turns in spin.motor_turns.items()}
    label = "rolled [m] (dashed: the distance by the gyro)"
    return compare_values(rolled, truth=spin.turned * distance, xlabel=label)


animate_charts(roll, knobs=(Knob("radius", "radius [mm]", 46.0, 54.0, 0.2, 53.0),))

# %% [markdown]
# Now compute them:

# %%
rows = []
for name, motor_turns in spin.motor_turns.items():
    wheel_turns = motor_turns / robot.ratio
    radius = spin.turned * distance / (2 * np.pi * wheel_turns)
    rows.append((name, motor_turns, 1000 * radius))
Table(("module", "turns of the motor", "radius of the wheel [mm]"), tuple(rows))

# %% [markdown]
# The radius of the back left wheel is 2.4 mm smaller. Change the wheel, or write the right radius
# into the code. Do the spin on carpet. On a hard floor the wheel does not sink in, so you measure a
# different radius. AdvantageKit's swerve templates contain this spin as a routine. ([AdvantageKit
# docs: TalonFX Swerve Template, at one
# commit](https://github.com/Mechanical-Advantage/AdvantageKit/blob/e847e20eb8a173e60140599ba35fc0c27a7d1d9b/docs/docs/getting-started/template-projects/talonfx-swerve-template.md))

# %% [markdown]
# ## 5 Turning on the spot: the moment of inertia
#
# Now each wheel points at a right angle to the diagonal, and the robot turns on the spot. Both
# tests use the same motors:
#
# - straight, kA is a constant of the motors times the **mass**;
# - turning, kA is the same constant times **moment of inertia / lever**.
#
# A wheel pushes along a line. The **lever** is the distance of this line from the middle of the
# robot. If you divide one kA by the other, the constant disappears:
#
# > I = mass · lever · kA_turning / kA_straight
#
# One kA depends on the mass, the other on the inertia. A single kA cannot give you both.
#
# ### CTRE's log: a rate and degrees
#
# For kA_turning you need **volts**. In CTRE's log, two columns often cause a mistake:
#
# - `Rotational_Rate` is the rate that the program asks for, in rad/s. Take the `MotorVoltage` of a
#   drive motor instead.
# - The gyro (Pigeon 2) logs **degrees**. Motors log rotations. The formula needs **radians**.
#
# (CTRE also writes that the angle must be "scaled by pi/180", and that `MotorVoltage` "can be
# useful" for the moment of inertia: see `SysIdSwerveRotation` in [Phoenix 6, release
# 26.3.0](https://pypi.org/project/phoenix6/26.3.0/))
#
# ### Which lever?
#
# [PathPlanner's
# page](https://github.com/mjansen4857/pathplanner/blob/207d36a66b09c96673428cddd62785b56fb29fee/Writerside/topics/Robot-Config.md)
# and [Choreo's
# page](https://github.com/SleipnirGroup/Choreo/blob/2f4fff4bd823e15d62ed803b0c61a755fa527d0b/docs/usage/estimating-moi.md)
# (at one commit each) give the formula with *half the trackwidth*. That is right for a tank drive:
# its wheels push straight forward, T/2 away from the middle. The modules of a square swerve push at
# a right angle to the diagonal, so each force F turns the robot with F · T/√2.
#
# Our robot has 5.0 kg·m². **Predict:**

# %%
ask_question("lesson10.lever")

# %%
turning = fit(simulate(robot.rotation, gentle, rng=np.random.default_rng(3))).in_units("radians")
straight = fits["front-left"]
levers = {"half the trackwidth, T/2": 0.5 * robot.trackwidth, "half the diagonal, T/√2": distance}
found = {
    name: compute_moment_of_inertia(turning, straight, mass=robot.mass, lever=lever)
    for name, lever in levers.items()
}
print(f"kA straight {straight.gains['kA']:.4f} V·s²/m")
print(f"kA turning  {turning.gains['kA']:.4f} V·s²/rad")
Table(
    ("lever", "lever [m]", "moment of inertia [kg·m²]"),
    tuple((name, one.lever, one.value) for name, one in found.items()),
)

# %% [markdown]
# With the wrong lever the answer is too small by a factor of √2, for every square swerve.
#
# ### The log shows the lever
#
# You can check the length of the lever without a tape measure. At the same voltage, a wheel is
# equally fast in both tests. This speed is lever · ω, where ω is the robot's rate in rad/s. So the
# ratio of the two kV is the lever:

# %%
quotient = turning.gains["kV"] / straight.gains["kV"]
print(f"kV turning / kV straight = {quotient:.3f} m. T/√2 = {distance:.3f} m.")
for doubt in found["half the trackwidth, T/2"].doubts:
    print(fill(doubt.text, 80))

# %% [markdown]
# This check also finds an angle in degrees where you need radians: then the "lever" is 7 mm.
#
# ### Why 5.2 and not 5.0?
#
# The motors must also speed up wheels, gears and rotors. So both kA are too large, one by a larger
# share than the other. Usually wheels, gears and rotors count like 3 to 10 % more mass. Then the
# result is a few percent too large. So do not trust the third digit.
#
# <details><summary>Want to know why? How much the rotors change</summary>
#
# The wheels and rotors act like an additional mass m_w. When the robot drives straight, they add
# m_w to the mass. When it turns, they add m_w · lever² to the inertia. The robot's own inertia is
# about I − s · (mass · lever² − I), with s = m_w / mass. `sysid fit` prints the range for s from 3
# to 10 %.
# </details>

# %%
least, most = found["half the diagonal, T/√2"].without_rotors
print(f"Without wheels and rotors: {least:.2f} to {most:.2f} kg·m².")

# %% [markdown]
# ## 6 The push against a wall: when do the wheels slip?
#
# The carpet gives the wheels only limited grip. If a motor pushes harder, the wheel spins on the
# floor: it **slips**. While it slips, your log shows the speed of the wheel, not the speed of the
# robot.
#
# CTRE's program runs its translation test with a step of 4 V. **Predict:**

# %%
ask_question("lesson10.step")


# %%
def speeds(step: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Time since a step of voltage, speed of the wheels, speed of the robot."""
    routine = sim.Routine(step=step, timeout=0.6, kinds=("dynamic",))
    log = simulate(robot.translation, routine, rng=np.random.default_rng(4), period=0.005)
    run = log.runs[0]
    since = run.time - run.time[0]
    floor = 9.81 * robot.grip * since  # the carpet gives the robot no more than this
    return since, run.velocity, np.minimum(run.velocity, floor)


def launch(step: float) -> Scene:
    """The robot after a step of voltage, and the place that its wheels count."""
    since, wheels, body = speeds(step)
    log = Motion("your log (the wheels)", velocity=wheels, ghost=True)
    return Scene(since, (Motion("robot", velocity=body), log))


limit = compute_slip_voltage(robot.translation)
print(f"The wheels of this robot slip above {limit:.1f} V.")
STEPS = {f"{step:g} V": launch(step) for step in (1.0, 1.5, 2.0, 3.0, 4.0, 5.0)}
animate_mechanism(
    "swerve",
    {(name,): scene for name, scene in STEPS.items()},
    choices=(Choice("step", tuple(STEPS), value="4 V"),),
    panels=(Panel("velocity", "speed [m/s]"),),
    alt="A robot from above. A dashed robot shows the place that its log gives. With a step of 1 V "
    "the two are at the same place. With 4 V the wheels spin, and the log is ahead of the robot.",
)

# %% [markdown]
# A fit of such a log finds a kA that is far too large. Look at the wheels after their first jump:
# their speed hardly changes until the robot is as fast as they are. Choose a step that does not
# make the wheels slip, here about 1.8 V. If the robot is heavier or the motors are weaker, the step
# may be larger.
#
# ### Measure it
#
# Put the robot with its bumpers against a **wall**. The wheels point straight at the wall. Raise
# the voltage slowly. At first nothing turns, and the current grows with the voltage. Then the
# wheels start to slip.
#
# *Safety: nobody stands near the robot or behind the wall. Stop at once when the wheels spin,
# because they burn the carpet. Do this test once or twice, not ten times.*

# %%
push = record_wall_push(robot, rng=np.random.default_rng(5))
first = int(np.argmax(push.velocity > 0.0))
slip_current = float(push.current[first - 1])
print(f"Just before the wheels turn, the current of one motor is {slip_current:.0f} A.")
shown = {
    "current of a motor ÷ 10 [A]": push.current / 10,
    "speed of its wheel [m/s]": push.velocity,
}
before = {"just before the wheels slip": (float(push.time[first - 1]), slip_current / 10)}
animate_charts(
    lambda: chart_curves(
        push.time, shown, xlabel="time [s]", ylabel="current and speed", marks=before
    )
)

# %% [markdown]
# This is the **slip current**. Set the stator current limit of the drive motors a little below it.
# (The *stator* current is the current in the motor. CTRE's name for the limit is `kSlipCurrent`,
# and its program starts with 120 A.) Then the wheels do not slip when the robot starts straight
# ahead, even if the driver pushes the joystick as far as possible. The current *falls* when the
# wheels slip, because rubber that slides has less grip. Use the largest current before that. ([CTRE
# docs: current limits, at one
# commit](https://github.com/CrossTheRoadElec/Phoenix6-Documentation/blob/f062dd86318acfb997ffd5945601f65d1f2848c1/source/docs/hardware-reference/talonfx/improving-performance-with-current-limits.rst))
#
# ### The grip, for "Wheel COF"
#
# Both planners ask for the **coefficient of friction** between wheel and carpet. We write µ. A
# robot with µ = 1.1 can push with 1.1 times its own weight, and not more. The slip current tells
# you µ, in three steps:
#
# 1. A part of the current only turns the gears. It is kS divided by the resistance of a motor (12 V
#    / stall current). Subtract this part.
# 2. Compute the torque of each motor from the remaining current: stall torque · current / stall
#    current.
# 3. The push of one wheel is torque · gear ratio / wheel radius. There are four wheels:
#
# > µ = 4 · torque · gear ratio / (wheel radius · mass · 9.81 m/s²)
#
# **Predict:**

# %%
ask_question("lesson10.grip")

# %%
idle = straight.gains["kS"] / robot.motor.resistance  # [A] that only turn the gears


def grip_of(current: float) -> float:
    """µ, if all of a motor's current pushes."""
    push_of_wheel = robot.motor.torque_constant * current * robot.ratio / robot.wheel_radius
    return 4 * push_of_wheel / (robot.mass * 9.81)


print(f"The current is {slip_current:.0f} A, but {idle:.1f} A of it only turn the gears.")
Table(
    ("current", "µ"),
    (
        ("all the current", grip_of(slip_current)),
        ("without the current that turns the gears", grip_of(slip_current - idle)),
        ("the truth", robot.grip),
    ),
)

# %% [markdown]
# ## 7 Into the settings
#
# | number | from | PathPlanner | Choreo |
# |---|---|---|---|
# | mass [kg], with battery and bumpers | a scale | Robot Mass | Mass |
# | moment of inertia [kg·m²] | section 5 | Robot MOI | MoI |
# | wheel radius [m] | section 4 | Wheel Radius | Wheel Radius |
# | gear ratio | count teeth | Drive Gearing | Gearing |
# | top speed [m/s] | (12 V − kS) / kV | True Max Drive Speed | |
# | grip µ | section 6 | Wheel COF | Wheel COF |
# | slip current [A] | section 6 | Drive Current Limit | |
# | torque of a motor at the slip current [N·m] | data sheet | | Motor Max Torque |
# | distances between the wheels [m] | tape measure | Module Offsets | Wheelbase, Trackwidth |
#
# A motor's torque is proportional to its current. So the torque at the slip current is stall torque
# · slip current / stall current. If your current limit is lower, use the torque at that limit. If
# you can, measure the top speed: the real top speed is a little lower than the formula says.
#
# <details><summary>For mentors: which speed, which current and which torque, with sources</summary>
#
# For the top speed, PathPlanner's page says: drive as fast as you can with a charged battery, and
# write down the speed. The real top speed is lower than (12 V − kS) / kV, because there are losses
# at high speed that the slow tests do not show. If you do not measure the top speed, PathPlanner's
# page proposes 85 % of the free speed. For its *Motor Speed Limit*, Choreo proposes about 80 %, so
# that some speed remains for corrections.
#
# PathPlanner's page calls *Drive Current Limit* a supply limit. But its library uses this number as
# the current *in the motor*, and computes the torque from it. So enter the stator limit that you
# set. ([Robot Config, at one
# commit](https://github.com/mjansen4857/pathplanner/blob/207d36a66b09c96673428cddd62785b56fb29fee/Writerside/topics/Robot-Config.md),
# [ModuleConfig.java, at one
# commit](https://github.com/mjansen4857/pathplanner/blob/c8ac86828f398c73cc945206dcd519279b3e50df/pathplannerlib/src/main/java/com/pathplanner/lib/config/ModuleConfig.java))
# Choreo's page proposes the torque at 1.5 times the current of the breaker: 60 A for a 40 A
# breaker. Then some torque remains for corrections. But more torque than the motor has at the slip
# current does not help. Choreo's window has *Wheel COF*, too. If you tick *Use torque-speed curve*
# there, enter the motor's free speed and stall torque of the data sheet. ([Robot Configuration, at
# one commit](https://github.com/SleipnirGroup/Choreo/blob/05c89476612291b458a7971b6c61f665d0fe1244/docs/document-settings/robot-configuration.md),
# [ModuleConfigPanel.tsx, at one
# commit](https://github.com/SleipnirGroup/Choreo/blob/083dd735db2cc0fe83d62bd8a6edbeb6ad9e7138/src/components/config/robotconfig/ModuleConfigPanel.tsx))
# </details>
#
# kS, kV and kA do not go into a planner. They go into your drive code (lesson 8). In CTRE's program
# they are the gains of the drive motor, per rotation of the *motor*. In AdvantageKit's templates
# they belong to the *wheel*: with TalonFX motors per rotation, with Spark motors per radian
# ([DriveConstants.java, at one
# commit](https://github.com/Mechanical-Advantage/AdvantageKit/blob/e5c8db7e21fd42cfc73eda13f9536ed878b72df4/template_projects/sources/spark_swerve/src/main/java/frc/robot/subsystems/drive/DriveConstants.java)).
# In YAGSL and WPILib they are per meter.
#
# ### Now you write it
#
# Another team asks you for help. Their robot has four NEO Vortex motors, and they have run all
# tests. Write the three formulas of this lesson: replace the dots in the next cell, and run it.
# Then run the cell below it. That cell checks each formula. If a formula is not right yet, the cell
# uses ours.


# %%
def my_radius(turned, lever, wheel_turns):
    """Formula 1 (section 4): a wheel's radius [m]. turned [rad], lever [m], wheel_turns [1]."""
    return ...


def my_inertia(mass, lever, ka_turning, ka_straight):
    """Formula 2 (section 5): the moment of inertia [kg·m²]."""
    return ...


def my_grip(torque, ratio, radius, mass):
    """Formula 3 (section 6): µ of four wheels. torque of one motor [N·m]."""
    return ...


# %%
mine = check_formulas(radius=my_radius, inertia=my_inertia, grip=my_grip)
print(mine.report)

# %% [markdown]
# <details><summary>Solution</summary>
#
# ```python
# def my_radius(turned, lever, wheel_turns):
#     return turned * lever / (2 * np.pi * wheel_turns)
#
# def my_inertia(mass, lever, ka_turning, ka_straight):
#     return mass * lever * ka_turning / ka_straight
#
# def my_grip(torque, ratio, radius, mass):
#     return 4 * torque * ratio / (radius * mass * 9.81)
# ```
# </details>
#
# Here are the results of their tests. Two of the numbers in their code are wrong. Which ones?

# %%
theirs = SwerveDrive(
    motor=find_motor("neoVortex"),
    ratio=6.12,
    trackwidth=0.52,
    mass=48.0,
    inertia=2.9,
    wheel_inertia=0.0012,
    friction=0.18,
    **read_answer("lesson10.theirs"),
)
rng = np.random.default_rng(8)
their_lever = theirs.trackwidth / np.sqrt(2.0)
their_spin = record_spin(theirs, turns=8.0, rng=rng)
their_turns = np.mean(list(their_spin.motor_turns.values())) / theirs.ratio
their_straight = fit(simulate(theirs.translation, gentle, rng=rng))
their_turning = fit(simulate(theirs.rotation, gentle, rng=rng)).in_units("radians")
their_push = record_wall_push(theirs, rng=rng)
their_slip = float(their_push.current[int(np.argmax(their_push.velocity > 0.0)) - 1])
pushing = their_slip - their_straight.gains["kS"] / theirs.motor.resistance

radius = mine.radius(their_spin.turned, their_lever, their_turns)
kas = their_turning.gains["kA"], their_straight.gains["kA"]
Table(
    ("number", "in their code", "measured"),
    (
        ("wheel radius [mm]", 50.8, 1000 * radius),
        ("moment of inertia [kg·m²]", 3.0, mine.inertia(theirs.mass, their_lever, *kas)),
        (
            "grip µ",
            1.2,
            mine.grip(theirs.motor.torque_constant * pushing, theirs.ratio, radius, theirs.mass),
        ),
    ),
)

# %% [markdown]
# <details><summary>Which two numbers are wrong?</summary>
#
# The wheel radius: their wheels are worn, so the robot drives 2.6 % less than its code computes.
# And the grip: with µ = 1.2 a planner plans curves in which the wheels slip. Their moment of
# inertia is good enough: the measured value is a few percent too large, because it contains wheels
# and rotors (section 5).
# </details>

# %% [markdown]
# ## 8 Your own robot
#
# 1. **Straight.** Mark 5 meters of carpet. Lock the wheels straight. Run the four tests of the
#    translation routine with a step voltage at which the wheels do not slip.
# 2. **Compare the modules:** `sysid fit straight.wpilog`. Read the sentence about the modules.
# 3. **Spin** slowly, five turns or more, on carpet. Write down the angle of the gyro and the turns
#    of each motor.
# 4. **Turn.** Run the four tests of the rotation routine. You need a circle of 2 meters around the
#    robot, and nobody in it. Use a small step here, too. CTRE's step of π rad/s is 3.4 V on our
#    robot, and its wheels slip above 2.4 V. With a step of 2 rad/s they do not slip.
# 5. **Fit it**, and let the command compute the inertia. `sysid entries turning.wpilog` shows the
#    names in your log. Replace V by a `MotorVoltage`, P by the gyro's `Yaw`, and W by its
#    `AngularVelocityZWorld`:
#
#    ```
#    sysid fit turning.wpilog --voltage V --position P --velocity W
#    ```
#
#    Add `--straight straight.wpilog --mass 60 --lever 0.424`, with your own mass and lever, and it
#    prints the moment of inertia.
#    (CTRE logs the straight drive in motor rotations. `sysid fit` converts them with the lever.)
#
# 6. **Push** against a wall, once.
#
# <details><summary>For mentors: AdvantageKit and YAGSL</summary>
#
# AdvantageKit's templates have only one SysId routine: it drives the robot straight. AdvantageKit's
# page shows which two lines you change so that the modules point at right angles to the diagonals.
# The first drives open loop. The second steers each module to the angle of its place plus 90°. Then
# a *voltage* turns the robot, and the log contains this voltage. ([TalonFX Swerve Template, at one
# commit](https://github.com/Mechanical-Advantage/AdvantageKit/blob/e847e20eb8a173e60140599ba35fc0c27a7d1d9b/docs/docs/getting-started/template-projects/talonfx-swerve-template.md))
# YAGSL's `SwerveDriveTest` has a drive routine and an angle routine. The drive routine first
# centers the modules, and the log of each module is in meters. The gyro's angle is not in the log,
# so add your own entries for it. ([SwerveDriveTest.java, at one
# commit](https://github.com/BroncBotz3481/YAGSL/blob/4bc6978a20dc2a036b3f562bf3c23c46f6da9361/swervelib/SwerveDriveTest.java))
# </details>

# %% [markdown]
# ## 9 System check
#
# Before you type a number into a planner, check all five:
#
# - [ ] The wheels were locked straight, and no module differs from the others.
# - [ ] The wheels did not slip: you see no jump at the start of the dynamic tests (lesson 6).
# - [ ] The "voltage" of the rotation log is a voltage, and the angle is in the unit that you gave.
# - [ ] kV turning / kV straight is the lever, within a few percent.
# - [ ] The robot had battery and bumpers on, as in a match.
#
# ## 10 Knowledge check
#
# Click an answer to the first question.

# %%
display(ask_question("lesson10.quick"), enable_checkboxes())

# %% [markdown]
# **1.** The kV of one module is 5 % smaller than that of the three others. What do you look at?
#
# <details><summary>Answer</summary>
#
# Look at the size of its wheel: a worn wheel turns more often. (If somebody has replaced the
# module, look at its gear ratio, too.) A module that rubs would *not* look different: the floor
# forces all wheels to the same speed.
# </details>
#
# **2.** The fit of a rotation log gives kV = 1.02, and its unit makes no sense. Which signal did
# you load as the voltage?
#
# <details><summary>Answer</summary>
#
# You loaded `Rotational_Rate`. It is the commanded rate, and the robot turns at about that rate, so
# kV is about 1. You cannot compute a moment of inertia from it. Load a `MotorVoltage`.
# </details>
#
# **3.** PathPlanner's formula gives 3.5 kg·m² for your square swerve. What do you check first?
#
# <details><summary>Answer</summary>
#
# Check the lever. With half the trackwidth the result is too small by a factor of √2, and 3.5 ·
# 1.41 = 5.0.
# </details>
#
# **4.** Your robot gets 10 kg heavier. What happens to the slip current?
#
# <details><summary>Answer</summary>
#
# The slip current grows: more weight presses the wheels onto the carpet, so they have more grip.
# Measure it again, and measure both kA again.
# </details>

# %% [markdown]
# ## 11 Practice
#
# **Exercise 13: swerve** ([exercises/exercise13/README.md](../exercises/exercise13/README.md)). You
# get the logs of your own swerve drive, with one worn wheel. Find the numbers for both planners.
#
# ```
# grade exercise13
# ```
#
# Or answer from a notebook:
#
# ```python
# from grader import submit
#
# submit("exercise13", kS=0.15, kV=2.5, worn="back-left", lever=0.42)
# ```
#
# Hints cost nothing: `grade exercise13 --hint`. If you write into `answers.toml` with an editor,
# start `grade watch exercise13`: it grades each time you save.
#
# <details><summary>More, if you like</summary>
#
# Give the robot of section 1 a mass of 68 kg, but the same moment of inertia, and run the lesson
# again. Which results change?
# </details>
#
# **Next:** `grade` in a terminal shows which exercises are left.
