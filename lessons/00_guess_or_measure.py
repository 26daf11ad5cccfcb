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
# *About 40 minutes. You need nothing but this page: no robot, no math beyond a straight line, no
# earlier lesson.*
#
# **At the end you can**
#
# - say what *system identification* is, and which question it asks that guessing does not;
# - say when a measured gain beats a guessed one, and when it does not;
# - say which gain moves when the robot gets heavier, and which do not;
# - use the three tools of this course, and find the mechanism that belongs to your name.
#
# **How a lesson works.** Gray cells hold code. Click into one and press *Shift + Enter*: it runs,
# and its answer appears below. Go from top to bottom, and leave none out. You do not have to
# understand every line of code.

# %% [markdown]
# ## 1 Why: somebody has to choose the numbers
#
# A robot program wants the drivetrain to move at 2 m/s. What it can give is a **voltage**. How many
# volts are 2 m/s? A **feedforward** answers that: it is a formula that turns the motion you want
# into the voltage it takes, before anything has gone wrong.
#
# The formula has three numbers in it, called **gains**:
#
# - **kS**: volts to overcome friction, needed as soon as anything moves;
# - **kV**: volts for each m/s of velocity;
# - **kA**: volts for each m/s² of acceleration. (An acceleration of 1 m/s² means: each second, the
#   velocity grows by 1 m/s.)
#
# Lesson 1 explains where they come from. Today there is one question: **who chooses them?**
#
# - You can **guess**: try 0.1, load the code onto the robot (*deploy*), watch, try 0.2.
# - You can **measure**: let the robot run a few tests, write down what it did, and compute the
#   gains from that. This is **system identification**, in short *SysId*.
#
# Let us not argue. Let us race.

# %%
import math
import tomllib
from dataclasses import replace
from pathlib import Path
from time import monotonic

import ipywidgets as widgets
import numpy as np
from IPython.display import display

import sim
from sim.bench.mechanism import Mechanism
from sim.bench.mechanisms import MECHANISMS
from sim.bench.simulate import move_gains_only, simulate
from sim.fit import fit
from sim.plot import (
    Picture,
    Table,
    measure_tracking_error,
    plot_misses,
    plot_time_series,
    plot_tracking_error,
    show_interactive,
)
from sim.teaching.prediction import Prediction

# %% [markdown]
# ## 2 Your robot
#
# Write your name between the quotes, and run the cell. Everybody gets a robot of their own: a
# drivetrain with its own gears, weight and friction. The same name always gives the same robot.

# %%
NAME = "me"


def robot_of(name: str) -> Mechanism:
    """The drivetrain that belongs to a name."""
    letters = list(name.strip().casefold().encode())
    return MECHANISMS["drivetrain"].draw(np.random.default_rng(letters))


robot = robot_of(NAME)
print(f"{NAME}'s robot: {robot.summary}, more or less.")
print("Its gains are hidden from you until the race is over.")

# %% [markdown]
# The robot is simulated. We call the simulation **the bench**. It has one great advantage over a
# real robot: its true gains are known, so that in the end we can say who was right.
#
# ### The drive
#
# This is what the robot is asked to do: speed up to 2.5 m/s within half a second, hold that, stop,
# wait, and then drive back at 1 m/s. The next cell writes the drive down and teaches the robot to
# try. Its heart is one line, `volts = …`: the voltage, computed from the wish. (`np.sign(v)` is +1
# forward and −1 backward, so that kS always works against friction.)

# %%
TIME = np.arange(0.0, 4.21, 0.02)  # [s] the robot program runs every 20 ms
CORNERS = [0.0, 0.2, 0.7, 1.6, 2.1, 2.4, 2.8, 3.4, 3.8, 4.2]  # [s]
SPEEDS = [0.0, 0.0, 2.5, 2.5, 0.0, 0.0, -1.0, -1.0, 0.0, 0.0]  # [m/s] at the corners
TARGET = np.interp(TIME, CORNERS, SPEEDS)


def drive(driven: Mechanism, gains: dict[str, float]) -> np.ndarray:
    """The velocity of a robot that is driven by feedforward alone."""
    v = (TARGET[:-1] + TARGET[1:]) / 2  # the wished velocity, from one loop to the next
    a = np.diff(TARGET) / np.diff(TIME)  # the wished acceleration
    volts = gains["kS"] * np.sign(v) + gains["kV"] * v + gains["kA"] * a
    _, velocity = move_gains_only(driven.gains, time=TIME, voltage=np.append(volts, 0.0))
    return velocity


# %% [markdown]
# Nothing corrects the robot on its way. That is on purpose: a correction (*feedback*, such as PID)
# would hide how good or bad the gains are.

# %% [markdown]
# ## 3 The race
#
# **Round one: you.** You have **90 seconds**, and two knobs, kS and kV. kA stays at 0: two knobs
# are hard enough. The clock starts when you move the first one. Make the colored line lie on the
# black one. The number to beat stands in the table: the *typical miss*. (It is the "root mean
# square" of all misses: an average in which large misses count more.) Race first, and run the cells
# below it afterwards.
#
# **Predict first.** Nobody grades this. Your guess is kept, and you will see it again below.
# (No buttons on your screen? Type `guess_race.value = "the three lines"` in a cell.)

# %%
guess_race = Prediction(
    "You have 90 seconds by hand, the other side has three lines of code. Who gets the smaller "
    "typical miss?",
    "me, clearly",
    "about the same",
    "the three lines",
)
guess_race

# %%
SECONDS = 90.0
START = (0.6, 1.5)  # kS [V] and kV [V·s/m] that the knobs begin with
tries = []  # of each try: when, kS, kV, and its typical miss


def attempt(ks: float, kv: float) -> Picture:
    """One try: drive with a guess, and see. The first move starts the clock."""
    velocity = drive(robot, {"kS": ks, "kV": kv, "kA": 0.0})
    if tries or (ks, kv) != START:
        tries.append((monotonic(), ks, kv, measure_tracking_error(TARGET, velocity).typical))
    left = SECONDS - (tries[-1][0] - tries[0][0] if tries else 0.0)
    title = f"try {len(tries)}: {left:.0f} s left" if left >= 0 else "time is up: this one is late"
    return plot_tracking_error(TIME, TARGET, {"your robot": velocity}, title=title)


show_interactive(
    attempt,
    ks=widgets.FloatSlider(
        min=0, max=1, step=0.02, value=START[0], description="kS [V]", continuous_update=False
    ),
    kv=widgets.FloatSlider(
        min=1, max=4, step=0.02, value=START[1], description="kV [V·s/m]", continuous_update=False
    ),
)

# %% [markdown]
# No sliders on your screen? Change the numbers here and run the cell, again and again. (To race
# once more, run the cell above again.)

# %%
attempt(0.6, 1.5)

# %% [markdown]
# **Round two: three lines.** Line one lets the robot run four short tests and keeps the **log**: a
# list of the time, the voltage, the position and the velocity, fifty rows per second. Line two
# computes the gains from the log, in the same way as WPILib's SysId. Line three drives.

# %%
log = simulate(robot, sim.Routine(ramp=1.0, step=2.0), rng=np.random.default_rng(1))
measured = fit(log, method="sysid").gains
followed = drive(robot, measured)

# %% [markdown]
# This is what the log holds: two slow ramps and two sudden steps of the voltage, each forward and
# backward. SysId calls the ramps *quasistatic* and the steps *dynamic*. (Only the first second of
# the steps is drawn. Lesson 3 says why just these four.)

# %%
plot_time_series(log, dynamic_seconds=1.0)

# %% [markdown]
# And the finish:

# %%
counted = [(off, ks, kv) for at, ks, kv, off in tries if at - tries[0][0] <= SECONDS]
_, best_ks, best_kv = min(counted, default=(math.inf, *START))
guessed = {"kS": best_ks, "kV": best_kv, "kA": 0.0}

print(f"You said: {guess_race}.")
print(f"You made {len(counted)} tries in time." if counted else "You have not tried yet.")
plot_tracking_error(
    TIME, TARGET, {"your best try": drive(robot, guessed), "three lines": followed}, title="Finish"
)


# %%
def row(who: str, gains: dict[str, float]) -> tuple[str | float, ...]:
    """Gains, and how well they drive the robot."""
    off = measure_tracking_error(TARGET, drive(robot, gains))
    return (who, gains["kS"], gains["kV"], gains["kA"], off.typical)


def best_of_two_knobs() -> dict[str, float]:
    """Try every pair of kS and kV, as nobody has the time to."""
    pairs = [(ks, kv) for ks in np.arange(0.0, 0.61, 0.05) for kv in np.arange(2.0, 3.51, 0.05)]
    found = [{"kS": float(ks), "kV": float(kv), "kA": 0.0} for ks, kv in pairs]
    return min(found, key=lambda gains: measure_tracking_error(TARGET, drive(robot, gains)).typical)


two_knobs = best_of_two_knobs()
HEADER = ("who", "kS [V]", "kV [V·s/m]", "kA [V·s²/m]", "typical miss [m/s]")
Table(
    HEADER,
    (
        row("your best try", guessed),
        row("the best there is with two knobs", two_knobs),
        row("three lines", measured),
        row("the truth", robot.gains),
    ),
)

# %% [markdown]
# ### Explain
#
# Look at the second row. Endless patience, *every* pair of kS and kV in steps of 0.05, and it still
# misses by that much. Look where: at the ramps of the drive, where the robot speeds up and slows
# down. Two knobs cannot pay for acceleration. That is what kA is for, and the three lines have it.
# (Even the true gains miss by a hair. The voltage is set once every 20 ms, and on a ramp the wish
# has moved on meanwhile.)
#
# Was the race fair? In part.
#
# - The bench was **kind to you**. A try took you two seconds. On a robot it is: change the number,
#   deploy, drive, walk back.
# - The bench was **kind to the three lines**, too. On a robot, line one is work: code for the
#   tests, room to drive, a good battery, a log that is not damaged. Lessons 3 to 6 are about that.
#
# Here is what the robot itself spends on line one:

# %%
spent = sum(float(run.time[-1] - run.time[0]) for run in log.runs)
rows_seen = sum(len(run) for run in log.runs)
farthest = max(float(np.ptp(run.position)) for run in log.runs)
print(f"Four tests: {spent:.0f} s of driving, {rows_seen} rows in the log.")
print(f"The longest one drives {farthest:.1f} m. (It can be done with less: lesson 3.)")

# %% [markdown]
# ## 4 An honest twist: a pencil is enough for kV
#
# Now a teammate says: "I do not drag knobs. I give the robot 1 V, wait until it is steady, and
# write down its speed. Then 2 V, and so on. Then I draw a straight line with a ruler."
#
# At a steady speed nothing accelerates, so kA does not matter. What is left is
#
# > voltage = kS + kV · velocity
#
# a straight line: kV is its slope (how steep it is), and kS is where it meets velocity 0.
#
# **Predict:**

# %%
guess_pencil = Prediction(
    "How far is the pencil's kV from the truth?",
    "about 20 % off",
    "about 5 % off",
    "1 % or less",
)
guess_pencil

# %%
VOLTS = np.array([1.0, 2.0, 3.0, 4.0, 5.0])
rng = np.random.default_rng(2)


def steady_speed(volts: float) -> float:
    """The speed that somebody reads off the dashboard after a second, to two decimals."""
    time = np.arange(0.0, 1.5, 0.02)
    _, velocity = move_gains_only(robot.gains, time=time, voltage=np.full(time.size, volts))
    shaky = velocity[-25:] + robot.sensor.velocity_noise * rng.standard_normal(25)
    return round(float(np.mean(shaky)), 2)


speeds = np.array([steady_speed(volts) for volts in VOLTS])
slope, start = np.polyfit(speeds, VOLTS, 1)  # the ruler: the straight line that misses least
plot_misses(
    speeds, VOLTS, intercept=start, slope=slope, xlabel="velocity [m/s]", ylabel="voltage [V]"
)

# %%
pencil = {"kS": float(start), "kV": float(slope), "kA": 0.0}
truth = robot.gains


def off(gains: dict[str, float], name: str) -> str:
    """By how many percent a gain is off."""
    if not gains[name]:
        return "not known"
    return f"{100 * (gains[name] / truth[name] - 1):+.1f} %".replace("-", "−")


print(f"You said: {guess_pencil}.")
Table(
    ("who", "kS off by", "kV off by", "kA off by"),
    (
        ("the pencil", off(pencil, "kS"), off(pencil, "kV"), off(pencil, "kA")),
        ("three lines", off(measured, "kS"), off(measured, "kV"), off(measured, "kA")),
    ),
)

# %% [markdown]
# For kV it is a tie, or nearly. A good manual fit is *good*, and for kS it is often no worse either
# (SysId's kS comes out a little high on such logs; lesson 7 says why). A maintainer of WPILib
# calls this line "the better way" to find kS and kV by hand.
# ([frc-docs issue 2712](https://github.com/wpilibsuite/frc-docs/issues/2712))
#
# So the difference is not "human against computer". Look closely at what the pencil did: it did
# *not* turn a knob until it liked the result. It **wrote down what the robot did, and fitted a
# model to it**. That is system identification, done with a pencil.
#
# What the pencil lacks is kA, because it only looks at steady speeds.

# %% [markdown]
# ## 5 Two questions
#
# > **Lesson says:** SysId does not ask "what gain produces behavior I like", it asks "what physical
# > model best explains the data this mechanism actually produced".
# >
# > **Source says:** the same in drier words: system identification is finding a mathematical model
# > of a system "through statistical analysis of its inputs and outputs". And it adds that the model
# > "is not perfect", but usually good enough.
# > ([WPILib docs: Introduction to System Identification](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/system-identification/introduction.html))
# >
# > **Try it:** in the table of section 3, which row was made by which question?
#
# (You will see such boxes often. This course grew out of another lesson, the *source lesson*. Most
# of it is right. Where it is not, or where it says less than it should, the box quotes it, shows
# what the official documentation or the code says, and lets you try.)
#
# The two questions lead to different things:
#
# | | guessing | measuring |
# |---|---|---|
# | asks | which gain makes it behave as I like? | which model explains what it did? |
# | looks at | one drive, with one's eyes | every row of the log |
# | gives | a number that worked | a number with a meaning and a unit |
# | can be checked | by trying again | against motor, gears and mass (lesson 1) |
# | when it fails | one more knob | one can see *where* the model fails (lesson 9) |
#
# Is everybody convinced? No, and you should know that:
#
# > **Lesson says:** "Teams like 2910 and 254 characterize every motorized mechanism that needs
# > closed-loop control."
# >
# > **Source says:** (*closed-loop control* is feedback.) We could not check what these teams do. A
# > maintainer of WPILib writes in 2026
# > that the prevailing advice is to "avoid the SysId tool and do manual tuning instead", because
# > SysId is "error-prone".
# > ([allwpilib issue 8643](https://github.com/wpilibsuite/allwpilib/issues/8643))
# >
# > **Try it:** that is what this course is for. Each lesson makes one of those errors on purpose,
# > on a bench where the truth is known, until you recognize it.

# %% [markdown]
# ## 6 Week 3: a brace
#
# Two weeks later the mechanics bolt a steel brace onto the frame: **+4 kg**. Nobody tells the
# programmers.
#
# **Predict**, twice:

# %%
guess_gain = Prediction("Which gain of the robot moves?", "kS", "kV", "kA", "all three")
guess_worse = Prediction(
    "You keep the gains of your best try. Do you see that it drives worse?",
    "yes, clearly",
    "hardly",
    "not at all",
)
display(guess_gain, guess_worse)


# %%
def with_brace(kg: float) -> tuple[Mechanism, dict[str, float]]:
    """The same robot with a brace, and what three lines measure on it."""
    heavy = replace(robot, load=robot.load + kg)
    again = simulate(heavy, sim.Routine(ramp=1.0, step=2.0), rng=np.random.default_rng(3))
    return heavy, fit(again, method="sysid").gains


def week_three(kg: float) -> Picture:
    """The race once more, on a heavier robot."""
    heavy, again = with_brace(kg)
    racers = {
        "your best try, kept": drive(heavy, guessed),
        "three lines, kept": drive(heavy, measured),
        "three lines, measured again": drive(heavy, again),
    }
    return plot_tracking_error(TIME, TARGET, racers, title=f"+{kg:g} kg")


show_interactive(
    week_three,
    kg=widgets.FloatSlider(
        min=0, max=40, step=1, value=4, description="brace [kg]", continuous_update=False
    ),
)

# %% [markdown]
# No slider on your screen? Change the number here:

# %%
week_three(4.0)

# %%
BRACE = 4.0  # [kg]
heavy, again = with_brace(BRACE)
before = measure_tracking_error(TARGET, drive(robot, guessed)).typical
after = measure_tracking_error(TARGET, drive(heavy, guessed)).typical

print(f"You said: {guess_gain}; {guess_worse}.")
print(f"Your best try missed by {before:.3f} m/s before the brace, and by {after:.3f} m/s with it.")
Table(
    ("gain", "true before", "true with the brace", "measured before", "measured again", "unit"),
    tuple(
        (name, truth[name], heavy.gains[name], measured[name], again[name], unit)
        for name, unit in (("kS", "V"), ("kV", "V·s/m"), ("kA", "V·s²/m"))
    ),
    caption="Which of the true gains has moved?",
)

# %% [markdown]
# ### Explain
#
# Only **kA** has moved. At a steady speed nothing is being sped up, so it takes no more volts to
# move more mass: kV stays. (On a real robot a brace may add a little friction, too. The bench
# leaves that out.)
#
# > **Lesson says:** when the mechanism gets heavier, "the guesses stop being valid".
# >
# > **Source says:** only where they depend on mass. WPILib describes kS as what friction takes, kV
# > as what a constant velocity takes, and kA as what acceleration takes. Mass resists acceleration.
# > ([WPILib docs: Introduction to DC Motor Feedforward](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/introduction/introduction-to-feedforward.html))
# >
# > **Try it:** set the slider to 40 kg. Where does the robot miss more: on the ramps, or while it
# > holds a speed?
#
# So be fair to the guess: its kS and kV are as good or as bad as before, and it never had a kA. But
# it has no way to *notice* the brace either. A measurement does. Here is the course's own method
# (`fit` without `method="sysid"`; lesson 7 compares the two), before and after:

# %%
heavy_log = simulate(heavy, sim.Routine(ramp=1.0, step=2.0), rng=np.random.default_rng(3))
light_fit, heavy_fit = fit(log), fit(heavy_log)
growth = heavy_fit.gains["kA"] / light_fit.gains["kA"]
weighed = robot.load * (growth - 1)
print(f"kA grew by {100 * (growth - 1):.1f} %.  kA grows in step with mass, and we know the")
print(f"robot's old mass, {robot.load:.1f} kg. So the brace weighs {weighed:.2f} kg.")
sysid_growth = again["kA"] / measured["kA"]
print(f"(SysId's recipe, same logs: {100 * (sysid_growth - 1):.1f} %. Its kA is less sharp.)")

# %% [markdown]
# The log has *weighed* the brace. A gain that you like cannot do that; a gain that means something
# can.
#
# How much does 4 kg matter? It depends on what it is bolted to:

# %%
lift = MECHANISMS["elevator"]
rows = []
for name, one in (("your drivetrain", robot), ("an elevator's carriage", lift)):
    more = replace(one, load=one.load + BRACE).gains
    changes = [f"{100 * (more[gain] / one.gains[gain] - 1):.0f} %" for gain in ("kV", "kA")]
    gravity = f"{100 * (more['kG'] / one.gains['kG'] - 1):.0f} %" if "kG" in more else "none"
    rows.append((name, one.load, *changes, gravity))
Table(("where", "moves [kg]", "kV grows by", "kA grows by", "kG grows by"), tuple(rows))

# %% [markdown]
# (**kG** is the gain of gravity, for what moves up and down: lesson 2.)
#
# ### So, guess or measure?
#
# - For **kV**, and often for kS, a careful line by hand is as good as a fit. If that is all you
#   need, take the pencil.
# - For **kA**, and for **kG**, measuring wins. Nobody sees them in one steady speed.
# - When **something changes**, measuring wins: it tells what has changed, and by how much.
# - On a **damaged log**, measuring loses. A fit prints three neat numbers for nonsense, too. Lesson
#   6 teaches you to see that coming.
#
# ## 7 What you get for it
#
# Good gains pay more than once, because other code builds on them.
#
# **Drivetrain.** A path planner such as PathPlanner plans a drive that the robot then has to
# follow. It wants to know how hard the robot is to turn, its *moment of inertia* (MOI). Its docs
# give a formula for that: it takes two kA's, one measured while turning and one straight ahead.
# ([PathPlanner docs: Robot Config](https://pathplanner.dev/robot-config.html))
#
# **Arm.** A motion profile asks for a velocity and an acceleration at every moment, as our drive
# did. With good gains the arm follows, and the feedback has little left to correct. With bad ones
# the feedback works against the feedforward all the way.
#
# **Shooter.** Ask for 4000 rpm, by feedforward alone:

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
    ("gains", "reached [rpm]", "off 4000 rpm by"),
    tuple(
        (name, f"{rpm:.0f}", f"{round(rpm / 40 - 100, 1) + 0.0:+.1f} %".replace("-", "−"))
        for name, rpm in (
            ("measured", reached(wheel, gains)),
            ("kV guessed 5 % too low", reached(wheel, gains | {"kV": 0.95 * gains["kV"]})),
            ("measured, but a bearing has aged since", reached(worn, gains)),
        )
    ),
)

# %% [markdown]
# > **Lesson says:** the feedforward can "predict the exact voltage for 4000 RPM without needing PID
# > to compensate for model error".
# >
# > **Source says:** feedforward handles what we already know; feedback then compensates "for what
# > we do not or cannot know" while the robot runs.
# > ([WPILib docs: Feedforward Control](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/controllers/feedforward.html))
# >
# > **Try it:** the last row above. The gains were perfect, last month.
#
# Good gains leave little for the feedback to do. They do not replace it. And they are *yours*: the
# gains of another team's robot, or of a robot with other gears, are numbers of another machine.

# %% [markdown]
# ## 8 Your tools
#
# Three things come with this course, and all of them run on your own computer.
#
# | tool | what it is for |
# |---|---|
# | these notebooks | predict, run, explain; ten lessons, 0 to 9 |
# | `grade` | checks the exercises, gives hints, says what comes next |
# | `sysid` | simulates, reads, fits and inspects logs, also those of a real robot |
#
# You type the last two in a **terminal**, in the course's folder. If you read this in JupyterLab,
# they are installed. If not, or if one of them is "not found", this one line installs everything:
#
# ```
# python -m grader start
# ```
#
# (WPILib's own tool is called **SysId** as well. It is installed with WPILib and opens the same
# `.wpilog` files. This course explains what it does; you can use either.)
#
# ### Say who you are
#
# Once, in a terminal, with your own name (the one your teacher uses, if you are in a class):
#
# ```
# grade start --student ada
# ```
#
# From then on, every exercise gives *you* numbers that only you have: your own mechanism, your own
# log, with your own damage in it. Your neighbor's answers are of no use to you, but you can compare
# *how* you got there. The numbers lie in `exercises/exercise1/data/ada/given.toml`, and so on. In a
# class, your teacher may hand them out. (`NAME` at the top of this page is for the race only.)
#
# The next cell shows what is there for you:

# %%
made = sorted(Path("..", "exercises", "exercise1", "data").glob("*/given.toml"))
if made:
    given = tomllib.loads(made[0].read_text(encoding="utf-8"))
    print(f"{made[0].parent.name}: {given['mechanism']}, velocities in {given['velocity_unit']}")
    print(f"kS = {given['kS']} V, kV = {given['kV']}, kA = {given['kA']} (units: exercise 1)")
else:
    print("Nothing yet. In a terminal, in the course's folder:  grade start --student YOUR-NAME")

# %% [markdown]
# ### A first try
#
# In the terminal, these two lines do what lines one and two of the race did, for the bench's own
# drivetrain: run the four tests, and compute the gains.
#
# ```
# sysid simulate drivetrain --seed 1 -o drive.wpilog
# sysid fit drive.wpilog
# ```
#
# And this one says how far you are, and what comes next:
#
# ```
# grade
# ```

# %% [markdown]
# ## 9 System check
#
# Before you go on to lesson 1:
#
# - [ ] You ran every cell of this page, and the race has a try of yours in it.
# - [ ] `grade` works in a terminal, and knows your name.
# - [ ] `sysid fit drive.wpilog` printed three gains.
# - [ ] You can say in one sentence which question guessing asks, and which one SysId asks.
# - [ ] You know which gain a heavier robot moves.
#
# ## 10 Knowledge check
#
# First one to click; you are told at once. (No buttons on your screen? Type
# `quick.answer("kS")`, or another of the answers, in a cell.)

# %%
from grader import QuickCheck

quick = QuickCheck(
    "Which gain moved when the 4 kg brace came on?",
    {
        "kS": "Friction sits in gears and bearings. Four kilograms more hardly change it.",
        "kV": (
            "kV says what a steady speed costs. At a steady speed nothing is accelerated, "
            "so mass has no say."
        ),
        "kA": "kA is what mass costs: more kilograms, more volts for the same acceleration.",
    },
    right="kA",
)
quick

# %% [markdown]
# **1.** What question does guessing ask, and what question does SysId ask?
#
# <details><summary>Answer</summary>
#
# Guessing: which gain makes it behave the way I like? SysId: which model of the physics explains
# best what this mechanism did?
# </details>
#
# **2.** A teammate holds five steady voltages and draws a line. Which gains does that give, and how
# good are they?
#
# <details><summary>Answer</summary>
#
# kV (the slope) and kS (where the line meets velocity 0). Both are good: kV ties with the fit. It
# cannot give kA, because at a steady speed nothing accelerates.
# </details>
#
# **3.** The robot gets 4 kg heavier in week 3. Which of its gains has to change, and which not?
#
# <details><summary>Answer</summary>
#
# kA grows, in step with the mass. kV follows from motor, gears and wheels, and kS from friction;
# neither asks how heavy the robot is. (For an elevator or an arm, kG grows, too.)
# </details>
#
# **4.** "We measured our gains, so we do not need PID." What do you say?
#
# <details><summary>Answer</summary>
#
# The gains were measured on one day, and no model is perfect. Bearings age, belts stretch, somebody
# pushes. Feedback takes care of what the feedforward cannot know. Good gains leave it little to do.
# </details>
#
# **5.** What else, beside the feedforward, is a drivetrain's kA good for?
#
# <details><summary>Answer</summary>
#
# It tells how hard the robot is to speed up: its mass. With a second kA, measured while turning, a
# formula gives the robot's moment of inertia (lesson 8). And a kA that jumps from one week to
# the next says that something was added.
# </details>

# %% [markdown]
# ## 11 Practice
#
# **Exercise 11** (`exercises/exercise11/README.md`) has the knowledge checks of the whole course.
# Its first three questions, under *Guessing and measuring*, are about this page. Answer them now,
# and leave the rest empty until lesson 8. In a terminal:
#
# ```
# grade exercise11
# ```
#
# Or in a notebook, with the letters of your own question sheet:
#
# ```python
# from grader import submit
#
# submit("exercise11", Q0_guess="...", Q0_sysid="...", Q0_brace="...")
# ```
#
# It writes your answers into `exercises/exercise11/answers.toml` and shows the result. Hints cost
# nothing: `grade exercise11 --hint`.
#
# **More, if you like.**
#
# - Race with a third knob: give `attempt` a `ka`, and `show_interactive` a slider for it. Can
#   you tie with the three lines now? How long does it take?
# - Use your neighbor's gains on your robot: `drive(robot, {...})`. Which of the three hurts most?
# - Write another name above, and run the page again: *Run*, *Run All Cells*.
#
# Next: lesson 1, the motor model. Where do kS, kV and kA come from?
