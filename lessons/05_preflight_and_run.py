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
# # Lesson 5: Pre-flight and the first run
#
# *About 40 minutes. You need lessons 3 and 4. You can read it without a robot. Print sections 5 and
# 6, and take them to the robot.*
#
# ![The speed of a robot over its distance from the start, with a wall at 12 m. A robot that is
# stopped at a tape stands still before the wall. Without a tape, it hits the wall at 3
# m/s.](attachment:picture.png)
#
# **At the end you can**
#
# - name the four steps of a characterization;
# - choose the place of the tape on the floor, and say where the robot will stop;
# - decide *go* or *no-go* from five checks, and say which problem each check prevents;
# - find your log on a roboRIO (2026) and on a Systemcore (2027);
# - run the four tests on a real robot, and find out within a minute whether the log is good.

# %% [markdown]
# ## 1 Why: for ten seconds, nobody steers
#
# A SysId test drives your mechanism with a voltage that grows (the *ramp*, or quasistatic test) or
# with a constant voltage (the *step*, or dynamic test). The code of the test does not check where
# the mechanism is. The person at the button has to stop it.
#
# So before the test you decide how far it may move, and check that everything is ready. Pilots call
# this a *pre-flight check*. It takes five minutes. In this lesson you skip one check at a time and
# see what happens.
#
# ### The four steps
#
# Click each step to see what you do, and why.
#
# <details><summary>Step 1: wire the routine (lesson 4)</summary>
#
# **What:** add a `SysIdRoutine` to the subsystem, and bind its four tests to four buttons. **Why:**
# the log contains only what your two callbacks set and write. A wrong unit here makes every later
# number wrong.
# </details>
#
# <details><summary>Step 2: run the tests (this lesson)</summary>
#
# **What:** make five checks, run the four tests, fetch the log. **Why:** nothing steers during a
# test. And the ramps show kS and kV, the steps show kA: without both ramps or both steps, a
# gain is missing.
# </details>
#
# <details><summary>Step 3: inspect, then fit (lessons 6 and 7)</summary>
#
# **What:** look at the data first, cut off what is damaged, then compute the gains. **Why:** a fit
# always gives numbers, also for a log in which the robot hits a wall.
# </details>
#
# <details><summary>Step 4: place the gains (lesson 8)</summary>
#
# **What:** put the gains with their units into the constants, and give them to the feedforward.
# **Why:** in the wrong place or unit, a right gain gives a wrong voltage, without any error
# message.
# </details>
#
# The order matters: if nobody looked at the data, you cannot trust the gains.
#
# <details><summary>For mentors: where the four steps come from</summary>
#
# > **Lesson says:** "The SysId Process: Four Steps … Click each step to understand what you're
# > doing and why."
# >
# > **Source says:** WPILib's pages have this order: create the routine, run it, load the data, view
# > diagnostics, analyze. ([WPILib docs: System
# > Identification](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/system-identification/index.html))
# > The text of the source lesson names only the first of the four steps. Its other steps were on a
# > page that opens with a click, and we could not see them. So the other three steps are our
# > interpretation.
# >
# > **Try it:** close all steps, and write the four down in order. Exercise 6 asks for them.
# </details>

# %%
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from IPython.display import display

import sim
from grader import ask_question, enable_checkboxes
from sim.bench.mechanisms import MECHANISMS
from sim.bench.simulate import simulate
from sim.fit import fit
from sim.inspect.contaminate import contaminate
from sim.inspect.detect_faults import inspect
from sim.physics.battery import Battery
from sim.plot import Table, plot_time_series, tabulate_gains
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
from sim.plot.animation.charts import Chart, Curve, animate_charts
from sim.teaching.logs import apply_mistake
from sim.teaching.runway import GRIP, THUMB, Floor, drive_test

ROBOT = replace(MECHANISMS["drivetrain"], travel=None)  # nobody ends its tests but you
TRUTH = ROBOT.gains
print(ROBOT.summary)
tabulate_gains(
    {"our robot": TRUTH}, caption="We know the true gains, because the robot is simulated."
)

# %% [markdown]
# ## 2 The model: how far does a test go?
#
# In a ramp the voltage grows by `r` volts per second. Nothing moves until the voltage is above kS.
# Then the speed grows by `r/kV` each second. So after `t` seconds of motion
#
# > v ≈ r·t / kV,  and the distance is  d ≈ r·t² / (2·kV) = kV·v² / (2·r)
#
# The motors drive until you let go of the button. Then the motors brake, if their neutral mode is
# *Brake* (the neutral mode says what a motor does at 0 V). The wheels can only brake as hard as
# they grip the carpet. So the robot needs at least `v² / (2·μ·g)` more meters to stop, with g =
# 9.81 m/s² and the grip μ (about 1.1 for wheels on carpet, less on a smooth floor).
#
# **Predict:**

# %%
display(ask_question("lesson5.room"), ask_question("lesson5.ten"))

# %%
RAMP, STEP = "quasistatic-forward", "dynamic-forward"
FOOT = 0.3048  # [m]
HALL = Floor(wall=60.0)  # so long that nothing is ever hit


rows = []
for ramp in (0.25, 0.5, 1.0, 2.0):
    went = drive_test(ROBOT, sim.Routine(ramp=ramp, timeout=11.0 / ramp), test=RAMP, floor=HALL)
    fast, ten = np.argmax(went.velocity >= 2.0), np.argmax(went.position >= 10 * FOOT)
    rule = TRUTH["kV"] * 2.0**2 / (2 * ramp)
    rows.append((ramp, went.time[fast], went.position[fast], rule, went.velocity[ten]))

slow = drive_test(ROBOT, sim.Routine(ramp=0.5, timeout=10.0), test=RAMP, floor=HALL)
gone = slow.final_position
print(f"With 0.5 V/s for 10 s, the robot drives {gone:.1f} m, or {gone / FOOT:.0f} feet.")
HEADER = ("2 m/s after [s]", "distance until then [m]", "kV·v²/(2·ramp) [m]", "m/s after 10 feet")
Table(("ramp [V/s]", *HEADER), tuple(rows))

# %% [markdown]
# "Slow is safe" is wrong here. With a slow ramp the robot drives for a long time and needs more
# room. In a short room, use a steeper ramp. (But then the kS that you read off is too large: lesson
# 3.)
#
# WPILib asks for "at least 10' of space, ideally closer to 20'" (10 feet are 3 m). CTRE recommends
# 15 m. The last column shows how fast the robot is after 10 feet: you get only *some* data, and the
# robot still needs room to brake. With more room it gets faster, and you need speed to measure kV.
#
# <details><summary>For mentors: how much room, with sources</summary>
#
# > **Lesson says:** "clear at least 10 feet forward and 10 feet back (more is better for
# > quasistatic)".
# >
# > **Source says:** WPILib recommends "at least 10' of space, ideally closer to 20'", and says that
# > the drive "can not be accurately characterized while on blocks". CTRE recommends 15 m. ([WPILib
# > docs: Running the
# > Routine](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/system-identification/running-routine.html),
# > [CTRE docs: Plumbing & Running
# > SysId](https://github.com/CrossTheRoadElec/Phoenix6-Documentation/blob/079a28341bc1ed380f3a4bc6e9fcec300517eabb/source/docs/api-reference/wpilib-integration/sysid-integration/plumbing-and-running-sysid.rst))
# >
# > **Try it:** the last column of the table shows how fast the robot is after 10 feet.
# </details>
#
# **On blocks**, the wheels are in the air, and the motors turn only the wheels. Suppose that the
# load on the motors is then a tenth of the robot's mass:

# %%
routine = sim.Routine(ramp=1.0, step=3.5, timeout=10.0)
on_blocks = simulate(replace(ROBOT, load=6.0), routine, rng=np.random.default_rng(5))
lifted = fit(on_blocks, method="sysid").gains
print(f"On blocks, the fit gives {lifted['kV'] / TRUTH['kV']:.2f} times the true kV")
print(f"and {lifted['kA'] / TRUTH['kA']:.2f} times the true kA.")

# %% [markdown]
# Here kV is almost right (a real robot also has less friction on blocks). But kA on blocks only
# describes wheels and motors. Why is it not exactly a tenth? On blocks kA/kV is only 8 ms, less
# than one row of the log. So the fit cannot measure kA well (lesson 1, section 6).
#
# So test on the floor, and compute the space you need.

# %% [markdown]
# ## 3 Doing it: the runway
#
# Now you press the button. The wall is 12 m away, and there is tape on the floor. You let go of the
# button 0.3 s after the front bumper passes the tape.
#
# The ramp is 1 V/s, the step is 3.5 V, and the timeout is 10 s.
#
# **Predict:**

# %%
ask_question("lesson5.stop")

# %% [markdown]
# Move the sliders, and press *Play*. "reaction" is the time from the tape until you let go.

# %%
WALL = 12.0  # [m]


def press_button(**volts: float) -> Scene:
    """One test in our hall, with the tape and the reaction of the sliders."""
    plan = TestPlan(mark=Gain("tape"), reaction=Gain("reaction"), timeout=routine.timeout, **volts)
    return Scene(np.arange(0.0, 12.0, 0.02), (Motion("robot", gains=TRUTH, plan=plan),))


animate_mechanism(
    "drivetrain",
    {
        ("ramp",): press_button(ramp=routine.ramp),
        ("step",): press_button(step=routine.step),
    },
    choices=(Choice("test", ("ramp", "step")),),
    knobs=(
        Knob("tape", "tape [m]", low=1.0, high=11.5, step=0.1, value=7.0),
        Knob("reaction", "reaction [s]", low=0.1, high=1.5, step=0.05, value=THUMB),
    ),
    panels=(Panel("velocity", "speed [m/s]", low=0.0, high=4.5),),
    span=(-1.0, WALL),
    wall=WALL,
    marks={"tape": Gain("tape")},
    alt="A robot drives toward a wall at 12 m. A strip of tape lies at 7 m. The motors are on "
    "until 0.3 s after the tape. In the ramp test, the robot stops about 1 m past the tape.",
)

# %% [markdown]
# (This is simplified: our simulated wheels never slip, neither in a step nor when the motors
# brake.)

# %%
went = drive_test(ROBOT, routine, test=RAMP, floor=Floor(wall=WALL, tape=7.0))
top = float(went.velocity.max())
let_go = float(np.interp(went.released, went.time, went.position))
print(f"The robot stops {went.final_position - 7.0:.2f} m past the tape:")
print(f"  {let_go - 7.0:.2f} m until you react, and {went.final_position - let_go:.2f} m to brake.")
print(f"  The formula v²/(2·μ·g) gives {top**2 / (2 * GRIP * 9.81):.2f} m at {top:.2f} m/s.")

# %% [markdown]
# To place the tape, start at the wall and go back by the reaction distance, the braking distance
# and a reserve. You need tape for each direction.
#
# ### Now skip a check
#
# In each row, one of the five checks was skipped. Everything else stays the same:
#
# | skipped | what was wrong that morning |
# |---|---|
# | 1 room | there is no tape on the floor, so you do not know when to let go |
# | 2 battery | the battery is old (35 mΩ) and nearly empty (11.6 V at rest) |
# | 3 encoder | the encoder is inverted: when the robot drives forward, the logged position falls |
# | 4 log | nobody knows where the robot saves the log |
# | 5 guard | no guard locks the tests: somebody presses a button in the pit, 1 m from a wall |
#
# **Predict:**

# %%
ask_question("lesson5.check")

# %%
TIRED = replace(ROBOT, battery=Battery(rest=11.6, resistance=0.035))
SKIPS = ("2 battery", "nothing", "1 room", "3 encoder", "4 log", "5 guard")
TESTS = {"step": STEP, "ramp": RAMP}


def skip_check(skipped: str, test: str) -> Scene:
    """What happens on the floor when a check was skipped, and which speed the log shows."""
    floor, start = Floor(wall=WALL, tape=None if skipped == "1 room" else 7.0), 0.0
    if skipped == "5 guard":
        floor, start = Floor(wall=1.0, watched=1.0), WALL - 1.0  # Disable takes a second
    robot = TIRED if skipped == "2 battery" else ROBOT
    went = drive_test(robot, routine, test=TESTS[test], floor=floor)
    logged = -went.velocity if skipped == "3 encoder" else went.velocity
    where = start + went.position
    return Scene(went.time, (Motion("robot", logged, where, voltage=went.battery),))


animate_mechanism(
    "drivetrain",
    {(skipped, test): skip_check(skipped, test) for skipped in SKIPS for test in TESTS},
    choices=(Choice("skipped", SKIPS), Choice("test", tuple(TESTS))),
    panels=(
        Panel("velocity", "logged speed [m/s]"),
        Panel("voltage", "battery [V]", low=0.0, high=13.0),
    ),
    span=(-1.0, WALL),
    wall=WALL,
    alt="A robot drives toward a wall at 12 m, after one of five checks was skipped. Below are the "
    "speed in the log and the battery voltage. With an old, empty battery, the step test pulls "
    "the voltage below 6.75 V again and again, and the robot hardly moves.",
)

# %% [markdown]
# With "2 battery", the step test draws so much current that the battery voltage falls below 6.75 V.
# Then the robot controller turns the motors off to protect itself: this is a *brownout*. The
# battery recovers, the motors start, and the voltage falls again. The robot hardly moves. (On a
# real robot, you would see the same, but more slowly.) Then choose the other checks.
#
# ### Which logs are good?
#
# Without check 4 there is no log at all. For each row of the next table, the robot ran all four
# tests, and SysId's method computed the gains. A value of 1 means that the gain is right. The
# program `sysid inspect` looks for known faults (lesson 6).

# %%
at_tape = replace(ROBOT, travel=7.0)  # you let go at the tape
sound = simulate(at_tape, routine, rng=np.random.default_rng(5))
untaped = simulate(ROBOT, routine, rng=np.random.default_rng(5))
hit = drive_test(ROBOT, routine, test=RAMP, floor=Floor(wall=WALL)).hit_wall
into_wall = contaminate(
    untaped, "hard-stop", severity=3, test=RAMP, at=hit, rng=np.random.default_rng(1)
)
logs = {
    "nothing": sound,
    "1 room": into_wall.log,
    "2 battery": simulate(TIRED, routine, rng=np.random.default_rng(5)),
    "3 encoder": apply_mistake(sound, factor=-1.0),
    "5 guard": sound,
}

rows = []
for name, log in logs.items():
    found, seen = fit(log, method="sysid"), inspect(log)
    names = {damage.fault for damage in seen.damages} | {doubt.code for doubt in log.doubts}
    ratios = [found.gains[gain] / TRUTH[gain] for gain in ("kS", "kV", "kA")]
    rows.append((name, ", ".join(sorted(names)) or "nothing", *ratios))
Table(("skipped", "found in the log", "kS ÷ true", "kV ÷ true", "kA ÷ true"), tuple(rows))

# %% [markdown]
# ### Explain
#
# - **1 room.** The robot hits the wall. The log is wrong, too: at the wall there is voltage without
#   speed. One bad ramp makes all gains wrong.
# - **2 battery.** The Driver Station shows the brownout. `sysid inspect` finds it, because the
#   applied voltage drops to 0 again and again.
# - **3 encoder.** On the floor, *everything looks normal*. No person notices the mistake until
#   every gain is negative; `sysid inspect` finds the `sign-flip`.
# - **4 log.** The tests went well, but you cannot find the log, so you have nothing to fit.
# - **5 guard.** In the step test the robot hits the wall, and may hurt somebody. The log of later
#   tests is good, and does not show this accident.

# %% [markdown]
# ## 4 Five checks, and the reasons for them
#
# ### Room
#
# Clear the way in **both** directions, on the carpet that the robot will drive on. Compute the
# distance (section 2), put tape down, and let a second person watch the tape. Move an arm or an
# elevator by hand from end to end: nothing may block it, and no cable may be too short.
#
# Make the **timeout** only as long as your plan needs: it ends the test if you forget to let go.
# Begin with a **small voltage step**. The wheels of a strong, light drivetrain slip even below 3 V
# (lesson 4).
#
# ### Battery
#
# A charged battery shows 12.7 V or more with nothing connected. At 12 V there is no brownout yet: a
# roboRIO 1 disables the motors below 6.3 V, and a roboRIO 2 below 6.75 V, unless you change this
# limit. Does an old or empty battery make kA wrong? The next cell runs the tests with two batteries
# and two step voltages. It computes kA once from the voltage that was **applied** to the motors,
# and once from the voltage that the code **commanded**.
#
# <details><summary>For mentors: batteries below 12 V, with source</summary>
#
# > **Lesson says:** "A battery below 12V produces unreliable kA values and may brownout mid-test".
# >
# > **Source says:** a roboRIO 1 disables the motors below 6.3 V. On a roboRIO 2 you can set this
# > limit; its default is 6.75 V. A voltage below 12 V is not yet a brownout. ([WPILib docs:
# > Brownouts, at one
# > commit](https://github.com/wpilibsuite/frc-docs/blob/c6315dc0701cb74273487d6e303a8cc5098a8462/source/docs/software/roborio-info/roborio-brownouts.rst))
# >
# > **Try it:** the next cell runs the tests with two batteries and two step voltages, and fits the
# > **applied** voltage and the **commanded** voltage.
# </details>


# %%
def as_asked(log: sim.Log, routine: sim.Routine) -> sim.Log:
    """The same runs, but the log holds the commanded voltage."""
    runs = []
    for run in log.runs:
        since = run.time - run.time[0] + 0.04  # a test drives from its third loop on
        asked = np.array([routine.command_voltage(run.test, t) for t in since])
        runs.append(replace(run, voltage=asked))
    return replace(log, runs=tuple(runs))


rows = []
for name, robot in (("charged", ROBOT), ("tired", TIRED)):
    for step in (2.0, 3.5):
        one = replace(routine, step=step)
        log = simulate(robot, one, rng=np.random.default_rng(5), electrical=True)
        lowest = min(float(run.bus_voltage.min()) for run in log.runs)
        ka = [fit(each, method="sysid").gains["kA"] for each in (log, as_asked(log, one))]
        out = "brownout" if lowest < robot.brownout else "no"
        rows.append((f"{name}, {step:g} V", lowest, out, *(each / TRUTH["kA"] for each in ka)))

Table(
    (
        "battery, step",
        "lowest voltage [V]",
        "brownout?",
        "kA ÷ true, applied voltage",
        "kA ÷ true, commanded voltage",
    ),
    tuple(rows),
    caption=f"In an idle robot, the charged battery has {ROBOT.battery.rest} V. The tired battery "
    f"is old and has {TIRED.battery.rest} V.",
)

# %% [markdown]
# The picture shows the battery voltage just after a step, while the motors still stand and take
# most current. (The line gets flat where the motors' limit of 120 A acts. It ends where the battery
# cannot give more power.) Set your own battery, as the battery tester shows it. From which step on
# is there a brownout, if at all?


# %%
def battery_chart(rest: float, resistance: float) -> Chart:
    """The battery voltage just after a step of each voltage, until half of ``rest``."""
    steps = np.arange(0.0, 7.01, 0.25)
    currents = np.minimum(steps / ROBOT.motor.resistance, ROBOT.stator)
    power = ROBOT.motor_count * ROBOT.motor.resistance * currents**2
    root = rest**2 - 4e-3 * resistance * power
    can = root >= 0.0
    bus = (rest + np.sqrt(root[can])) / 2
    brownout = Curve("brownout of a roboRIO 2", [0.0, 7.0], [6.75, 6.75], "dashed")
    return Chart("step [V]", "battery voltage [V]", (Curve("battery", steps[can], bus), brownout))


animate_charts(
    battery_chart,
    knobs=(
        Knob("rest", "at rest [V]", low=11.0, high=13.0, step=0.1, value=12.6),
        Knob("resistance", "resistance [mΩ]", low=10.0, high=40.0, step=2.5, value=20.0),
    ),
)

# %% [markdown]
# Without a brownout, both kA columns are right, even with the tired battery: this robot calls
# `setVoltage`, and its motor controllers compensate for the lower battery voltage. With `set`, the
# controllers do not do this (lesson 4). With a brownout, both columns are wrong, and kA from the
# commanded voltage is far worse. So charge the battery, begin with a small step, and log the
# applied voltage.
#
# Require **more than 12.5 V at rest**, and 20 mΩ or less on a battery tester.
#
# <details><summary>Want to know why 12.5 V?</summary>
#
# The source lesson requires at least 12 V at rest. But a lead-acid battery at 12.0 V is half empty
# or worse. According to one table of voltages, only a quarter of the charge is left ([the table, at
# one
# commit](https://github.com/age-series/ElectricalAge2/blob/5ea25a23cbcb7443347505035cc4ea10f73b5002/src/main/resources/assets/eln2/datasets/lead_acid_12v/ds.csv)).
# WPILib's docs give 12.7 to 13.5 V for a full battery with nothing connected, and say that a
# battery at 12.5 V on an idle robot "should be swapped and charged". These docs also say that you
# should not use a battery of more than 20 mΩ in matches. ([WPILib docs: Robot Battery Basics, at
# one
# commit](https://github.com/wpilibsuite/frc-docs/blob/e44bb36208e3eba33216b9b9f1dfca4339e4cc40/source/docs/hardware/hardware-basics/robot-battery.rst))
# </details>
#
# ### Encoder
#
# Disable the robot and push the mechanism **forward** by hand. On the dashboard or in
# AdvantageScope, the position must **rise** smoothly, and the velocity must be positive. Then
# enable the robot, and hold the button *quasistatic forward* until the mechanism begins to move: it
# must move forward, too. (An elevator moves up only above kG + kS, an arm only above kG·cos(θ) +
# kS.) The most important check is that a positive voltage gives a positive velocity. SysId's score
# R² stays high even if the velocity has the wrong sign (lesson 6).
#
# ### Log
#
# Before the first test, fetch an **older** log, as practice. Section 5 shows where logs are.
#
# ### Guard
#
# A guard is the condition in your code that locks the tests (lesson 4 shows three kinds). Check
# that it locks them: if Test mode (*Utility* mode in 2027) is your guard, enable the robot in
# Teleop. Press all four buttons. Nothing may move. During the tests, the only job of
# one person is to press *Disable*. In the 2026 Driver Station the **Enter** key disables the robot.
# The **space bar** is the emergency stop: it works even if another window is in front, and you have
# to reboot the roboRIO afterwards. ([WPILib docs: Driver
# Station](https://docs.wpilib.org/en/stable/docs/software/driverstation/driver-station.html))
#
# Safety code in your own *commands* does not run during a test. Limits *in the motor controller*
# work, if you have set them (lesson 4). The next cell sets a current limit of 40 A per motor and
# runs the tests.
#
# <details><summary>For mentors: which limits work in a test?</summary>
#
# > **Lesson says:** "There is no position limit, no current limit bypass protection, and no
# > closed-loop correction."
# >
# > **Source says:** the last part of the lesson's sentence is true. During a test, nothing corrects
# > the motion (this is called *open loop*). But limits *in the motor controller* go on working in a
# > test, if you have set them: "it is up to you to set up hard or soft limits to prevent injury or
# > damage". Only the safety code in your own **commands** does not run, because no other command
# > can use the subsystem during a test. ([WPILib docs: Running the
# > Routine](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/system-identification/running-routine.html))
# >
# > **Try it:** the next cell sets a current limit of 40 A per motor and runs the tests.
# </details>

# %%
weak = replace(ROBOT, stator=40.0)
limited = simulate(weak, routine, rng=np.random.default_rng(5), electrical=True)
highest = max(float(np.abs(run.current).max()) for run in limited.runs)
arrived, asked = (
    fit(one, method="sysid").gains["kA"] / TRUTH["kA"]
    for one in (limited, as_asked(limited, routine))
)
print(f"The highest current of a motor in all four tests is {highest:.0f} A: the limit acts.")
print(f"With the applied voltage, the fit gives {arrived:.2f} times the true kA.")
print(f"With the commanded voltage, it gives {asked:.2f} times the true kA.")

# %% [markdown]
# So the limit **protects** you. But while a limit acts, a log of the commanded voltage is wrong.
#
# Two more rules:
#
# - **One mechanism per log.** WPILib says: if you run a second routine "without extracting the log
#   or power-cycling the roboRIO in between, analysis will fail".
# - **Each test once.** If one test went wrong, begin a new log and run all four again. (If a log
#   contains a test twice, SysId 2026 uses the first one.)

# %% [markdown]
# ## 5 Where is my log?
#
# ```
# Who wrote it?
# ├─ WPILib (DataLogManager; the routine of lesson 4 uses it): a .wpilog file
# │   Was a Driver Station connected while the program ran?
# │   ├─ no  → the file's name contains TBD, and the next start of the program deletes the file
# │   └─ yes → is there a USB stick in the controller (for a roboRIO: formatted FAT32)?
# │       ├─ yes → the folder logs on the stick: /u/logs on a roboRIO
# │       └─ no  → which controller?
# │           ├─ roboRIO (2026)    → /home/lvuser/logs
# │           └─ Systemcore (2027) → /home/systemcore/logs
# ├─ CTRE SignalLogger: a .hoot file → Tuner X, Log Extractor (section 6)
# ├─ URCL (REV motors): it is inside the .wpilog → export it with AdvantageScope (section 6)
# ├─ REVLib 2026, by itself: a .revlog file (section 6)
# └─ AdvantageKit: a .wpilog file of its own (section 6)
# ```
#
# <details><summary>For mentors: the log folder, with sources</summary>
#
# > **Lesson says:** "the default path is /home/lvuser/logs/. Retrieve them via the Driver Station
# > log folder tool or AdvantageScope's file fetch feature."
# >
# > **Source says:** if there is a USB stick, the folder is `/u/logs`. The Driver Station copies
# > logs only if you ticked *Upload WPILogs* (gear icon). It copies them into
# > `C:\Users\Public\Documents\FRC\Log Files\WPILogs`. The Data Log Tool and AdvantageScope can
# > always fetch logs. But on a competition field the radio's firewall blocks them: use a USB cable
# > there. ([WPILib docs: Downloading Data
# > Logs](https://docs.wpilib.org/en/stable/docs/software/telemetry/datalog-download.html), [Data
# > Logs](https://docs.wpilib.org/en/stable/docs/software/telemetry/datalog.html))
# >
# > **Try it:** find the folder for your robot in the tree above.
# </details>

#
# <details><summary>Four ways to fetch the log, step by step</summary>
#
# WPILib's Data Log Tool and AdvantageScope can always fetch the log. (On a competition field, use a
# USB cable: the firewall of the radio blocks them.) The Driver Station copies logs only if you
# ticked *Upload WPILogs*.
#
# - **AdvantageScope:** *File* > *Download Logs…*. You should see a list of logs, with the newest at
#   the top. Select a log, then click the ↓ sign. If AdvantageScope finds no robot, set the robot's
#   address and the log folder in the preferences (*App* > *Show Preferences…*).
# - **Data Log Tool:** type your team number, the user `lvuser` and no password, then *Connect*. Go
#   to the log folder, tick the file, and click *Select Download Folder…*, then *Download*. You
#   should see *Download complete!*
# - **Driver Station:** click the gear icon and tick *Upload WPILogs* **before** you run the tests.
#   The file then appears on the laptop, in `C:\Users\Public\Documents\FRC\Log Files\WPILogs`.
# - **The USB stick:** switch the robot off and pull the USB stick out. The logs are in its folder
#   `logs`.
# </details>
#
# <details><summary>For 2027: what is not settled yet</summary>
#
# Systemcore and its tools are new. The folders above, and file names that begin with WPILIB instead
# of FRC, come from WPILib's development branch. The folder of a USB stick on a Systemcore is not
# settled: WPILib's code says `/u/logs`, but teams that test a Systemcore report `/U/logs`. If
# something looks different, follow the docs of your season.
# </details>

# %% [markdown]
# ## 6 On the real robot, step by step
#
# 1. **Add the routine** (lesson 4), and `DataLogManager.start()` where the robot program starts.
#    Deploy: in VS Code `Ctrl+Shift+P`, *WPILib: Deploy Robot Code*. *Expect:* the Driver Station
#    shows *Robot Code* in green.
# 2. **Make the five checks.** *Expect:* five times *go*.
# 3. **Power-cycle** the robot (off and on), so that the log contains nothing else.
# 4. **Driver Station:** choose *Test* if Test mode is your guard, then *Enable*. *Expect:* nothing
#    moves.
# 5. Hold the button **quasistatic forward** until the robot reaches the tape. *Expect:* a slow
#    start, then more and more speed, for at least 3 s.
# 6. Hold the button **quasistatic reverse**. *Expect:* the same, but backward.
# 7. Hold the button **dynamic forward** until the speed is steady, at most until the tape.
#    *Expect:* a sudden start, then a steady speed.
# 8. Hold the button **dynamic reverse**. *Expect:* the same, but backward.
# 9. **Disable.** Fetch the log (section 5). *Expect:* one new `.wpilog`.
# 10. Type `sysid inspect FILE.wpilog`. *Expect:* 4 runs, no fault found.
# 11. Type `sysid fit FILE.wpilog --method sysid`. *Expect:* a positive kV and a positive kA.
#
# You may run the four tests in any order.
#
# **Do step 10 before anybody packs up.** Repeating a test takes five minutes today, but a whole
# evening tomorrow.
#
# Here are steps 9 to 11 with a simulated log:

# %%
with TemporaryDirectory() as place:
    path = Path(place, "FRC_20260214_153000.wpilog")
    sim.write(sound, path)
    mine = sim.read(path)

checked = inspect(mine)
print(f"{len(mine.runs)} runs, {len(checked.damages) or 'no'} fault found")
plot_time_series(mine, dynamic_seconds=1.0)

# %%
tabulate_gains({"the log": fit(mine, method="sysid").in_log_units().gains})

# %% [markdown]
# In a terminal, with your own file, type:
#
# ```
# sysid inspect FRC_20260214_153000.wpilog
# sysid fit FRC_20260214_153000.wpilog --method sysid
# ```
#
# An arm or an elevator needs `--type arm` or `--type elevator`. If your log has several motors,
# name one motor: `--motor left`.
#
# <details><summary>If the entries in your log have other names</summary>
#
# Give their names with the options `--voltage`, `--position`, `--velocity` and `--state`.
# </details>
#
# <details><summary>The same file in WPILib's SysId, in five steps</summary>
#
# In VS Code press `Ctrl+Shift+P`, and choose *WPILib: Start Tool*, *SysId*. The drawings show where
# you click (`►`); the numbers are those of one log.
#
# 1. *Log Loader*: *Open data log file…*
#
# ```
# ┌ Log Loader ────────────────────────────────┐
# │ ► [Open data log file...]                  │
# │   Filter: [                              ] │
# └────────────────────────────────────────────┘
# ```
#
# 2. Type `sysid-test-state` into *Filter*. Drag that entry to *Test State*.
#
# ```
# ┌ Log Loader ────────────────────────────────┐    ┌ Data Selector ─────────────────────────┐
# │   Filter: [sysid-test-state              ] │    │ Test State: <none (DROP HERE)> (string)│
# │ ► sysid-test-state-drive           string  │ ──►│                                        │
# └────────────────────────────────────────────┘    └────────────────────────────────────────┘
# ```
#
# 3. Empty *Filter*. Drag *Velocity*, *Position* and *Voltage* of one motor to their slots.
# 4. Check the *Analysis Type*: it starts on *Elevator*. Choose the *Units* of your log. Click
#    *Load*, then *Ok*.
#
# ```
# ┌ Data Selector ─────────────────────────────┐    ┌ Data Selector ─────────────────────────┐
# │   Test State: sysid-test-state-drive       │    │   Test State: quasistatic-forward      │
# │ ► Analysis Type  [Simple              ▼]   │    │     Run 1 samples: 412 Volt 412 Pos    │
# │ ► Velocity: <none (DROP HERE)> (number)    │    │   Test State: quasistatic-reverse      │
# │ ► Position: <none (DROP HERE)> (number)    │ ──►│     Run 1 samples: 407 Volt 407 Pos    │
# │ ► Voltage: <none (DROP HERE)> (number)     │    │   ...                                  │
# │ ► Units  [Meters ▼]                        │    │ ► [Ok]                                 │
# │   Velocity scaling  [1.000]                │    └────────────────────────────────────────┘
# │ ► [Load]                                   │
# └────────────────────────────────────────────┘
# ```
#
# 5. Look at the plots first (lesson 6), forward and backward, then at the gains.
#
# ```
# ┌ Diagnostic Plots ──────────────────────────┐    ┌ Analyzer ──────────────────────────────┐
# │ ► Direction [Forward ▼]                    │    │ Feedforward Analysis                   │
# │   (velocity, acceleration, time steps)     │    │  Ks [0.151]    ► Window Size        [1]│
# │   Acceleration R²  [0.74]                  │    │  Kv [2.518]    ► Velocity Threshold    │
# │   Sim velocity R²  [0.99]                  │    │  Ka [0.192]    ► Test Duration         │
# │   Sim velocity RMSE [0.02]                 │    │ Feedback Analysis                      │
# └────────────────────────────────────────────┘    └────────────────────────────────────────┘
# ```
#
# ([WPILib docs: Loading
# Data](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/system-identification/loading-data.html),
# SysId's source, at one commit each:
# [DataSelector.cpp](https://github.com/wpilibsuite/allwpilib/blob/047efb4d0e9298b39fff2035ac9ae66f296e39f6/sysid/src/main/native/cpp/view/DataSelector.cpp),
# [Analyzer.cpp](https://github.com/wpilibsuite/allwpilib/blob/29a7e4069305ec1e271c14d1e1364fef9c3162a9/sysid/src/main/native/cpp/view/Analyzer.cpp))
#
# The window shows three numbers that say how good the fit is: *acceleration R²*, *simulated
# velocity R²* and *simulated velocity RMSE*. ([WPILib docs: Viewing Diagnostics, at one
# commit](https://github.com/wpilibsuite/frc-docs/blob/29e2f6a9fcb7b1f342f094f7725f7bb4e038b905/source/docs/software/advanced-controls/system-identification/viewing-diagnostics.rst))
#
# **Do it** with your own file, for one motor. Write down kS, kV, kA and these three numbers. Then
# type `sysid fit FILE.wpilog --method sysid`: it uses the window's recipe, and shows the same
# numbers. If they differ, compare type, units, motor and *Velocity Threshold*.
# </details>

# %% [markdown]
# ### Motors from CTRE or REV?
#
# The steps above work for all motors. Each maker also has its own logger: open the box for your
# motors.
#
# <details><summary>If your motors are CTRE's (Phoenix 6)</summary>
#
# You can log a TalonFX as in lesson 4. You can also use CTRE's *SignalLogger*. It records each
# signal when it arrives on the CAN bus, and not once per loop.
#
# 1. In `Config`, send the state to CTRE's log:
#    `state -> SignalLogger.writeString("state", state.toString())`. The log callback is `null`.
# 2. Bind `SignalLogger.start()` and `SignalLogger.stop()` to two buttons. Press start, run each of
#    the four tests once, then press stop.
# 3. Open *Log Extractor* in **Tuner X**. Choose the `.hoot` file on the robot and download it. The
#    file appears in the queue on the right. Choose WPILOG, then *Convert*.
# 4. In SysId, the *Test State* is the entry `state`, as you named it in step 1. Load `Position`,
#    `Velocity` and `MotorVoltage` of that TalonFX. `MotorVoltage` is the applied voltage.
#
# CTRE asks you not to convert with other tools, because they may lose signals.
# ([CTRE docs: Plumbing & Running SysId](https://github.com/CrossTheRoadElec/Phoenix6-Documentation/blob/079a28341bc1ed380f3a4bc6e9fcec300517eabb/source/docs/api-reference/wpilib-integration/sysid-integration/plumbing-and-running-sysid.rst),
# [Extracting Signal Logs](https://v6.docs.ctr-electronics.com/en/stable/docs/tuner/tools/log-extractor.html))
#
# If you log as in lesson 4, a signal that comes more slowly than your loop is written down twice,
# or late. Ask for it once per loop: `m_motor.getVelocity().setUpdateFrequency(50)`, and the same
# for `getPosition()` and `getMotorVoltage()`. **Do it,** then let `sysid inspect` look for *stale
# samples*.
#
# Phoenix 6 (release 26.3) sets two current limits by itself. The stator limit is 120 A: stator
# current is the current in the motor. The supply limit is 70 A: supply current is what the
# controller draws from the battery. While a limit acts, a log of the commanded volts is wrong.
# </details>
#
# <details><summary>If your motors are REV's</summary>
#
# You can log a SPARK as in lesson 4: `getAppliedOutput() * getBusVoltage()` is the applied voltage.
# You can also use *URCL*, a logger by Team 6328:
#
# 1. Call `URCL.start()` after `DataLogManager.start()`. The log callback of `Mechanism` is `null`.
# 2. Fetch the log and open it in **AdvantageScope**. Choose *File* > *Export Data…*, the format
#    *WPILOG* and the field set *Include Generated*. SysId can read only the exported file.
# 3. Load `MotorPositionRotations`, `MotorVelocityRPM` and `AppliedOutputVoltage`.
#    ([AdvantageScope docs: URCL](https://docs.advantagescope.org/more-features/urcl))
#
# REVLib 2026 also writes a log of its own, a `.revlog` file. It begins with the first call of
# REVLib. ([`StatusLogger` of robotpy-rev 2026.0.4](https://pypi.org/project/robotpy-rev/2026.0.4/))
# It does not say which test runs. So record one file for each test, and name it after its test:
# `sysid fit` reads `dynamic-forward.revlog` and the other three.
#
# There are three traps:
#
# - A SPARK sends most signals only when the robot program reads them. Read position, velocity and
#   output once per loop, or switch these signals on in the SPARK's `SignalsConfig`. Otherwise they
#   are not in the log.
# - The units are rotations and rotations per **minute** (unless you set conversion factors in the
#   SPARK).
# - A NEO's own encoder filters the velocity so much that the logged velocity is about 0.1 s late
#   (lesson 6). Shorten the filter *before* the tests, in `config.encoder`: `uvwMeasurementPeriod`
#   (32 ms by default, at least 8 ms) and `uvwAverageDepth` (8 samples by default; 1, 2, 4 or 8).
#   ([`EncoderConfig` of robotpy-rev 2026.0.4](https://pypi.org/project/robotpy-rev/2026.0.4/)) **Do
#   it** with 8 ms and a depth of 2, and run one step with each setting. Which kA does `sysid fit`
#   find?
# </details>
#
# <details><summary>If your team uses AdvantageKit</summary>
#
# AdvantageKit logs your motors already. So the log callback of `Mechanism` is `null`, and the state
# goes to AdvantageKit: `state -> Logger.recordOutput("SysIdTestState", state.toString())`.
#
# `sysid fit` reads this log as it is, module by module. SysId's window cannot: AdvantageKit writes
# only what has changed, and SysId expects every sample. For SysId, open the log in AdvantageScope,
# choose *File* > *Export Data…*, the format *WPILOG* and the timestamps *AdvantageKit Cycles*.
# ([AdvantageKit: SysId Compatibility, at one
# commit](https://github.com/Mechanical-Advantage/AdvantageKit/blob/1262563779dd287242904e3e1a863b304cfe3072/docs/docs/data-flow/sysid-compatibility.md))
# </details>

# %% [markdown]
# ### Watch the tests live
#
# `sysid watch` reads the log while the robot writes it. After each test it fits the gains again and
# says what to do next: run a missing test, repeat a test, or stop because you have enough data.
#
# <details><summary>Try it with a simulated robot, or use it with your own robot</summary>
#
# `exercises/exercise6/robot.py` is a robot program with a `SysIdRoutine`, as in lesson 4. This
# program runs the four tests in WPILib's simulation. It needs RobotPy: `grade doctor`
# says how to install it. Open two terminals in the course folder. In the first type
#
# ```
# sysid watch logs --page
# ```
#
# and in the second
#
# ```
# python exercises/exercise6/robot.py logs
# ```
#
# (If there is no folder `logs` yet, make it first.) The option `--page` shows the same text in your
# browser. `Ctrl+C` ends `sysid watch` and prints the gains.
#
# With a real robot, your laptop does not see the log file while it grows. Follow *NetworkTables*
# instead, the values that the robot sends to the dashboard: `sysid watch --nt 1234`, with your own
# team number. Then the robot program has to send voltage, position, velocity and the name of the
# test. The example program sends all of them.
# </details>
#
# The next table shows what `sysid watch` would say after each test of our simulated robot.

# %%
from sim.core import errors
from sim.report.next_test import advise_next

rows = []
for count in range(1, 5):
    so_far = replace(sound, runs=sound.runs[:count])
    last = so_far.runs[-1].test
    try:
        now = fit(so_far)
    except errors.Refusal:
        now = None
    rows.append((last, advise_next(so_far, found=now, inspection=inspect(so_far), last=[last])))
Table(("after this test", "it says"), tuple(rows))

# %% [markdown]
# ## 7 When: not at the first regional
#
# Some teams "spend their entire practice match window trying to characterize their drivetrain". But
# a pit is as small as a parking space, and there may be only eight minutes between two matches. The
# tests themselves are short:

# %%
seconds = sum(float(run.time[-1] - run.time[0]) for run in sound.runs)
print(f"The four tests take {seconds:.0f} s, which is {seconds / (8 * 60):.0%} of eight minutes.")
print(f"A ramp test of 0.5 V/s needs up to {slow.final_position / FOOT:.0f} feet.")

# %% [markdown]
# But it takes a long time to find room, charge a battery, fetch the log and try again.
#
# **Plan it for the last two weeks of build season.** Then the robot is mechanically finished, and
# you still have time to use the gains.
#
# Gains from the shop are right at the competition only if the robot and the floor stay the same.
# The next table changes one thing at a time. Which gain changes?
#
# <details><summary>For mentors: do the gains transfer to competition?</summary>
#
# > **Lesson says:** "The gains you collect in the shop will transfer directly to competition."
# >
# > **Source says:** only if the robot and the floor stay the same. The source lesson itself says to
# > run again "if drivetrain gearing, wheels, or carpet contact changes", and WPILib says not to
# > test on blocks: the floor under the wheels is part of the gains. ([WPILib docs: Running the
# > Routine](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/system-identification/running-routine.html))
# >
# > **Try it:** the next cell changes one thing at a time. Which gain changes?
# </details>

# %%
changes = {
    "as tested": ROBOT,
    "softer carpet: friction +0.1 V": replace(ROBOT, friction=ROBOT.friction + 0.1),
    "5 kg more": replace(ROBOT, load=ROBOT.load + 5.0),
    "wheels worn by 2 mm": replace(ROBOT, radius=ROBOT.radius - 0.002),
}
tabulate_gains({name: one.gains for name, one in changes.items()}, first="change")

# %% [markdown]
# ## 8 System check
#
# Read this list aloud before the first test. If one point is not true, do not start:
#
# - [ ] **Room.** The way is clear in both directions, for the distance you *computed*. There is
#   tape on the floor.
# - [ ] **Battery.** It is charged: more than 12.5 V at rest, 20 mΩ or less.
# - [ ] **Encoder.** When you push forward, the position rises smoothly. A positive voltage gives a
#   positive velocity.
# - [ ] **Log.** You have fetched a log from this robot before, and know its folder. Each mechanism
#   gets its own log.
# - [ ] **Guard.** While the guard locks the tests, pressing a button moves nothing. One person only
#   waits to disable the robot.
#
# And for the moment after a test:
#
# - [ ] **Release.** The neutral mode of an elevator or arm is *Brake*, and something soft lies
#   below it. You know what the subsystem's default command does when you let go.
#
# Each test ends with 0 V. ([`SysIdRoutine` of robotpy-commands-v2
# 2026.2.2](https://pypi.org/project/robotpy-commands-v2/2026.2.2/)) In *Coast* mode an elevator
# then falls. Once the test command has ended, the subsystem's *default command* starts. If it holds
# a position, the mechanism moves to its old target at once. ([WPILib docs: Subsystems, at one
# commit](https://github.com/wpilibsuite/frc-docs/blob/011b777ed66fe90e41e2dfdadab4b3625453ac26/source/docs/software/commandbased/subsystems.rst))
#
# For each log, also write down the current limit and the neutral mode, **brake or coast**. (For a
# drivetrain, use the mode that you drive with: it decides how far the robot rolls after a test.)
#
# ## 9 Knowledge check
#
# Click an answer to the first question.

# %%
display(ask_question("lesson5.quick"), enable_checkboxes())

# %% [markdown]
# **1.** A teammate says: "Our room is short, so we use a slow ramp of 0.25 V/s." What do you
# answer?
#
# <details><summary>Answer</summary>
#
# With a slower ramp the robot needs *more* room to reach the same speed: d = kV·v²/(2·r). With half
# the ramp, the distance is twice as long. In a short room use a steeper ramp and let go earlier.
# </details>
#
# **2.** A teammate says: "SysId switches all limits off, so be careful." Is that right?
#
# <details><summary>Answer</summary>
#
# You must be careful. But limits that you set in the motor controller work during a test. The only
# limits that do not work are those in your other commands. So set the limits in the motor
# controller. If such a limit acts during a test, run all four tests again with a lower voltage.
# </details>
#
# **3.** The tests went well, but the Driver Station's folder contains no `.wpilog`. Where do you
# look?
#
# <details><summary>Answer</summary>
#
# The Driver Station copies logs only if you ticked *Upload WPILogs*. If a USB stick is plugged in,
# look in `/u/logs`. Otherwise look in `/home/lvuser/logs` on a roboRIO, and in
# `/home/systemcore/logs` on a Systemcore. Use AdvantageScope or the Data Log Tool. If the file's
# name contains TBD, no Driver Station was connected: fetch this file before the program starts
# again.
# </details>
#
# **4.** All gains are negative, and R² is 0.99. What happened? Do you have to run the tests again?
#
# <details><summary>Answer</summary>
#
# A positive voltage gave a negative velocity: the encoder or the motor is inverted. Apart from the
# sign of the velocity, the data are good, so you could change this sign in the log. But the robot's
# code has the same mistake, so fix it there, and run the tests again.
# </details>
#
# **5.** When would you run these tests, and why not at the first regional?
#
# <details><summary>Answer</summary>
#
# Run them in the last two weeks of build season: the robot is finished, there is room, and there is
# time to use the gains. At an event you have no room, no time and no second try.
# </details>

# %% [markdown]
# ## 10 Practice
#
# **Exercise 6, part (b)** ([exercises/exercise6/README.md](../exercises/exercise6/README.md)). You
# get a description of a test morning with some mistakes. Decide *go* or *no-go* for each line, put
# the four steps in order, and say where the log is. (Part (a) belongs to lesson 3.)
#
# ```
# grade exercise6
# ```
#
# <details><summary>You can also answer in a notebook</summary>
#
# This code writes your answers into `exercises/exercise6/answers.toml` and shows the result:
#
# ```python
# from grader import submit
#
# submit("exercise6", check_travel="go", check_battery="no-go", log_2027="/home/systemcore/logs")
# ```
#
# (These answers are only examples.)
# </details>
#
# Hints cost nothing: `grade exercise6 --hint`. If you use an editor, `grade watch exercise6` grades
# each time you save.
#
# ### On your own robot: instrument a subsystem
#
# 1. Choose a subsystem with a motor: drivetrain, shooter, arm or elevator. Give it a `SysIdRoutine`
#    (lesson 4) with the ramp, the small step and the timeout of your own plan (lesson 3).
# 2. Write the two callbacks. Bind the four tests, each with a comment that names the test and what
#    it measures, and lock them.
# 3. Make the five checks, and run the four tests (section 6).
# 4. Fetch the log, and let the program check it:
#
# ```
# sysid inspect my_log.wpilog
# ```
#
# It must find four runs and no fault. Otherwise it says what is wrong: repeat the tests now.
#
# No robot today? Do the five checks with any robot that is disabled, and fetch any log from it. Or
# record a log with the simulated robot program of section 6. Keep your log: you fit it in lesson 7,
# and place its gains in lesson 8. `grade practice` grades all of this work.
#
# **Next:** [Lesson 6, read the data](06_read_the_data.ipynb). Can you trust this log?
