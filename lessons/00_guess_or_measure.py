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
# # Lesson 0: Start here: guess or measure?
#
# *About 40 minutes. You need only this page: no robot, no earlier lesson, no math beyond a straight
# line.*
#
# ![Speed over time. The robot should reach 2 m/s. With guessed gains it only reaches 1.6
# m/s.](attachment:picture.png)
#
# **At the end you can**
#
# - say what *system identification* is, and how it differs from guessing;
# - say when a measured gain is better than a guessed gain, and when it is not;
# - say which gain changes when the robot gets heavier, and which do not;
# - use the three tools of this course, and find your own numbers for its exercises.
#
# **How a lesson works.** Gray cells hold code. Click into one and press *Shift + Enter*: the cell
# runs, and its answer appears below. Go through the page from top to bottom, and run every cell.
# Most code only prepares or draws something. It is hidden behind a bar with three dots. Run these
# cells like the others; you do not have to open them. The code that you see is worth reading.
#
# <details><summary>Do you see no buttons or sliders?</summary>
#
# You can type an answer in a cell, for example `ask_question("lesson0.race").answer("about the
# same")`. Where sliders are missing, you see their picture with the first setting. All lessons work
# this way.
# </details>

# %% [markdown]
# ## 1 Why: somebody has to choose the numbers
#
# Your robot program wants the drivetrain (motors, gears and wheels) to move at 2 m/s. But the
# program can only set a **voltage**. How many volts give 2 m/s? A **feedforward** is a formula that
# computes the voltage for the motion you want. A feedforward does not wait until the robot is too
# slow: it sets the right voltage from the start.
#
# The formula contains three numbers, called **gains**:
#
# - **kS**: the volts that overcome friction while the robot moves;
# - **kV**: the volts for each m/s of velocity;
# - **kA**: volts for each m/s² of acceleration. (An acceleration of 1 m/s² means: each second, the
#   velocity grows by 1 m/s.)
#
# Lesson 1 explains where these gains come from. Today's question is: **how do you find these
# numbers?**
#
# - You can **guess**: try 0.1, load the code onto the robot (*deploy*), and watch the robot. Then
#   try 0.2.
# - You can **measure**: let the robot run a few tests, write down what it did, and compute the
#   gains from these data. This is called **system identification**, or *SysId* for short.
#
# Which way is better? A race will show it.

# %%
import math
import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np
from IPython.display import display

import sim
from grader import ask_question, enable_checkboxes
from sim.bench.mechanism import Mechanism
from sim.bench.mechanisms import MECHANISMS
from sim.bench.simulate import move_gains_only, simulate
from sim.fit import fit
from sim.plot import Table, plot_time_series
from sim.plot.animation import (
    Animation,
    Choice,
    Gain,
    Knob,
    Motion,
    Panel,
    Scene,
    Score,
    animate_mechanism,
)
from sim.plot.animation.charts import animate_charts, chart_line_errors

# %% [markdown]
# ## 2 Your robot
#
# Write your name between the quotes, and run the cell. You get your own robot: a drivetrain with
# its own gears, mass and friction. The same name always gives the same robot.

# %%
NAME = "me"


def robot_of(name: str) -> Mechanism:
    """The drivetrain that belongs to a name."""
    letters = list(name.strip().casefold().encode())
    return MECHANISMS["drivetrain"].draw(np.random.default_rng(letters))


robot = robot_of(NAME)
print(f"{NAME}'s robot is similar to this one:\n{robot.summary}.")
print("You will see this robot's gains after the race.")

# %% [markdown]
# The robot is simulated. The simulation knows the robot's true gains, so you can check whose gains
# were right.
#
# ### The drive
#
# The robot should speed up to 2.5 m/s within half a second, hold that speed, stop, wait, and then
# drive back at 1 m/s. The next cell describes this drive. The most important line is `volts = …`:
# it computes the voltage from the motion we want. (`np.sign(v)` is +1 forward and −1 backward.
# Friction always acts against the motion, so its voltage changes sign, too.)

# %%
TIME = np.arange(0.0, 4.21, 0.02)  # [s] the robot program runs every 20 ms
CORNERS = [0.0, 0.2, 0.7, 1.6, 2.1, 2.4, 2.8, 3.4, 3.8, 4.2]  # [s]
SPEEDS = [0.0, 0.0, 2.5, 2.5, 0.0, 0.0, -1.0, -1.0, 0.0, 0.0]  # [m/s] at the corners
TARGET = np.interp(TIME, CORNERS, SPEEDS)


def drive(driven: Mechanism, gains: dict[str, float]) -> np.ndarray:
    """The velocity of a robot that is driven by feedforward alone."""
    v = (TARGET[:-1] + TARGET[1:]) / 2  # the target velocity, from one loop to the next
    a = np.diff(TARGET) / np.diff(TIME)  # the target acceleration
    volts = gains["kS"] * np.sign(v) + gains["kV"] * v + gains["kA"] * a
    _, velocity = move_gains_only(driven.gains, time=TIME, voltage=np.append(volts, 0.0))
    return velocity


# %% [markdown]
# Nothing corrects the robot while it drives. A correction (*feedback*, for example a PID
# controller) would hide how good or bad the gains are.

# %% [markdown]
# ## 3 The race
#
# **Round one: you.** You have **90 seconds** and two sliders, kS and kV. kA stays at 0. The clock
# starts when you move the first slider. The dashed robot shows the target motion. Move the sliders
# until both robots stay together, and make the *typical error* small. (It is the "root mean square"
# of all errors: an average in which large errors count more.)
#
# **Round two: three lines.** Your opponent is a program of three lines. It tests the robot and
# computes the gains.
#
# **Predict** before you race. Click an answer: the page says at once whether it is right. Nobody
# grades it.

# %%
ask_question("lesson0.race")

# %%
START = (0.6, 1.5)  # kS [V] and kV [V·s/m] where the sliders start
KS = Knob("kS", "kS [V]", low=0.0, high=1.0, step=0.02, value=START[0])
KV = Knob("kV", "kV [V·s/m]", low=1.0, high=4.0, step=0.02, value=START[1])
KA = Knob("kA", "kA [V·s²/m]", low=0.0, high=0.6, step=0.01, value=0.0)
asked = Motion("target", velocity=TARGET, asked=True)


def race(*knobs: Knob, seconds: float = 0.0) -> Animation:
    """Your robot beside the target. The sliders set the gains of its program."""
    program = {"kS": 0.0, "kV": 0.0, "kA": 0.0} | {knob.name: Gain(knob.name) for knob in knobs}
    yours = Motion("your robot", gains=robot.gains, program=program)
    return animate_mechanism(
        "drivetrain",
        Scene(TIME, (asked, yours), target=TARGET),
        panels=(Panel("velocity", "velocity [m/s]", low=-2.0, high=4.0),),
        knobs=knobs,
        score=Score("your robot", seconds=seconds),
        span=(-1.5, 5.0),
        alt="Your robot drives next to a dashed robot, which shows the target motion. The dashed "
        "robot speeds up to 2.5 m/s, stops, and comes back at 1 m/s. If your robot stays close to "
        "it, your gains are good.",
    )


race(KS, KV, seconds=90.0)

# %% [markdown]
# Race now. The line above the picture shows your best try. Write its kS and kV into the next cell,
# and run it:

# %%
MY_KS, MY_KV = START  # for example 0.44, 3.1

# %% [markdown]
# Now your opponent drives. Line one of its program runs four tests with the robot and keeps the
# **log**: a table of time, voltage, position and velocity with fifty rows per second. Line two
# *fits* the formula to the log: it computes the gains that match the rows best, in the same way as
# the SysId tool of WPILib (the code library of FRC). Line three makes the robot drive with these
# gains.

# %%
log = simulate(robot, sim.Routine(ramp=1.0, step=2.0), rng=np.random.default_rng(1))
measured = fit(log, method="sysid").gains
followed = drive(robot, measured)

# %% [markdown]
# The log contains four tests: a *ramp* (the voltage grows slowly) and a *step* (the voltage jumps),
# each forward and in reverse. SysId calls the ramps *quasistatic* and the steps *dynamic*. (The
# picture shows only the first second of each step. Lesson 3 explains these four tests.)

# %%
plot_time_series(log, dynamic_seconds=1.0)

# %% [markdown]
# Here is the result:

# %%
guessed = {"kS": MY_KS, "kV": MY_KV, "kA": 0.0}
YOU = "your best try" if (MY_KS, MY_KV) != START else "the start values"


def side_by_side(driven: Mechanism, racers: dict[str, dict[str, float]]) -> Scene:
    """One robot driven by the gains of each racer."""
    motions = [Motion(name, velocity=drive(driven, one)) for name, one in racers.items()]
    return Scene(TIME, (asked, *motions))


animate_mechanism(
    "drivetrain",
    side_by_side(robot, {YOU: guessed, "three lines": measured}),
    panels=(Panel("velocity", "velocity [m/s]", low=-2.0, high=4.0),),
    alt=f"This is the finish of the race. The robot with {YOU} leaves the dashed target robot "
    "while the target speeds up and slows down. The robot of the three lines stays with the "
    "target.",
)


# %%
def typical_error(driven: Mechanism, gains: dict[str, float]) -> float:
    """The root mean square of the errors of the velocity [m/s]."""
    return float(np.sqrt(np.mean((drive(driven, gains) - TARGET) ** 2)))


def row(who: str, gains: dict[str, float]) -> tuple[str | float, ...]:
    """Gains, and how well they drive the robot."""
    return (who, gains["kS"], gains["kV"], gains["kA"], typical_error(robot, gains))


def best_of_two_knobs() -> dict[str, float]:
    """Try every pair of kS and kV."""
    pairs = [(ks, kv) for ks in np.arange(0.0, 1.01, 0.02) for kv in np.arange(1.0, 4.01, 0.02)]
    found = [{"kS": float(ks), "kV": float(kv), "kA": 0.0} for ks, kv in pairs]
    return min(found, key=lambda gains: typical_error(robot, gains))


two_knobs = best_of_two_knobs()
HEADER = ("who", "kS [V]", "kV [V·s/m]", "kA [V·s²/m]", "typical error [m/s]")
Table(
    HEADER,
    (
        row(YOU, guessed),
        row("the best possible with kS and kV", two_knobs),
        row("three lines", measured),
        row("the truth", robot.gains),
    ),
)

# %% [markdown]
# ### Explain
#
# Look at the second row of the table. The computer tried *every* pair of kS and kV that your
# sliders can reach. Even the best pair has a large error. The error is large where the robot speeds
# up and slows down. kS and kV alone do not give the voltage for acceleration. The kA term gives
# this voltage, and only your opponent's program uses kA. So **you could not win round one**.
#
# Was the race fair? Only partly.
#
# - **You** had an easy race. Each try took you two seconds. On a real robot, for each try you
#   change the number, deploy the code, drive, and walk back.
# - **Your opponent's program** had an easy race, too. On a real robot, line one is a lot of work:
#   you need code for the tests, room to drive, a good battery, and a log without wrong data.
#   Lessons 3 to 6 teach this.
#
# <details><summary>Want to know why the true gains have an error, too?</summary>
#
# The program sets the voltage only every 20 ms, but the motion changes all the time.
# </details>
#
# On a real robot, the four tests of your opponent would need this much driving:

# %%
spent = sum(float(run.time[-1] - run.time[0]) for run in log.runs)
rows_seen = sum(len(run) for run in log.runs)
farthest = max(float(np.ptp(run.position)) for run in log.runs)
print(f"Four tests: {spent:.0f} s of driving, {rows_seen} rows in the log.")
print(f"The longest test drives {farthest:.1f} m. (Lesson 3 shows how to test in less room.)")

# %% [markdown]
# **Round three: kA unlocked.** Now race once more, with all three sliders and no clock. Can you get
# an error as small as your opponent's? How long does this take?

# %%
race(KS, KV, KA)

# %% [markdown]
# ## 4 A third way: a pencil and a ruler
#
# A teammate says: "I do not move sliders. I give the robot 1 V, wait until the speed is steady, and
# write the speed down. Then I do the same with 2 V, 3 V, 4 V and 5 V. Then I draw a straight line
# with a ruler."
#
# At a steady speed nothing accelerates, so kA does not matter. The formula becomes
#
# > voltage = kS + kV · velocity
#
# This is a straight line: kV is its slope (how steep it is), and kS is the voltage where the line
# meets velocity 0.
#
# **Predict:**

# %%
ask_question("lesson0.pencil")

# %%
VOLTS = np.array([1.0, 2.0, 3.0, 4.0, 5.0])
rng = np.random.default_rng(2)


def steady_speed(volts: float) -> float:
    """The speed after a second, read off the dashboard to two decimals."""
    time = np.arange(0.0, 1.5, 0.02)
    _, velocity = move_gains_only(robot.gains, time=time, voltage=np.full(time.size, volts))
    shaky = velocity[-25:] + robot.sensor.velocity_noise * rng.standard_normal(25)
    return round(float(np.mean(shaky)), 2)


speeds = np.array([steady_speed(volts) for volts in VOLTS])
slope, start = np.polyfit(speeds, VOLTS, 1)  # the ruler: the straight line that fits best
labels = {"xlabel": "velocity [m/s]", "ylabel": "voltage [V]"}
animate_charts(lambda: chart_line_errors(speeds, VOLTS, intercept=start, slope=slope, **labels))

# %% [markdown]
# (The *error* of a dot is its vertical distance from the line. Here the errors are too small to
# see.)

# %%
pencil = {"kS": float(start), "kV": float(slope), "kA": 0.0}
truth = robot.gains


def off(gains: dict[str, float], name: str) -> str:
    """By how many percent a gain is off."""
    if not gains[name]:
        return "not known"
    return f"{100 * (gains[name] / truth[name] - 1):+.1f} %".replace("-", "−")


Table(
    ("who", "kS off by", "kV off by", "kA off by"),
    (
        ("the pencil", off(pencil, "kS"), off(pencil, "kV"), off(pencil, "kA")),
        ("three lines", off(measured, "kS"), off(measured, "kV"), off(measured, "kA")),
    ),
)

# %% [markdown]
# The kV from the pencil is nearly as good as the kV from the three lines. The kS from the pencil is
# often good, too. If you draw with care, the line is *good*. A maintainer of WPILib (a person who
# develops it) calls it "the better way" to find kS and kV by hand. ([frc-docs issue
# 2712](https://github.com/wpilibsuite/frc-docs/issues/2712))
#
# So the race was not "human against computer". Your teammate did *not* search for a number that
# looks good. Your teammate **wrote down what the robot did, and fitted a model to these data**. (A
# *model* is a formula for what the robot does.) This is system identification with a pencil.
#
# The pencil cannot find kA, because it only looks at steady speeds.

# %% [markdown]
# ## 5 Two questions
#
# If you guess, you ask: **which number makes the robot behave as I like?** SysId asks: **which
# physical model best explains what the robot did?** It computes this model from what went into the
# robot (the voltage) and what came out (the motion). The two questions give different results:
#
# | | guessing | measuring |
# |---|---|---|
# | asks | which gain makes it behave as I like? | which model explains what it did? |
# | looks at | one drive, by eye | every row of the log |
# | gives | a number that worked | a number with a meaning and a unit |
# | how to check it | try again | compare with motor, gears and mass (lesson 1) |
# | when it fails | try another number | see *where* the model fails (lesson 9) |
#
# **Not everybody agrees.** Some people say that every good team uses SysId on every mechanism. A
# maintainer of WPILib wrote in 2026 that most teams get the opposite advice: "avoid the SysId tool
# and do manual tuning instead", because SysId is "error-prone": it is easy to make mistakes with
# SysId. ([allwpilib issue 8643](https://github.com/wpilibsuite/allwpilib/issues/8643)) This course
# makes such mistakes on purpose, so that you recognize them.
#
# (This course grew out of another lesson, the *source lesson*. Most of it is right. Where it is
# wrong or incomplete, you find a box with the title *For mentors*. The box quotes the source
# lesson, shows what the official documentation says, and lets you try it. You do not need these
# boxes.)
#
# <details><summary>For mentors: which question SysId asks</summary>
#
# > **Lesson says:** SysId does not ask "what gain produces behavior I like", it asks "what physical
# > model best explains the data this mechanism actually produced".
# >
# > **Source says:** WPILib says the same in other words: system identification is finding a
# > mathematical model of a system "through statistical analysis of its inputs and outputs". WPILib
# > adds that the model "is not perfect", but usually good enough. ([WPILib docs: Introduction to
# > System
# > Identification](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/system-identification/introduction.html))
# >
# > **Try it:** look at the table of section 3. Which row comes from guessing, and which row from
# > SysId?
# </details>
#
# <details><summary>For mentors: does every good team use SysId?</summary>
#
# > **Lesson says:** "Teams like 2910 and 254 characterize every motorized mechanism that needs
# > closed-loop control."
# >
# > **Source says:** a maintainer of WPILib writes in 2026 that the prevailing advice is to "avoid
# > the SysId tool and do manual tuning instead", because SysId is "error-prone". ([allwpilib issue
# > 8643](https://github.com/wpilibsuite/allwpilib/issues/8643)) The authors of this course could
# > not check what the two teams do. (*Closed-loop control* means control with feedback.)
# >
# > **Try it:** in this course you can make such errors. Each lesson makes one of them on purpose in
# > a simulation with known gains, so that you learn to recognize the error.
# </details>

# %% [markdown]
# ## 6 Week 3: a brace
#
# Two weeks later, the build team bolts a brace (a steel bar that makes the frame stronger) onto the
# robot: **+4 kg**. Nobody tells the programmers.
#
# **Predict** two things:

# %%
display(ask_question("lesson0.gain"), ask_question("lesson0.worse"))


# %%
def with_brace(kg: float) -> tuple[Mechanism, dict[str, float]]:
    """The same robot with a brace, and what three lines measure on it."""
    heavy = replace(robot, load=robot.load + kg)
    again = simulate(heavy, sim.Routine(ramp=1.0, step=2.0), rng=np.random.default_rng(3))
    return heavy, fit(again, method="sysid").gains


def week_three(kg: float) -> Scene:
    """The race once more, on a heavier robot."""
    heavy, again = with_brace(kg)
    kept = {f"{YOU}, kept": guessed, "three lines, kept": measured}
    return side_by_side(heavy, {**kept, "three lines, measured again": again})


BRACES = {f"{kg} kg": week_three(kg) for kg in (0, 4, 10, 20, 40)}
animate_mechanism(
    "drivetrain",
    {(name,): scene for name, scene in BRACES.items()},
    choices=(Choice("brace", tuple(BRACES), value="4 kg"),),
    panels=(Panel("velocity", "velocity [m/s]", low=-2.0, high=4.0),),
    alt="Three robots carry the same brace. One drives with your gains, one with the old gains of "
    "the three lines, and one with gains that were measured again. With 4 kg you see no "
    "difference. With 40 kg the robots with old gains fall behind while the target speeds up, and "
    "the robot with new gains does not.",
)

# %%
BRACE = 4.0  # [kg]
heavy, again = with_brace(BRACE)
before = typical_error(robot, guessed)
after = typical_error(heavy, guessed)

print(f"Typical error of {YOU}: {before:.3f} m/s, with the brace {after:.3f} m/s.")
Table(
    ("gain", "true before", "true with the brace", "measured before", "measured again", "unit"),
    tuple(
        (name, truth[name], heavy.gains[name], measured[name], again[name], unit)
        for name, unit in (("kS", "V"), ("kV", "V·s/m"), ("kA", "V·s²/m"))
    ),
    caption="Compare the true gains: which of them has changed?",
)

# %% [markdown]
# ### Explain
#
# Only **kA** has changed. At a steady speed nothing accelerates, so a heavier robot needs no more
# volts: kV stays the same. Choose 40 kg in the picture. With the old gains, the error of the
# velocity grows only where the robot speeds up or slows down.
#
# <details><summary>For mentors: do guesses stop being valid when the robot gets heavier?</summary>
#
# > **Lesson says:** when the mechanism gets heavier, "the guesses stop being valid".
# >
# > **Source says:** a guess stops being valid only if the gain depends on mass. WPILib describes kS
# > as the voltage for friction, kV as the voltage for a constant velocity, and kA as the voltage
# > for acceleration. Mass resists acceleration. kS is "static friction in your gears, bearings,
# > etc". More weight increases this friction only if the weight presses on gears or bearings, or on
# > the carpet. ([WPILib docs: Introduction to DC Motor Feedforward, at one
# > commit](https://github.com/wpilibsuite/frc-docs/blob/250e32128d9a93f27d58bc3cd1d0b3ab5eec43cd/source/docs/software/advanced-controls/introduction/introduction-to-feedforward.rst))
# >
# > **Try it:** choose 40 kg. When is the robot's velocity error larger: while its speed changes, or
# > while it holds a speed?
# </details>
#
# Your guessed kS and kV are as good as before, and you never guessed a kA. But when you guess, you
# do not *notice* the brace. When you measure, you notice it. The next cell measures the robot
# without and with the brace, and uses the course's own method (`fit` without `method="sysid"`):

# %%
heavy_log = simulate(heavy, sim.Routine(ramp=1.0, step=2.0), rng=np.random.default_rng(3))
light_fit, heavy_fit = fit(log), fit(heavy_log)
growth = heavy_fit.gains["kA"] / light_fit.gains["kA"]
weighed = robot.load * (growth - 1)
print(f"kA grew by {100 * (growth - 1):.1f} %. kA grows in proportion to mass, and we know the")
print(f"robot's old mass, {robot.load:.1f} kg. So the brace weighs {weighed:.2f} kg.")
sysid_growth = again["kA"] / measured["kA"]
print(f"(SysId's method, same logs: {100 * (sysid_growth - 1):.1f} %. Its kA is less precise.)")

# %% [markdown]
# So the log can *weigh* the brace, because a measured gain has a physical meaning.
#
# How much do 4 kg more change the gains? That depends on the mechanism. (**kG** is the gain for
# gravity. Only mechanisms that move up and down have it: lesson 2.)

# %%
lift = MECHANISMS["elevator"]
rows = []
for name, one in (("your drivetrain", robot), ("an elevator's carriage", lift)):
    more = replace(one, load=one.load + BRACE).gains
    changes = [f"{100 * (more[gain] / one.gains[gain] - 1):.0f} %" for gain in ("kV", "kA")]
    gravity = f"{100 * (more['kG'] / one.gains['kG'] - 1):.0f} %" if "kG" in more else "none"
    rows.append((name, one.load, *changes, gravity))
Table(("added to", "moving mass [kg]", "kV grows by", "kA grows by", "kG grows by"), tuple(rows))

# %% [markdown]
# ### So, guess or measure?
#
# - For **kV**, and often for kS, a line that you draw with care is as good as a fit. If you need no
#   other gain, draw such a line.
# - For **kA** and **kG**, measuring wins. Your eye sees kA only while the speed changes, and
#   friction hides kG (lesson 2).
# - When **something changes** on the robot, measuring wins: it shows what changed, and by how much.
# - With a **damaged log** (a log with wrong data), a guess can be better. A fit prints three gains
#   even when they are wrong. Lesson 6 teaches you to recognize such a log.
#
# ## 7 What good gains give you
#
# Good gains help you more than once, because other parts of the robot's code use them, too.
#
# **Drivetrain.** A path planner such as PathPlanner needs the robot's *moment of inertia* (MOI).
# The MOI says how hard it is to turn the robot. The PathPlanner docs give a formula with two kA
# values: one is measured while the robot turns, the other while it drives straight. ([PathPlanner
# docs: Robot Config](https://pathplanner.dev/robot-config.html))
#
# **Arm.** A *motion profile* is a plan of the velocity and acceleration at every moment. The robots
# in our race followed such a plan, too. With good gains the arm follows this plan, and the feedback
# has little to correct.
#
# **Shooter.** A shooter should reach 4000 rpm (rotations per minute) with feedforward alone. The
# next table shows its speed:

# %%
wheel = MECHANISMS["shooter"]
ASKED = 4000.0 * 2 * math.pi / 60  # [rad/s]
wheel_log = simulate(wheel, sim.Routine(ramp=0.5, step=4.0), rng=np.random.default_rng(4))
gains = fit(wheel_log, method="sysid").gains


def reached(real: Mechanism, used: dict[str, float]) -> float:
    """The steady speed [rpm] that a feedforward with these gains leads to."""
    volts = used["kS"] + used["kV"] * ASKED
    return (volts - real.gains["kS"]) / real.gains["kV"] * 60 / (2 * math.pi)


worn = replace(wheel, drag=wheel.drag + 0.03)
Table(
    ("gains", "speed reached [rpm]", "difference from 4000 rpm"),
    tuple(
        (name, f"{rpm:.0f}", f"{round(rpm / 40 - 100, 1) + 0.0:+.1f} %".replace("-", "−"))
        for name, rpm in (
            ("measured", reached(wheel, gains)),
            ("kV guessed 5 % too low", reached(wheel, gains | {"kV": 0.95 * gains["kV"]})),
            ("measured, but a bearing got worse later", reached(worn, gains)),
        )
    ),
)

# %% [markdown]
# With good gains the feedback has little to correct. But you still need feedback: in the last row
# of the table the gains were right, until a bearing got worse. And these gains fit only *your*
# robot: another team's robot has other gains.
#
# <details><summary>For mentors: can feedforward hit 4000 rpm exactly, without PID?</summary>
#
# > **Lesson says:** the feedforward can "predict the exact voltage for 4000 RPM without needing PID
# > to compensate for model error".
# >
# > **Source says:** no. Feedforward handles what we already know; feedback then compensates "for
# > what we do not or cannot know" while the robot runs. ([WPILib docs: Feedforward
# > Control](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/controllers/feedforward.html))
# >
# > **Try it:** look at the last row of the table. These gains were right before the bearing got
# > worse.
# </details>

# %% [markdown]
# ## 8 Your tools
#
# This course comes with three tools.
#
# | tool | what it is for |
# |---|---|
# | these notebooks | predict, run, explain; eleven lessons, 0 to 10 |
# | `grade` | checks the exercises, gives hints, says what comes next |
# | `sysid` | simulates, reads, fits and inspects logs, also those of a real robot |
#
# You type the last two in a **terminal** (in JupyterLab: *File*, *New*, *Terminal*), in the
# course's folder. If it says "not found", type `.venv\Scripts\activate` on Windows, or `source
# .venv/bin/activate` elsewhere, and try again. If that fails too, this line installs everything:
#
# ```
# python -m grader start
# ```
#
# (WPILib's own tool is also called **SysId**. It opens the same `.wpilog` files, so you can use
# either tool.)
#
# ### Say who you are
#
# The course asked for your name when you started it. The name gives you your own numbers in every
# exercise: your own mechanism and your own log. Your neighbor has other answers, but you can
# compare *how* you found your answers. Your numbers are in
# `exercises/exercise1/data/YOUR-NAME/given.toml`, and so on. (`NAME` at the top of this page is for
# the race only.)
#
# If you gave no name, type this once in a terminal of JupyterLab (in a class, use the name your
# teacher uses):
#
# ```
# grade start --student ada
# ```
#
# The next cell shows which data you have:

# %%
made = list(Path("..", "exercises", "exercise1", "data").glob("*/given.toml"))
if made:
    newest = max(made, key=lambda path: path.stat().st_mtime)
    given = tomllib.loads(newest.read_text(encoding="utf-8"))
    print(f"{newest.parent.name}: {given['mechanism']}, velocities in {given['velocity_unit']}")
    print(f"kS = {given['kS']} V, kV = {given['kV']}, kA = {given['kA']} (units: exercise 1)")
else:
    print("You have no data yet. Type this in a terminal, in the course's folder:")
    print("    grade start --student YOUR-NAME")

# %% [markdown]
# ### A first try
#
# In the terminal, these two commands do the work of lines one and two of the race:
#
# ```
# sysid simulate drivetrain --seed 1 -o drive.wpilog
# sysid fit drive.wpilog
# ```
#
# And this command shows how far you are and what to do next:
#
# ```
# grade
# ```

# %% [markdown]
# ## 9 System check
#
# Before you go on to lesson 1:
#
# - [ ] You ran every cell of this page, and you raced.
# - [ ] `grade` works in a terminal, and knows your name.
# - [ ] `sysid fit drive.wpilog` printed three gains.
# - [ ] You can say in one sentence which question guessing asks, and which one SysId asks.
# - [ ] You know which gain changes when the robot gets heavier.
#
# ## 10 Knowledge check
#
# Click an answer to the first question; you get feedback at once.

# %%
display(ask_question("lesson0.quick"), enable_checkboxes())

# %% [markdown]
# **1.** What question does guessing ask, and what question does SysId ask?
#
# <details><summary>Answer</summary>
#
# If you guess, you ask: which gain makes the robot behave as I like? SysId asks: which physical
# model best explains what the robot did?
# </details>
#
# **2.** A teammate holds five steady voltages and draws a line. Which gains does the line give, and
# how good are these gains?
#
# <details><summary>Answer</summary>
#
# The line gives kV (its slope) and kS (the voltage where it meets velocity 0). Both are good: this
# kV is about as good as the kV of a fit. The line cannot give kA, because at a steady speed nothing
# accelerates.
# </details>
#
# **3.** The carriage of an elevator gets heavier. Which of its gains change, and which do not?
#
# <details><summary>Answer</summary>
#
# kA and kG grow in proportion to the mass. kV depends on motor and gears, so kV stays the same. kS
# depends on friction, so kS hardly changes.
# </details>
#
# **4.** "We measured our gains, so we do not need PID." What do you say?
#
# <details><summary>Answer</summary>
#
# The gains were measured on one day, and no model is perfect. Bearings age, belts stretch, and
# other robots push yours. Feedback corrects what the feedforward cannot know. With good gains,
# feedback has little to do.
# </details>
#
# **5.** What else can you use a drivetrain's kA for, besides the feedforward?
#
# <details><summary>Answer</summary>
#
# kA shows the robot's mass, because a heavier robot needs more volts for the same acceleration. If
# you also measure a kA while the robot turns, a formula gives the robot's moment of inertia (lesson
# 8). And if kA jumps from one week to the next, somebody added something heavy.
# </details>

# %% [markdown]
# ## 11 Practice
#
# **Exercise 11** ([exercises/exercise11/README.md](../exercises/exercise11/README.md)) has the
# knowledge checks of the whole course. Its first three questions, under *Guessing and measuring*,
# are about this page. Answer these three now, and leave the other questions empty until lesson 8:
# an empty answer is no mistake. Choose below, then click the button.

# %%
from grader import ExerciseQuestions

ExerciseQuestions("exercise11", "Q0_guess", "Q0_sysid", "Q0_brace")

# %% [markdown]
# The button writes your answers into `exercises/exercise11/answers.toml`. You can also write the
# letters into that file with an editor: the questions are in
# `exercises/exercise11/data/YOUR-NAME/questions.md`. Then grade the file in a terminal:
#
# ```
# grade exercise11
# ```
#
# `grade watch exercise11` grades the file each time you save it. Hints cost nothing:
# `grade exercise11 --hint`. In a notebook, this line writes the letters and grades them:
#
# ```python
# from grader import submit
#
# submit("exercise11", Q0_guess="...", Q0_sysid="...", Q0_brace="...")
# ```
#
# <details><summary>More, if you like</summary>
#
# - Drive your robot with your neighbor's gains, for example `typical_error(robot, {"kS": 0.2, "kV":
#   2.4, "kA": 0.2})`. Which of the three gains causes the largest error?
# - Write another name above, and run the page again (menu: *Run*, *Run All Cells*).
# </details>
#
# **Next:** [Lesson 1, the motor model](01_motor_model.ipynb). Where do kS, kV and kA come from?
