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
# # Lesson 6: Read the data
#
# *About 45 minutes. You need lessons 1 and 3. Today you decide whether you can trust a log.*
#
# ![The speed of the same test in a good log and in a damaged log. For 0.4 s, the damaged log shows
# half the speed.](attachment:picture.png)
#
# **At the end you can**
#
# - say what a good log of each test looks like, and why;
# - name thirteen ways to damage a log, and the plots that show them;
# - cut away samples that the model does not describe, and keep samples that are only noisy;
# - explain why a good R² does not prove a good log, and name five better checks.

# %% [markdown]
# ## 1 Why: a fit never says "I do not know"
#
# A *fit* is the calculation that finds the gains from a log. It gives you three numbers for any
# log. It does not know that a wheel slipped, or that the battery was empty. It finds the numbers
# that match the data best, good or bad.
#
# > The fit believes the log. So you have to check the log first.
#
# Today's robot is our simulated drivetrain. We know its true gains, so we can say how wrong a fit
# is.

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
from sim.inspect.contaminate import contaminate
from sim.inspect.detect_faults import inspect
from sim.inspect.faults import FAULTS
from sim.physics.battery import Battery
from sim.plot import (
    Table,
    plot_acceleration_velocity,
    plot_time_series,
    plot_voltage_velocity,
    tabulate_fits,
)
from sim.plot.animation import Choice, Knob
from sim.plot.animation.charts import Chart, Curve, animate_charts, compare_values
from sim.plot.animation.of_logs import animate_logs
from sim.plot.decimate import decimate_cloud
from sim.teaching.logs import select_rows
from sim.teaching.r2_cases import GOOD, make_cases

ROBOT = replace(MECHANISMS["drivetrain"], travel=None)
TRUTH = ROBOT.gains
ROUTINE = sim.Routine(ramp=1.0, step=3.5, timeout=6.0)
sound = simulate(ROBOT, ROUTINE, rng=np.random.default_rng(6))

TAU = TRUTH["kA"] / TRUTH["kV"]
print(f"The truth: kS {TRUTH['kS']:.3f} V, kV {TRUTH['kV']:.3f} V·s/m, kA {TRUTH['kA']:.3f} V·s²/m")
print(f"kA/kV is {1000 * TAU:.0f} ms. After this time, a step has nearly 2/3 of its final speed.")

# %% [markdown]
# ## 2 The model: what a good log looks like
#
# **Predict first.** In the dynamic test the voltage jumps to 3.5 V and stays there.

# %%
ask_question("lesson6.rise")

# %%
plot_time_series(sound, dynamic_seconds=0.6)

# %% [markdown]
# **A good quasistatic test** (left):
#
# - The voltage is a ramp. The velocity stays at zero until the voltage is above kS, then it climbs
#   in a straight line.
# - Forward and reverse are nearly mirror images. (For an elevator or an arm they are not: lesson
#   2.)
# - Voltage against velocity is a straight line with little scatter, as in the plot below.
#
# **A good dynamic test** (right):
#
# - The voltage jumps and stays constant.
# - The velocity rises steeply from the first moment. Then it rises less and less, and stays
#   constant.
# - The test ends because somebody lets go of the button or presses *Disable*, not because the robot
#   hits a wall.
#
# Both tests have a sample every 20 ms, and the slope of the position is the velocity.

# %%
plot_voltage_velocity(sound)

# %% [markdown]
# At velocity 0, the straight line meets the voltage axis near kS, but not exactly at kS (lesson 7
# explains why).
#
# <details><summary>For mentors: the plots of SysId, with source</summary>
#
# > **Lesson says:** "Voltage vs. velocity forms a straight line with low scatter. The forward and
# > reverse runs are near-symmetric. R² value is above 0.9 in the analyzer."
# >
# > **Source says:** SysId 2026 has no plot of voltage against velocity. It draws velocity over
# > time, acceleration against velocity, and the time steps. And it has *two* R², which mean
# > different things (section 5). ([WPILib docs: Viewing
# > Diagnostics](https://github.com/wpilibsuite/frc-docs/blob/c94b51df80ed991bdb634ed20dbf758e31dc0d3c/source/docs/software/advanced-controls/system-identification/viewing-diagnostics.rst))
# >
# > **Try it:** look where our line meets velocity 0. That is near kS, but not exactly at kS (lesson
# > 7 explains why).
# </details>
#
# Now look at the dynamic test in a plot of acceleration against velocity:

# %%
plot_acceleration_velocity(sound)

# %%
rise = sound.list_runs_of_test("dynamic-forward")[0]
slope = np.gradient(rise.velocity, rise.time)
early, later = (int(np.searchsorted(rise.time, rise.time[0] + wait)) for wait in (0.02, 0.02 + TAU))
print(f"Acceleration after  20 ms: {slope[early]:.1f} m/s²")
print(f"Acceleration {1000 * TAU:.0f} ms later: {slope[later]:.1f} m/s²", end="")
print(f", {slope[later] / slope[early]:.0%} of it")

# %% [markdown]
# ### Explain
#
# The voltage that remains for the acceleration is V − kS − kV·v. The faster the robot goes, the
# less voltage remains. So the acceleration is **largest at the start**. After every kA/kV seconds,
# only about 37 % of it is left. Such a curve is called *exponential*. In the plot of acceleration
# against velocity, it is a straight line that falls.
#
# **Myth check.** "The acceleration is constant while the velocity rises." *False* in a good test. A
# constant acceleration means that something is wrong. The log named *current limit* in section 3 is
# an example.
#
# <details><summary>For mentors: the rise is exponential, with source</summary>
#
# > **Lesson says:** "Acceleration is relatively constant during the rising portion."
# >
# > **Source says:** "a successful dynamic graph will be an approximately exponential approach of
# > the steady-speed".
# > ([WPILib docs: Viewing Diagnostics](https://github.com/wpilibsuite/frc-docs/blob/c94b51df80ed991bdb634ed20dbf758e31dc0d3c/source/docs/software/advanced-controls/system-identification/viewing-diagnostics.rst))
# >
# > **Try it:** in section 3, choose *current limit*. In that log the acceleration is **constant**.
# > It is a warning, not a good sign.
# </details>

# %% [markdown]
# ## 3 Read the plots: thirteen ways to damage a log
#
# A *fault* is something that makes a log wrong: it *contaminates* the log. The table lists four
# classic faults, five more that are common on real robots, and four that are easy to see. Exercise
# 7 and `sysid inspect` use the same names, with a hyphen: `encoder-slip`. (Two of them do not occur
# there, *velocity filter* and *current limit*. `sysid effects` lists these two.)
#
# | fault | what happened | what to do |
# |---|---|---|
# | **four classic faults** | | |
# | encoder slip | the encoder slips on its shaft for a while | fix it, run again |
# | brownout | the battery voltage drops, the controller turns the motors off | charge, run again |
# | hard stop | the mechanism hits its end, the voltage stays on | cut off that part, or run again |
# | loop overrun | the robot program is too slow, samples are missing | find the cause, run again |
# | **five from real robots** | | |
# | command logged | the motor got less than the logged voltage | log the applied voltage |
# | velocity filter | the sensor takes an average, so its velocity is late | set a shorter filter |
# | current limit | the motor controller reduces the voltage of the step | use a smaller step |
# | wheel slip | the wheels spin faster than the robot moves | use a smaller step, drive on carpet |
# | stale samples | the log samples faster than the sensor updates | log at the sensor's rate |
# | **four more** | | |
# | unit error | the velocity does not match the position (rpm instead of rot/s) | fix the code |
# | mislabelled test | a test has the name of another test | fix the code |
# | voltage dropout | the log holds 0 V for single samples | fix the logging |
# | stuck sensor | position and velocity freeze for a while | check the cable, run again |
#
# **Predict:**

# %%
display(ask_question("lesson6.late"), ask_question("lesson6.gap"))

# %% [markdown]
# Choose a log and a plot. First look at the log "clean" in every plot.


# %%
def spoiled(fault: str, *, test: str | None = None, at: float | None = None) -> sim.Log:
    """The clean log with one fault in it, of an ordinary size."""
    return contaminate(sound, fault, test=test, at=at, rng=np.random.default_rng(2)).log


RAMP, STEP = "quasistatic-forward", "dynamic-forward"
all_cases = make_cases(rng=np.random.default_rng(0))
by_name = {case.name: case for case in all_cases}
late_sensor = replace(ROBOT, sensor=replace(ROBOT.sensor, filter=0.224))
limited = replace(ROBOT, stator=40.0)
weak = replace(ROBOT, battery=Battery(rest=11.6, resistance=0.035))
gallery = {
    "clean": sound,
    "encoder slip": spoiled("encoder-slip", test=RAMP, at=3.0),
    "brownout": spoiled("brownout", test=RAMP, at=3.0),
    "brownout, applied voltage": simulate(weak, ROUTINE, rng=np.random.default_rng(6)),
    "hard stop": spoiled("hard-stop", test=RAMP, at=4.5),
    "loop overrun": spoiled("loop-overrun", test=STEP, at=0.04),
    "command logged": spoiled("command-logged"),
    "velocity filter": simulate(late_sensor, ROUTINE, rng=np.random.default_rng(6)),
    "current limit": simulate(limited, ROUTINE, rng=np.random.default_rng(6)),
    "wheel slip": by_name["wheel slip, 7 V step"].log,
    "stale samples": spoiled("stale-samples"),
    "unit error": spoiled("unit-error"),
    "mislabelled test": spoiled("mislabelled-test"),
    "voltage dropout": spoiled("voltage-dropout", test=RAMP, at=2.0),
    "stuck sensor": spoiled("stuck-sensor", test=RAMP, at=3.0),
}


PLOTS = {
    "over time": lambda run, since: {
        "voltage [V]": (since, run.voltage),
        "velocity [m/s]": (since, run.velocity),
    },
    "voltage against velocity": lambda run, _: {"voltage [V]": (run.velocity, run.voltage)},
    "acceleration against velocity": lambda run, _: {
        "acceleration [m/s²]": (run.velocity, np.gradient(run.velocity, run.time))
    },
    "time steps": lambda run, since: {"time step [ms]": (since[1:], 1000 * np.diff(run.time))},
    "velocity and position's slope": lambda run, since: {
        "velocity in the log": (since, run.velocity),
        "slope of the position": (since, np.gradient(run.position, run.time)),
    },
}


def look(log: str, plot: str, test: str) -> Chart:
    """One test of a log in one plot; only the first 0.6 s of a step."""
    run = gallery[log].list_runs_of_test(test)[0]
    run = run.select(run.time - run.time[0] <= (0.6 if test == STEP else 6.0))
    against = "against" in plot
    curves, ends = [], None
    if plot in {"acceleration against velocity", "velocity and position's slope"}:
        shown = np.concatenate([y for _, y in PLOTS[plot](run, run.time).values()])
        low, high = np.percentile(shown, (1, 99))  # single wild values stay outside
        ends = (low - 0.1 * (high - low), high + 0.1 * (high - low))
    for color, (name, (x, y)) in enumerate(PLOTS[plot](run, run.time - run.time[0]).items()):
        kept = decimate_cloud(x, y, most=120)
        style = "dots" if against or "step" in name else "line"
        curves.append(Curve(name, x[kept], y[kept], style, color))
    xlabel = "velocity [m/s]" if against else f"time in the {test} test [s]"
    return Chart(xlabel, plot, curves, y=ends)


animate_charts(
    look,
    choices=(
        Choice("log", tuple(gallery)),
        Choice("plot", tuple(PLOTS)),
        Choice("test", (RAMP, STEP)),
    ),
)

# %% [markdown]
# A log is only what the sensor says. Below, the robot drives as in the clean log. The outline shows
# where the damaged log says that the robot is. After which fault does it never come back?

# %%
LIARS = ("encoder slip", "stuck sensor", "unit error")
animate_logs(
    "drivetrain",
    {name: (gallery[name], sound) for name in LIARS},
    tests={"ramp": RAMP, "step": STEP},
    label="fault",
    alt="A robot drives, and an outline shows where its log says that it is. During the fault, the "
    "two speeds differ.",
)

# %% [markdown]
# The next table shows what each fault does to the gains. *kS ÷ true* is the gain that SysId finds,
# divided by the true one: 1 is right. The two **R²** are scores that SysId shows for a fit: 1 is
# perfect. Section 5 explains them.


# %%
tabulate_fits(gallery, TRUTH)

# %% [markdown]
# ### What to look for
#
# Ask one question about every plot: **could the motor do that?** A robot cannot change its speed
# within one sample.
#
# - **Encoder slip.** From one sample to the next, the velocity drops to a fraction of its value.
#   Later it jumps back. The plot of voltage against velocity shows a second line.
# - **Brownout.** The controller turned the motors off. The velocity falls along a *curve*, and
#   later rises again along a curve. If the log holds the **commanded** voltage, it shows a voltage
#   although the motors got none. If it holds the **applied** voltage (lesson 4), the voltage drops
#   to 0 and comes back, again and again. If the log has the **bus voltage** (of the battery), you
#   see it fall below the threshold of lesson 5.
# - **Hard stop.** The velocity goes to zero within a few samples. The position stays the same, and
#   the voltage stays on.
# - **Loop overrun.** In the plot "time steps", some points are far above 20 ms. The other plots
#   hardly show the fault.
# - **Command logged.** The voltage of the step test looks perfect, but at first the velocity rises
#   in a straight line.
# - **Current limit.** The velocity rises in a straight line, too. But the *voltage* shows the
#   limit, because this log holds the applied voltage. So the log is correct, and the errors of its
#   gains are small.
# - **Velocity filter.** The velocity rises later than the slope of the position, because the
#   position is not filtered.
# - **Wheel slip.** The velocity jumps up, stays there for a moment, then rises slowly: the wheels
#   turned faster than the robot moved.
# - **Stale samples.** The curve looks like stairs: it shows the same value several times, and
#   then it jumps.
#
# <details><summary>Four more faults, which are easy to see</summary>
#
# - **Unit error.** The velocity has the right shape but the wrong size compared with the slope of
#   the position.
# - **Mislabelled test.** In a "quasistatic" test the voltage jumps, or a "forward" test goes
#   backward.
# - **Voltage dropout.** The voltage drops to zero for single samples, but the velocity does not
#   react.
# - **Stuck sensor.** Position and velocity stay at one value, then jump to the right value.
# </details>
#
# <details><summary>For mentors: the voltage in a brownout, with source</summary>
#
# > **Lesson says:** "Voltage data suddenly drops mid-test, then recovers."
# >
# > **Source says:** in a brownout the robot controller disables its outputs until the battery
# > recovers. So the *applied* voltage drops and recovers. The commanded voltage does not drop,
# > because the routine does not know about the brownout. ([WPILib docs:
# > Brownouts, at one
# > commit](https://github.com/wpilibsuite/frc-docs/blob/c6315dc0701cb74273487d6e303a8cc5098a8462/source/docs/software/roborio-info/roborio-brownouts.rst))
# >
# > **Try it:** in the menus above, choose "brownout, applied voltage", the plot "over time", and
# > one test after the other. In which of them does the voltage drop?
# </details>
#
# ### How bad are timing gaps?
#
# To get the acceleration, SysId divides each change of the velocity by the *mean* time step of the
# test. So at a gap the acceleration is wrong. The usual step is 20 ms, and half of all steps are a
# bit longer. Only a step that is more than 1.5 times as long as usual is a gap. How wrong is kA?
#
# <details><summary>For mentors: gaps and kA, with source</summary>
#
# > **Lesson says:** "Timestamps in the log show gaps larger than 20 ms. The regression assumes
# > uniform sample timing; large gaps produce incorrect kA values".
# >
# > **Source says:** in principle, yes: SysId divides each difference of velocities by the *mean*
# > time step of the test. But 20 ms is the normal step, so half of all steps are a bit longer.
# > Count the time steps that are more than 1.5 times as long as usual. ([SysId's source:
# > FilteringUtils.cpp](https://github.com/wpilibsuite/allwpilib/tree/v2026.2.2/sysid/src/main/native/cpp/analysis/FilteringUtils.cpp))
# >
# > **Try it:** the next cell makes ten logs for each row of its table. The gaps are few or many,
# > short or long.
# </details>


# %%
def written(run: sim.Run, share: float, longest: float, rng: np.random.Generator) -> np.ndarray:
    """Whether each row is written: after a share of the rows, the next loops are late."""
    late = rng.random(len(run)) < share
    lost = np.convolve(late, np.ones(round(longest / 0.02)))[: len(run)] > 0
    return ~lost | (np.arange(len(run)) == 0)


rows = []
for share, longest in ((0.0, 0.02), (0.05, 0.04), (0.05, 0.08), (0.05, 0.2)):
    found = []
    for seed in range(10):
        rng = np.random.default_rng(seed)
        whole = simulate(ROBOT, ROUTINE, rng=rng)
        log = select_rows(whole, lambda run, how=(share, longest, rng): written(run, *how))
        found.append(fit(log, method="sysid").gains)
    kv, ka = (np.array([one[gain] / TRUTH[gain] for one in found]) for gain in ("kV", "kA"))
    name = f"{1000 * longest:.0f} ms after {100 * share:.0f} % of the rows" if share else "none"
    rows.append((name, kv.mean(), ka.mean(), ka.min(), ka.max()))

Table(("gaps", "kV ÷ true", "kA ÷ true, mean of ten", "smallest", "largest"), tuple(rows))

# %% [markdown]
# kV hardly changes. kA changes if a gap falls into the few samples in which the velocity rises.
#
# ### How bad are repeated samples?
#
# A motor controller sends its measurements in *status frames*, 50 to 250 times a second. A program
# that logs faster writes the same measurement several times. Here is a log with a row every 5 ms,
# but only 50 frames a second.

# %%
framed = replace(ROBOT, sensor=replace(ROBOT.sensor, frame=1 / 50))
log = simulate(framed, ROUTINE, rng=np.random.default_rng(3), period=0.005)
for who, method in (("SysId's recipe", "sysid"), ("sysid fit", "output-error")):
    print(f"{who}: kA is {fit(log, method=method).gains['kA'] / TRUTH['kA']:.2f} times the true kA")

# %% [markdown]
# Where a measurement repeats, SysId computes an acceleration of zero, and drops these rows. In the
# rows next to a new measurement, it divides the change by the time of two rows. But the change took
# four rows. So the acceleration is twice as large as it should be, and kA only half as large. Log
# at the rate of the status frames, or set faster frames for the test. (`sysid fit` finds the
# repeated measurements and leaves them out.)

# %% [markdown]
# ## 4 Doing it: trim what the model does not describe
#
# To *trim* a log is to cut off samples. The equation V = kS·sgn(v) + kV·v + kA·a is true while
# **only the motor** moves the mechanism.
#
# - At a hard stop, the stop pushes the mechanism, too. The equation does not describe that: **cut
#   this part off.**
# - At rest, friction holds the mechanism at any voltage up to kS. The equation does not describe
#   that either: **drop it**, with a *threshold* (the lowest speed that you keep).
# - A single *wild reading*, far from its neighbors, is a sensor error. A **median filter** sorts
#   each value and its neighbors by size, and keeps the middle one.
# - A noisy part looks ugly, but the equation is true there: **keep it.**
#
# SysId's window has three settings: *Velocity Threshold* (quasistatic tests only), *Window Size*
# (the median filter) and *Test Duration* (dynamic tests only). No setting says where a ramp ends.
# The picture below has a slider for this, too. Its log has a hard stop, a noisy standstill and
# three wild readings. Set the sliders so that the gains become as true as you can get them.
#
# <details><summary>For mentors: trimming in SysId, with source</summary>
#
# > **Lesson says:** "You need to trim the data end point in the analyzer, or re-run the test with
# > more conservative travel limits."
# >
# > **Source says:** SysId's window has three settings. *Velocity Threshold* works on quasistatic
# > tests only, *Window Size* is the median filter, *Test Duration* works on dynamic tests only.
# > None of them sets the end of a ramp. The threshold removes samples at a stop, **if** the encoder
# > is quiet at standstill. ([WPILib docs: Viewing
# > Diagnostics](https://github.com/wpilibsuite/frc-docs/blob/c94b51df80ed991bdb634ed20dbf758e31dc0d3c/source/docs/software/advanced-controls/system-identification/viewing-diagnostics.rst),
# > [SysId's source:
# > FilteringUtils.cpp](https://github.com/wpilibsuite/allwpilib/tree/v2026.2.2/sysid/src/main/native/cpp/analysis/FilteringUtils.cpp))
# >
# > **Try it:** below is a log with a hard stop, a noisy standstill and three wild readings. Only
# > the slider *until* ends its ramp.
# </details>

# %%
messy = contaminate(
    sound, "hard-stop", severity=2, test=RAMP, at=4.5, rng=np.random.default_rng(2)
).log
messy = contaminate(messy, "noisy-standstill", test=RAMP, rng=np.random.default_rng(2)).log
ramp = messy.list_runs_of_test(RAMP)[0]
wild = ramp.velocity.copy()
wild[[90, 150, 200]] += np.array([1.2, -1.0, 1.5])
messy = replace(messy, runs=(replace(ramp, velocity=wild), *messy.runs[1:]))

plot_time_series(messy, dynamic_seconds=0.6)


# %%
def kept(log: sim.Log, *, end: float, threshold: float) -> sim.Log:
    """The log without what comes after ``end`` in the ramps, and without their slow samples."""
    return select_rows(
        log,
        lambda run: (
            (run.kind == "dynamic")
            | ((run.time - run.time[0] <= end) & (np.abs(run.velocity) >= threshold))
        ),
    )


def chart_trimmed_fit(median: str, threshold: float, end: float) -> Chart:
    """The gains of a choice, each over its true value."""
    part = kept(messy, end=end, threshold=threshold)
    found = fit(part, method="sysid", median=int(median)).gains
    ratios = {gain: value / TRUTH[gain] for gain, value in found.items()}
    shown = compare_values(ratios, truth=1.0, xlabel="found gain ÷ true gain")
    return replace(shown, x=(-2.0, 4.0))


animate_charts(
    chart_trimmed_fit,
    choices=(Choice("median", ("1", "3", "15")),),
    knobs=(
        Knob("threshold", "threshold [m/s]", low=0.0, high=1.0, step=0.2, value=0.0),
        Knob("until", "until [s]", low=3.0, high=6.0, step=0.5, value=6.0),
    ),
)

# %% [markdown]
# - The threshold drops the noisy standstill, and the samples at the stop. The slider *until* ends
#   the ramp and cuts off the hard stop with its bounce. The median removes the wild readings. No
#   single setting repairs all three faults.
# - **More filtering is not better.** A median of 15 samples flattens the rise, so kA becomes much
#   too small. A threshold of 1 m/s drops the slow part of the ramp, which shows kS.
#
# ### Do not cut off good samples
#
# The fast end of a ramp is its most valuable part: kV is a slope, and you need a long line to
# measure a slope. Each row of the next table uses a shorter part of the ramps of the **clean** log.
# *One standard error* is the typical error that noise alone causes.

# %%
rows = []
for end in (6.0, 4.0, 2.0, 1.0):
    part = kept(sound, end=end, threshold=0.05)
    top = float(part.list_runs_of_test(RAMP)[0].velocity.max())
    errors = fit(part, method="sysid").errors
    rows.append((f"{end:g} s of each ramp", top, errors["kV"], errors["kS"]))
Table(
    ("kept", "fastest sample [m/s]", "standard error of kV [V·s/m]", "standard error of kS [V]"),
    tuple(rows),
)

# %% [markdown]
# ## 5 R² does not find every bad log
#
# Here you see no plots of the logs, only one score: SysId's **simulated velocity R²**. SysId
# simulates the robot with the fitted gains and the voltage of the log. The score compares simulated
# and measured velocity. Below are logs A to V of one drivetrain. One is clean. One was damaged and
# then repaired. In all others something is wrong.
#
# The official docs say: "A value north of .9 indicates a good fit" ("north of" means "above").
# ([WPILib docs: Viewing
# Diagnostics](https://github.com/wpilibsuite/frc-docs/blob/c94b51df80ed991bdb634ed20dbf758e31dc0d3c/source/docs/software/advanced-controls/system-identification/viewing-diagnostics.rst))
#
# **Predict:**

# %%
wrong = [case for case in all_cases if case.harmful]
display(ask_question("lesson6.count", wrong=len(wrong)), ask_question("lesson6.robust"))

# %% [markdown]
# **Decide first:** which of these logs would you use? Write down their letters. Then choose
# *reveal*.

# %%
order = np.random.default_rng(6).permutation([case.name for case in all_cases]).tolist()
LETTERS = {name: chr(ord("A") + place) for place, name in enumerate(order)}
SIM = "simulated velocity R²"
KEYS = {
    "letter": lambda case: LETTERS[case.name],
    SIM: lambda case: -case.fit.simulated_velocity_r2,
    "acceleration R²": lambda case: -case.fit.acceleration_r2,
}


def grid(truth: str, sort: str) -> list[Chart]:
    """All logs with their scores, and on demand their damage and the errors of their gains."""
    revealed = truth == "reveal"
    cases = sorted(all_cases, key=KEYS[sort])
    bars = []
    for row, case in enumerate(cases):
        score = case.fit.simulated_velocity_r2
        note = f"{'✓' if case.has_good_r2 else '✗'} {score:.2f}"
        bars.append(Curve("", [0.0, score], [row, row], "bar", 1 + case.has_good_r2, ["", note]))
    errors = []
    for color, gain in enumerate(TRUTH if revealed else ()):
        off = np.clip([100 * case.compute_gain_error(gain) for case in cases], -99, 99)
        errors.append(Curve(gain, off, range(len(cases)), "dots", color))
    rows = [f"{LETTERS[one.name]}: {one.name}" if revealed else LETTERS[one.name] for one in cases]
    limit = Curve("", [GOOD, GOOD], [-0.6, len(rows) - 0.4], "dashed")
    return [
        Chart(f"{SIM} (dashed: {GOOD:g})", "", [*bars, limit], rows, x=(0.0, 1.2)),
        Chart("error of a gain [%], at most 99", "", errors, rows, x=(-100.0, 100.0)),
    ]


animate_charts(
    grid,
    choices=(Choice("truth", ("hide", "reveal")), Choice("sort by", tuple(KEYS))),
)

# %%
passing = [case for case in wrong if case.has_good_r2]
print(f"{len(passing)} of {len(wrong)} wrong logs have a {SIM} above {GOOD:g}.")
damage = [case for case in wrong if abs(case.compute_gain_error("kV")) < 0.2]
print(f"In {len(damage)} of them, kV is less than 20 % off. Their median errors:")
for gain in ("kS", "kV", "kA"):
    median = np.median([abs(case.compute_gain_error(gain)) for case in damage])
    print(f"  {gain}: {100 * median:.1f} %")

# %% [markdown]
# ### Explain
#
# - **The simulated velocity R² asks:** is the simulated velocity close to the measured one? The
#   velocity depends mostly on kV, and kV is right in nearly all logs. kA only matters for a part of
#   a second. So kA may be wrong by half, and the score hardly changes.
# - **Damage hardly changes kV, but it changes kA a lot; kS is in between.** Many samples contain
#   information about kV, and only a few about kA.
# - **The acceleration R² compares accelerations row by row (lesson 7), and it finds more faults.**
#   Sort the logs by this score: spikes (wild readings), the sudden jump and the worst slips come
#   last. But this score does *not notice* a wrong voltage, a wrong gear ratio or a wrong sign. And
#   a low value proves nothing: many good logs have one.
#
# <details><summary>Want to know more?</summary>
#
# - The docs say that the acceleration R² "rarely goes above 0.5, even on very good datasets".
# - A repaired log can have a **lower** R² than a wrong one. The median filter
#   keeps the wild readings out of the fit. The score still counts them, because SysId compares its
#   simulation with the velocities as recorded.
# - Each of these logs is only one simulation. Its errors also depend on luck, for example on
#   where a gap is. So remember which *kind* of error a fault causes, not the exact
#   numbers.
# </details>
#
# ## 6 Checks that find more than R²
#
# 1. **Signs.** kV and kA are positive, kS is not negative.
# 2. **kV is right for these motors and gears**: it differs from the computed kV (lesson 1) by less
#    than 10 %.
# 3. **kA is right for these motors and this mass**: it differs from the computed kA by less than 25
#    %.
# 4. **Acceleration R² is not below 0.2.**
# 5. **Somebody looked** at the plots of section 3. In the next table, the program `inspect` does
#    that.

# %%
CHECKS = {
    "signs": lambda case: min(case.fit.gains.values()) < 0,
    "kV": lambda case: abs(case.compute_gain_error("kV")) > 0.10,
    "kA": lambda case: abs(case.compute_gain_error("kA")) > 0.25,
    "acceleration R²": lambda case: case.fit.acceleration_r2 < 0.2,
    "looked": lambda case: bool(inspect(case.log).damages),
}
rows = [
    (case.name, *("caught" if check(case) else "·" for check in CHECKS.values()))
    for case in all_cases
    if case.name != "10 spikes, median of 5"
]
Table(("log", *CHECKS), tuple(rows))

# %%
escaped = [name for name, *found in rows if "caught" not in found]
print(f"No check finds these logs: {'; '.join(escaped)}.")

# %% [markdown]
# It is right that no check reports the clean log. But the other two logs in this line are damaged.
# The program looks for neither a velocity filter nor such a short slip. So look yourself: compare
# the velocity with the slope of the position, and read the settings of your motor controller.
#
# A sixth check: **fit forward and reverse separately.** Friction may differ between the directions.
# One kS cannot describe both, and R² does not show it:

# %%
leaning = by_name["friction differs"].log
for way in ("forward", "reverse"):
    run = leaning.list_runs_of_test(f"quasistatic-{way}")[0]
    moving = np.abs(run.velocity) > 0.1
    _, volts = np.polyfit(np.abs(run.velocity[moving]), np.abs(run.voltage[moving]), 1)
    print(f"{way}: the line of the ramp meets velocity 0 at {volts:.2f} V")

# %% [markdown]
# Before you load a log, check one setting: SysId's menu *Analysis Type* starts on **Elevator**.
# Choose the type of your mechanism (lesson 2).
#
# ### Let the program look, after you looked
#
# The program `inspect` says which fault it finds, where, how sure it is (1 is certain), and what to
# do:

# %%
print(f"The program knows {len(FAULTS)} faults: most faults of section 3, and some more.")
seen = inspect(gallery["encoder slip"])
for damage in seen.damages:
    print(f"{damage.fault} in {damage.where.test}, confidence {damage.confidence:.2f}")
    for text in (damage.evidence, damage.advice):
        print(fill(text, width=80, initial_indent="  ", subsequent_indent="  "))
plot_time_series(gallery["encoder slip"], dynamic_seconds=0.6, damages=seen.damages)

# %% [markdown]
# In a terminal, type `sysid inspect drive.wpilog`. But look at the plots yourself first.

# %% [markdown]
# ## 7 System check
#
# Before you fit, check all five:
#
# - [ ] **Signs:** a positive voltage gives a positive velocity, in all four tests.
# - [ ] **Over time:** you see nothing that a motor cannot do. In the dynamic tests, the velocity
#   rises along a curve from the start.
# - [ ] **Time steps:** none is more than 1.5 times as long as usual, or you know how many are
#   longer.
# - [ ] **Position:** its slope is the velocity, without a delay.
# - [ ] **The voltage** is the one applied to the motor.
#
# ## 8 Knowledge check
#
# Click an answer to the first question.

# %%
display(ask_question("lesson6.quick"), enable_checkboxes())

# %% [markdown]
# **1.** Which plot shows which fault? The plots are (a) time steps, (b) velocity next to the slope
# of the position, (c) velocity over time, close up, (d) voltage over time. The faults: (1) a
# current limit in a log of the applied voltage, (2) a loop overrun, (3) encoder slip, (4) a
# velocity filter.
#
# <details><summary>Answer</summary>
#
# a2, b4, c3, d1. The voltage shows a current limit only if the log contains the applied voltage. If
# it contains the commanded voltage, look at how the velocity rises: under a current limit, it rises
# in a straight line at first.
# </details>
#
# **2.** In the middle of the quasistatic forward test, the mechanism suddenly jumped forward. The
# rest of the log is clean. What was the cause, and what happens to the gains?
#
# <details><summary>Answer</summary>
#
# A mechanical part got stuck and then came free: for example a loose chain, a skipped tooth or a
# tight bearing. (It was encoder slip only if a second sensor or the current shows that the
# mechanism did *not* jump. The position comes from the same encoder: it cannot show this.) The few
# samples of the jump matter a lot, because a fit squares the errors: an error that is three times
# as large counts nine times as much. So kS is too small or negative, kA is too large, kV hardly
# changes, and the simulated velocity R² stays above 0.9. Find the log "sudden jump" in section 5
# (choose *reveal*). Fix the mechanism and run again. A median filter or trimming helps less.
# </details>
#
# **3.** "All our R² are above 0.97, so the gains are fine." What do you ask?
#
# <details><summary>Answer</summary>
#
# Which R²? Are kV and kA close to the values you expect from motors, gears and mass? Does the log
# hold the applied voltage? Did anybody look at the plots? In section 5, nearly all wrong logs have
# a simulated velocity R² above 0.9.
# </details>
#
# **4.** The end of the ramp is noisy. A teammate wants to cut it off, "so that the line looks
# clean". Do you agree?
#
# <details><summary>Answer</summary>
#
# No. The equation is true for noisy samples, too, and the fast samples contain the most information
# about kV. Cut only where something *other than the motor* moves or holds the mechanism: where it
# hits a hard stop, or where it stands still.
# </details>
#
# **5.** The battery was weak in a test. Do you have to run it again?
#
# <details><summary>Answer</summary>
#
# If the controller turned the motors off (a brownout), run it again with a charged battery. You see
# a brownout if the velocity falls along a curve, or if the applied voltage drops to 0 and comes
# back. The bus voltage shows it in both cases. If the voltage only dropped a little, look at which
# voltage the log contains. If the log contains the applied voltage, it is correct, and you do not
# have to run the test again. If the log contains the commanded voltage, fix the logging, then run
# the test again.
# </details>

# %% [markdown]
# ## 9 Practice
#
# **Exercise 7, Detective** ([exercises/exercise7/README.md](../exercises/exercise7/README.md)). You
# get twelve logs, most of them damaged. Name the fault, where it is, and what to do. To look at log
# 4, run `python exercises/exercise7/look.py 4 --page`. Drag the mouse over a part of a plot to get
# its start and end time.
#
# ```
# grade exercise7
# ```
#
# **Exercise 8, Trim and clean**
# ([exercises/exercise8/README.md](../exercises/exercise8/README.md)). You get one log with a hard
# stop, a noisy standstill and wild readings. You choose what to keep.
#
# ```
# grade exercise8
# ```
#
# <details><summary>Or answer from a notebook, with your own values</summary>
#
# ```python
# from grader import submit
#
# submit("exercise7", log01="clean", log02="hard-stop, dynamic-forward, 1.2 to 1.7, trim")
# submit("exercise8", quasistatic_forward="0 to 4.4", threshold=0.1, median=3)
# ```
#
# </details>
#
# If you write into `answers.toml` with an editor, `grade watch exercise7` grades each time you
# save. Hints cost nothing: `grade exercise7 --hint`.
#
# **Want more logs?** `grade mystery` makes a new log each time you run it.
#
# **On your own robot:** open an old log in AdvantageScope, and go through the list of section 7.
# Then run `sysid inspect` on it.
#
# **Next:** [Lesson 7, fit it yourself](07_fit_it_yourself.ipynb). How does the fit find the gains?
