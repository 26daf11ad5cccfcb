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
# # Lesson 8: From the analyzer to the robot
#
# *About 40 minutes. You need lessons 1, 2 and 7. You need no robot today.*
#
# ![Speed over time. With the gains in the right order, the robot does what you want. With kV and kA
# swapped, it starts much too fast, almost stops, and then drives backward.](attachment:picture.png)
#
# **At the end you can**
#
# - write the gains of a fit as constants, with units that somebody else understands;
# - choose the feedforward class, and pass its arguments in the right order;
# - recognize a wrong unit or a wrong argument order by watching the robot;
# - write the loop that uses the gains, and say what kP can and cannot fix;
# - decide which mechanisms to characterize, and when.

# %% [markdown]
# ## 1 Why: no error message
#
# SysId shows three or four numbers, and you put them into your code. Much can go wrong: the gain is
# per rotation but the code uses radians, kG and kV are swapped, or somebody uses the suggested kP
# without a test. **There is no error message.** The robot just does not move correctly.
#
# A *feedforward* computes the voltage from the motion that you **want**: "for 40 rotations per
# second I need 5 V". *Feedback* measures the motion that you **get**, and corrects the voltage.
# Today we simulate both, and make mistakes on purpose.

# %%
import math
from dataclasses import replace

import numpy as np
from IPython.display import display

import sim
from grader import ask_question, enable_checkboxes
from sim.bench.mechanisms import MECHANISMS
from sim.bench.simulate import simulate
from sim.core.units import convert_gains
from sim.fit import fit
from sim.physics.model import Model
from sim.physics.motors import find_motor
from sim.plot import Table, tabulate_gains
from sim.plot.animation import Choice, Motion, Panel, Scene, Score, animate_mechanism
from sim.reconcile import reconcile
from sim.report.robot_code_snippet import ORDER, write_robot_code
from sim.teaching.answers import read_answer
from sim.teaching.profile_loop import (
    LOOP,
    ElevatorFeedforward,
    FollowedMove,
    LoopInput,
    PIDController,
    TrapezoidProfile,
    check_loop,
    follow_in_closed_loop,
    simulate_loop,
)

shooter, elevator, arm = (MECHANISMS[name] for name in ("shooter", "elevator", "arm"))
log = simulate(shooter, sim.Routine(ramp=0.5, step=4.0), rng=np.random.default_rng(8))
found = fit(log).in_log_units()
print(f"The mechanism: {shooter.summary}.\nIts gains are per rotation.")

# %% [markdown]
# ## 2 Constants that explain themselves
#
# Put the numbers into `Constants.java`, in a class of their own. Write the unit of each number in a
# comment. Above the numbers, write *when to measure again*.
#
# Do not copy somebody else's constants: lesson 1 has an example with a wrong number. If kV is more
# than a few percent below the theoretical kV, the ratio, the wheel or the unit is wrong.
#
# `sysid fit` can write the constants, with their errors as comments:
#
# ```
# sysid fit my_log.wpilog --paste java
# ```
#
# Here is the code for our shooter. Each number has as many digits as its error allows. (One
# *standard error* is the typical error that noise alone causes. On a real robot, effects that are
# not in the model cause larger errors. So trust only two or three digits.)

# %%
print(write_robot_code(found, target="java", season=2026, name="shooter"))

# %% [markdown]
# **Predict:**

# %%
ask_question("lesson8.season")

# %%
for target in ("java", "python"):
    old, new = (
        write_robot_code(found, target=target, season=season, name="shooter").splitlines()
        for season in (2026, 2027)
    )
    print(f"{target}: these lines are different in the two seasons:")
    print("\n".join(f"  2026  {line.strip()}" for line in old if line not in new))
    print("\n".join(f"  2027  {line.strip()}" for line in new if line not in old))

# %% [markdown]
# The gains do not change with the season, but names in the code do.
#
# **Units.** `kS` and `kG` are always in volts. `kV` and `kA` are per meter, per rotation or per
# radian: *use the unit of the velocity that your code passes to the feedforward*. Two rules:
#
# - **Convert a unit in one place:** in the constant or at the call, never in both.
# - **kP belongs to its loop.** A PIDController whose output you give to `setVoltage` needs a kP in
#   volts per unit of error. The output of a motor controller's own loop may be a duty cycle from −1
#   to 1 instead of volts. Then divide kP by 12.

# %% [markdown]
# ## 3 The class, and its arguments
#
# | analysis type in SysId | class | arguments, in this order |
# |---|---|---|
# | Simple | `SimpleMotorFeedforward` | kS, kV, kA |
# | Elevator | `ElevatorFeedforward` | kS, **kG**, kV, kA |
# | Arm | `ArmFeedforward` (angle in **radians from horizontal**) | kS, **kG**, kV, kA |
#
# In Python, the first is `SimpleMotorFeedforwardMeters` or `SimpleMotorFeedforwardRadians`.
#
# With gravity there are **four** arguments, and kG is the **second**. All four are numbers, so the
# compiler accepts them in any order.
#
# <details><summary>For mentors: the feedforward classes, with source</summary>
#
# > **Lesson says:** "Place the analyzed gains into `Constants.java` and connect them to the
# > appropriate feedforward class"; WPILib's arm and elevator classes "can absorb kG in addition to
# > the kS/kV/kA values".
# >
# > **Source says:** with gravity there are **four** arguments, and kG is the **second**. All four
# > are plain numbers, so a compiler accepts them in any order.
# > ([WPILib docs: Feedforward Control in WPILib](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/controllers/feedforward.html))
# >
# > **Try it:** suppose that somebody learned the order "kS, kV, kA" and adds kG at the end. The
# > next cells show what an elevator does then.
# </details>
#
# Somebody remembers the order "kS, kV, kA" and puts kG last. The *carriage* (the elevator's moving
# part) should hold still. **Predict:**

# %%
lift = elevator.gains
ask_question("lesson8.slot")

# %% [markdown]
# For a velocity of 0, an elevator's feedforward gives its second argument, in volts.

# %%
orders = {
    "kS, kG, kV, kA (right)": "kG",
    "kS, kV, kA, kG (kG last)": "kV",
    "kG, kS, kV, kA (kG first)": "kS",
}
rows = []
for order, second in orders.items():
    free = lift[second] - lift["kG"]  # friction holds the carriage against kS volts
    does = "stays" if abs(free) <= lift["kS"] else "rises" if free > 0 else "falls"
    rows.append((order, lift[second], does))
print(f"The carriage needs {lift['kG']:.2f} V to hold still.", end=" ")
print(f"Friction allows {lift['kS']:.2f} V more or less.")
Table(("arguments", "voltage at zero speed [V]", "the carriage"), tuple(rows))

# %% [markdown]
# ### `calculate`: velocities, not an acceleration
#
# In Java, use `calculateWithVelocities(velocity, nextVelocity)`. Its arguments are the velocity now
# and the velocity in the next loop. (For an arm, the angle comes first.) Python's `calculate` takes
# the same arguments. If you pass an acceleration instead, the voltage is wrong.
#
# <details><summary>Want to know more? The old call, and the first loop</summary>
#
# In Java, `calculate(velocity, acceleration)` is deprecated (it will be removed). Some pages of
# WPILib's docs still show it. WPILib gives kS the sign of the *current* velocity (if kA is not 0).
# At the start this velocity is zero, so there is no kS in the first loop. (The simulation below
# adds kS at once.) ([WPILib's source:
# SimpleMotorFeedforward.java](https://github.com/wpilibsuite/allwpilib/blob/v2026.2.2/wpimath/src/main/java/edu/wpi/first/math/controller/SimpleMotorFeedforward.java))
# </details>
#
# ### Gains inside the motor controller
#
# A motor controller can add the feedforward itself, a thousand times a second. It has its own
# units, and it does not warn you if you use other units:
#
# | where | kV is volts per | set also |
# |---|---|---|
# | Phoenix 6, `Slot0Configs` | *mechanism* rotation/s | `SensorToMechanismRatio`, `GravityType` |
# | REVLib, `FeedForwardConfig` | your unit/s | both conversion factors (an arm: `kCosRatio`, too) |
# | YAGSL 2026 (a swerve library) | m/s of a wheel | `replaceSwerveModuleFeedforward` |
#
# `sysid fit` writes the code for each of them and converts the units. If your log is in meters, add
# the radius:
#
# ```
# sysid fit my_log.wpilog --paste phoenix6 --radius 0.0508
# ```

# %%
print(write_robot_code(found, target="phoenix6", name="shooter"))
foc = replace(shooter, motor=find_motor("krakenX60FOC")).gains
share = {gain: 100 * (foc[gain] / shooter.gains[gain] - 1) for gain in ("kV", "kA")}
print("With FOC, a mode of CTRE's motors, gains change (by WPILib's table of motors):")
print(f"kV by {share['kV']:+.1f} %, kA by {share['kA']:+.0f} %.")

# %% [markdown]
# If `SensorToMechanismRatio` is set, the gains are in volts per rotation of the *mechanism*. Put
# them into **one place only.** If your code also sends the volts of a feedforward class, the motor
# controller adds its own volts: a *double feedforward*.
#
# <details><summary>If your motors are CTRE's: FOC, and sources</summary>
#
# **Use the same FOC setting as in the tests.** If FOC was on in the tests, use it on the robot,
# too. FOC is a mode of CTRE's motors that needs a Phoenix Pro license. With the license,
# `setVoltage` and `VoltageOut` turn it on unless you say otherwise. Gains that were measured with
# FOC are wrong without it. (`VelocityVoltage` and `Slot0Configs` in [Phoenix 6, release
# 26.3.0](https://pypi.org/project/phoenix6/26.3.0/), [REVLib API:
# FeedForwardConfig](https://codedocs.revrobotics.com/java/com/revrobotics/spark/config/feedforwardconfig))
# </details>
#
# <details><summary>If you use TorqueCurrentFOC: gains in amperes</summary>
#
# A request such as `VelocityTorqueCurrentFOC` sets the *current* of the motor, so it "directly
# controls the acceleration". ([CTRE docs: TorqueCurrentFOC, at one
# commit](https://github.com/CrossTheRoadElec/Phoenix6-Documentation/blob/079a28341bc1ed380f3a4bc6e9fcec300517eabb/source/docs/api-reference/device-specific/talonfx/talonfx-control-intro.rst))
# Then kS, kV, kA and kP of the slot are in **amperes**. Gains in volts are wrong there:
#
# - kV is nearly 0: a steady speed needs volts against the back-EMF, but hardly any current.
# - kS and kA: divide the gain in volts by the motor's resistance R = 12 V / (stall current).
#
# **Do it:** a flywheel with two Kraken X60 has kS = 0.12 V, and R is 0.033 Ω. How many amperes is
# its kS? (3.6 A for each motor.) Then look into your team's code: which requests does it use, and
# do the gains of their slot have the right unit?
# </details>
#
# <details><summary>If your arm is not level at 0</summary>
#
# An arm's kG is multiplied by the cosine of its position. So 0 must be where the *center of mass*
# is level, and for an arm like an L that is not where the arm looks level. The fit finds this angle
# (lesson 2). Set the sensor to 0 there. Or give Phoenix 6 the angle, in rotations:
# `GravityArmPositionOffset` in `Slot0Configs`, from −0.25 to 0.25. ([`Slot0Configs` of phoenix6
# 26.3.0](https://pypi.org/project/phoenix6/26.3.0/))
#
# **Do it:** hold the arm where its center of mass is level, with the robot disabled. What does the
# sensor show?
# </details>
#
# <details><summary>If your swerve drive uses a newer YAGSL</summary>
#
# YAGSL's newer pages say that `replaceSwerveModuleFeedforward` is gone. In newer versions, kS, kV
# and kA are the numbers `s`, `v` and `a` in the file `pidfproperties.json`.
# </details>

# %% [markdown]
# ## 4 A profile follower, and wrong units
#
# The shooter should spin up smoothly, hold its speed, and spin down. A **profile** is such a plan:
# a target velocity v for each moment. In each loop, the robot program sends the motor this voltage:
#
# > kS·sgn(v) + kV·v + kA·(v_next − v)/0.02 s &nbsp; + &nbsp; kP·(v − measured)
#
# The first three terms are the feedforward. The last term is the feedback; kP is 0 at first.
#

# %%
TIME = np.arange(0.0, 4.0, LOOP)
TARGET = np.interp(TIME, [0.0, 0.2, 1.4, 2.6, 3.6, 4.0], [0, 0, 50, 50, 0, 0])  # [rot/s]
wheel = convert_gains(shooter.gains, factor=2 * math.pi)  # the truth, per rotation


target = Motion("target", velocity=TARGET, asked=True)


def follow(gains: dict[str, float], kp: float) -> Motion:
    """The wheel with a feedforward and a kP."""

    def volts(loop: int, _: list[float], v: list[float]) -> float:
        now, ahead = TARGET[loop], TARGET[min(loop + 1, TIME.size - 1)]
        fed = gains["kS"] * np.sign(max(now, ahead)) + gains["kV"] * now
        return float(fed + gains["kA"] * (ahead - now) / LOOP + kp * (now - v[-1]))

    turns, velocity, _ = simulate_loop(Model("simple", wheel), volts, loops=TIME.size)
    return Motion("wheel", velocity=velocity, position=2 * math.pi * turns)


measured = {name: found.gains[name] for name in ORDER["simple"]}


def scaled(factor: float) -> dict[str, float]:
    """The measured gains with kV and kA in another unit."""
    return measured | {"kV": measured["kV"] * factor, "kA": measured["kA"] * factor}


GAINS = {
    "as measured": measured,
    "per radian, gets rotations": scaled(1 / (2 * math.pi)),
    "per rotation, gets radians": scaled(2 * math.pi),
    "kV and kA swapped": measured | {"kV": measured["kA"], "kA": measured["kV"]},
    "without kA": measured | {"kA": 0.0},
    "gains divided by 12 by mistake": {name: gain / 12 for name, gain in measured.items()},
}

# %% [markdown]
# **Predict:**

# %%
display(ask_question("lesson8.radian"), ask_question("lesson8.rotation"))

# %% [markdown]
# Choose gains and a kP. (kP is always per rotation.) With 12 V the wheel reaches about 100 rot/s.

# %%
KPS = {f"{kp:g}": kp for kp in (0.0, 0.1, 0.2, 0.4)}  # [V per rot/s]
animate_mechanism(
    "flywheel",
    {
        (name, shown): Scene(TIME, (follow(gains, kp), target), target=TARGET)
        for name, gains in GAINS.items()
        for shown, kp in KPS.items()
    },
    choices=(Choice("gains", tuple(GAINS)), Choice("kP", tuple(KPS))),
    panels=(Panel("velocity", "velocity [rot/s]", low=-5.0, high=105.0),),
    score=Score("wheel", unit="rot/s"),
    slow=12.0,
    alt="A wheel spins up to 50 rot/s, holds this speed, and spins down. With the measured gains "
    "it follows its target closely. With gains per radian, it hardly turns. With gains that are 2π "
    "times too large, it is twice as fast as its target.",
)

# %% [markdown]
# ### Explain
#
# - **Gains per radian, but the code passes rotations:** the voltage is 2π times too small. The
#   wheel is very slow.
# - **Gains per rotation, but the code passes radians:** the voltage is 2π times too large. There
#   are only 12 V, so the wheel runs as fast as it can. With a drivetrain or an arm this is
#   dangerous.
# - **kV and kA swapped:** there is far too much voltage while the wheel speeds up, and far too
#   little while it holds its speed.
# - **Without kA:** the speed is right while the target is constant, and late while the target
#   changes. For many mechanisms that is good enough.
# - **kP hides the mistake.** With feedback, wrong units cause a smaller error: the robot "works",
#   but badly. So if feedback does not help enough, check the units before you change kP.
#
# The easiest check is to compute one voltage by hand. `kS + kV · (a speed you know)` must be
# between 0 and 12 V, and it must make sense for this speed.
#
# <details><summary>Want to know more? When you may leave out kA</summary>
#
# WPILib computes the kA term a bit more exactly, with the time constant of the mechanism.
#
# WPILib's docs say that you may leave out kA, and AdvantageKit's swerve template calls the drive's
# kA "unnecessary in most cases". ([WPILib docs: Feedforward Control in
# WPILib](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/controllers/feedforward.html),
# [AdvantageKit docs: TalonFX Swerve
# Template](https://docs.advantagekit.org/getting-started/template-projects/talonfx-swerve-template/))
# </details>

# %% [markdown]
# ## 5 What kP can do, and what not
#
# A shooter has good gains. Its target is 4000 rpm (rotations per minute), but it reaches 3900. The
# reason: the code calls `set(volts / 12)`, and the battery has only 11.7 V, so the motor gets 2.5 %
# less voltage.
#
# Now add kP, and change nothing else. **Predict:**

# %%
ask_question("lesson8.kp")

# %%
WANTED = 4000 / 60  # [rot/s]
STEADY = wheel["kS"] + wheel["kV"] * WANTED


def hold_speed(times: float, late: int = 0) -> Motion:
    """The wheel with 11.7/12 of each volt and a kP of some kV; it is measured some loops late."""

    def volts(loop: int, _: list[float], v: list[float]) -> float:
        asked = STEADY + times * wheel["kV"] * (WANTED - v[max(loop - late, 0)])
        return min(asked, 12.0) * 11.7 / 12

    turns, velocity, _ = simulate_loop(Model("simple", wheel), volts, loops=TIME.size)
    return Motion("wheel", velocity=60 * velocity, position=2 * math.pi * turns)


wanted = Motion("target", velocity=np.full(TIME.size, 60 * WANTED), asked=True)
TIMES, LATE = {"0": 0, "kV": 1, "4 · kV": 4, "6 · kV": 6}, {"at once": 0, "120 ms late": 6}
animate_mechanism(
    "flywheel",
    {
        (shown, when): Scene(TIME, (hold_speed(times, late), wanted))
        for shown, times in TIMES.items()
        for when, late in LATE.items()
    },
    choices=(Choice("kP", tuple(TIMES)), Choice("the speed is measured", tuple(LATE))),
    panels=(Panel("velocity", "speed [rpm]", low=3000.0, high=5000.0),),
    slow=12.0,
    alt="A wheel spins up to nearly 4000 rpm. With a larger kP it comes closer to 4000 rpm. But "
    "with a large kP and a speed that is measured 120 ms late, its speed swings up and down.",
)

# %%
rests = {name: 4000 - float(hold_speed(times).velocity[-1]) for name, times in TIMES.items()}
print("\n".join(f"kP = {name}: {rest:.0f} rpm remain" for name, rest in rests.items()))
kp = found.feedback()["velocity"].kp
print(f"kP that the fit suggests: {kp:.3f} V per rot/s, which is {kp / wheel['kV']:.1f} · kV.")

# %% [markdown]
# Feedback with kP acts only if there is an error. So it never removes the whole error: about
# **error ÷ (1 + kP/kV)** remains. (Engineers call it *droop*.) With a larger kP, less of the error
# remains. So why not use a very large kP? Choose "120 ms late" above.
#
# If the measurement is late, the feedback may correct an error that is already gone. Then a large
# kP makes the error larger, until the speed oscillates (swings up and down). So choose SysId's
# *Gain Preset* for your motor controller, and start from the suggested kP.
#
# <details><summary>Want to know more? How late motor controllers are</summary>
#
# SysId's presets assume that the velocity from Phoenix 6 is 1 ms late, and that the velocity from a
# NEO's own encoder is 112 ms late. ([SysId's source:
# FeedbackControllerPreset.h](https://github.com/wpilibsuite/allwpilib/blob/v2026.2.2/sysid/src/main/native/include/sysid/analysis/FeedbackControllerPreset.h))
# </details>
#
# <details><summary>For mentors: is the suggested kP final?</summary>
#
# > **Lesson says:** "SysId suggests kP = 0.62 — start here, tune on carpet with fresh battery."
# >
# > **Source says:** right. The suggested feedback gains are "educated guesses", a "starting point".
# > ([WPILib docs: Analyzing
# > Data](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/system-identification/analyzing-gains.html))
# > Which number it suggests depends on settings (lesson 7), among them the delay.
# >
# > **Try it:** in SysId, choose the preset of your motor controller, and see whether kP changes.
# </details>
#
# So if the shooter reaches 3900 rpm instead of 4000: **keep the gains**, use `setVoltage` instead
# of `set(volts / 12)`, then add feedback to correct the rest. Do *not* make kV larger: this kV
# would be right only for one speed and one battery voltage.

# %% [markdown]
# ## 6 Use the gains: one loop, one move
#
# A *setpoint* is the target of the profile at one moment. In each loop, the robot program uses two
# setpoints, the one for *now* and the one for the *next loop*. It adds **feedforward + feedback**.
# In Java, this line controls a velocity:
#
# ```java
# setVoltage(ff.calculateWithVelocities(v, next) + pid.calculate(measured, v));
# ```
#
# Our elevator should rise by one meter. Its feedforward uses velocities, and its feedback uses
# positions.
#
# **Now you write it.** `one.now` and `one.after` are the two setpoints. Each has a `position` and a
# `velocity`. `one.position` is measured. Replace the `...`, then run the cell below.


# %%
def my_loop(ff, pid, one):
    """Volts for one loop: feedforward plus feedback."""
    return ...


# %%
mine = check_loop(my_loop)
print(mine.report)

# %% [markdown]
# <details><summary>Solution</summary>
#
# ```python
# def my_loop(ff, pid, one):
#     forward = ff.calculateWithVelocities(one.now.velocity, one.after.velocity)
#     return forward + pid.calculate(one.position, one.now.position)
# ```
# </details>
#
# A rubber tube pulls at this elevator like a spring, and the friction is larger at very low speed.
# The model contains neither of these. We have three sets of gains:
#
# - **guessed:** kV comes from the motor's free speed. kA and kG come from the mass in CAD, which is
#   17 kg (the true mass is 20 kg). kS is 0.
# - **measured:** `fit` finds the gains from four tests.
# - **reconciled:** `reconcile` finds them from the same tests. It finds the tube, too (lesson 9).
#
# **Predict.** All three sets of gains use kP = 5 V/m:

# %%
ask_question("lesson8.move")

# %%
robot = elevator.hide("spring").hide("stribeck", 0.3)
tests = simulate(robot, sim.Routine(ramp=1.0, step=4.5), rng=np.random.default_rng(8))
story = reconcile(tests, type="elevator")
free_speed = robot.motor.free_speed / robot.ratio * robot.radius  # [m/s]
SETS = {
    "guessed": replace(elevator, load=17.0).gains | {"kS": 0.0, "kV": 12 / free_speed},
    "measured": fit(tests, type="elevator").gains,
    "reconciled": story.model.gains,
}
tube = next(part.parameters for part in story.model.parts if part.effect == "spring")
RISE = TrapezoidProfile(start=0.1, goal=1.1, max_velocity=1.2, max_acceleration=6.0)


def rise(gains: dict[str, float], *, kp: float = 5.0, with_tube: bool = False) -> FollowedMove:
    """The move with your loop; if asked, plus the volts that hold the tube."""
    ff, pid = ElevatorFeedforward(*(gains[name] for name in ORDER["elevator"])), PIDController(kp)

    def volts(one: LoopInput) -> float:
        held = tube["rate"] * one.now.position + tube["preload"]
        return mine.loop(ff, pid, one) + with_tube * held

    return follow_in_closed_loop(robot, RISE, volts)


moves = {name: rise(gains) for name, gains in SETS.items()}
moves["+ tube"] = rise(SETS["reconciled"], with_tube=True)
some = next(iter(moves.values()))
target = Motion("target", position=some.target, velocity=np.gradient(some.target, LOOP), asked=True)
animate_mechanism(
    "elevator",
    Scene(
        some.time,
        (
            target,
            *(
                Motion(name, position=move.position, voltage=move.voltage)
                for name, move in moves.items()
            ),
        ),
    ),
    panels=(
        Panel("error", "distance ahead of the target [cm]", scale=100.0),
        Panel("voltage", "voltage [V]"),
    ),
    span=(0.0, 1.2),
    alt="Four elevators rise by one meter. A dashed line shows the target. All use kP = 5 V/m. "
    + " ".join(
        f"{name}: the worst error is {100 * one.worst_error:.1f} cm." for name, one in moves.items()
    ),
)

# %%
tabulate_gains(
    {name: SETS.get(name, SETS["reconciled"]) for name in moves},
    first="gains",
    more={"worst error [cm]": [100 * move.worst_error for move in moves.values()]},
)

# %% [markdown]
# - **Guessed gains:** kG and kA are too small, and kS is missing.
# - **Measured gains:** the worst error is only a third as large. But kS is nearly zero! The model
#   has no tube, so the fit put the force of the tube into the gains.
# - **Reconciled gains:** kS is right again. But the tube still pulls. So add **one more term** ("+
#   tube"), the voltage that balances the tube: `+ kTubeRate * position + kTubePreload`. Then the
#   worst error is only two millimeters.
#
# ### ProfiledPIDController and Motion Magic: the same sum
#
# `ProfiledPIDController` makes the profile itself. You only add the feedforward. Its feedback
# compares the position with the setpoint of the *next* loop. So our elevator runs about a
# centimeter ahead of the profile.
#
# <details><summary>The code in Java</summary>
#
# The method `calculate` first moves the setpoint one loop ahead. So store the velocity before you
# call this method:
#
# ```java
# double v = pid.getSetpoint().velocity;
# double feedback = pid.calculate(measured, goal);
# setVoltage(ff.calculateWithVelocities(v, pid.getSetpoint().velocity) + feedback);
# ```
# </details>
#
# **Motion Magic** does all of this inside the motor controller. It uses the gains of
# `Slot0Configs`, in volts per rotation of the *mechanism*. Here that is the drum that winds up the
# rope. A common mistake: `SensorToMechanismRatio` is set, but the gains are per rotation of the
# *rotor* (the motor's shaft). Then they are too small by the gear ratio.
#
# <details><summary>If you use Motion Magic Expo: a kV and a kA of its own</summary>
#
# *Expo* plans the move with `MotionMagicExpo_kV` and `MotionMagicExpo_kA`. They are separate from
# the gains of the slot, and always in volts per rotation of the mechanism. The plan's top speed is
# 12 V / kV, and its first acceleration is 12 V / kA. Their defaults are 0.12 and 0.1.
# ([`MotionMagicConfigs` of phoenix6 26.3.0](https://pypi.org/project/phoenix6/26.3.0/)) But 0.12 V
# per rot/s is a Kraken X60 *without gears* (lesson 1). With gears of 10:1, this plan is ten times
# too fast for the mechanism.
#
# Start from your measured gains per rotation of the mechanism. CTRE says that it is safer to start
# *above* them, because a higher kV or kA makes the plan slower. ([CTRE docs: Motion Magic Expo, at
# one
# commit](https://github.com/CrossTheRoadElec/Phoenix6-Documentation/blob/0ffe1e97bf7740e152af0ef86e176f162e777af1/source/docs/api-reference/device-specific/talonfx/motion-magic.rst))
#
# **Do it:** find both numbers in your team's code. Divide 12 V by the kV. Can your mechanism turn
# so many rotations in a second?
# </details>
#
# <details><summary>Sources</summary>
#
# [WPILib docs:
# ProfiledPIDController](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/controllers/profiled-pidcontroller.html),
# [CTRE docs: Motion
# Magic](https://github.com/CrossTheRoadElec/Phoenix6-Documentation/blob/e52e9b2f106db9b3322ce72ed4f57f3aa49003eb/source/docs/api-reference/device-specific/talonfx/motion-magic.rst)
# </details>

# %% [markdown]
# ## 7 An arm that sinks
#
# Gravity, too, can cause an error that kP does not remove. Somebody measured the gains of an
# **empty** arm. Now the arm is level and holds a game piece at its end. A *position* loop with kP
# holds the arm: kP volts for each radian of error.
#
# **Predict:**

# %%
ask_question("lesson8.arm")

# %%
PIECE, REACH = 1.0, 0.5  # [kg], [m] from the joint
bare = arm.gains
torque = 4.0 * 0.5 * 9.81  # [N·m] of the empty arm, level: kG volts hold it
inertia = arm.load * (1.0 + arm.spin)  # [kg·m²]
loaded = bare | {
    "kG": bare["kG"] * (1 + PIECE * REACH * 9.81 / torque),
    "kA": bare["kA"] * (1 + PIECE * REACH**2 / inertia),
}


HELD = np.arange(0.0, 3.0, LOOP)


def hold_level(kp: float, told: dict[str, float]) -> Motion:
    """The loaded arm, which should stay level, with the gains of the empty or the loaded arm."""

    def volts(_: int, x: list[float], v: list[float]) -> float:
        return told["kG"] - kp * x[-1] - 0.1 * v[-1]

    position, _, voltage = simulate_loop(Model("arm", loaded), volts, loops=HELD.size)
    return Motion("arm", position=position, voltage=voltage)


print(f"kG: {bare['kG']:.2f} V empty, {loaded['kG']:.2f} V with the piece. kV, kS: the same.")
TOLD = {"the empty arm": bare, "the loaded arm": loaded}
STIFF = {f"{kp:g}": kp for kp in (1.0, 2.0, 5.0, 10.0)}  # [V/rad]
animate_mechanism(
    "arm",
    {
        (name, shown): Scene(HELD, (hold_level(kp, told),))
        for name, told in TOLD.items()
        for shown, kp in STIFF.items()
    },
    choices=(Choice("gains of", tuple(TOLD)), Choice("kP", tuple(STIFF))),
    panels=(Panel("position", "angle [°]", low=-10.0, high=2.0, scale=180 / math.pi),),
    alt="A level arm with a game piece. With the gains of the empty arm and a kP of 1 V/rad it "
    f"sinks by {-math.degrees(hold_level(1.0, bare).position[-1]):.1f} degrees. With a larger kP "
    "it sinks less. With those of the loaded arm it does not sink.",
)

# %% [markdown]
# The arm hangs below level. Without friction, the angle is (missing kG)/kP. Here it is smaller,
# because friction helps to hold the arm. A larger kP makes this angle smaller, but never zero. The
# right kG removes the error. So measure **with and without** the piece (or compute the second kG),
# and switch the gains when a sensor detects the piece.
#
# With the load, kA and kG grow. kV stays the same, because it comes from the motor's back-EMF (the
# voltage that a turning motor produces) and the gears. (Section 2 of lesson 2 shows the numbers for
# an elevator with 1.5 times the mass.)
#
# <details><summary>For mentors: which gains change with the load?</summary>
#
# > **Lesson says:** run the elevator with full payload "since kA and kV change significantly with
# > load mass".
# >
# > **Source says:** kA and kG grow with the mass. kV comes from the motor's back-EMF, the gears and
# > the drum; mass is not in it. ([WPILib docs: Introduction to DC Motor
# > Feedforward](https://github.com/wpilibsuite/frc-docs/blob/250e32128d9a93f27d58bc3cd1d0b3ab5eec43cd/source/docs/software/advanced-controls/introduction/introduction-to-feedforward.rst))
# >
# > **Try it:** look at the table in section 2 of lesson 2. Which factor is 1?
# </details>

# %% [markdown]
# ## 8 Which gains belong to which mechanism?
#
# Here are three sets of gains without names. One is from a **drivetrain**, one from an **elevator**
# and one from a **shooter**. kV and kA are per meter or per radian. Match each set with its
# mechanism.

# %%
sets = read_answer("lesson8.sets")
fits = {}
for name, mechanism in sets.items():
    one = MECHANISMS[mechanism]
    record = simulate(one, sim.Routine(ramp=0.5, step=4.0), rng=np.random.default_rng(1))
    fits[name] = fit(record, type=one.type)
tabulate_gains(
    {name: one.gains for name, one in fits.items()},
    unit="m or rad",
    more={"kA/kV [ms]": [1000 * x.gains["kA"] / x.gains["kV"] for x in fits.values()]},
)

# %%
display(ask_question("lesson8.one"), ask_question("lesson8.two"))

# %% [markdown]
# Set 3 belongs to the mechanism that remains.
#
# <details><summary>How can you see it?</summary>
#
# If there is a kG, gravity acts on the mechanism. The top speed is (12 − kS)/kV (with gravity,
# subtract kG as well): a drivetrain reaches a few m/s, a wheel hundreds of rad/s. And kA/kV shows
# how slowly the mechanism reacts: a heavy wheel reacts slowly.
# </details>

# %% [markdown]
# ## 9 Which mechanisms, and when
#
# A test takes time, and parts of the robot wear out. Ask: **what would be worse with gains that are
# 5 % off?**
#
# | mechanism | characterize? | because |
# |---|---|---|
# | drivetrain | **always** | with a wrong voltage the robot leaves its path |
# | shooter wheel | **always** | its speed at one moment decides the shot |
# | arm, pivot | **recommended** | gravity changes with the angle; no single voltage fits |
# | elevator | **recommended** | gravity pulls all the time, and the load changes kG and kA |
# | intake rollers | optional | only if their *speed* is controlled |
# | climber | optional | only if it must follow a profile; otherwise a high kP is enough |
# | conveyor, indexer | usually not | on and off is enough |
#
# <details><summary>Want to know more? Drivetrain, arm and elevator</summary>
#
# - **Drivetrain:** kS and kV are the most important. From kA you also get the mass. From a second
#   kA, measured while turning on the spot, you get the moment of inertia (below).
# - **Arm:** test it first without the game piece, then with it (section 7). For a light, short arm,
#   computed gains may be enough.
# - **Elevator:** test it with its load. kA and kG change with the mass, kV does not.
# - **Optional** means: you decide whether the mechanism on *your* robot needs its gains. Either
#   answer is right if you give the reason.
# </details>
#
# If inexact gains are good enough, do not test. If you have no room or no time, you can compute kG,
# kV and kA. But you must measure kS.
#
# <details><summary>For mentors: does every team characterize everything?</summary>
#
# > **Lesson says:** "Teams like 2910 and 254 characterize every motorized mechanism that needs
# > closed-loop control."
# >
# > **Source says:** WPILib's docs name another way for teams that have no room or no time:
# > "reasonable estimates of kG, kV, and kA can be obtained by fairly simple computation", while kS
# > "must be measured". ([WPILib docs: Feedforward Control in
# > WPILib](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/controllers/feedforward.html))
# > The authors of this course could not check what the two teams do. Experienced people have
# > different opinions about this question.
# >
# > **Try it:** for each row of the table, say what your robot would do worse. If you find nothing,
# > do not test it.
# </details>
#
# ### PathPlanner, Choreo, AdvantageKit: where the gains are used
#
# PathPlanner does not ask for kS or kV, but for mass, moment of inertia, wheels, motors and top
# speed. With these numbers it plans speeds, and your drive code needs the feedforward to reach
# these speeds. If the robot is late, it leaves its path in every curve.
#
# <details><summary>For mentors: what PathPlanner needs, with source</summary>
#
# > **Lesson says:** "The payoff is compounding: a characterized drivetrain lets PathPlanner produce
# > accurate autonomous trajectories."
# >
# > **Source says:** PathPlanner does not ask for kS or kV. It asks for properties of the robot:
# > mass, moment of inertia, wheels, motors, true top speed. With these numbers it plans speeds.
# > Your drive code has to reach these speeds, and it needs the feedforward for that. ([PathPlanner
# > docs: Robot Config](https://pathplanner.dev/robot-config.html))
# >
# > **Try it:** in section 4, choose "without kA". How large is the difference between the shooter's
# > speed and its target? A robot with such a difference at each change of speed leaves its path in
# > every curve.
# </details>
#
# <details><summary>Want to know more? The moment of inertia, Choreo and AdvantageKit</summary>
#
# - **PathPlanner's moment of inertia**: you compute it from two kA values. You measure one while
#   the robot turns on the spot, and the other while it drives straight. One kA gives the mass, the
#   other the inertia:
#
#   > I = mass · r · kA_angular / kA_linear
#
#   Here r is the lever of a wheel. The wheel pushes along a line, and r is the distance of this
#   line from the middle of the robot. For a **tank drive** that is half the trackwidth, r =
#   trackwidth/2. The modules of a **square swerve** are at the corners and push at a right angle to
#   the diagonal: r = trackwidth/√2. The pages of both planners use trackwidth/2 for every robot.
#   ([PathPlanner](https://github.com/mjansen4857/pathplanner/blob/207d36a66b09c96673428cddd62785b56fb29fee/Writerside/topics/Robot-Config.md),
#   [Choreo](https://github.com/SleipnirGroup/Choreo/blob/2f4fff4bd823e15d62ed803b0c61a755fa527d0b/docs/usage/estimating-moi.md),
#   each at one commit)
#
# - **Choreo** computes time-optimal paths from what you tell it about your robot. Here too, a path
#   is only as good as the drive code that follows it. ([WPILib docs:
#   Choreo](https://docs.wpilib.org/en/latest/docs/software/pathplanning/choreo/index.html))
# - **AdvantageKit's** swerve templates contain a simple routine for kS and kV of the drive, and
#   SysId's four tests if you want kA. Its log uses **radians**, and Phoenix uses **rotations**, so
#   the gains differ by a factor of 2π. ([AdvantageKit docs: TalonFX Swerve
#   Template](https://docs.advantagekit.org/getting-started/template-projects/talonfx-swerve-template/))
#
# Why does the formula work? When the robot drives straight, the wheels accelerate the mass. When it
# turns on the spot, they accelerate the moment of inertia, with the lever r. The motors are the
# same, so the ratio of the kA values is the ratio of the loads.
# </details>
#
# You compute the moment of inertia (how hard it is to turn the robot) from two kA values: I = mass
# · r · kA_angular / kA_linear. Lesson 10 does it for a square swerve, and finds out which lever r
# is right.
#
# ### When
#
# Plan two evenings in the last two weeks of build season: measure on the first, and again on the
# second. Measure again if the mass changed (kA, kG), if gears or wheels changed (kV, kA), or after
# you repaired a part that rubbed (kS). Keep the old log and compare.
#
# <details><summary>For mentors: the schedule, with source</summary>
#
# > **Lesson says:** "Build characterization time into your schedule during the last two weeks of
# > build season, when the robot is mechanically done but the software is still being written." And
# > the gains from the shop "will transfer directly to competition".
# >
# > **Source says:** WPILib's docs ask for at least 10 feet to drive, ideally 20, and a pit does not
# > have that. So the lesson's first sentence is good advice. Its second sentence is true only under
# > one condition: the robot and the floor must be the same as in the test. The source lesson says
# > so itself: measure again if gearing, wheels or carpet contact change. ([WPILib docs:
# > Characterizing Your Robot
# > Drive](https://docs.wpilib.org/en/stable/docs/software/pathplanning/trajectory-tutorial/characterizing-drive.html))
# >
# > **Try it:** count back from your first competition. Write two evenings into the calendar:
# > measure on the first, and measure again on the second.
# </details>
#
# <details><summary>Want to know more? Gains during a match</summary>
#
# Gains also change during a match. If copper is 50 °C warmer, it has 20 % more resistance. Then the
# same force needs 20 % more volts: kS, kA and kG grow, and kV hardly changes. If the output of the
# loop is in volts, a low battery does not change any gain. But it can give only 10 V. kP corrects
# small changes.
# </details>

# %% [markdown]
# ## 10 Your own robot
#
# 1. Copy the log from the robot (lesson 5), look at its plots (lesson 6), then inspect it: `sysid
#    inspect my_log.wpilog`
# 2. Fit it with its type:
#
#    ```
#    sysid fit my_log.wpilog --type arm
#    ```
#
#    The first lines name the unit of the gains: it is the unit of the log. For an arm, step 3
#    converts them to radians. For other mechanisms, convert them yourself (lesson 1, section 8).
#
# 3. Let it write the code, and paste it into a new file:
#
#    ```
#    sysid fit my_log.wpilog --type arm --paste java
#    sysid fit my_log.wpilog --type arm --paste python --season 2027
#    ```
#
# 4. Compute one voltage by hand before you enable. Then use small targets. The robot is on the
#    floor, and somebody is ready to press *Disable*. Start with kP = 0, and check that the
#    mechanism *nearly* follows its target. Then add kP.
#
# If the gains cannot be right, the command writes no code and explains why.
#
# <details><summary>Want to know more? Three logs, and an arm's angle</summary>
#
# Record the four tests three times, each into its own log, and fit all three:
#
# ```
# sysid fit monday_1.wpilog monday_2.wpilog monday_3.wpilog
# ```
#
# The command fits each log alone, compares the gains, and averages them. Compare the spread with
# the error bars: how much the gains of the logs differ, and how large the standard errors are. If
# the spread is larger, something changes between the recordings: the battery, the heat of the
# motors, a bearing.
#
# For an arm, the code uses radians. It contains the offset between the angle that your sensor
# measures and the angle from horizontal.
# </details>

# %% [markdown]
# ## 11 System check
#
# Before you enable with new gains, check all five:
#
# - [ ] For every constant, a comment gives its unit and the date of the measurement.
# - [ ] The class is the right one for the analysis type, and **kG** is the second argument.
# - [ ] The unit of kV is the unit of the velocities that your code passes.
# - [ ] One voltage, computed by hand, is between 0 and 12 V and makes sense.
# - [ ] A comment says that kP is a first guess, and kP has the right unit for its loop (volts or
#   duty cycle). The first try is with kP = 0.
#
# ## 12 Knowledge check
#
# Click an answer to the first question.

# %%
display(ask_question("lesson8.quick"), enable_checkboxes())

# %% [markdown]
# **1.** A shooter has kS = 0.11 V, kV = 0.082 V·s/rot, kA = 0.003. Its target is 4000 rpm, but it
# stays at 3900. Are the gains wrong?
#
# <details><summary>Answer</summary>
#
# No. 4000 rpm is 66.7 rot/s, so the feedforward gives 0.11 + 0.082 · 66.7 = 5.58 V. Without
# feedback, an error of 2.5 % is normal. Keep the gains, and check the units. Check also that the
# motor gets the full voltage: `set(volts / 12)` on an 11.7 V battery causes exactly this error.
# Then add feedback. kP alone does not remove the whole error.
# </details>
#
# **2.** A team characterized an empty arm. With a game piece, the arm sinks. What changed, and what
# do you do?
#
# <details><summary>Answer</summary>
#
# kG and kA are larger with the piece. kV and kS hardly change. Measure (or compute) the gains of
# the loaded arm, and use them when a sensor sees the piece. With a larger kP the arm sinks less,
# but it still sinks.
# </details>
#
# **3.** An arm has kS 0.2, kV 1.2, kA 0.08 and kG 1.5. Its code says `new ArmFeedforward(0.2, 1.2,
# 0.08, 1.5)`. What is wrong?
#
# <details><summary>Answer</summary>
#
# The order of the arguments is wrong. It must be kS, kG, kV, kA: `new ArmFeedforward(0.2, 1.5, 1.2,
# 0.08)`. In the wrong order, the class uses 1.2 V as kG and 0.08 as kV.
# </details>
#
# **4.** In week 3 a brace of 4 kg is added to the drivetrain. Which constants do you measure again?
#
# <details><summary>Answer</summary>
#
# Measure kA again. Then recompute everything that depends on kA: kP, and the mass and moment of
# inertia in the path planner. kV and kS stay nearly the same.
# </details>
#
# **5.** With kP = 0 your turret hardly moves. With a large kP it reaches the target late, and
# shakes. What do you suspect?
#
# <details><summary>Answer</summary>
#
# The unit of the feedforward is probably wrong: the gains are per radian, but the code passes
# rotations. So the voltage is 2π times too small. The large kP hid this mistake. Compute one
# voltage by hand.
# </details>

# %% [markdown]
# ## 13 Practice
#
# **Exercise 10: from the analyzer to the robot**
# ([exercises/exercise10/README.md](../exercises/exercise10/README.md)). You get the gains of your
# own mechanism, and a code file to fill in. Sections 2 to 4 and 6 help. `grade watch exercise10`
# grades each time you save.
#
# ```
# grade exercise10
# ```
#
# **Exercise 11: knowledge checks and the mechanism table**
# ([exercises/exercise11/README.md](../exercises/exercise11/README.md)). Sections 5, 7 and 9 help,
# and lesson 6 for the first check.
#
# ```
# grade exercise11
# ```
#
# <details><summary>Or answer from a notebook</summary>
#
# ```python
# from grader import submit
#
# submit("exercise11", intake="optional", intake_reason="…", schedule="…")
# ```
# </details>
#
# <details><summary>More, if you like</summary>
#
# Set kP = 0.2 in section 4. Which wrong sets of gains can you still see in the plot? What would
# you log on your robot to see them there?
# </details>
#
# **Next:** [Lesson 9, the reality gap](09_reality_gap.ipynb). What does your model not know?
