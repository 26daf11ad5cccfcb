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
# *About 45 minutes. You need lessons 3 and 4. No robot is needed to read it. Sections 5 and 6 are
# the sheet you take to the robot.*
#
# **At the end you can**
#
# - name the four steps of a characterization, and say which one you are in;
# - choose where the tape goes on the floor, and say where the robot will stand;
# - decide *go* or *no-go* from five checks, and say what each one saves you from;
# - find your log, on a roboRIO of 2026 and on a Systemcore of 2027;
# - run the four tests on a real robot, and know within a minute whether the log is any good.

# %% [markdown]
# ## 1 Why: for ten seconds, nobody steers
#
# A SysId test drives your mechanism with a voltage that only grows, or with one that is simply
# *on*. Nothing looks at where the mechanism is. Whoever holds the button is the only brake.
#
# So before the test you decide how far it may go, and you look whether everything is ready. Pilots
# call that a *pre-flight check*. It takes five minutes. This lesson shows what each minute is for:
# you will skip the checks one by one, on a simulated robot, and see what comes of it.
#
# ### The four steps
#
# | step | what you do | where you learn it |
# |---|---|---|
# | 1. wire the routine | add a `SysIdRoutine` to the subsystem, bind four buttons | lesson 4 |
# | 2. run the tests | check, run four tests, fetch the log | **this lesson** |
# | 3. inspect and fit | look at the data first, then compute the gains | lessons 6 and 7 |
# | 4. place the gains | put them into the constants and the feedforward | lesson 8 |
#
# The order is not a matter of taste. Gains that were never inspected are guesses with more digits.
#
# > **Lesson says:** "The SysId Process: Four Steps … Click each step to understand what you're
# > doing and why."
# >
# > **Source says:** the source lesson's text names only the first step; the other three were behind
# > a click that did not reach us. The table is our reading. WPILib's pages go the same way: create
# > the routine, run it, load the data, view diagnostics, analyze.
# > ([WPILib docs: System Identification](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/system-identification/index.html))
# >
# > **Try it:** cover the table, and write the four steps down in order. Exercise 6 asks for them.

# %%
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

import ipywidgets as widgets
import numpy as np
from IPython.display import display

import sim
from sim.bench.mechanisms import MECHANISMS
from sim.bench.simulate import simulate
from sim.fit import fit
from sim.inspect.contaminate import contaminate
from sim.inspect.detect_faults import inspect
from sim.physics.battery import CONTROLLERS, Battery
from sim.plot import Picture, Table, plot_runway, plot_time_series, show_interactive
from sim.teaching.prediction import Prediction
from sim.teaching.runway import GRIP, THUMB, Floor, drive_test

ROBOT = replace(MECHANISMS["drivetrain"], travel=None)  # nobody ends its tests but you
TRUTH = ROBOT.gains
print(ROBOT.summary)
Table(
    ("gain", "true value", "unit"),
    (("kS", TRUTH["kS"], "V"), ("kV", TRUTH["kV"], "V·s/m"), ("kA", TRUTH["kA"], "V·s²/m")),
    caption="Our robot. Its true gains are known, because we built it.",
)

# %% [markdown]
# ## 2 The model: how far does a test go?
#
# A ramp of `r` volts per second does nothing until the voltage is above kS. From then on the speed
# grows by `r/kV` each second. So after `t` seconds of motion
#
# > v ≈ r·t / kV,  and the distance is  d ≈ r·t² / (2·kV) = kV·v² / (2·r)
#
# (This leaves out that the robot lags a little behind the voltage. The bench does not.)
#
# Then you let go. First your thumb needs its time, and the voltage is still on. Then the motors
# brake, if their neutral mode is *Brake*. They cannot brake harder than the carpet holds. So on top
# of the thumb comes at least `v² / (2·μ·g)`, with g = 9.81 m/s² and the grip μ (about 1.1 for
# wheels on carpet, less on a smooth floor).
#
# **Predict.** Nobody grades this; you will see your guess again. (No buttons on your screen? Type
# `guess_room.value = "more room"` in a cell.)

# %%
guess_room = Prediction(
    "You want to reach 2 m/s. With a ramp half as steep, do you need more room or less?",
    "less room",
    "the same",
    "more room",
)
guess_ten = Prediction(
    "0.5 V/s for 10 s is a common setting. How far does our robot go?",
    "about 1 m",
    "about 3 m (10 feet)",
    "about 9 m (30 feet)",
)
display(guess_room, guess_ten)

# %%
RAMP, STEP = "quasistatic-forward", "dynamic-forward"
FOOT = 0.3048  # [m]
HALL = Floor(wall=60.0)  # so long that nothing is ever hit


def way_to(speed: float, ramp: float) -> tuple[float, float]:
    """Meters and seconds until the robot is this fast."""
    went = drive_test(ROBOT, sim.Routine(ramp=ramp, timeout=11.0 / ramp), test=RAMP, floor=HALL)
    there = int(np.argmax(went.velocity >= speed))
    return float(went.position[there]), float(went.time[there])


rows = []
for ramp in (0.25, 0.5, 1.0, 2.0):
    way, time = way_to(2.0, ramp)
    rows.append((ramp, time, way, TRUTH["kV"] * 2.0**2 / (2 * ramp)))

slow = drive_test(ROBOT, sim.Routine(ramp=0.5, timeout=10.0), test=RAMP, floor=HALL)
print(f"You said: {guess_room}; {guess_ten}.")
gone = slow.final_position
print(f"0.5 V/s for 10 s goes {gone:.1f} m, that is {gone / FOOT:.0f} feet.")
Table(
    ("ramp [V/s]", "2 m/s after [s]", "distance until then [m]", "kV·v²/(2·ramp) [m]"), tuple(rows)
)

# %% [markdown]
# *Slow is safe* sounds right, and it is wrong here. A slow ramp spends a long time at middle
# speeds, and time at speed is distance. If the room is short, a steeper ramp gets more speed out of
# it. (The price of a steeper ramp is in lesson 3: it moves the apparent kS.)
#
# > **Lesson says:** "clear at least 10 feet forward and 10 feet back (more is better for
# > quasistatic)".
# >
# > **Source says:** WPILib: "at least 10' of space, ideally closer to 20'", and the drive "can not
# > be accurately characterized while on blocks". CTRE recommends 15 m.
# > ([WPILib docs: Running the Routine](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/system-identification/running-routine.html),
# > [CTRE docs: Plumbing & Running SysId](https://v6.docs.ctr-electronics.com/en/stable/docs/api-reference/wpilib-integration/sysid-integration/plumbing-and-running-sysid.html))
# >
# > **Try it:** the next cell asks how fast the robot is when 10 feet are over.

# %%
rows = []
for ramp in (0.5, 1.0, 2.0):
    went = drive_test(ROBOT, sim.Routine(ramp=ramp, timeout=11.0 / ramp), test=RAMP, floor=HALL)
    there = int(np.argmax(went.position >= 10 * FOOT))
    volts = ramp * went.time[there]
    share = went.velocity[there] / (12.0 / TRUTH["kV"])
    rows.append((ramp, float(volts), float(went.velocity[there]), f"{100 * share:.0f} %"))
Table(
    ("ramp [V/s]", "voltage reached [V]", "speed reached [m/s]", "of its top speed"),
    tuple(rows),
    caption="What 10 feet give you",
)

# %% [markdown]
# Ten feet are enough for *some* data. And this is before anybody brakes. More room means more
# speed, and kV comes from speed.
#
# **And on blocks?** Then the wheels carry nothing but themselves. Say they are a tenth of the
# robot's inertia:

# %%
routine = sim.Routine(ramp=1.0, step=3.5, timeout=10.0)
on_blocks = simulate(replace(ROBOT, load=6.0), routine, rng=np.random.default_rng(5))
lifted = fit(on_blocks, method="sysid").gains
print(f"On blocks: kV ÷ true = {lifted['kV'] / TRUTH['kV']:.2f}")
print(f"           kA ÷ true = {lifted['kA'] / TRUTH['kA']:.2f}")

# %% [markdown]
# kV hardly minds here (a real robot also has less friction on blocks). kA is that of bare wheels,
# and of no use for a robot that carries its own weight. (A tenth of the inertia should give a tenth
# of kA. The fit misses even that: the rise is now over by the third sample.)

# %% [markdown]
# ## 3 Doing it: the runway
#
# Now you are the person at the button. The hall is 12 m long. A strip of tape lies on the floor.
# When the front bumper passes it, you let go; your thumb takes 0.3 s.
#
# The ramp is 1 V/s, the step 3.5 V, the timeout 10 s.
#
# **Predict:**

# %%
guess_stop = Prediction(
    "Tape at 7 m, wall at 12 m, a ramp of 1 V/s. Where does the robot stand?",
    "right at the tape",
    "about 1 m past it",
    "about 3 m past it",
    "at the wall",
)
guess_check = Prediction(
    "You skip one of the five checks. Which one spoils the log although on the floor everything "
    "looks normal?",
    "room",
    "battery",
    "encoder",
    "log",
    "guard",
)
display(guess_stop, guess_check)

# %% [markdown]
# Move the sliders. *Moment* moves the robot through the test. The dashed outline is where it will
# stand.

# %%
WALL = 12.0  # [m]


def run_it(test: str, tape: float, thumb: float, moment: float) -> Picture:
    """One test in our hall."""
    floor = Floor(wall=WALL, tape=tape, thumb=thumb)
    return plot_runway(drive_test(ROBOT, routine, test=test, floor=floor), moment=moment)


show_interactive(
    run_it,
    test=widgets.Dropdown(options=[("ramp", RAMP), ("step", STEP)], description="test"),
    tape=widgets.FloatSlider(
        min=1, max=11.5, step=0.5, value=7, description="tape [m]", continuous_update=False
    ),
    thumb=widgets.FloatSlider(
        min=0.1, max=1.5, step=0.1, value=THUMB, description="thumb [s]", continuous_update=False
    ),
    moment=widgets.FloatSlider(
        min=0, max=1, step=0.1, value=0.7, description="moment", continuous_update=False
    ),
)

# %% [markdown]
# No sliders on your screen? Change the numbers here, and run the cell:

# %%
run_it(RAMP, tape=7.0, thumb=0.3, moment=0.7)

# %%
went = drive_test(ROBOT, routine, test=RAMP, floor=Floor(wall=WALL, tape=7.0))
top = float(went.velocity.max())
print(f"You said: {guess_stop}.")
let_go = float(np.interp(went.released, went.time, went.position))
print(f"It stands {went.final_position - 7.0:.2f} m past the tape:")
print(f"  the thumb costs {let_go - 7.0:.2f} m, the brakes {went.final_position - let_go:.2f} m.")
print(f"  v²/(2·μ·g) at {top:.2f} m/s would be {top**2 / (2 * GRIP * 9.81):.2f} m.")

# %% [markdown]
# Where to put the tape: start from the wall. Go back by what the thumb costs, by what the brakes
# cost, and by a good reserve. Put the tape there, and one piece for each direction. Going back is
# the same test from the other end.
#
# ### Now skip a check
#
# The same hall, the same robot. One check was skipped:
#
# | skipped | what was wrong that morning |
# |---|---|
# | 1 room | nobody put tape on the floor, so nobody knows when to let go |
# | 2 battery | it has driven all day: 11.6 V at rest, and worn (35 mΩ) |
# | 3 encoder | mounted the wrong way round: forward counts down |
# | 4 log | nobody knows where the robot keeps it |
# | 5 guard | in the pit, a thumb hits the button: a wall after 1.5 m, and 1 s to *Disable* |

# %%
TIRED = replace(ROBOT, battery=Battery(rest=11.6, resistance=0.035))
SKIPS = ["nothing", "1 room", "2 battery", "3 encoder", "4 log", "5 guard"]


def morning(skipped: str, test: str, moment: float) -> Picture:
    """What happens on the floor when a check was skipped."""
    floor = Floor(wall=WALL, tape=7.0)
    if skipped == "1 room":
        floor = Floor(wall=WALL)
    if skipped == "5 guard":
        floor = Floor(wall=1.5, watched=1.0)
    robot = TIRED if skipped == "2 battery" else ROBOT
    return plot_runway(drive_test(robot, routine, test=test, floor=floor), moment=moment)


show_interactive(
    morning,
    skipped=widgets.Dropdown(options=SKIPS, description="skipped"),
    test=widgets.Dropdown(options=[("ramp", RAMP), ("step", STEP)], description="test"),
    moment=widgets.FloatSlider(
        min=0, max=1, step=0.1, value=1, description="moment", continuous_update=False
    ),
)

# %% [markdown]
# No menu? Here is the battery that was not charged, in the step:

# %%
morning("2 battery", STEP, moment=1.0)

# %% [markdown]
# Look at the battery's line. The step asks for so much current that the battery's voltage falls
# below a threshold. Then the robot controller takes the motors off, to keep itself alive: that is a
# *brownout*. The battery recovers at once, the motors come back, and so on. The robot crawls. (Our
# bench lets the motors back as soon as they may; a real robot stutters at a rhythm of its own.)
#
# With 3 and 4 skipped, the floor shows nothing: the robot drives as always. What they spoil is the
# log, and that nobody sees in the pit.
#
# ### What the log is worth
#
# The floor is one half. Here are the four tests of each morning, and what SysId's recipe makes of
# them. `inspect` is our own program that looks for known faults; lesson 6 is about it.

# %%
sound = simulate(ROBOT, routine, rng=np.random.default_rng(5))
hit = drive_test(ROBOT, routine, test=RAMP, floor=Floor(wall=WALL)).hit_wall
backward = replace(
    sound,
    runs=tuple(replace(r, position=-r.position, velocity=-r.velocity) for r in sound.runs),
)
into_wall = contaminate(
    sound, "hard-stop", severity=3, test=RAMP, at=hit, rng=np.random.default_rng(1)
)
logs = {
    "nothing": sound,
    "1 room": into_wall.log,
    "2 battery": simulate(TIRED, routine, rng=np.random.default_rng(5)),
    "3 encoder": backward,
    "4 log": None,
    "5 guard": sound,
}

rows = []
for name, log in logs.items():
    if log is None:
        rows.append((name, "there is no log", "-", "-", "-"))
        continue
    found, seen = fit(log, method="sysid"), inspect(log)
    names = {damage.fault for damage in seen.damages} | {doubt.code for doubt in log.doubts}
    ratios = [found.gains[gain] / TRUTH[gain] for gain in ("kS", "kV", "kA")]
    rows.append((name, ", ".join(sorted(names)) or "nothing", *ratios))
print(f"You said: {guess_check}.")
Table(("skipped", "found in the log", "kS ÷ true", "kV ÷ true", "kA ÷ true"), tuple(rows))

# %% [markdown]
# ### Explain
#
# - **1 room.** You see it on the floor, and the log is spoiled, too: against the wall there is
#   voltage without speed. (Here it is in one ramp only. That is enough.)
# - **2 battery.** You may see the robot crawl, and the Driver Station shows the brownout. `inspect`
#   finds it, because the applied voltage is cut to 0 again and again.
# - **3 encoder.** On the floor, *everything is normal*. All gains come out negative. This is the
#   check that nobody sees being skipped.
# - **4 log.** A perfect afternoon, and nothing to show for it.
# - **5 guard.** The log is fine. The robot is not, and perhaps a hand is not.

# %% [markdown]
# ## 4 Five checks, and what stands behind them
#
# ### Room
#
# Clear the way in **both** directions, on the carpet it will drive on. Work out the way (section
# 2), put tape down, and let somebody who does not hold the button watch it. For an arm or an
# elevator: move it by hand through all of its travel. Nothing may be in the way, no cable may pull.
#
# Set the **timeout** to what your plan needs, and no longer: it ends the test if the thumb does
# not. Begin with a **small step**. The source lesson says 3 to 4 V; a strong, light drivetrain
# slips below that (lesson 4).
#
# ### Battery
#
# > **Lesson says:** "A battery below 12V produces unreliable kA values and may brownout mid-test".
# >
# > **Source says:** motors are disabled below 6.3 V on a roboRIO 1; on a roboRIO 2 the threshold
# > can be set, and is 6.75 V if you do not. Below 12 V is not yet a brownout.
# > ([WPILib docs: Brownouts](https://docs.wpilib.org/en/stable/docs/software/roborio-info/roborio-brownouts.html))
# >
# > **Try it:** the next cell runs the tests with two batteries and two steps, and fits the voltage
# > that **arrived** at the motors and the one that was **asked for**.


# %%
def as_asked(log: sim.Log, routine: sim.Routine) -> sim.Log:
    """The same runs, but the log holds the voltage that the routine asked for."""
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

for name, one in CONTROLLERS.items():
    print(f"{name} takes the motors off below {one.brownout} V")
Table(
    (
        "battery, step",
        "lowest voltage [V]",
        "brownout?",
        "kA ÷ true, arrived",
        "kA ÷ true, asked for",
    ),
    tuple(rows),
    caption=f"Charged: {ROBOT.battery.rest} V at rest. Tired: {TIRED.battery.rest} V, and worn.",
)

# %% [markdown]
# As long as nothing browns out, the tired battery gives the same kA, in both columns: this robot
# asks for a *voltage*, and its motor controllers make up for the sag. (Lesson 4's share of the
# battery does not.) A brownout spoils both columns, and the asked-for one far more. So: charge it
# anyway, begin with a small step, and log the applied voltage. The source lesson's rule is 12 V or
# more at rest. But a lead-acid battery at 12.0 V is about half flat; WPILib's docs call 11.7 to
# 12.5 V on an idle robot "depleted", and advise against a battery of more than 20 mΩ. So ask for
# **12.5 V or more at rest**, and for 20 mΩ or less on a battery tester.
# ([WPILib docs: Robot Battery Basics](https://docs.wpilib.org/en/stable/docs/hardware/hardware-basics/robot-battery.html))
# (The threshold of a Systemcore is the default in WPILib 2027, which is not released yet.)
#
# ### Encoder
#
# Disabled, push the mechanism **forward** by hand. On the dashboard or in AdvantageScope, the
# position must **rise**, smoothly, and the velocity must be positive while it moves. Then push it
# back. Then give it a small positive voltage: it must move the same way. *Plus volts, plus
# velocity* is the first of all checks, since nothing in R² shows when it fails (lesson 6).
#
# ### Log
#
# Fetch **yesterday's** log before you need today's. Section 5 says from where.
#
# ### Guard
#
# Enable the robot with the guard *off*, that is: the tests are locked. (If your guard is Test mode,
# called *Utility* in 2027, enable in Teleop.) Press all four buttons. Nothing may move. (Lesson 4
# has three kinds of guard.)
# And one person does nothing but wait to press *Disable*. In the 2026 Driver Station the **Enter**
# key disables, and the **space bar** is the emergency stop: it works even if another window is in
# front, and the roboRIO has to be rebooted afterwards.
# ([WPILib docs: Driver Station](https://docs.wpilib.org/en/stable/docs/software/driverstation/driver-station.html))
#
# > **Lesson says:** "There is no position limit, no current limit bypass protection, and no
# > closed-loop correction."
# >
# > **Source says:** half of it. Nothing corrects the motion, that is true (it is called *open
# > loop*). But limits *in the motor controller* go on working in a test, if you have set them: "it
# > is up to you to set up hard or soft limits to prevent injury or damage". What a test bypasses is
# > what your own **commands** do: it has the subsystem for itself.
# > ([WPILib docs: Running the Routine](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/system-identification/running-routine.html))
# >
# > **Try it:** the next cell sets a current limit of 40 A per motor and runs the tests.

# %%
limited = simulate(
    replace(ROBOT, stator=40.0), routine, rng=np.random.default_rng(5), electrical=True
)
highest = max(float(np.abs(run.current).max()) for run in limited.runs)
arrived, asked = (
    fit(one, method="sysid").gains["kA"] / TRUTH["kA"]
    for one in (limited, as_asked(limited, routine))
)
print(f"Highest current of a motor in all four tests: {highest:.0f} A. The limit acts.")
print(f"kA ÷ true: {arrived:.2f} if the log holds what arrived, {asked:.2f} if what was asked for.")

# %% [markdown]
# Two sides again. The limit **protects** you. And when it engages, the motor gets less than the
# test asked for; a log that does not know that is wrong.
#
# Two more rules that are easy to keep and costly to forget:
#
# - **One mechanism per log.** WPILib: if you run a second routine "without extracting the log or
#   power-cycling the roboRIO in between, analysis will fail".
# - **Each test once.** If one went wrong, begin a new log and run all four again. CTRE's page says
#   the same. (The text beside the class `SysIdRoutine` says that you may choose between repeats in
#   the tool. SysId 2026 has no such choice: it takes the first one.)

# %% [markdown]
# ## 5 Where is my log?
#
# ```
# Who wrote it?
# ├─ WPILib (DataLogManager; the routine of lesson 4 uses it): a .wpilog file
# │   Was a Driver Station connected while the program ran?
# │   ├─ no  → its name still has TBD in it, and the next start of the program deletes it
# │   └─ yes → is there a USB stick in the controller (for a roboRIO: formatted FAT32)?
# │       ├─ yes → the folder logs on the stick: /u/logs on a roboRIO
# │       └─ no  → which controller?
# │           ├─ roboRIO (2026)    → /home/lvuser/logs
# │           └─ Systemcore (2027) → /home/systemcore/logs
# ├─ CTRE SignalLogger: a .hoot file → Tuner X, Log Extractor (section 6)
# └─ URCL (REV motors): it is inside the .wpilog → export it with AdvantageScope (section 6)
# ```
#
# > **Lesson says:** "the default path is /home/lvuser/logs/. Retrieve them via the Driver Station
# > log folder tool or AdvantageScope's file fetch feature."
# >
# > **Source says:** a USB stick comes first: `/u/logs`. The Driver Station copies logs only if you
# > ticked *Upload WPILogs* (gear icon), into `C:\Users\Public\Documents\FRC\Log Files\WPILogs`. The
# > Data Log Tool and AdvantageScope fetch them always, but not through the radio on a competition
# > field, whose firewall is in the way: use a USB cable there.
# > ([WPILib docs: Downloading Data Logs](https://docs.wpilib.org/en/stable/docs/software/telemetry/datalog-download.html),
# > [Data Logs](https://docs.wpilib.org/en/stable/docs/software/telemetry/datalog.html))
# >
# > **Try it:** answer for three robots, in the next cell. Then for yours.


# %%
def folder(controller: str, *, stick: bool) -> str:
    """Where DataLogManager writes."""
    if stick:
        return "/u/logs"
    return "/home/systemcore/logs" if controller == "Systemcore" else "/home/lvuser/logs"


Table(
    ("controller", "USB stick?", "folder"),
    (
        ("roboRIO", "no", folder("roboRIO", stick=False)),
        ("roboRIO", "yes, FAT32", folder("roboRIO", stick=True)),
        ("Systemcore", "no", folder("Systemcore", stick=False)),
    ),
)

# %% [markdown]
# How to fetch it, and what to expect:
#
# - **AdvantageScope:** *File* > *Download Logs…*. You should see a list, the newest at the top.
#   Select, then click the ↓ sign. If it finds no robot: set its address and the log folder in the
#   preferences (*App* > *Show Preferences…*).
# - **Data Log Tool:** type your team number, the user `lvuser` and no password, then *Connect*. Go
#   to the folder, tick the file, *Select Download Folder…*, *Download*. You should see *Download
#   complete!*
# - **Driver Station:** gear icon, *Upload WPILogs*, **before** you run. The file turns up on the
#   laptop by itself.
# - **The stick:** robot off, pull it out. It has a folder `logs`.
#
# (2027: Systemcore and its tools are new. The folders above, and file names that begin with WPILIB
# where those of 2026 begin with FRC, are those of WPILib's development branch. Where a Systemcore
# has its stick is not settled: that code says `/u/logs`, teams who test one write `/U/logs`. If
# something looks different, believe the docs of your season.)

# %% [markdown]
# ## 6 On the real robot, step by step
#
# 1. **Add the routine** (lesson 4), and `DataLogManager.start()` where the robot program starts.
#    Deploy: in VS Code `Ctrl+Shift+P`, *WPILib: Deploy Robot Code*. *Expect:* the Driver Station
#    shows *Robot Code* in green.
# 2. **The five checks.** *Expect:* five times *go*.
# 3. **Power-cycle** the robot, so that the log holds nothing else.
# 4. **Driver Station:** choose *Test*, if that is your guard; *Enable*. *Expect:* nothing moves.
# 5. Hold **quasistatic forward** until the tape. *Expect:* slow, then faster, for 3 s or more.
# 6. Hold **quasistatic reverse**. *Expect:* the same, back.
# 7. Hold **dynamic forward**, and let go early. *Expect:* a jerk, then steady speed.
# 8. Hold **dynamic reverse**. *Expect:* the same, back.
# 9. **Disable.** Fetch the log (section 5). *Expect:* one new `.wpilog`.
# 10. `sysid inspect FILE.wpilog`. *Expect:* 4 runs, no fault found.
# 11. `sysid fit FILE.wpilog --method sysid`. *Expect:* a positive kV and a positive kA.
#
# Any order of the four tests will do. Forward, then reverse, has the robot back where it was.
#
# **Do step 10 before anybody packs up.** It takes a minute, and a rerun takes five. Tomorrow it
# takes an evening.
#
# Here are steps 9 to 11 with a log of the bench. `sim.write` makes the kind of file a robot makes:

# %%
with TemporaryDirectory() as place:
    path = Path(place, "FRC_20260214_153000.wpilog")
    sim.write(sound, path)
    mine = sim.read(path)

checked = inspect(mine)
print(f"{len(mine.runs)} runs, {len(checked.damages) or 'no'} fault found")
plot_time_series(mine, dynamic_seconds=1.0)

# %%
gains = fit(mine, method="sysid").in_log_units()
Table(
    ("gain", "value", "unit"),
    tuple((gain, gains.gains[gain], gains.gain_unit(gain)) for gain in ("kS", "kV", "kA")),
)

# %% [markdown]
# In a terminal, with a file of your own:
#
# ```
# sysid inspect FRC_20260214_153000.wpilog
# sysid fit FRC_20260214_153000.wpilog --method sysid
# ```
#
# An arm or an elevator needs `--type arm` or `--type elevator`. If your log has several motors,
# name one: `--motor left`. If its entries have names of their own, say which they are: `--voltage`,
# `--position`, `--velocity`, `--state`.
#
# **The same file in WPILib's SysId.** In VS Code `Ctrl+Shift+P`, *WPILib: Start Tool*, *SysId*.
#
# 1. *Log Loader*: *Open data log file…*
# 2. Type `sysid-test-state` into *Filter*. Drag that entry to *Test State*.
# 3. Drag *Position*, *Velocity* and *Voltage* of one motor to their slots.
# 4. *Analysis Type*: look twice. It starts on *Elevator*. *Units*: those of your log. *Load*.
# 5. Look at the plots first (lesson 6), then at the gains.
#    ([WPILib docs: Loading Data](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/system-identification/loading-data.html))

# %% [markdown]
# ### If your motors are CTRE's (Phoenix 6)
#
# A TalonFX can be logged as in lesson 4. Or let CTRE's *SignalLogger* do it, which records signals
# as they arrive on the CAN bus, and not once per loop.
#
# 1. In `Config`, the state goes to CTRE's log:
#    `state -> SignalLogger.writeString("state", state.toString())`. The log callback is `null`.
# 2. Bind `SignalLogger.start()` and `SignalLogger.stop()` to two buttons. Start, run the four
#    tests, each once, stop.
# 3. **Tuner X**, *Log Extractor*: choose the `.hoot` file on the robot and download it. It lands in
#    the queue on the right. Choose WPILOG, then *Convert*.
# 4. In SysId, the *Test State* is the entry `state`, as you named it in step 1. Load `Position`,
#    `Velocity` and `MotorVoltage` of that TalonFX. `MotorVoltage` is what arrived.
#
# CTRE asks you not to convert with other tools, since signals may be lost on the way.
# ([CTRE docs: Plumbing & Running SysId](https://v6.docs.ctr-electronics.com/en/stable/docs/api-reference/wpilib-integration/sysid-integration/plumbing-and-running-sysid.html),
# [Extracting Signal Logs](https://v6.docs.ctr-electronics.com/en/stable/docs/tuner/tools/log-extractor.html))
#
# Phoenix 6 sets current limits by itself (release 26.3): 120 A stator, which is the current in the
# motor, and 70 A supply, which is what the controller draws from the battery. You have just seen
# what a limit does to a log of asked-for volts.
#
# ### If your motors are REV's
#
# A SPARK can be logged as in lesson 4: `getAppliedOutput() * getBusVoltage()` is the voltage that
# arrived. Or use *URCL*, a logger by Team 6328:
#
# 1. `URCL.start()` after `DataLogManager.start()`; the log callback of `Mechanism` is `null`.
# 2. Fetch the log, open it in **AdvantageScope**, *File* > *Export Data…*, format *WPILOG*, field
#    set *Include Generated*. SysId cannot read it before that.
# 3. Load `MotorPositionRotations`, `MotorVelocityRPM` and `AppliedOutputVoltage`.
#    ([AdvantageScope docs: URCL](https://docs.advantagescope.org/more-features/urcl))
#
# Three traps. A SPARK sends most signals only when the robot program asks for them, and what it
# does not send is not in the log: read position, velocity and output once per loop, or switch them
# on in the SPARK's `SignalsConfig`. The names say it: position in rotations, velocity in rotations
# per **minute** (unless you gave the SPARK conversion factors). And a NEO's own encoder filters its
# velocity so much that it comes about 0.1 s late (lesson 6).

# %% [markdown]
# ## 7 When: not at the first regional
#
# The source lesson's author has watched it: teams that "spend their entire practice match window
# trying to characterize their drivetrain". The pit is as large as a parking space, and there are
# eight minutes between two matches. The tests themselves are short:

# %%
seconds = sum(float(run.time[-1] - run.time[0]) for run in sound.runs)
print(f"The four tests take {seconds:.0f} s, {seconds / (8 * 60):.0%} of eight minutes.")
print(f"They need up to {slow.final_position / FOOT:.0f} feet, even at 0.5 V/s.")

# %% [markdown]
# What takes long is all the rest: room, carpet, a battery, a log, and a second try.
#
# **Plan it for the last two weeks of build season.** Then the robot is mechanically done, and the
# software still has time to use the gains.
#
# > **Lesson says:** "The gains you collect in the shop will transfer directly to competition."
# >
# > **Source says:** as far as everything under and in the robot stays the same. The source lesson
# > itself says to run again "if drivetrain gearing, wheels, or carpet contact changes", and WPILib
# > refuses a drive on blocks: what the wheels stand on is part of the gains.
# > ([WPILib docs: Running the Routine](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/system-identification/running-routine.html))
# >
# > **Try it:** the next cell changes one thing at a time. Which gain moves?

# %%
changes = {
    "as tested": ROBOT,
    "softer carpet: friction +0.1 V": replace(ROBOT, friction=ROBOT.friction + 0.1),
    "5 kg more": replace(ROBOT, load=ROBOT.load + 5.0),
    "wheels worn by 2 mm": replace(ROBOT, radius=ROBOT.radius - 0.002),
}
Table(
    ("change", "kS [V]", "kV [V·s/m]", "kA [V·s²/m]"),
    tuple((name, *(one.gains[gain] for gain in TRUTH)) for name, one in changes.items()),
)

# %% [markdown]
# ## 8 System check
#
# Read it aloud before the first button is pressed. All five, or *no-go*:
#
# - [ ] **Room.** The way is clear in both directions, for the way you *computed*. Tape is on the
#   floor.
# - [ ] **Battery.** Charged: 12.5 V or more at rest, 20 mΩ or less.
# - [ ] **Encoder.** Pushed forward, the position rises smoothly. Plus volts, plus velocity.
# - [ ] **Log.** You have fetched a log from this robot before, and know its folder. One mechanism
#   per log.
# - [ ] **Guard.** With the guard off, no button moves anything. One person only waits to disable.
#
# Write two more things beside the log. **Brake or coast.** Set the mode that you drive with; it
# decides how far the robot rolls after a test. And the current limit that was set.
#
# ## 9 Knowledge check
#
# First one to click; you are told at once. (No buttons on your screen? Type
# `quick.answer("always")`, or another of the answers, in a cell.)

# %%
from grader import QuickCheck

quick = QuickCheck(
    "When is a soft limit bypassed by a SysId test?",
    {
        "always": "A limit set inside the motor controller goes on acting.",
        "never": "The test takes the place of your own commands, and of the limits in them.",
        "where it is in your own commands": (
            "The test owns the subsystem; what is set in the motor controller still acts, "
            "and then it is in your data."
        ),
    },
    right="where it is in your own commands",
)
quick

# %% [markdown]
# **1.** "We take a ramp of 0.25 V/s. Our room is short, so we go slowly." What do you answer?
#
# <details><summary>Answer</summary>
#
# Slower needs *more* room for the same speed: d = kV·v²/(2·r). Half the ramp, twice the distance.
# In a short room take a steeper ramp, and let go earlier.
# </details>
#
# **2.** A teammate says: "SysId switches all limits off, so watch out." Right?
#
# <details><summary>Answer</summary>
#
# Watch out, yes. But limits that are configured in the motor controller act during a test. What is
# bypassed is what your other commands would have done. Both sides: set the limits, and if one
# engages, run that test again, more gently.
# </details>
#
# **3.** The tests went well. The Driver Station's folder holds no `.wpilog`. Where do you look?
#
# <details><summary>Answer</summary>
#
# It only copies if *Upload WPILogs* was ticked. Look into `/u/logs` if a stick is in. Else look
# into `/home/lvuser/logs` on a roboRIO, and into `/home/systemcore/logs` on a Systemcore. Use
# AdvantageScope or the Data Log Tool. If the file's name has TBD in it, no Driver Station was
# connected: fetch it before the program starts again.
# </details>
#
# **4.** All gains are negative, and R² is 0.99. What happened, and do you have to run again?
#
# <details><summary>Answer</summary>
#
# Plus volts gave minus velocity: an inverted encoder, or an inverted motor. The data are otherwise
# sound, so you could turn the sign in the log. But the robot's code has the same mistake, so fix it
# there, and run again.
# </details>
#
# **5.** When would you do all this, and why not at the first regional?
#
# <details><summary>Answer</summary>
#
# In the last two weeks of build season: the mechanics are done, there is room, and there is time to
# use the gains. At an event there is neither room nor time, and no second try.
# </details>

# %% [markdown]
# ## 10 Practice
#
# **Exercise 6, part (b):** a morning of your own. Some of it is not as it should be. Decide *go* or
# *no-go* for each line, order the four steps, and say where the log is. (Part (a), the four plans,
# is lesson 3.) Read `exercises/exercise6/README.md`, then
#
# ```
# grade exercise6
# ```
#
# Or from a notebook, if you like that better. This writes into
# `exercises/exercise6/answers.toml` and shows the result:
#
# ```python
# from grader import submit
#
# submit("exercise6", check_travel="go", check_battery="no-go", log_2027="/home/systemcore/logs")
# ```
#
# (These words are made up. Yours depend on your morning.) Hints cost nothing:
# `grade exercise6 --hint`.
#
# **On your own robot:** do the five checks with the robot disabled, today. Fetch any log that is on
# it, and open it in AdvantageScope.
#
# Next: lesson 6, read the data before you fit it.
