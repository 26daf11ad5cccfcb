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
# # Lesson 2: Gravity
#
# *About 45 minutes. You need lesson 1: what kS, kV and kA mean. A little cosine helps; section 4
# says what it does.*
#
# **At the end you can**
#
# - say what kG is, and why a whole *window* of voltages holds an elevator still;
# - find kG and kS from two voltages, and say which edge of the window a recipe finds;
# - do the same for an arm, and correct an encoder that was mounted askew;
# - choose SysId's analysis type and WPILib's feedforward class, with the arguments in order;
# - explain why an elevator that was only driven up cannot tell kG from kS.

# %% [markdown]
# ## 1 Why: it falls
#
# The model of lesson 1 says what a motion costs:
#
# > V = kS·sgn(v) + kV·v + kA·a
#
# Put in 0 V, and nothing moves. That is right for a drivetrain. Let go of an elevator, though, and
# it comes down. Something is missing in the model.
#
# Today's elevator and arm are simulated. We call that *the bench*, and we know its true gains
# because we built it. Run the next cell to set it up. (You need not read
# the code in this lesson to follow it. Run each cell, and read what it prints.)

# %%
from dataclasses import replace

import ipywidgets as widgets
import numpy as np

import sim
from sim.bench.mechanism import Mechanism
from sim.bench.mechanisms import MECHANISMS
from sim.bench.simulate import simulate
from sim.fit import fit
from sim.fit.information_matrix import compute_information
from sim.fit.sysid_rows import prepare_rows
from sim.physics.engine import State, simulate_run
from sim.plot import (
    Picture,
    Table,
    plot_curves,
    plot_ellipses,
    plot_hold_angles,
    plot_hold_window,
    plot_time_series,
    show_interactive,
)
from sim.teaching.prediction import Prediction

elevator, arm = MECHANISMS["elevator"], MECHANISMS["arm"]
truth = elevator.gains
print(elevator.summary)


def let_go(volts: float, *, height: float = 0.6, lasts: float = 0.4) -> float:
    """The speed [m/s] of the elevator after a while under a constant voltage; up is positive."""
    time = np.arange(0.0, lasts, 0.02)
    track = simulate_run(
        elevator.model, time=time, voltage=np.full(time.size, volts), state=State.cold_at(height)
    )
    return float(track.velocity[-1])


print(f"0 V: after 0.4 s it does {let_go(0.0):.2f} m/s. Minus is down.")

# %% [markdown]
# ## 2 The model: one more term
#
# Gravity pulls with a constant force. To hold a constant force, a motor needs a constant current,
# and that takes a constant voltage. We call it **kG**: the volts that gravity takes.
#
# > elevator: **V = kG + kS·sgn(v) + kV·v + kA·a**
#
# > arm: **V = kG·cos(θ) + kS·sgn(v) + kV·v + kA·a**
#
# (θ, "theta", is the arm's angle from level. sgn(v) is the direction: +1 up, −1 down.)
#
# Look at the first two terms. kS has a sign that flips: friction is always *against* the motion.
# kG has none: gravity pulls down, whichever way the elevator moves. That difference is what this
# lesson is about.
#
# **Predict** before you run on. (No buttons? Type `guess_load.value = "kG and kA"` in a cell.)

# %%
guess_load = Prediction(
    "A game piece makes the carriage 1.5 times as heavy. Which gains change?",
    "kV and kA",
    "kG and kA",
    "kG only",
    "all of them",
)
guess_load

# %%
TIMES = 1.5
UNITS = {"kS": "V", "kV": "V·s/m", "kA": "V·s²/m", "kG": "V"}
heavy = replace(elevator, load=TIMES * elevator.load).gains
print(f"You said: {guess_load}.")
Table(
    ("gain", f"at {elevator.load:.0f} kg", f"at {TIMES * elevator.load:.0f} kg", "times", "unit"),
    tuple((one, truth[one], heavy[one], heavy[one] / truth[one], UNITS[one]) for one in truth),
)

# %% [markdown]
# 1.5 times the mass needs 1.5 times the force: to hold it (kG) and to speed it up (kA). At a
# steady speed nothing is sped up, so kV does not care. (On the bench friction does not care
# either. On a real robot, more weight can press harder on a bearing.)
#
# > **Lesson says:** run the elevator with its load, "since kA and kV change significantly with load
# > mass".
# >
# > **Source says:** kV is the voltage "to hold (or "cruise") at a given constant velocity", against
# > the motor's own back-EMF and friction that grows with speed. There is no mass in it. kA is, and
# > kG is.
# > ([WPILib docs: Introduction to DC Motor Feedforward](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/introduction/introduction-to-feedforward.html))
# >
# > **Try it:** change `TIMES` above to 3. Which rows move?
#
# The advice to test with the load is still good: for kA and kG.
#
# **A free check.** Mass stands in kG and in kA, in the same way, so in kG/kA it cancels. What is
# left is gravity itself:

# %%
print(f"elevator: kG/kA = {truth['kG'] / truth['kA']:.2f} m/s². The pull of the earth is 9.81.")

# %% [markdown]
# On a real elevator with one stage the ratio is a little smaller, because kA also pays for the
# motors' own spinning parts, which weigh nothing on the rope. If yours says 15, look for a mistake
# before you trust either gain.
#
# A **cascade** elevator is different. Its lower stage moves at half the carriage's speed. With a
# carriage of mass m and a lower stage of mass m₁, the motor carries the weight (m + m₁/2)·g and
# speeds up the inertia m + m₁/4. So kG/kA lies between g and 2·g: 11.8 m/s² where both have the
# same mass.
#
# A **counterweight** on the other end of the rope adds inertia and takes away weight. Then kG/kA is
# below g. The bench has both:

# %%
for name in ("cascade-elevator", "counterweight-elevator"):
    other = MECHANISMS[name]
    ratio = other.gains["kG"] / other.gains["kA"]
    print(f"{other.summary}: kG/kA = {ratio:.1f} m/s²")

# %% [markdown]
# ## 3 Doing it: hold it still
#
# Now find kG without any log. Choose a voltage, hold the carriage in the middle, let go, watch.
#
# **Predict:**

# %%
guess_hold = Prediction(
    f"Gravity takes {truth['kG']:.2f} V, friction {truth['kS']:.2f} V. You give it "
    f"{truth['kG'] - 0.15:.2f} V, a little less than gravity takes. What does it do?",
    "it sinks slowly",
    "it stays",
    "it rises slowly",
)
guess_hold

# %%
little_less = let_go(truth["kG"] - 0.15)
print(f"You said: {guess_hold}.")
print(f"{truth['kG'] - 0.15:.2f} V: after 0.4 s it does {little_less:.3f} m/s.")

# %% [markdown]
# It stays. Friction is against *any* motion, also against falling: it helps you to hold. Only when
# the missing voltage is larger than kS does gravity win. And upward the same: only what exceeds
# kG by more than kS lifts it.
#
# So there is a **window**, from kG − kS to kG + kS, in which nothing moves. Recipes for kG turn the
# voltage up and stop at "the" right moment. Let us follow two of them, in steps of 10 mV.

# %%
steps = np.arange(0.0, 4.0, 0.01)
speeds = np.array([let_go(float(volts)) for volts in steps])
STILL = 1e-4  # [m/s] nobody sees it move

not_falling = float(steps[np.argmax(speeds > -STILL)])
not_rising = float(steps[np.flatnonzero(speeds < STILL)[-1]])
recipes = {
    "stop when it no longer drops": not_falling,
    "stop just before it rises": not_rising,
    "the middle of both": (not_falling + not_rising) / 2,
}


def window_picture(volts: float) -> Picture:
    """The window that holds, what the recipes find, and a voltage of your choice."""
    shown = slice(round(100 * not_falling) % 10 + 110, 311, 10)  # both edges are among them
    return plot_hold_window(
        steps[shown],
        speeds[shown],
        window=(truth["kG"] - truth["kS"], truth["kG"] + truth["kS"]),
        marks=recipes,
        here=(volts, let_go(volts)),
    )


show_interactive(
    window_picture,
    volts=widgets.FloatSlider(
        min=1.2, max=3.0, step=0.01, value=1.5, description="voltage [V]", continuous_update=False
    ),
)

# %% [markdown]
# No slider on your screen? Change the number here:

# %%
window_picture(1.5)

# %% [markdown]
# Move the star through the window. Where does it begin to sink, and where to rise?
#
# > **Lesson says:** for an elevator, kG is "measured by slowly increasing voltage until the
# > elevator just barely doesn't drop".
# >
# > **Source says:** raise kG "as much as you can without the elevator moving upward". That page's
# > simulation has no friction, and it says so: where kS matters, it recommends SysId.
# > ([WPILib docs: Tuning a Vertical Elevator](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/introduction/tuning-elevator.html))
# >
# > **Try it:** the two recipes are the two marks in the picture. One finds the lower edge, kG − kS,
# > the other the upper edge, kG + kS. They agree only where there is no friction.
#
# The honest recipe uses both edges:
#
# > **kG is the middle: (lower + upper) / 2. kS is half the width: (upper − lower) / 2.**

# %%
rows = [
    (
        name,
        volts,
        round(volts - truth["kG"], 3) + 0.0,
        round((volts - truth["kG"]) / truth["kV"], 3) + 0.0,
    )
    for name, volts in recipes.items()
]
print(f"half the width: {(not_rising - not_falling) / 2:.3f} V. True kS: {truth['kS']:.3f} V.")
Table(
    ("recipe", "taken for kG [V]", "too much by [V]", "moves upward too fast by [m/s]"),
    tuple(rows),
    caption=f"True kG: {truth['kG']:.3f} V. Minus means too little, or too fast downward.",
)

# %% [markdown]
# The last column is what a wrong kG does later, in a feedforward. With the first recipe the
# elevator is too slow on the way up and too fast on the way down; with the second it is the other
# way around. Always by kS/kV.
#
# (What is simplified: the bench's friction is the same at rest and in motion. Real friction often
# grips more at rest. Then this window is wider than the motion would tell.)
#
# How does the window depend on friction? At no friction it closes, and both recipes are right:


# %%
def edges_picture(friction: float) -> Picture:
    """Both edges over the friction, with a friction of your choice marked on the upper one."""
    ks = np.round(np.arange(0.0, 0.61, 0.05), 2)
    return plot_curves(
        ks,
        {"upper edge, kG + kS": truth["kG"] + ks, "lower edge, kG − kS": truth["kG"] - ks},
        xlabel="kS [V]",
        ylabel="voltage [V]",
        levels={"kG": truth["kG"]},
        marked=(friction, truth["kG"] + friction),
    )


show_interactive(
    edges_picture,
    friction=widgets.FloatSlider(
        min=0.0, max=0.6, step=0.05, value=0.25, description="kS [V]", continuous_update=False
    ),
)

# %% [markdown]
# No slider? Here:

# %%
edges_picture(0.25)

# %% [markdown]
# ## 4 An arm: the cosine
#
# Hold a heavy bag with your arm stretched out level. Now straight down. Same bag, same arm; level
# is far harder. What counts is how far out the weight is *sideways*, and for an arm of length L at
# the angle θ from level that is L·cos(θ). The cosine is 1 when level, 0 straight up or down.
#
# So gravity takes kG·cos(θ) volts. **Predict:**

# %%
guess_angle = Prediction(
    "The arm stands 60° above level. How much of kG does gravity take there?",
    "all of it",
    "about 9/10",
    "half",
    "a third",
)
guess_angle

# %%
cosines = [
    (f"{angle}°", round(float(np.cos(np.radians(angle))), 3)) for angle in (0, 30, 45, 60, 90, 120)
]
print(f"You said: {guess_angle}.")
print(f"np.cos(60) = {np.cos(60):.3f}. Careful: NumPy, Java and C++ count angles in radians.")
Table(("angle from level", "share of kG"), tuple(cosines))

# %% [markdown]
# Beyond 90° the share is negative: the arm has gone over the top, and gravity pulls it on.
#
# Friction does not know of angles. So the arm has a window everywhere, equally wide, around a
# middle that follows the cosine. Let us measure it at seven angles, as we did with the elevator.


# %%
def edges_at(degrees: float) -> tuple[float, float]:
    """The lowest and the highest voltage [V] that hold the arm at an angle from level."""
    angle = float(np.radians(degrees))
    time = np.arange(0.0, 0.1, 0.02)

    def stays(volts: float) -> bool:
        held = np.full(time.size, volts)
        track = simulate_run(arm.model, time=time, voltage=held, state=State.cold_at(angle))
        return abs(float(track.velocity[-1])) < STILL

    tried = np.arange(-1.0, 2.5, 0.01)
    holding = tried[[stays(float(volts)) for volts in tried]]
    return float(holding[0]), float(holding[-1])


true_angles = [-30, -15, 0, 20, 40, 60, 85]
measured = [(float(angle), *edges_at(angle)) for angle in true_angles]


def arm_picture(angle: float) -> Picture:
    """The windows of the arm, and an angle of your choice."""
    return plot_hold_angles(measured, kg=arm.gains["kG"], ks=arm.gains["kS"], here=angle)


show_interactive(
    arm_picture,
    angle=widgets.IntSlider(
        min=-90, max=90, step=5, value=60, description="angle [deg]", continuous_update=False
    ),
)

# %% [markdown]
# No slider? Here:

# %%
arm_picture(60)

# %% [markdown]
# ### An encoder that was mounted askew
#
# All this needs the angle from **level**. An encoder does not know where level is. It counts from
# wherever its zero happened to be when somebody mounted it. Say ours shows 25° too much. Then the
# true angle is reading + offset, with an offset of −25°.
#
# The window does not lie, though. Its middle follows kG·cos(reading + offset), and a cosine with an
# offset is a mix of a cosine and a sine:
#
# > kG·cos(r + offset) = **A**·cos(r) + **B**·sin(r), with A = kG·cos(offset) and
# > B = −kG·sin(offset)
#
# Two unknowns, A and B. At a reading of 0° the sine is 0, so the middle there is A. At 90° the
# cosine is 0, so the middle there is B. With more rows, a least-squares fit takes all of them
# (`np.linalg.lstsq`; lesson 7 says how it works). Then kG = √(A² + B²), and the offset is the angle
# whose tangent is −B/A (`np.arctan2` finds it).

# %%
TILT = 25.0  # [deg] that our encoder shows too much
table = [(angle + TILT, low, high) for angle, low, high in measured]
reading = np.radians([row[0] for row in table])
middle = np.array([(low + high) / 2 for _, low, high in table])
half_width = np.array([(high - low) / 2 for _, low, high in table])

columns = np.column_stack([np.cos(reading), np.sin(reading)])
(a_share, b_share), *_ = np.linalg.lstsq(columns, middle, rcond=None)
found_kg = float(np.hypot(a_share, b_share))
found_offset = float(np.degrees(np.arctan2(-b_share, a_share)))
print(f"kG = {found_kg:.3f} V (true: {arm.gains['kG']:.3f} V)")
print(f"kS = {half_width.mean():.3f} V (true: {arm.gains['kS']:.3f} V)")
print(f"offset = {found_offset:.1f}°, to be added to every reading")

# %% [markdown]
# Not quite the truth? We tried voltages in steps of 10 mV. An edge can lie anywhere between two
# steps, so half the width may come out too small by up to 10 mV. Finer steps do better.
#
# In the picture: the cosine has its top where the arm is *really* level, not at a reading of 0.


# %%
def askew_picture(offset: float) -> Picture:
    """The readings of the encoder that is askew, and the cosine with an offset of your choice."""
    return plot_hold_angles(table, kg=found_kg, ks=float(half_width.mean()), offset=offset)


show_interactive(
    askew_picture,
    offset=widgets.IntSlider(
        min=-60, max=60, step=5, value=0, description="offset [deg]", continuous_update=False
    ),
)

# %% [markdown]
# No slider? Here:

# %%
askew_picture(0)

# %% [markdown]
# Find the offset at which the band covers all marks. SysId does the same sum for an arm: it fits a
# cosine and a sine, and makes kG and the offset of them.
#
# > **Lesson says:** for an arm, kG is "the voltage needed at horizontal".
# >
# > **Source says:** the term is kG·cos(θ), with θ = 0 level. The page on arms holds the arm "with
# > as little movement as possible", and again leaves friction out.
# > ([WPILib docs: Tuning a Vertical Arm](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/introduction/tuning-vertical-arm.html))
# >
# > **Try it:** at a *reading* of 0°, what is the middle in our table, and by how much would you
# > miss kG?

# %%
at_zero = arm.gains["kG"] * float(np.cos(np.radians(TILT)))
print(f"At a reading of 0° the middle is {at_zero:.2f} V; kG is {arm.gains['kG']:.2f} V.")

# %% [markdown]
# ## 5 From a log: tell SysId what it looks at
#
# Holding still costs an hour of patience. The four tests of SysId find kG as well, with the other
# gains, *if* you choose the right **analysis type**. The types are the models of section 2:
#
# | analysis type | model | for |
# |---|---|---|
# | Simple | kS, kV, kA | drivetrain, flywheel, turret |
# | Elevator | kG + … | what moves straight up and down |
# | Arm | kG·cos(θ) + … | what swings up and down |
#
# Here are the four tests on our elevator. In the two *reverse* tests it goes down.

# %%
routine = sim.Routine(ramp=1.0, step=4.5)
log = simulate(elevator, routine, rng=np.random.default_rng(2))
plot_time_series(log)

# %% [markdown]
# **Predict:**

# %%
guess_type = Prediction(
    "We fit this log as Simple, which has no kG. What comes out?",
    "kS takes up kG, the rest is right",
    "the same gains, only kG is missing",
    "nonsense",
)
guess_type

# %%
drive_log = simulate(MECHANISMS["drivetrain"], sim.Routine(step=2.0), rng=np.random.default_rng(2))
arm_log = simulate(arm, sim.Routine(ramp=0.5, step=3.5), rng=np.random.default_rng(2))
cases = {
    "elevator": (log, ("elevator", "simple")),
    "arm": (arm_log, ("arm", "elevator", "simple")),
    "drivetrain": (drive_log, ("simple", "elevator")),
}
rows = []
for name, (one, types) in cases.items():
    gains = MECHANISMS[name].gains
    rows.append((f"{name}: truth", *(gains.get(gain, "–") for gain in ("kS", "kV", "kA", "kG"))))
    for kind in types:
        got = fit(one, type=kind, method="sysid").gains
        found = (got.get(gain, "–") for gain in ("kS", "kV", "kA", "kG"))
        rows.append((f"{name}, read as {kind}", *found))

print(f"You said: {guess_type}.")
Table(
    ("log", "kS [V]", "kV", "kA", "kG [V]"),
    tuple(rows),
    caption="kV in V·s/m and kA in V·s²/m; for the arm, in V·s/rad and V·s²/rad",
)

# %% [markdown]
# With the right type, the gains are close to the truth. (kS is the furthest off. It usually is.)
# Read as Simple, the elevator's gains are nonsense: kV is negative. The model has no term that is
# the same up and down, so the fit bends the others. (Our `sysid fit` prints doubts about such
# gains.)
#
# The arm that is read as Elevator is worse. Every gain is positive and looks possible, and every
# one is wrong. The last row is the gentle case: a drivetrain that is read as Elevator only finds a
# kG near 0.
#
# > **Lesson says:** "The DC motor model fitted by SysId does not include a gravity compensation
# > term. For arms and elevators, kG must be determined separately".
# >
# > **Source says:** SysId fits kG for both: "The constant term (kG) is added to correctly account
# > for the effect of gravity" (elevator), and "The cosine term (kG)" (arm). The lesson's sentence
# > is true only for the type *Simple*.
# > ([WPILib docs: Introduction to System Identification](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/system-identification/introduction.html))
# >
# > **Try it:** you just did. Compare kG in the second row with the truth.
#
# **Where to choose it.** In SysId's Data Selector, a menu holds the analysis type. It starts on
# *Elevator*, whatever you load
# ([SysId's source: DataSelector](https://github.com/wpilibsuite/allwpilib/tree/v2026.2.2/sysid/src/main/native/cpp/view)).
# Look at it every time. In this course: `sysid fit log.wpilog --type elevator`.
#
# **Why does an arm's log need the position?** Velocity and voltage are enough for the other types.
# An arm's gravity depends on the angle, so its fit needs the angle of every row. (SysId's
# window asks for a position in any case.)

# %% [markdown]
# ## 6 Only up: two gains become one
#
# Going down is unpleasant. The carriage drops from the first moment, and somebody has to lift it
# again. So why not skip the reverse tests, and drive up only? **Predict:**

# %%
guess_up = Prediction(
    "Fit an elevator that was only driven up. What can the fit tell?",
    "all four gains",
    "all but kA",
    "neither kS nor kG, only their sum",
    "nothing",
)
guess_up

# %%
up_only = replace(log, runs=tuple(run for run in log.runs if run.direction == "forward"))
print(f"You said: {guess_up}.")
try:
    fit(up_only)
except sim.Refusal as refusal:
    print(refusal)

# %% [markdown]
# On the way up sgn(v) is always +1, so every single row says
#
# > V = **kG + kS** + kV·v + kA·a
#
# The two only ever appear as a sum. Take 1 V off kG and give it to kS, and every row fits as well
# as before. A thousand rows do not help, as none of them is different.
#
# The next picture shows that. If you ran the tests again and again, noise would move the fitted
# pair (kS, kG) about. The shaded region holds 95 of 100 such fits: a *confidence ellipse*. A small
# ellipse means: well known. The slider adds rows of the way down.
#
# (You may skip the code. It takes rows without noise and computes how far noise could push a fit.)

# %%
SIDES = ("kS", "kG")


def quiet_rows(mechanism: Mechanism, routine: sim.Routine) -> dict:
    """The rows a fit sees of all four tests, as they would be without any noise."""
    sensor = replace(mechanism.sensor, velocity_noise=0.0, jitter=0.0, resolution=1e-9)
    seen = simulate(replace(mechanism, sensor=sensor), routine, rng=np.random.default_rng(0))
    return dict(prepare_rows(seen).rows)


def noise_of(mechanism: Mechanism) -> float:
    """What the encoder's noise amounts to in volts, in a row of 20 ms."""
    return mechanism.gains["kA"] * mechanism.sensor.velocity_noise / (np.sqrt(2) * 0.02)


all_rows = quiet_rows(elevator, routine)
forward = {test: part for test, part in all_rows.items() if test.endswith("forward")}
down = all_rows["quasistatic-reverse"]


def up_and(down_rows: int) -> Picture:
    """How well kS and kG are known from the way up and some rows of the way down."""
    used = {**forward, "quasistatic-reverse": down.select(slice(down_rows))}
    told = compute_information(used, type="elevator", noise=noise_of(elevator)).information_on_pair(
        *SIDES
    )
    return plot_ellipses(
        {f"the way up; rows of the way down: {down_rows}": told},
        names=("kS [V]", "kG [V]"),
        truth=(truth["kS"], truth["kG"]),
        reach=(0.25, 0.25),
    )


show_interactive(
    up_and,
    down_rows=widgets.SelectionSlider(
        options=[0, 1, 2, 5, 20, len(down)], value=0, description="rows down"
    ),
)

# %% [markdown]
# No slider? Change the number here: 0, 1, 5, 20.

# %%
up_and(0)

# %% [markdown]
# With no row of the way down the ellipse has no ends: it is a line, a band as wide as the noise.
# All along it kG + kS is the same. A single row of the way down closes it.
#
# An arm is kinder. On the way up its cosine changes and kS does not, so the two can be told apart,
# though not sharply:

# %%
rows = []
for name, mechanism, tests in (
    ("elevator", elevator, routine),
    ("arm", arm, sim.Routine(ramp=0.5, step=3.5)),
):
    every = quiet_rows(mechanism, tests)
    for which, ways in (("all four tests", ("forward", "reverse")), ("up only", ("forward",))):
        used = {test: part for test, part in every.items() if test.endswith(ways)}
        errors = compute_information(used, type=mechanism.type, noise=noise_of(mechanism)).errors
        cells = (errors[gain] if np.isfinite(errors[gain]) else "anything" for gain in SIDES)
        rows.append((f"{name}, {which}", *cells))
Table(("log", "kS ± [V]", "kG ± [V]"), tuple(rows), caption="One standard error of each")

# %% [markdown]
# (A *standard error* is the typical distance between a fit and the truth when only noise is to
# blame.)
#
# > **Lesson says:** "Skipping the reverse runs produces gains that only model the forward direction
# > accurately, and for mechanisms with gravity (arms, elevators) the two directions are physically
# > very different."
# >
# > **Source says:** SysId's window wants all four tests. Its maintainer once wrote that backward
# > tests are not required for the fit of an elevator or arm, they "just make Ks a bit more
# > accurate", and that they cannot be run accurately where the mechanism does not hold itself up.
# > ([sysid issue 492](https://github.com/wpilibsuite/sysid/issues/492))
# >
# > **Try it:** on the bench, an arm agrees roughly with the maintainer. An elevator does not: see
# > the table. Down is what separates kS from kG.
#
# So run them, and be ready. With 0 V the carriage already falls:

# %%
falls = (truth["kG"] - truth["kS"]) / truth["kV"]
down_run = log.runs_of_test("quasistatic-reverse")[0]
print(f"At 0 V it goes down at {falls:.2f} m/s.")
print(f"The slow ramp down had {down_run.time[-1] - down_run.time[0]:.1f} s before the end.")
print(f"The slow ramp up had {log.runs[0].time[-1] - log.runs[0].time[0]:.1f} s.")

# %% [markdown]
# ## 7 Which class, and in which order
#
# In the robot's code, the gains go into a *feedforward class*. There is one for each model:
#
# | analysis type | class | arguments |
# |---|---|---|
# | Simple | `SimpleMotorFeedforward` | kS, kV, kA |
# | Elevator | `ElevatorFeedforward` | kS, **kG**, kV, kA |
# | Arm | `ArmFeedforward` | kS, **kG**, kV, kA |
#
# (In Python, `SimpleMotorFeedforward` is called `SimpleMotorFeedforwardMeters` or `…Radians`.)
#
# kG is the **second** argument, before kV. In Java and Python all four are plain numbers, so
# nothing warns you when two of them trade places. And an `ArmFeedforward` wants the angle in
# **radians from level**: correct the encoder's offset first.
# ([WPILib docs: Feedforward Control](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/controllers/feedforward.html))
#
# ```java
# // kS, kG, kV, kA
# private final ElevatorFeedforward m_feedforward =
#     new ElevatorFeedforward(0.25, 2.01, 4.47, 0.205);
# ```
#
# ```python
# self.feedforward = ElevatorFeedforward(0.25, 2.01, 4.47, 0.205)  # kS, kG, kV, kA
# ```
#
# **Predict:** somebody writes `ElevatorFeedforward(kS, kV, kG, kA)`.

# %%
guess_order = Prediction(
    "kV and kG have traded places. The code asks the elevator to stand still. What happens?",
    "it stands still",
    "it sinks",
    "it goes up",
)
guess_order

# %%
wrong = truth["kV"]  # at rest, an ElevatorFeedforward gives what stands in kG's place
print(f"You said: {guess_order}.")
print(f"At rest it gets {wrong:.2f} V instead of {truth['kG']:.2f} V, and does ", end="")
print(f"{let_go(wrong, height=0.3):.2f} m/s.")

# %% [markdown]
# > **Lesson says:** "WPILib's ArmFeedforward and ElevatorFeedforward can absorb kG in addition to
# > the kS/kV/kA values SysId provides."
# >
# > **Source says:** yes, as their *second* argument; and SysId provides kG, too, if the type is
# > right.
# > ([WPILib docs: Feedforward Control](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/controllers/feedforward.html))
# >
# > **Try it:** write down the order for your own mechanism, then look at your robot's code.

# %% [markdown]
# ## 8 System check
#
# Before you trust a kG, all five:
#
# - [ ] You used **both** edges, or a log with both directions. Not one edge.
# - [ ] The analysis type is the mechanism's: Elevator, Arm or Simple.
# - [ ] An arm's angle is 0 when it is **level**, and in radians where the code wants radians.
# - [ ] Elevator: kG/kA is near 9.81 m/s²; above it (up to 19.6) only with a cascade, well below it
#   only with a counterweight or a spring.
# - [ ] In the code kG stands second, and the carriage holds still at zero speed.
#
# ## 9 Knowledge check
#
# First one to click; you are told at once. (No buttons on your screen? Type
# `quick.answer("kG")`, or another of the answers, in a cell.)

# %%
from grader import QuickCheck

quick = QuickCheck(
    "You raise the voltage until the elevator just does not drop. Which edge is that?",
    {
        "kG − kS": "Friction helps you hold it, so less than kG is enough.",
        "kG": "That is the middle. Would friction not help to hold it?",
        "kG + kS": "That is where it just begins to rise: there, friction is in your way.",
    },
    right="kG − kS",
)
quick

# %% [markdown]
# **1.** An elevator just does not fall at 1.2 V and just begins to rise at 1.8 V. What are kG and
# kS?
#
# <details><summary>Answer</summary>
#
# kG is the middle, 1.5 V. kS is half the width, 0.3 V. Either voltage alone is off by kS.
# </details>
#
# **2.** Which recipe finds the lower edge, and which the upper?
#
# <details><summary>Answer</summary>
#
# "Until it just does not drop" stops at the lower edge, kG − kS: friction helps you hold. "As much
# as you can without it moving upward" stops at the upper edge, kG + kS: friction is in your way.
# </details>
#
# **3.** You hold an arm straight up. What do the two edges tell you?
#
# <details><summary>Answer</summary>
#
# The cosine is 0 there, so gravity takes nothing. The edges are −kS and +kS: they tell you the
# friction, and nothing about kG. For kG, hold it level.
# </details>
#
# **4.** SysId shows a negative kV for an elevator, and the log looks clean. What do you look at
# first?
#
# <details><summary>Answer</summary>
#
# The analysis type. Read as Simple, an elevator's gains are nonsense. (Then the sign: does a
# positive voltage give a positive velocity?)
# </details>
#
# **5.** Your arm was measured empty. With a game piece it droops. Which gains must change?
#
# <details><summary>Answer</summary>
#
# kG and kA: both contain the mass. kV and kS hardly change. Lesson 8 comes back to this.
# </details>

# %% [markdown]
# ## 10 Practice
#
# **Exercise 3** (`exercises/exercise3/README.md`). You get an elevator and an arm of your own. In a
# terminal, in the course's folder:
#
# ```
# grade exercise3
# ```
#
# It makes your numbers, and later checks `exercises/exercise3/answers.toml`. You may also answer
# from a notebook:
#
# ```python
# from grader import submit
# submit("exercise3", elevator_kG=1.5, elevator_kS=0.3, elevator_type="Elevator")
# ```
#
# For the elevator you need section 3, for the arm and its offset section 4, for type and class
# sections 5 and 7. Hints cost nothing: `grade exercise3 --hint`.
#
# **More, if you like.**
#
# - Give the arm's table noise: add `0.02 * np.random.default_rng(1).standard_normal(7)` to the
#   middles. How far does the offset move?
# - A constant-force spring lifts the carriage with 1 V worth of force. What is kG now? Can it
#   become negative?
#
# Next: lesson 3, test design.
