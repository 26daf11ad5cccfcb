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
# # Lesson 7: Fit it yourself
#
# *About 45 minutes. You need lessons 1 and 3. You do not need to know what a regression is: you
# learn it here.*
#
# ![Voltage over speed: noisy samples, a straight line through them, and the error of the line at
# each sample.](attachment:picture.png)
#
# **At the end you can**
#
# - compute gains from a log with five lines of NumPy;
# - say why SysId puts the *acceleration* on the left side, and what happens without that;
# - explain SysId's two R², compute both, and say which errors neither of them shows;
# - explain how kS can become negative, and what a filter does to kA;
# - explain which three settings determine the suggested kP, and why it is only a first guess.

# %% [markdown]
# ## 1 Why: the analyzer is not magic
#
# SysId reads a log and prints gains. Often the gains are good. Sometimes they are wrong, but look
# just as good. When you have built the fit (the calculation that finds the gains) yourself, you
# know where it can go wrong.
#
# Today's robot is our simulated drivetrain. Its gears rattle a little, so its measured velocity is
# noisy. We know its true gains.

# %%
from dataclasses import replace

import numpy as np
from IPython.display import display

import sim
from grader import ask_question, enable_checkboxes
from sim.bench.duty_cycle import simulate_duty_cycle
from sim.bench.mechanism import Mechanism
from sim.bench.mechanisms import MECHANISMS
from sim.bench.simulate import simulate
from sim.core.units import convert_gains, find_unit
from sim.feedback import compute_allowed_velocity_error, design_velocity_loop
from sim.fit import fit
from sim.fit.sysid_rows import median_filter, prepare_rows
from sim.physics.model import Model
from sim.physics.replay import replay_log
from sim.plot import (
    Line,
    Table,
    plot_time_series,
    plot_voltage_velocity,
    tabulate_fits,
    tabulate_gains,
)
from sim.plot.animation import Choice, Knob
from sim.plot.animation.charts import (
    Chart,
    Curve,
    animate_charts,
    chart_curves,
    compare_values,
)
from sim.plot.animation.of_logs import animate_model
from sim.teaching.fit_gaps import fill_gaps
from sim.teaching.logs import apply_mistake, read_own_log, select_rows

drivetrain = MECHANISMS["drivetrain"]


def shaking(noise: float) -> Mechanism:
    """The drivetrain with this noise [m/s] in its velocity while it moves."""
    return replace(drivetrain, sensor=replace(drivetrain.sensor, velocity_noise=noise))


def signals(log: sim.Log) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Voltage, velocity and acceleration of every row that moves."""
    volts = np.concatenate([run.voltage for run in log.runs])
    v = np.concatenate([run.velocity for run in log.runs])
    a = np.concatenate([np.gradient(run.velocity, run.time) for run in log.runs])
    moving = np.abs(v) > 0.05
    return volts[moving], v[moving], a[moving]


robot = shaking(0.02)
truth = robot.gains
routine = sim.Routine(ramp=1.0, step=3.5, timeout=10.0)
log = simulate(robot, routine, rng=np.random.default_rng(7))

plot_time_series(log, dynamic_seconds=1.0)

# %% [markdown]
# ## 2 Look first: voltage against velocity
#
# The model gives the voltage for a motion:
#
# > **V = kS·sgn(v) + kV·v + kA·a**
#
# In the slow ramp (the *quasistatic* test) the acceleration is small. Ignore the term kA·a for now:
#
# > V ≈ kS + kV·v
#
# This is a straight line: at velocity 0 its voltage is kS, and its slope is kV. `np.polyfit` finds
# the straight line that fits the samples best.
#
# **Predict:**

# %%
ask_question("lesson7.line")

# %%
slow, step = (log.list_runs_of_test(test)[0] for test in ("quasistatic-forward", "dynamic-forward"))
moving = np.abs(slow.velocity) > 0.1
slope, intercept = np.polyfit(slow.velocity[moving], slow.voltage[moving], 1)
timescale = truth["kA"] / truth["kV"]
print(f"kS of the line: {intercept:.3f} V. True kS: {truth['kS']:.3f} V.")
print(f"True kS + (kA/kV)·ramp: {truth['kS'] + timescale * routine.ramp:.3f} V.")
plot_voltage_velocity(log, lines={"straight line": Line(intercept, slope)})

# %% [markdown]
# ### Explain
#
# In a ramp the robot accelerates all the time. When the voltage rises by `ramp` volts each second,
# the speed rises by `ramp/kV` each second: this is the acceleration a. It needs `kA·a =
# (kA/kV)·ramp` volts during the whole ramp. The equation of the straight line has no term for these
# volts, so they are added to kS.
#
# <details><summary>Want to know why? The last hundredth of a volt</summary>
#
# A row contains the current speed and the voltage for the *next* 20 ms. So the voltage is on
# average 10 ms (half a loop) newer than the speed. In a ramp, that adds 10 ms times its slope. The
# rest of the hundredth comes from noise. Section 4 shows how noise changes the slope of a line.
# </details>
#
# So this plot is only good for a *first look*. For kS and kA we need all three terms. SysId also
# fits all four tests together.
#
# <details><summary>For mentors: does SysId read an intercept?</summary>
#
# > **Lesson says:** the analyzer fits a line, "the intercept is kS" and "the slope is kV"; kA comes
# > from the voltage that is left over in the dynamic test.
# >
# > **Source says:** SysId does not read lines off a plot. It fits all four tests together, and the
# > model computes the acceleration, not the voltage. Its window has no voltage–velocity plot
# > either: it shows velocity over time, acceleration against velocity, and the time steps. (Its
# > predecessor, frc-characterization, [had
# > one](https://github.com/wpilibsuite/frc-characterization/issues/7).) ([WPILib docs: Viewing
# > Diagnostics](https://github.com/wpilibsuite/frc-docs/blob/c94b51df80ed991bdb634ed20dbf758e31dc0d3c/source/docs/software/advanced-controls/system-identification/viewing-diagnostics.rst),
# > [SysId's source:
# > FeedforwardAnalysis.cpp](https://github.com/wpilibsuite/allwpilib/blob/v2026.2.2/sysid/src/main/native/cpp/analysis/FeedforwardAnalysis.cpp))
# >
# > **Try it:** the slope in the picture above is good. How far off is the intercept at 2 V/s?
# </details>

# %% [markdown]
# ## 3 Three unknowns, a thousand equations
#
# Every row of the log gives one equation: V, v and a are numbers, and the three gains are the
# unknowns. Three rows give three equations, which have one solution. So take three rows: a slow
# one, a fast one, and one with a large acceleration. (In all three the robot goes forward, so
# sgn(v) is 1.)
#
# The acceleration is not in the log. `np.gradient` computes it from neighboring rows.

# %%
slow_a, step_a = np.gradient(slow.velocity, slow.time), np.gradient(step.velocity, step.time)

solutions = []
for early, late, start in ((60, 300, 2), (61, 301, 3), (62, 302, 4), (63, 303, 5)):
    three = [
        (1.0, slow.velocity[early], slow_a[early]),
        (1.0, slow.velocity[late], slow_a[late]),
        (1.0, step.velocity[start], step_a[start]),
    ]
    volts = [slow.voltage[early], slow.voltage[late], step.voltage[start]]
    solutions.append((f"rows {early}, {late} and {start}", *np.linalg.solve(three, volts).tolist()))

Table(
    ("three rows", "kS [V]", "kV [V·s/m]", "kA [V·s²/m]"), (*solutions, ("truth", *truth.values()))
)

# %% [markdown]
# The robot is the same, but you get four different answers, because each row contains some noise.
# With a thousand rows, no gains solve all equations exactly. So we take the gains with the
# **smallest total error**.
#
# How do you add up errors? Square each error and add the squares. Squares are never negative, so
# two errors cannot cancel each other. The method that makes this sum as small as possible is called
# **least squares**. (To fit a model to data in this way is called a *regression*.)
#
# **Try it by hand** on six samples of the ramp. Move both sliders until the sum at the top is as
# small as you can make it.

# %%
some = slice(40, None, 60)
six_v, six_volts = slow.velocity[some], slow.voltage[some]


def by_hand(intercept: float, slope: float) -> Chart:
    """The errors of a line of your choice at six samples."""
    line = intercept + slope * six_v
    ends = np.array([0.0, 1.05 * six_v.max()])
    gaps = np.full(six_v.size, np.nan)
    errors = np.column_stack([line, six_volts, gaps]).ravel()
    curves = (
        Curve("errors", np.repeat(six_v, 3), errors, "line", 3),
        Curve("the line", ends, intercept + slope * ends, "dashed", 1),
        Curve("samples", six_v, six_volts, "dots", 0),
    )
    total = f"sum of squared errors: {np.sum((six_volts - line) ** 2):.4f} V²"
    return Chart("velocity [m/s]", "voltage [V]", curves, title=total)


animate_charts(
    by_hand,
    knobs=(
        Knob("intercept", "V at v = 0", low=0.0, high=1.0, step=0.05, value=0.8),
        Knob("slope", "V per m/s", low=1.5, high=3.5, step=0.1, value=2.0),
    ),
)

# %% [markdown]
# Now let NumPy do it. `np.linalg.lstsq` ("least squares") needs the equations as a table: one row
# per sample, and one **column per unknown**. In each row, each column holds the number that
# multiplies its unknown. For a line, the columns are 1 and v.

# %%
columns = np.column_stack([np.ones(six_v.size), six_v])
(intercept, slope), *_ = np.linalg.lstsq(columns, six_volts, rcond=None)
smallest = np.sum((six_volts - columns @ [intercept, slope]) ** 2)
print(f"{intercept:.2f} V at v = 0, {slope:.2f} V per m/s, sum of squares {smallest:.4f}")

# %% [markdown]
# No straight line has a smaller sum. Set the sliders near these values.

# %% [markdown]
# ## 4 The whole fit in five lines
#
# Now do the same with three columns. `signals` takes the rows of all four tests, leaves out those
# in which the robot stands still, and gives V, v and a:


# %%
def fit_voltage(volts: np.ndarray, v: np.ndarray, a: np.ndarray) -> dict[str, float]:
    """The model as it is written: V = kS·sgn(v) + kV·v + kA·a."""
    columns = np.column_stack([np.sign(v), v, a])
    return dict(zip(truth, np.linalg.lstsq(columns, volts, rcond=None)[0].tolist(), strict=True))


first_try = fit_voltage(*signals(log))
print(f"kV is {first_try['kV'] / truth['kV']:.2f} times the truth,", end=" ")
print(f"kA is {first_try['kA'] / truth['kA']:.2f} times the truth.")

# %% [markdown]
# kV is very good, but kA is far from the truth. This log has no fault. What happened?
#
# ### Which side is noisy?
#
# Try a small experiment. The truth is y = 2·x. In the first data set we add noise to **y**, in the
# second to **x**. Least squares finds both slopes.
#
# **Predict:**

# %%
ask_question("lesson7.noise")

# %%
rng = np.random.default_rng(1)
x = rng.uniform(-1, 1, 5000)
noise = 0.5 * rng.standard_normal(x.size)
in_y = np.linalg.lstsq(x[:, None], 2 * x + noise, rcond=None)[0][0]
in_x = np.linalg.lstsq((x + noise)[:, None], 2 * x, rcond=None)[0][0]
print(f"noise in y: slope {in_y:.3f}    noise in x: slope {in_x:.3f}    truth: 2")

# %% [markdown]
# Noise on the **left** side of the equation averages out over many rows. Noise in a **column** does
# not average out: it makes the fit's number for that column too small. More data does not help.
#
# Our noisiest signal is the acceleration, because it is computed from differences of noisy
# velocities. In the five lines above, the acceleration was a column. So move it to the left side,
# and solve the equation of the model for a:
#
# > a = −(kV/kA)·v + (1/kA)·V − (kS/kA)·sgn(v)
#
# Call the three numbers α, β and γ: a = α·v + β·V + γ·sgn(v). Then kA = 1/β, kV = −α/β and
# kS = −γ/β.
#
# <details><summary>Want to know more? With gravity</summary>
#
# (The formula above is for the analysis type *Simple*. If gravity acts on the mechanism, SysId adds
# columns to the fit. For *Elevator* it adds a column of ones. For *Arm* it adds cos θ and sin θ,
# where θ is the angle of the arm. From these columns it computes kG, and for an arm also the offset
# of the sensor. [SysId's source:
# FeedforwardAnalysis.cpp](https://github.com/wpilibsuite/allwpilib/blob/v2026.2.2/sysid/src/main/native/cpp/analysis/FeedforwardAnalysis.cpp))
# </details>
#
# **Now you write it.** Replace the four `...` in the next cell. Run the cell, then the cell below
# it, which checks your answers.


# %%
def my_left(volts, v, a):
    """Gap 1: the signal on the left side."""
    return ...


def my_columns(volts, v, a):
    """Gap 2: one column each for α, β and γ. The third column is missing."""
    return [v, volts, ...]


def my_gains(alpha, beta, gamma):
    """Gap 3: the gains. kV and kA are missing."""
    return {"kS": -gamma / beta, "kV": ..., "kA": ...}


# %%
mine = fill_gaps(left=my_left, columns=my_columns, gains=my_gains)
print(mine.report)

# %% [markdown]
# <details><summary>Solution</summary>
#
# ```python
# def my_left(volts, v, a):
#     return a
#
# def my_columns(volts, v, a):
#     return [v, volts, np.sign(v)]
#
# def my_gains(alpha, beta, gamma):
#     return {"kS": -gamma / beta, "kV": -alpha / beta, "kA": 1 / beta}
# ```
# </details>
#
# The next cell fits the log with your lines. If one of your answers is not right yet, the cell uses
# ours instead.


# %%
def fit_acceleration(volts: np.ndarray, v: np.ndarray, a: np.ndarray) -> dict[str, float]:
    """The model solved for the acceleration, as SysId does it."""
    columns = np.column_stack(mine.columns(volts, v, a))
    found = np.linalg.lstsq(columns, mine.left(volts, v, a), rcond=None)[0]
    return mine.gains(*found.tolist())


SIDES = {"voltage": fit_voltage, "acceleration": fit_acceleration}
sets = {f"{side} on the left": fit_side(*signals(log)) for side, fit_side in SIDES.items()}
tabulate_gains({**sets, "truth": truth}, first="fit")

# %% [markdown]
# How much noise can each method tolerate? For each noise level we simulate five logs and average
# the results:

# %%
NOISE = [0.0, 0.005, 0.01, 0.015, 0.02, 0.03, 0.04]
by_side = {f"{side} on the left": [] for side in SIDES}
for level in NOISE:
    logs = [simulate(shaking(level), routine, rng=np.random.default_rng(seed)) for seed in range(5)]
    for name, fit_side in zip(by_side, SIDES.values(), strict=True):
        by_side[name].append(float(np.mean([fit_side(*signals(one))["kA"] for one in logs])))

labels = {"xlabel": "noise of the velocity [m/s]", "ylabel": "kA [V·s²/m]"}
animate_charts(lambda: chart_curves(NOISE, by_side, levels={"the truth": truth["kA"]}, **labels))

# %% [markdown]
# The acceleration on the left side is the better choice, so SysId uses it. But it is not perfect:
# one column still contains the velocity, which is noisy, too. So α and β become smaller, and kA,
# which is 1/β, becomes larger.
#
# <details><summary>Want to know more? What SysId's source says</summary>
#
# SysId's source says that least squares "performs best with the noisiest variable as the dependent
# variable". The dependent variable is the signal on the left side of the equation, here the
# acceleration.
# ([FeedforwardAnalysis.cpp](https://github.com/wpilibsuite/allwpilib/blob/v2026.2.2/sysid/src/main/native/cpp/analysis/FeedforwardAnalysis.cpp);
# the book that explains why noise in a column makes its number too small: Fuller, *Measurement
# Error Models* (1987), section 1.1)
# </details>

# %% [markdown]
# ## 5 What SysId does before it fits
#
# SysId's fit is the five lines above. Before the fit, SysId prepares the data in four stages. The
# names of its settings are in italics.
#
# 1. **Threshold** (*Velocity Threshold*). In the quasistatic tests, SysId drops the rows that are
#    slower than a threshold. At standstill, friction holds the robot at any voltage up to kS, so
#    these rows do not show how large kS is.
# 2. **Median filter** of the velocity, if you switch it on (*Window Size*, up to 15 samples). It
#    sorts each value and its neighbors by size, and keeps the middle one.
# 3. **Acceleration**: SysId takes the velocity one row later minus the velocity one row earlier. It
#    divides this difference by twice the **mean** time step of the test.
# 4. **Trim the dynamic tests** (*Test Duration*): unless you change the setting, SysId keeps only
#    the rows from the largest acceleration to 90 % of the top speed. Last, it drops all rows with
#    an acceleration of exactly 0.
#
# ([SysId's source: FilteringUtils.cpp](https://github.com/wpilibsuite/allwpilib/blob/v2026.2.2/sysid/src/main/native/cpp/analysis/FilteringUtils.cpp))


# %%
def rows_of(
    run: sim.Run,
    threshold: float = 0.05,
    median: int = 1,
    *,
    mean_dt: bool = True,
    trim: bool = True,
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Voltage, velocity and acceleration of one test, prepared."""
    keep = np.ones(len(run), dtype=bool)
    if run.kind == "quasistatic":
        keep = np.abs(run.velocity) >= threshold
    time, volts, v = run.time[keep], run.voltage[keep], run.velocity[keep]
    if median > 1:
        v = median_filter(v, window=median)
    a = np.gradient(v) / np.mean(np.diff(time)) if mean_dt else np.gradient(v, time)
    if trim and run.kind == "dynamic":
        peak = int(np.argmax(np.sign(v) * a))
        fast = peak + int(np.argmax(np.abs(v[peak:]) > 0.9 * np.abs(v).max()))
        volts, v, a = (signal[peak : fast + 1] for signal in (volts, v, a))
    return volts, v, a


def my_fit(log: sim.Log, left: str = "acceleration", **settings: float) -> dict[str, float]:
    """Gains from the prepared rows of all tests, by least squares."""
    prepared = zip(*(rows_of(run, **settings) for run in log.runs), strict=True)
    return SIDES[left](*map(np.concatenate, prepared))


recipe = fit(log, method="sysid")
tabulate_gains({"my fit": my_fit(log), "SysId": recipe.gains}, first="fit")

# %% [markdown]
# Your gains and SysId's gains are close. SysId computes its threshold from the noise, so it drops a
# few more rows. If your five lines use exactly the rows that SysId keeps, the gains are the same:

# %%
kept = prepare_rows(log).rows.values()
volts, v, a = (
    np.concatenate([getattr(rows, name) for rows in kept])
    for name in ("voltage", "velocity", "acceleration")
)
exact = fit_acceleration(volts, v, a)
for name, gains in (("five lines: ", exact), ("SysId's:    ", recipe.gains)):
    print(name + "   ".join(f"{gain} = {value:.9f}" for gain, value in gains.items()))
used = recipe.samples_used
for test in ("quasistatic-forward", "dynamic-forward"):
    print(f"SysId uses {used[test]} rows of the {test} test.")

# %% [markdown]
# The last line shows that SysId uses only a few rows of the dynamic test, because this robot
# reaches its speed so fast. kA depends mostly on these few rows.
#
# <details><summary>For mentors: does a long test make kA wrong?</summary>
#
# > **Lesson says:** if you run the dynamic test too long, "kA becomes unobservable".
# >
# > **Source says:** SysId cuts the dynamic test at 90 % of the top speed by itself (*Test
# > Duration*). A long test can damage the hardware. It makes kA wrong only if you write your own
# > fit and do not trim. ([SysId's source:
# > FilteringUtils.cpp](https://github.com/wpilibsuite/allwpilib/blob/v2026.2.2/sysid/src/main/native/cpp/analysis/FilteringUtils.cpp))
# >
# > **Try it:** do not trim the step in the next section.
# </details>

# %% [markdown]
# ## 6 Same data, five choices, five values of kA
#
# A real robot program sometimes misses a loop. So we remove one row in twenty from our log. Then we
# fit the **same data** again. You change five choices, one at a time: the left side, the threshold,
# the filter, the time step or the trim.
#
# **Predict:**

# %%
ask_question("lesson7.choice")


# %%
gappy = []
for seed in range(5):
    rng = np.random.default_rng(seed)
    whole = simulate(robot, routine, rng=rng)
    gappy.append(select_rows(whole, lambda run, rng=rng: rng.random(len(run)) >= 0.05))
usual = [my_fit(one)["kA"] for one in gappy]


def try_choices(left: str, step: str, trim: str, median: str, threshold: float) -> Chart:
    """The kA of five logs with SysId's choices and with yours: its mean and its spread."""
    choices = {"mean_dt": step == "mean", "trim": trim == "yes", "median": int(median)}
    mine = [my_fit(one, left, threshold=threshold, **choices)["kA"] for one in gappy]
    found = {"as SysId does it": usual, "yours": mine}
    return compare_values(
        {way: float(np.mean(values)) for way, values in found.items()},
        spreads={way: float(np.std(values)) for way, values in found.items()},
        truth=truth["kA"],
        xlabel="kA [V·s²/m] (dashed: the truth)",
    )


animate_charts(
    try_choices,
    choices=(
        Choice("left side", ("acceleration", "voltage")),
        Choice("time step", ("mean", "each")),
        Choice("trim the step", ("yes", "no")),
        Choice("median", ("1", "3", "5", "9", "15")),
    ),
    knobs=(Knob("threshold", "threshold [m/s]", low=0.05, high=1.55, step=0.75, value=0.05),),
)

# %% [markdown]
# Each dot is the mean of five logs, and its bar shows how much their results differ. None of these
# choices is a mistake in the calculation. They are decisions that SysId makes for you.
#
# ### Explain
#
# The **filter** and the **left side** matter most. Section 9 shows what a filter does. Noise in the
# acceleration column makes kA too small (section 4).
#
# <details><summary>Want to know more? Time step, trim and threshold</summary>
#
# - **Time step.** SysId uses the mean time step, which is wrong for the rows next to a gap. So gaps
#   in the log make kA less accurate. kV hardly changes.
# - **Trim.** At full speed the acceleration is zero, so the rows at full speed only bring noise
#   into the fit.
# - **Threshold.** It hardly matters *here*, because our encoder is quiet at rest. With a noisy
#   encoder, sgn(v) is random in the rows at standstill. The longer the robot stands, the worse kA
#   gets. (To try it, see the last point of section 14.)
# </details>

# %% [markdown]
# ## 7 Two errors, two R²
#
# You now have gains. Are they good? There are two kinds of error, and SysId has a score for each.
#
# - **Equation error:** in each row, how far is the measured acceleration from the acceleration that
#   the model computes? SysId's score is the **acceleration R²**.
# - **Simulation error:** give the model only the *voltage* of a whole test, and simulate. How far
#   is the simulated velocity from the measured one? Here errors add up over time. SysId's score is
#   the **simulated velocity R²**.
#
# The dashed robot is the simulation with the gains of SysId's method. Make kA half as large: how
# much does the typical error of each test change? Then change kV by a tenth.


# %%
animate_model(
    log,
    recipe.gains,
    tests={"step": ("dynamic-forward", 1.0), "ramp": ("quasistatic-forward", 3.5)},
    alt="The solid robot is the log, and the dashed robot is the simulation with the gains of "
    "SysId's method. The two stay together: the typical error is about 0.02 m/s.",
)

# %% [markdown]
# Now compute both scores by hand. The textbook defines
#
# > R² = 1 − (sum of squared errors) / (sum of squared distances from the mean)
#
# So 1 is perfect. With a score of 0, the model is as bad as a guess of the mean for every row.

# %%
explained = (volts - exact["kS"] * np.sign(v) - exact["kV"] * v) / exact["kA"]
acceleration_r2 = 1 - np.sum((a - explained) ** 2) / np.sum((a - a.mean()) ** 2)
adjusted = 1 - (1 - acceleration_r2) * (a.size - 1) / (a.size - 3 - 1)  # for three unknowns

seen = np.concatenate([run.velocity for run in log.runs])
tracks = replay_log(Model("simple", recipe.gains), log)
said = np.concatenate([track.velocity for track in tracks])
rmse = np.sqrt(np.mean((seen - said) ** 2))
textbook = 1 - np.sum((seen - said) ** 2) / np.sum((seen - seen.mean()) ** 2)
sysids = 1 - rmse / np.sqrt(np.mean(seen**2))

print(f"Acceleration R², adjusted: {adjusted:.4f} by hand, {recipe.acceleration_r2:.4f} by SysId")
print(f"Simulated velocity R²: {sysids:.3f} by hand, {recipe.simulated_velocity_r2:.3f} by SysId")
print(f"With the textbook's formula it would be {textbook:.4f}. (RMSE: {rmse:.4f} m/s)")
print(f"If the mean velocity is 0, SysId's 0.90 is a textbook's {1 - (1 - 0.9) ** 2:.2f}.")

# %% [markdown]
#
# <details><summary>Want to know more? What “adjusted” means</summary>
#
# *Adjusted* means that the score becomes a little lower with each unknown in the model. The reason:
# every additional column matches some of the noise by chance. With hundreds of rows the difference
# is very small. ([SysId's source:
# OLS.cpp](https://github.com/wpilibsuite/allwpilib/blob/v2026.2.2/sysid/src/main/native/cpp/analysis/OLS.cpp))
#
# For the simulation we used all rows. SysId leaves out the standstill.
# </details>
#
# **Myth check.** "R² must be above 0.9." *Which one?* The *simulated velocity* R² should be above
# 0.9. The *acceleration* R² "rarely goes above 0.5, even on very good datasets"; do not trust kA if
# this score is below about 0.2. And the simulated velocity R² is not the textbook's R²: SysId
# computes 1 − RMSE / (root mean square of v). (RMSE, the root mean square error, is the typical
# error.) So SysId's 0.9 is stricter than the textbook's. Always say which R² you mean.
#
# <details><summary>For mentors: SysId's two R², with sources</summary>
#
# > **Lesson says:** "R² value is above 0.9 in the analyzer."
# >
# > **Source says:** there are two. The *acceleration* R² "rarely goes above 0.5, even on very good
# > datasets"; if it is below about 0.2, do not trust kA. The *simulated velocity* R² (in SysId's
# > window: *Sim velocity R²*) should be above 0.9. ([Viewing
# > Diagnostics](https://github.com/wpilibsuite/frc-docs/blob/c94b51df80ed991bdb634ed20dbf758e31dc0d3c/source/docs/software/advanced-controls/system-identification/viewing-diagnostics.rst))
# > The second is not the R² of textbooks: SysId computes 1 − RMSE / (root mean square of v). SysId
# > does not square the ratio and does not subtract the mean. So a score of 0.9 is harder to reach
# > than in a textbook. ([SysId's source:
# > AnalyzerPlot.cpp](https://github.com/wpilibsuite/allwpilib/blob/v2026.2.2/sysid/src/main/native/cpp/view/AnalyzerPlot.cpp))
# > (The docs page calls the acceleration the *independent* variable. In the code it is the
# > *dependent* variable, on the left side.)
# >
# > **Try it:** compare the two scores that you computed above. From now on, always say
# > which R² you mean.
# </details>
#
# ### What R² does not show
#
# Here are five logs of the same drivetrain. Cover the gains with your hand. Which log has the best
# R², which has the worst? Then look at the gains.

# %%
quiet = simulate(drivetrain, routine, rng=np.random.default_rng(3))
fast_log = simulate(drivetrain, routine, rng=np.random.default_rng(3), period=0.005)
hard = sim.Routine(ramp=1.0, step=7.0)
sag = simulate_duty_cycle(drivetrain, hard, rng=np.random.default_rng(3))


suspects = {
    "clean": quiet,
    "clean, logged at 200 Hz": fast_log,
    "wrong gear ratio in the code (÷ 1.25)": apply_mistake(quiet, factor=1 / 1.25),
    "encoder inverted": apply_mistake(quiet, factor=-1.0),
    "commanded voltage logged, 7 V step": apply_mistake(sag, commanded=True),
}
tabulate_fits(suspects, truth)

# %% [markdown]
# - **A low R² does not mean bad gains.** With faster logging, each computed acceleration is
#   noisier, so the acceleration R² drops. The gains are as good as before.
# - **A high R² does not mean good gains.** A wrong ratio or a wrong sign gives exactly the *same*
#   R²: the log looks like a good log of another robot. And the log of the commanded voltage has the
#   highest acceleration R² in the table, but its kA is far too large.
#
# So use the checks of lesson 6, not only R².

# %% [markdown]
# ## 8 How can kS be negative?
#
# Friction only brakes a robot, so a true kS is never negative. But SysId sometimes prints a
# negative kS. To see how, we add more and more noise to the velocity, and look at kS, kA, and the
# sum **kS + kA·(ramp/kV)**.

# %%
rows = []
for level in (0.0, 0.02, 0.04, 0.06, 0.08, 0.10):
    logs = [simulate(shaking(level), routine, rng=np.random.default_rng(seed)) for seed in range(5)]
    gains = [fit(one, method="sysid").gains for one in logs]
    ks, kv, ka = (float(np.mean([one[name] for one in gains])) for name in ("kS", "kV", "kA"))
    rows.append((level, ks, ka, ks + ka * routine.ramp / kv))

print(f"true kS {truth['kS']:.3f} V, true kA {truth['kA']:.3f} V·s²/m")
Table(("noise [m/s]", "kS [V]", "kA [V·s²/m]", "kS + kA·(ramp/kV) [V]"), tuple(rows))

# %% [markdown]
# As long as the noise is moderate, the sum in the last column hardly changes. You know this sum
# from section 2: it is the voltage of the straight line at velocity 0. The ramp has many rows, and
# they determine the **sum** well. But they do not show how much of the sum comes from kS and how
# much from kA. Only the few rows of the step test show that. So when noise makes kA too large, kS
# becomes too small, or even negative.
#
# So if kS is negative, do not look at friction first. Ask: **why is kA too large?** Possible causes
# are noise, a log of the commanded voltage, a slipping wheel, or a sudden jump. (With gravity,
# first check the analysis type: lesson 2.)

# %% [markdown]
# ## 9 A filter has a disadvantage
#
# Noise makes kA too large, and a median filter removes noise. But in section 6, a window of 15
# samples made kA much too small. **Predict** for a drivetrain with three times as much noise:

# %%
ask_question("lesson7.filter")

# %%
WINDOWS = [1, 3, 5, 7, 9, 11, 13, 15]
levels = {"little noise": 0.0075, "much noise": 0.06}
by_window = {name: [] for name in levels}
for name, level in levels.items():
    logs = [simulate(shaking(level), routine, rng=np.random.default_rng(seed)) for seed in range(5)]
    for window in WINDOWS:
        fits = [fit(one, method="sysid", median=window).gains["kA"] for one in logs]
        by_window[name].append(float(np.mean(fits)))

print(f"kA/kV = {1000 * timescale:.0f} ms, which is {timescale / 0.02:.1f} samples of 20 ms.")
labels["xlabel"] = "window of the median filter [samples]"
animate_charts(
    lambda: chart_curves(WINDOWS, by_window, levels={"the truth": truth["kA"]}, **labels)
)

# %% [markdown]
# After a step the velocity rises with the time constant kA/kV (after this time, it has reached
# nearly two thirds of its new value). A window that is much longer than kA/kV flattens the rise:
# the filter removes what you want to measure.
#
# A window of 3 to 5 samples helps on a *slow* mechanism. On a fast mechanism, log faster, or repair
# the encoder.
#
# <details><summary>Want to know more? What WPILib's docs say</summary>
#
# They warn about this for mechanisms with strong motors and a small load: the filter may "eat" the
# acceleration data. Then kA tends toward zero. ([Viewing Diagnostics, at one
# commit](https://github.com/wpilibsuite/frc-docs/blob/c94b51df80ed991bdb634ed20dbf758e31dc0d3c/source/docs/software/advanced-controls/system-identification/viewing-diagnostics.rst))
# </details>

# %% [markdown]
# ## 10 From gains to a first kP
#
# SysId also suggests a feedback gain, kP. A feedback loop compares the measured velocity with the
# target. kP is the voltage that it adds for each unit of velocity error. SysId computes kP from kV,
# kA and **three settings**. Their names in SysId's window are in italics:
#
# - **q**, the velocity error that you accept (*Max Velocity Error*);
# - **r**, the volts that the feedback may use to correct this error (*Max Control Effort*);
# - the **delay** of the measurement (*Measurement Delay*).
#
# <details><summary>Want to know more? Gain presets</summary>
#
# A *Gain Preset* for your motor controller sets the delay, how often the loop runs, and the unit of
# its output. Here we use the preset for WPILib's own loop: it runs every 20 ms, and its output is
# in volts.
# </details>
#
# A method called LQR (*linear-quadratic regulator*) finds the kP that balances q and r. A small q
# and a large r give a large kP. A delay makes kP smaller, because late corrections make the
# mechanism shake.
#
# Somebody got kP = 0.62 with kS 0.14, kV 2.68 and kA 0.34. Leave r and the delay as they are, and
# move q until the dot is on the dashed line. Which q did they use?
#
# <details><summary>For mentors: the source lesson's kP</summary>
#
# > **Lesson says:** "SysId suggests kP = 0.62" for kS 0.14, kV 2.68, kA 0.34.
# >
# > **Source says:** such gains are "educated guesses", a "starting point".
# > ([WPILib docs: Analyzing Data](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/system-identification/analyzing-gains.html))
# >
# > **Try it:** which q gives 0.62?
# </details>

# %%
lesson_kv, lesson_ka = 2.68, 0.34
QS = np.round(np.arange(0.5, 4.01, 0.25), 2)


def suggest_kp(q: float, r: float, delay: float) -> float:
    """The kP that SysId suggests, with the source lesson's gains."""
    return design_velocity_loop(
        kv=lesson_kv, ka=lesson_ka, velocity_error=q, volts=r, delay=delay / 1000
    ).kp


def chart_kp(q: float, r: float, delay: float) -> Chart:
    """The suggested kP for each allowed error."""
    ends, kp = QS[[0, -1]], suggest_kp(q, r, delay)
    curves = (
        Curve("kP = 0.62", ends, [0.62, 0.62], "dashed"),
        Curve("kP of each q", QS, [suggest_kp(float(one), r, delay) for one in QS], "line", 0),
        Curve("your q", [q], [kp], "dots", 1, [f"{kp:.2f}"]),
    )
    return Chart("q, the allowed velocity error [m/s]", "kP [V·s/m]", curves)


animate_charts(
    chart_kp,
    knobs=(
        Knob("q", "q [m/s]", low=0.5, high=4.0, step=0.1, value=1.5),
        Knob("r", "r [V]", low=1.0, high=11.0, step=2.0, value=7.0),
        Knob("delay", "delay [ms]", low=0.0, high=120.0, step=20.0, value=0.0),
    ),
)

# %%
window = compute_allowed_velocity_error(ks=0.14, kv=lesson_kv)  # a quarter of the top speed
for name, q in (("SysId's code starts with", 1.5), ("SysId's window fills in", window)):
    kp = design_velocity_loop(kv=lesson_kv, ka=lesson_ka, velocity_error=q, volts=7.0, delay=0.0).kp
    print(f"{name} q = {q:.2f} m/s: kP = {kp:.2f} V·s/m")

# %% [markdown]
# <details><summary>Which q gives 0.62?</summary>
#
# q = 3.43 m/s, with r = 7 V and no delay. That is more than twice the default.
# </details>
#
# The gains are the same, but the values of kP are very different. So a suggested kP is only a first
# guess: tune it on the robot. And if kA is wrong, kP is wrong, too, without any warning.
#
# <details><summary>Want to know more? Where these numbers come from</summary>
#
# The rule "a quarter of the top speed" comes from [SysId's source:
# Analyzer.cpp](https://github.com/wpilibsuite/allwpilib/blob/v2026.2.2/sysid/src/main/native/cpp/view/Analyzer.cpp).
# The delays are in
# [FeedbackControllerPreset.h](https://github.com/wpilibsuite/allwpilib/blob/v2026.2.2/sysid/src/main/native/include/sysid/analysis/FeedbackControllerPreset.h).
# </details>

# %% [markdown]
# ## 11 Your own log
#
# In exercise 9 you fit a log of your own mechanism. `grade start` or `grade exercise9` makes this
# log. If it exists, the next cell reads it.

# %%
own, where = read_own_log()
print(where)
plot_time_series(own, dynamic_seconds=1.0)

# %% [markdown]
# Fit this log with SysId's method, and with your own five lines. *One standard error* is the
# typical error that noise alone causes.

# %%
best = fit(own, method="sysid").in_log_units()
hand = my_fit(own, threshold=0.02 * max(float(np.abs(run.velocity).max()) for run in own.runs))
hand = convert_gains(hand, factor=find_unit(own.units).si)
Table(
    ("gain", "SysId's recipe", "one standard error", "my fit", "unit"),
    tuple(
        (gain, value, best.errors[gain], hand[gain], best.format_gain_unit(gain))
        for gain, value in best.gains.items()
    ),
)

# %%
print(f"acceleration R²:       {best.acceleration_r2:.3f}")
print(f"simulated velocity R²: {best.simulated_velocity_r2:.3f}")
for doubt in best.doubts:
    print(f"Warning: {doubt.text}")

# %% [markdown]
# In a terminal, in the course's folder (if you gave a name, write it instead of `me`):
#
# ```
# sysid fit exercises/exercise9/data/me/log.wpilog --method sysid
# ```

# %% [markdown]
# ## 12 System check
#
# Before you trust a fit, check all five:
#
# - [ ] All four tests are in the log, and you **looked** at the plots.
# - [ ] kV and kA are positive, kS is not negative.
# - [ ] kV and kA are close to the values you expect from motors, gears and mass.
# - [ ] You know the window of the median filter, and it is not much longer than kA/kV.
# - [ ] When you write R², you say which R² it is.
#
# ## 13 Knowledge check
#
# Click an answer to the first question.

# %%
display(ask_question("lesson7.quick"), enable_checkboxes())

# %% [markdown]
# **1.** Why is the acceleration on the left side of SysId's fit?
#
# <details><summary>Answer</summary>
#
# The acceleration is the noisiest signal. Noise on the left side averages out. Noise in a column
# makes the fit's number for that column too small, and a longer log does not help.
# </details>
#
# **2.** In somebody's fit, kS is −0.1 V, kA is three times as large as you expect, and the
# simulated velocity R² is 0.93. Where do you look for the mistake?
#
# <details><summary>Answer</summary>
#
# Look at kA, not at friction. The ramp determines the sum kS + kA·(ramp/kV). So if kA is too large,
# kS is too small. Look for noise in the velocity, for a log of the commanded voltage, and for slip.
# R² does not show any of these well.
# </details>
#
# **3.** Your acceleration R² is 0.35. Is the fit bad?
#
# <details><summary>Answer</summary>
#
# Not necessarily. WPILib's docs say that values above 0.5 are rare, even for good data. Below about
# 0.2, do not trust kA. Compare kA with motors and mass, and forward with reverse.
# </details>
#
# **4.** Your flywheel has kA/kV = 400 ms, and your turret has 15 ms. For which of them can you use
# a median window of 5 samples (one sample is 20 ms)?
#
# <details><summary>Answer</summary>
#
# For the flywheel: from its first to its fifth sample, the window is 80 ms long, a fifth of the
# time constant. The turret reaches its speed within a few samples, so the filter destroys its kA.
# Even without a filter, one sample every 20 ms is too slow for the turret.
# </details>
#
# **5.** A teammate pastes SysId's kP and the drivetrain shakes. "So SysId is wrong." Is it?
#
# <details><summary>Answer</summary>
#
# Not necessarily. kP depends on q, r and the delay. Did your teammate choose the preset of the
# right motor controller, and with it the right delay? Are the gains per meter, while the motor
# controller counts rotations? If all of that is right, start with a lower kP. It is only a starting
# point.
# </details>

# %% [markdown]
# ## 14 Practice
#
# **Exercise 9** ([exercises/exercise9/README.md](../exercises/exercise9/README.md)). Write your
# gains and both R² into `exercises/exercise9/answers.toml`, then
#
# ```
# grade exercise9
# ```
#
# If a number is wrong by a well-known factor (2π or −1), or if you swapped two numbers, the
# feedback says so. Hints cost nothing: `grade exercise9 --hint`. You also write your fit into
# `fit.py`. `grade watch exercise9` in a terminal grades it each time you save.
#
# <details><summary>More, if you like</summary>
#
# - Fit the forward tests alone and the reverse tests alone. Print how much the gains differ.
# - Fit logs of the shooter and of the turret with a median window of 5. Why is only one kA good?
# - Give the robot an encoder that is noisy at rest, and a slow ramp. Find the threshold that gives
#   the best kA:
#
#   ```python
#   noisy = replace(robot, sensor=replace(robot.sensor, noise_speed=1e-9))
#   slow_log = simulate(noisy, sim.Routine(ramp=0.25, step=3.5), rng=np.random.default_rng(0))
#   my_fit(slow_log, threshold=0.0)
#   ```
# </details>
#
# **Next:** [Lesson 8, from the analyzer to the robot](08_from_analyzer_to_robot.ipynb). Where do
# the gains go?
