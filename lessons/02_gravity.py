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
# *About 40 minutes. You need lesson 1: what kS, kV and kA mean. Section 4 uses the cosine and
# explains it.*
#
# ![The height of an elevator after somebody lets go of it. With 0 V it falls, with 2 V it stays,
# and with 4 V it rises.](attachment:picture.png)
#
# **At the end you can**
#
# - say what kG is, and which voltages hold an elevator still;
# - find kG and kS from two voltages, and say which methods find a wrong kG;
# - find kG and kS of an arm, and correct the zero of its encoder (the sensor that measures
#   position);
# - choose SysId's analysis type and WPILib's feedforward class, with the arguments in the right
#   order;
# - say which gains you get if you drive an elevator only up.

# %% [markdown]
# ## 1 Why: an elevator falls
#
# The model of lesson 1 gives the voltage for a motion:
#
# > V = kS·sgn(v) + kV·v + kA·a
#
# This model says that nothing moves with 0 V. That is right for a drivetrain. But the *carriage* of
# an elevator (the part that moves up and down) falls when you let go of it. The model has no term
# for gravity.
#
# Today's elevator and arm are simulated, so we know their true gains. Run the next cell to set them
# up. (You do not need to read the code. Run each cell, and read what it prints.)

# %%
from dataclasses import replace
from textwrap import fill

import numpy as np
from IPython.display import display

import sim
from grader import ask_question, enable_checkboxes
from sim.bench.mechanisms import MECHANISMS
from sim.bench.simulate import simulate
from sim.fit import fit
from sim.physics.engine import State, simulate_run
from sim.plot import Table, plot_time_series
from sim.plot.animation import Choice, Gain, Knob, Motion, Panel, Scene, animate_mechanism
from sim.plot.animation.charts import (
    Chart,
    Curve,
    animate_charts,
    chart_gain_errors,
    chart_hold_angles,
    chart_hold_window,
)
from sim.teaching.gain_errors import compute_gain_errors, simulate_rows

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


print(f"0 V: after 0.4 s the carriage moves at {let_go(0.0):.2f} m/s. A minus sign means down.")

# %% [markdown]
# ## 2 The model: one more term
#
# Gravity pulls with a constant force. To balance a constant force, a motor needs a constant
# current, and therefore a constant voltage. We call this voltage **kG**.
#
# > elevator: **V = kG + kS·sgn(v) + kV·v + kA·a**
#
# > arm: **V = kG·cos(θ) + kS·sgn(v) + kV·v + kA·a**
#
# (θ, "theta", is the arm's angle. It is 0° when the arm is level (horizontal). sgn(v) is the
# direction: +1 up, −1 down.)
#
# Compare the first two terms. The kS term changes its sign with the direction, because friction
# always acts *against* the motion. The kG term keeps its sign, because gravity always pulls down.
#
# **Predict:**

# %%
ask_question("lesson2.load")

# %%
TIMES = 1.5
UNITS = {"kS": "V", "kV": "V·s/m", "kA": "V·s²/m", "kG": "V"}
heavy = replace(elevator, load=TIMES * elevator.load).gains
Table(
    ("gain", f"at {elevator.load:.0f} kg", f"at {TIMES * elevator.load:.0f} kg", "factor", "unit"),
    tuple((one, truth[one], heavy[one], heavy[one] / truth[one], UNITS[one]) for one in truth),
)

# %% [markdown]
# With 1.5 times the mass, the motor needs 1.5 times the force to hold the carriage (kG) and to
# accelerate it (kA). At a steady speed nothing accelerates, so kV does not change. (In our
# simulation kS does not change either. On a real robot, more weight can press harder on a bearing
# and increase the friction.)
#
# So test an elevator with the load that it will carry: otherwise kG and kA are wrong. Click the bar
# above the table, change `TIMES` to 3, and run the cell again. Which rows of the table change?
#
# <details><summary>For mentors: does kV change with the load?</summary>
#
# > **Lesson says:** run the elevator with its load, "since kA and kV change significantly with load
# > mass". **Source says:** kV is the voltage "to hold (or "cruise") at a given constant velocity",
# > against the motor's own back-EMF and friction that grows with speed. There is no mass in it. kA
# > and kG depend on the mass. ([WPILib docs: Introduction to DC Motor
# > Feedforward](https://github.com/wpilibsuite/frc-docs/blob/250e32128d9a93f27d58bc3cd1d0b3ab5eec43cd/source/docs/software/advanced-controls/introduction/introduction-to-feedforward.rst))
# >
# > **Try it:** change `TIMES` above to 3. Which rows of the table change?
# </details>
#
# **A quick check.** Both kG and kA grow in proportion to the mass. So kG/kA does not depend on the
# mass. For an elevator, kG/kA is the acceleration of gravity:

# %%
print(f"elevator: kG/kA = {truth['kG'] / truth['kA']:.2f} m/s². Gravity is 9.81 m/s².")

# %% [markdown]
# On a real elevator kG/kA is smaller, because kA also contains the spinning parts of the motors: a
# little smaller with usual gears, much smaller with a very high gear ratio. If your kG/kA is 15
# m/s², look for a mistake before you trust the two gains.
#
# For two kinds of elevator, kG/kA is not near 9.81 m/s². The next cell computes kG/kA for both:
#
# - In a **cascade**, a lower stage moves, too, at half the carriage's speed: kG/kA is between g and
#   2·g. (g is the acceleration of gravity.)
# - With a **counterweight** on the other end of the rope, the motor lifts less weight, but
#   accelerates more mass. So kG/kA is below g.
#
# <details><summary>Want to know why?</summary>
#
# Let the carriage of a cascade have the mass m and its lower stage the mass m₁. The carriage moves
# at the speed v, and the stage at v/2. To lift both, the motor needs the power m·g·v + m₁·g·v/2.
# One weight of (m + m₁/2)·g that moves at v needs the same power. Together, carriage and stage have
# the kinetic energy m·v²/2 + m₁·(v/2)²/2. One mass of m + m₁/4 that moves at v has the same energy.
# So kG/kA is 11.8 m/s² if both have the same mass.
#
# A counterweight of mass m₂ goes down at the speed v. So the motor lifts the weight (m − m₂)·g and
# accelerates the mass m + m₂. (Textbooks call it Atwood's machine: Goldstein, *Classical
# Mechanics*, 3rd edition (2002), section 1.6.)
# </details>

# %%
for name in ("cascade-elevator", "counterweight-elevator"):
    other = MECHANISMS[name]
    print(f"{other.summary}:\n    kG/kA = {other.gains['kG'] / other.gains['kA']:.1f} m/s²")

# %% [markdown]
# ## 3 Doing it: hold it still
#
# Now find kG without a log. Choose a voltage, hold the carriage in the middle, let go, and watch
# it.
#
# **Predict:**

# %%
ask_question("lesson2.hold", kG=truth["kG"], kS=truth["kS"], less=truth["kG"] - 0.15)

# %%
less = truth["kG"] - 0.15
print(f"{less:.2f} V: after 0.4 s the carriage moves at {let_go(less):.3f} m/s.")

# %% [markdown]
# The carriage stays. Friction acts against *any* motion, even falling, so friction helps you to
# hold the carriage. The carriage sinks only if your voltage is less than kG − kS. The carriage
# rises only if your voltage is more than kG + kS.
#
# So there is a **window** of voltages, from kG − kS to kG + kS, in which nothing moves. Two common
# methods for kG raise the voltage little by little. One method stops when the carriage no longer
# drops. The other stops just before the carriage rises. Which method is right?

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


MIDDLE = 0.6  # [m] where you let go
animate_mechanism(
    "elevator",
    Scene(
        np.arange(0.0, 1.01, 0.02),
        (Motion("carriage", gains=truth, type="elevator", voltage=Gain("volts"), start=MIDDLE),),
    ),
    panels=(
        Panel("position", "height [m]", low=0.0, high=1.2),
        Panel("velocity", "velocity [m/s]", low=-0.2, high=0.2),
    ),
    knobs=(Knob("volts", "voltage [V]", low=1.2, high=3.0, step=0.01, value=1.5),),
    span=(0.0, 1.2),
    alt=f"You choose a voltage and let go of a carriage at a height of {MIDDLE} m. The carriage "
    "sinks, stays or rises.",
)

# %% [markdown]
# Change the voltage and press *Play*. At which voltage does the carriage begin to sink, and at
# which does it begin to rise? Then run the next cell: it tries a voltage every 10 mV, and shows
# which kG each method finds.

# %%
shown = slice(round(100 * not_falling) % 10 + 110, 311, 10)  # both edges are among them
window = (truth["kG"] - truth["kS"], truth["kG"] + truth["kS"])
animate_charts(lambda: chart_hold_window(steps[shown], speeds[shown], window=window, marks=recipes))

# %% [markdown]
# **Myth check.** "Raise the voltage until the elevator no longer drops: that is kG." *Not quite:*
# this method finds the lower edge of the window, kG − kS. Another method raises the voltage "as
# much as you can without the elevator moving upward". This method finds the upper edge, kG + kS.
# The two edges are equal only without friction.
#
# <details><summary>For mentors: the two methods, and their sources</summary>
#
# > **Lesson says:** for an elevator, kG is "measured by slowly increasing voltage until the
# > elevator just barely doesn't drop".
# >
# > **Source says:** raise kG "as much as you can without the elevator moving upward". The
# > simulation on that page has no friction, and the page says so. For mechanisms where kS matters,
# > it recommends SysId. ([WPILib docs: Tuning a Vertical
# > Elevator](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/introduction/tuning-elevator.html))
# >
# > **Try it:** look at the marks of the two methods in the picture. One method finds the lower
# > edge, kG − kS, and the other finds the upper edge, kG + kS. They agree only without friction.
# </details>
#
# So use both edges of the window:
#
# > **kG is the middle: (lower + upper) / 2. kS is half the width: (upper − lower) / 2.**

# %%
errors = {name: round(volts - truth["kG"], 3) + 0.0 for name, volts in recipes.items()}
rows = [
    (name, recipes[name], error, round(error / truth["kV"], 3) + 0.0)
    for name, error in errors.items()
]
print(f"Half the window's width is {(not_rising - not_falling) / 2:.3f} V.", end=" ")
print(f"The true kS is {truth['kS']:.3f} V.")
Table(
    ("method", "its kG [V]", "error of kG [V]", "error of velocity [m/s]"),
    tuple(rows),
    caption=f"The true kG is {truth['kG']:.3f} V. A positive velocity is upward.",
)

# %% [markdown]
# The last column shows the velocity error that a wrong kG causes later, in a feedforward. With the
# first method the elevator is too slow on the way up and too fast on the way down. With the second
# method it is too fast on the way up and too slow on the way down. The velocity error is always
# kS/kV.
#
# With less friction the window is narrower. Without friction there is no window, and both methods
# are right.
#
# (This is simplified: our simulated friction is the same at rest and in motion. Real friction is
# often larger at rest. Then the window of voltages is wider than 2·kS.)

# %% [markdown]
# ## 4 An arm: the cosine
#
# Hold a heavy bag with your arm stretched out level. Then let the arm hang straight down. The bag
# is the same, but you need far more strength while your arm is level. Only the *horizontal*
# distance from your shoulder to the weight matters. For an arm of length L at the angle θ from
# level, this distance is L·cos(θ). The cosine is 1 when the arm is level, and 0 when it points
# straight up or down.
#
# So the motor needs kG·cos(θ) volts to balance gravity. **Predict:**

# %%
ask_question("lesson2.angle")

# %%
print(f"np.cos(60) = {np.cos(60):.3f}: NumPy, Java and C++ need angles in radians.")
for angle in (0, 60, 120):
    print(f"At {angle}° the motor needs {np.cos(np.radians(angle)):g} · kG.".replace("-", "−"))

# %% [markdown]
# Beyond 90° the share of kG is negative: the arm is past the top, and gravity pulls it down on the
# other side.
#
# Friction does not depend on the angle. So the window of voltages that hold the arm has the same
# width at every angle. The middle of the window is kG·cos(θ). Hold the arm at 0°, then at 60°: at
# which voltages does it stay?


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


MOTIONS = {
    f"{degrees}°".replace("-", "−"): Motion(
        "arm", gains=arm.gains, type="arm", voltage=Gain("volts"), start=float(np.radians(degrees))
    )
    for degrees in (-30, 0, 30, 60, 85)
}
animate_mechanism(
    "arm",
    {(name,): Scene(np.arange(0.0, 1.01, 0.02), (held,)) for name, held in MOTIONS.items()},
    choices=(Choice("angle", tuple(MOTIONS), value="60°"),),
    knobs=(Knob("volts", "voltage [V]", low=-0.5, high=2.5, step=0.01, value=0.2),),
    panels=(Panel("position", "angle [°]", low=-90.0, high=135.0, scale=180 / np.pi),),
    alt="The picture shows an arm at its angle. You choose a voltage and let go of the arm. At "
    "every angle, a window of voltages holds the arm. These voltages are highest where the arm is "
    "level.",
)

# %% [markdown]
# The next picture shows this window at seven angles. We tried a voltage every 10 mV:

# %%
animate_charts(lambda: chart_hold_angles(measured, kg=arm.gains["kG"], ks=arm.gains["kS"]))

# %% [markdown]
# ### An encoder with an offset
#
# The formula needs the angle from **level**. But an encoder does not know where level is: its zero
# depends on how somebody mounted it. The *reading* is the angle that the encoder shows. The
# *offset* is what you add to a reading to get the true angle.
#
# Our encoder shows too much. In the next picture the marks are highest where the arm is *really*
# level, not where the encoder shows 0°. Find the offset at which the shaded band covers all marks.


# %%
def chart_offset(offset: float) -> Chart:
    """The readings of the encoder that is askew, and the cosine with an offset of your choice."""
    readings = np.linspace(-120.0, 120.0, 49)
    middle = arm.gains["kG"] * np.cos(np.radians(readings + offset))
    width = arm.gains["kS"]
    band = np.concatenate([middle - width, (middle + width)[::-1]])
    angles, lowest, highest = zip(*table, strict=True)
    curves = (
        Curve("window", np.concatenate([readings, readings[::-1]]), band, "area", 4),
        Curve("kG·cos(reading + offset)", readings, middle, "dashed", 0),
        Curve("no longer falls", angles, lowest, "dots", 1),
        Curve("begins to rise", angles, highest, "dots", 2),
    )
    return Chart("what the encoder reads [deg]", "voltage [V]", curves)


TILT = 25.0  # [deg] our encoder shows this much too much
table = [(angle + TILT, low, high) for angle, low, high in measured]
animate_charts(
    chart_offset,
    knobs=(Knob("offset", "offset [deg]", low=-60.0, high=60.0, step=2.5, value=0.0),),
)

# %% [markdown]
# The next cell computes the offset with a fit, and kG and kS, too. Is it the offset that you found?
#
# <details><summary>How to compute the offset (you need it for exercise 3)</summary>
#
# Let r be the reading. The middle of the window is kG·cos(r + offset). A rule of mathematics splits
# this term into a cosine and a sine:
#
# > kG·cos(r + offset) = **A**·cos(r) + **B**·sin(r), with A = kG·cos(offset) and
# > B = −kG·sin(offset)
#
# So the fit has to find two numbers, A and B. At a reading of 0° the sine is 0, so the middle of
# the window is A. At 90° the cosine is 0, so the middle is B. If you have measured more angles, a
# least-squares fit uses all of them (`np.linalg.lstsq`; lesson 7 explains it). Then kG = √(A² +
# B²), and the offset is the angle whose tangent is −B/A (`np.arctan2`).
# </details>

# %%
reading = np.radians([row[0] for row in table])
middle = np.array([(low + high) / 2 for _, low, high in table])
half_width = np.array([(high - low) / 2 for _, low, high in table])

columns = np.column_stack([np.cos(reading), np.sin(reading)])
(a_share, b_share), *_ = np.linalg.lstsq(columns, middle, rcond=None)
found_kg = float(np.hypot(a_share, b_share))
found_offset = float(np.degrees(np.arctan2(-b_share, a_share)))
print(f"kG = {found_kg:.3f} V (true: {arm.gains['kG']:.3f} V)")
print(f"kS = {half_width.mean():.3f} V (true: {arm.gains['kS']:.3f} V)")
print(f"offset = {found_offset:.1f}° (true: {-TILT:g}°). Add the offset to every reading.")

# %% [markdown]
# The fit is not exactly right, because we tried only one voltage every 10 mV.
#
# SysId uses the same method for an arm: it fits a cosine and a sine, and computes kG and the offset
# from them.
#
# So "the voltage at horizontal" is kG only if you use the middle of the window, and if your encoder
# shows 0° when the arm is level. What is the middle of the window when our encoder shows 0°?
#
# <details><summary>For mentors: kG at horizontal, and its source</summary>
#
# > **Lesson says:** for an arm, kG is "the voltage needed at horizontal".
# >
# > **Source says:** the term is kG·cos(θ), and θ = 0 means level. WPILib's page on arms holds the
# > arm "with as little movement as possible", and its simulation has no friction either. ([WPILib
# > docs: Tuning a Vertical
# > Arm](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/introduction/tuning-vertical-arm.html))
# >
# > **Try it:** when our encoder shows 0°, what is the middle of the window? How far is this voltage
# > from kG?
# </details>

# %%
at_zero = arm.gains["kG"] * float(np.cos(np.radians(TILT)))
print(f"When the encoder shows 0°, the middle of the window is {at_zero:.2f} V.", end=" ")
print(f"But kG is {arm.gains['kG']:.2f} V.")

# %% [markdown]
# ## 5 From a log: choose the analysis type
#
# Finding the window by hand takes time. From SysId's four tests you get kG and the other gains
# together, *if* you choose the right **analysis type**. Each type is one model:
#
# | analysis type | model | for |
# |---|---|---|
# | Simple | kS, kV, kA | drivetrain, flywheel, turret |
# | Elevator | kG + … | mechanisms that move straight up and down |
# | Arm | kG·cos(θ) + … | mechanisms that swing up and down |
#
# Here are the four tests of our elevator. In the two *reverse* tests it goes down.

# %%
routine = sim.Routine(ramp=1.0, step=4.5)
log = simulate(elevator, routine, rng=np.random.default_rng(2))
plot_time_series(log)

# %% [markdown]
# **Predict:**

# %%
ask_question("lesson2.type")

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
    rows.append(
        (f"{name}: true gains", *(gains.get(gain, "–") for gain in ("kS", "kV", "kA", "kG")))
    )
    for kind in types:
        got = fit(one, type=kind, method="sysid").gains
        found = (got.get(gain, "–") for gain in ("kS", "kV", "kA", "kG"))
        rows.append((f"{name}, fitted as {kind}", *found))

Table(
    ("log", "kS [V]", "kV", "kA", "kG [V]"),
    tuple(rows),
    caption="Units: kV in V·s/m and kA in V·s²/m. For the arm: V·s/rad and V·s²/rad.",
)

# %% [markdown]
# With the right type, the gains are close to the truth. With the type Simple, the elevator's gains
# are nonsense: kV is negative. Gravity pulls downward in every row of the log. This model has no
# term for gravity, so the fit makes the other terms wrong. (`sysid fit` warns about such gains.)
#
# It is more dangerous to fit the arm with the type Elevator: every gain is positive and looks
# possible, but every gain is wrong. The mistake in the last row of the table is harmless: if you
# fit a drivetrain with the type Elevator, you get a kG near 0.
#
# **Myth check.** "SysId does not find kG; you must measure it separately." *False:* SysId fits kG
# for the types Elevator and Arm. The sentence is true only for the type Simple. Compare kG in the
# second row of the table with the true kG.
#
# <details><summary>For mentors: SysId fits kG, with source</summary>
#
# > **Lesson says:** "The DC motor model fitted by SysId does not include a gravity compensation
# > term. For arms and elevators, kG must be determined separately".
# >
# > **Source says:** SysId fits kG for both: "The constant term (kG) is added to correctly account
# > for the effect of gravity" (elevator), and "The cosine term (kG)" (arm). The lesson's sentence
# > is true only for the type *Simple*.
# > ([WPILib docs: Introduction to System Identification](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/system-identification/introduction.html))
# >
# > **Try it:** compare kG in the second row of the table with the true kG.
# </details>
#
# **Where to choose the type.** The menu for the type is in SysId's Data Selector. This menu starts
# on *Elevator*, whatever you load ([SysId's source:
# DataSelector](https://github.com/wpilibsuite/allwpilib/tree/v2026.2.2/sysid/src/main/native/cpp/view)).
# In this course you type `sysid fit log.wpilog --type elevator`.
#
# **Why does an arm's log need the position?** The torque of gravity on an arm depends on the angle,
# so the fit needs the angle in every row of the log. The other types need only velocity and
# voltage.

# %% [markdown]
# ## 6 Only up: is that enough?
#
# Nobody likes the tests in which an elevator moves down (the reverse tests). The carriage drops as
# soon as the test starts, and somebody has to lift it again. Can you skip the reverse tests and
# drive only up? **Predict:**

# %%
ask_question("lesson2.up")

# %%
up_only = replace(log, runs=tuple(run for run in log.runs if run.direction == "forward"))
try:
    fit(up_only)
except sim.Refusal as refusal:
    print(fill(str(refusal)))

# %% [markdown]
# On the way up sgn(v) is always +1, so every row of the log gives the equation
#
# > V = **kG + kS** + kV·v + kA·a
#
# kG and kS are always together in a sum. If you make kG 1 V smaller and kS 1 V larger, the model
# matches every row as well as before. Even a thousand rows do not help, because each row shows only
# the sum.
#
# Every sensor has *noise*: small random errors. If you repeated the tests, noise would change each
# fitted gain a little. In the next picture, the bar of a gain shows its *standard error*: the
# typical distance from the true gain. A bar as long as the gain itself means: this gain is
# **unknown**. With the slider you add rows that were recorded while the carriage moved down.

# %%
all_rows = simulate_rows(elevator, routine)
forward = {test: part for test, part in all_rows.items() if test.endswith("forward")}
down = all_rows["quasistatic-reverse"]


def show_gain_errors(down_rows: float) -> Chart:
    """Bars of the gains' errors in a fit of the way up and some rows of the way down."""
    used = {**forward, "quasistatic-reverse": down.select(slice(int(down_rows)))}
    return chart_gain_errors(compute_gain_errors(elevator, used))


animate_charts(
    show_gain_errors,
    knobs=(Knob("rows", "rows down", low=0.0, high=len(down), step=1.0, value=0.0),),
)

# %% [markdown]
# Without rows from the way down, kS and kG are unknown: only their sum is known. One row from the
# way down separates them, and more rows make the bars shorter.
#
# For an arm this is easier. On the way up, cos(θ) changes and kS does not. So the fit can separate
# kG from kS, but not precisely:

# %%
rows = []
for name, mechanism, tests in (
    ("elevator", elevator, routine),
    ("arm", arm, sim.Routine(ramp=0.5, step=3.5)),
):
    every = simulate_rows(mechanism, tests)
    for which, ways in (("all four tests", ("forward", "reverse")), ("up only", ("forward",))):
        used = {test: part for test, part in every.items() if test.endswith(ways)}
        errors = compute_gain_errors(mechanism, used)
        shares = (100 * errors[gain] for gain in ("kS", "kG"))
        rows.append((f"{name}, {which}", *(one if one < 100 else "unknown" for one in shares)))
Table(("log", "kS ± [%]", "kG ± [%]"), tuple(rows), caption="± is one standard error")

# %% [markdown]
# So on an elevator, only the reverse tests separate kS from kG. SysId's window asks for all four
# tests. Run all four, and be careful: the carriage falls even with 0 V, and **each test ends with
# 0 V**. ([`SysIdRoutine` of robotpy-commands-v2
# 2026.2.2](https://pypi.org/project/robotpy-commands-v2/2026.2.2/)) Set the motors to *Brake*: then
# they slow the falling carriage down. The next cell computes how fast it still falls. In *Coast*
# mode they do not, and the carriage falls freely. A TalonFX is in *Coast* mode until you change it.
# ([`MotorOutputConfigs` of phoenix6 26.3.0](https://pypi.org/project/phoenix6/26.3.0/)) As soon
# as a test ends, the program's usual command drives the motors again: lesson 5, section 8.
#
# <details><summary>For mentors: are reverse tests needed for gravity mechanisms?</summary>
#
# > **Lesson says:** "Skipping the reverse runs produces gains that only model the forward direction
# > accurately, and for mechanisms with gravity (arms, elevators) the two directions are physically
# > very different."
# >
# > **Source says:** SysId's window requires all four tests. Its maintainer once wrote that backward
# > tests are not required for the fit of an elevator or arm, they "just make Ks a bit more
# > accurate", and that they cannot be run accurately where the mechanism does not hold itself up.
# > ([sysid issue 492](https://github.com/wpilibsuite/sysid/issues/492))
# >
# > **Try it:** look at the table. For the simulated arm, the maintainer is roughly right. For the
# > elevator this is wrong: only downward tests separate kS from kG.
# </details>

# %%
falls = (truth["kG"] - truth["kS"]) / truth["kV"]
down_run = log.list_runs_of_test("quasistatic-reverse")[0]
print(f"At 0 V the carriage goes down at {falls:.2f} m/s.")
print(f"The slow ramp down, to the bottom, lasted {down_run.time[-1] - down_run.time[0]:.1f} s.")
print(f"The slow ramp up lasted {log.runs[0].time[-1] - log.runs[0].time[0]:.1f} s.")

# %% [markdown]
# ## 7 Which class, and in which order
#
# In the robot's code, you put the gains into a *feedforward class*. WPILib has one class for each
# model:
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
# nothing warns you when you swap two of them. And an `ArmFeedforward` needs the angle in **radians
# from level**: correct the encoder's offset first. ([WPILib docs: Feedforward
# Control](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/controllers/feedforward.html))
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
ask_question("lesson2.order")

# %%
wrong = truth["kV"]
print(f"At rest the motor gets {wrong:.2f} V instead of {truth['kG']:.2f} V.")
print(f"The carriage moves at {let_go(wrong, height=0.3):.2f} m/s.")

# %% [markdown]
# At rest, an `ElevatorFeedforward` gives its second argument. So check the order of the arguments
# in your robot's code today.
#
# <details><summary>For mentors: kG in WPILib's classes, with source</summary>
#
# > **Lesson says:** "WPILib's ArmFeedforward and ElevatorFeedforward can absorb kG in addition to
# > the kS/kV/kA values SysId provides."
# >
# > **Source says:** yes, kG is their *second* argument. SysId provides kG, too, if the analysis
# > type is right. ([WPILib docs: Feedforward
# > Control](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/controllers/feedforward.html))
# >
# > **Try it:** write down the order of the arguments for your own mechanism. Then look at your
# > robot's code.
# </details>

# %% [markdown]
# ## 8 System check
#
# Before you trust a kG, check these five points:
#
# - [ ] You used **both** edges of the window, or a log with both directions.
# - [ ] You chose the analysis type for this mechanism: Elevator, Arm or Simple.
# - [ ] An arm's angle is 0 when the arm is **level**, and the angle is in radians where the code
#   needs radians.
# - [ ] An elevator's kG/kA is near 9.81 m/s². It is larger (up to 19.6) only with a cascade, and
#   much smaller only with a counterweight, a spring or a very high gear ratio.
# - [ ] In the code kG is the second argument, and the carriage stays still at zero speed.
#
# ## 9 Knowledge check
#
# Click an answer to the first question; you get feedback at once.

# %%
display(ask_question("lesson2.quick"), enable_checkboxes())

# %% [markdown]
# **1.** You raise the voltage slowly. At 1.2 V an elevator no longer falls. At 1.8 V it begins to
# rise. What are kG and kS?
#
# <details><summary>Answer</summary>
#
# kG is the middle, 1.5 V. kS is half the width, 0.3 V. If you took one of the two voltages as kG,
# the error would be kS.
# </details>
#
# **2.** Which method for kG finds the lower edge of the window, and which finds the upper edge?
#
# <details><summary>Answer</summary>
#
# "Raise the voltage until it no longer drops" finds the lower edge, kG − kS, because friction helps
# you to hold the elevator. "As much as you can without it moving upward" finds the upper edge, kG +
# kS, because friction acts against the motor.
# </details>
#
# **3.** An arm points straight up. You find the lowest and the highest voltage that hold it. What
# do these two edges tell you?
#
# <details><summary>Answer</summary>
#
# The cosine is 0 there, so the motor needs no voltage against gravity. The edges are −kS and +kS:
# they show the friction, but not kG. For kG, hold the arm level.
# </details>
#
# **4.** SysId shows a negative kV for an elevator, and the log looks clean. What do you check
# first?
#
# <details><summary>Answer</summary>
#
# Check the analysis type first. If you fit an elevator with the type Simple, the gains are
# nonsense. (Then check the sign: does a positive voltage give a positive velocity?)
# </details>
#
# **5.** You measured the gains of an arm without a game piece. With a game piece, the arm sinks.
# Which gains must change?
#
# <details><summary>Answer</summary>
#
# kG and kA must change: both contain the mass. kV and kS hardly change. Lesson 8 comes back to
# this.
# </details>

# %% [markdown]
# ## 10 Practice
#
# **Exercise 3** ([exercises/exercise3/README.md](../exercises/exercise3/README.md)). You get your
# own elevator and your own arm. In a terminal, in the course's folder:
#
# ```
# grade exercise3
# ```
#
# The first time you run it, this command creates your own numbers. After that, it checks
# `exercises/exercise3/answers.toml`. (`grade watch exercise3` checks each time you save that file.)
# You can also answer in a notebook:
#
# ```python
# from grader import submit
# submit("exercise3", elevator_kG=..., elevator_kS=..., elevator_type="...")
# ```
#
# You need section 3 for the elevator, section 4 for the arm and its offset, and sections 5 and 7
# for the analysis type and the class. Hints cost nothing: `grade exercise3 --hint`.
#
# <details><summary>More, if you like</summary>
#
# - Add noise to the middle voltages of the arm's windows: `middle = middle + 0.02 *
#   np.random.default_rng(1).standard_normal(7)`. By how much does the fitted offset change?
# - A constant-force spring pulls the carriage up as hard as the motor does with 1 V. What is kG
#   now? Can kG become negative?
# </details>
#
# **Next:** [Lesson 3, test design](03_test_design.ipynb). Which tests does a robot need?
