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
# *About 50 minutes. You need lessons 1 and 3. You do not need to know how a fit works: that is
# lesson 7. Today you decide whether a log deserves one.*
#
# **At the end you can**
#
# - say what a sound log looks like, test by test, and why;
# - name nine ways in which a log is spoiled, and the plot that shows each;
# - cut away what is not physics, and leave alone what is only ugly;
# - explain why a good R² does not make a good log, and name five checks that do better.

# %% [markdown]
# ## 1 Why: a fit never says "I do not know"
#
# Give a fit any log, and it gives you three numbers. It does not know that a wheel slipped, or that
# the battery was empty. It finds the numbers that miss *those* data least.
#
# > The fit believes the log: nonsense in, nonsense out. So somebody has to read the log first. That
# > is you.
#
# Our robot today is the bench's drivetrain. We know its true gains, so we can tell how wrong an
# answer is. On your robot you cannot, and that is the point of this lesson.

# %%
from dataclasses import replace
from textwrap import fill

import ipywidgets as widgets
import numpy as np
from IPython.display import display

import sim
from sim.bench.mechanisms import MECHANISMS
from sim.bench.simulate import simulate
from sim.fit import fit
from sim.inspect.contaminate import contaminate
from sim.inspect.detect_faults import inspect
from sim.inspect.fault import select_samples
from sim.inspect.faults import FAULTS
from sim.physics.battery import Battery
from sim.plot import (
    Picture,
    Table,
    plot_acceleration_velocity,
    plot_choices,
    plot_curves,
    plot_r2_vs_gain_error,
    plot_time_series,
    plot_timesteps,
    plot_voltage_velocity,
    show_interactive,
)
from sim.teaching.prediction import Prediction
from sim.teaching.r2_cases import GOOD, make_cases

ROBOT = replace(MECHANISMS["drivetrain"], travel=None)
TRUTH = ROBOT.gains
ROUTINE = sim.Routine(ramp=1.0, step=3.5, timeout=6.0)
sound = simulate(ROBOT, ROUTINE, rng=np.random.default_rng(6))

TAU = TRUTH["kA"] / TRUTH["kV"]
print(f"The truth: kS {TRUTH['kS']:.3f} V, kV {TRUTH['kV']:.3f} V·s/m, kA {TRUTH['kA']:.3f} V·s²/m")
print(f"kA/kV = {1000 * TAU:.0f} ms: by then nearly two thirds of a new speed is reached")

# %% [markdown]
# ## 2 The model: what a sound log looks like
#
# **Predict first.** In the dynamic test the voltage jumps to 3.5 V and stays. (No buttons on your
# screen? Type `guess_rise.value = "largest at the start"` in a cell.)

# %%
guess_rise = Prediction(
    "While the velocity rises, the acceleration is…",
    "about constant, then zero",
    "largest at the start, then less and less",
    "small at first, then larger and larger",
)
guess_rise

# %%
plot_time_series(sound, dynamic_seconds=0.6)

# %% [markdown]
# **A sound quasistatic test** (left):
#
# - The voltage is a ramp. The velocity stays at zero until the voltage is above kS, then it climbs
#   in a straight line.
# - Forward and reverse are mirror images, nearly. (Not for an elevator or an arm: there gravity
#   helps one of them. Lesson 2.)
# - Voltage over velocity is a straight line with little scatter: the plot below.
#
# **A sound dynamic test** (right):
#
# - The voltage jumps, and stays.
# - The velocity rises at once, steeply, then bends over and goes flat.
# - It ends by *Disable* or by letting go, not at a wall.
#
# In both, the samples come every 20 ms, and the position is what the velocity adds up to.

# %%
plot_voltage_velocity(sound)

# %% [markdown]
# > **Lesson says:** "Voltage vs. velocity forms a straight line with low scatter. The forward and
# > reverse runs are near-symmetric. R² value is above 0.9 in the analyzer."
# >
# > **Source says:** SysId 2026 has no plot of voltage over velocity. It draws velocity over time,
# > acceleration over velocity, and the time steps. And it has *two* R², which mean different things
# > (section 5).
# > ([WPILib docs: Viewing Diagnostics](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/system-identification/viewing-diagnostics.html))
# >
# > **Try it:** the straight line is a good sign all the same, and our bench draws it. Look where it
# > leaves standstill: that is near kS, not at it (lesson 7 says why).
#
# Now the rise of the dynamic test: acceleration over velocity. (SysId has a plot of that name. It
# shows all four tests, and first takes off what the voltage and friction account for.)

# %%
plot_acceleration_velocity(sound)

# %%
rise = sound.runs_of_test("dynamic-forward")[0]
slope = np.gradient(rise.velocity, rise.time)
early, later = (int(np.searchsorted(rise.time, rise.time[0] + wait)) for wait in (0.02, 0.02 + TAU))
print(f"You said: {guess_rise}.")
print(f"Acceleration after  20 ms: {slope[early]:.1f} m/s²")
print(f"Acceleration {1000 * TAU:.0f} ms later: {slope[later]:.1f} m/s²", end="")
print(f", {slope[later] / slope[early]:.0%} of it")

# %% [markdown]
# ### Explain
#
# The motor pushes with what is left of the voltage: V − kS − kV·v. The faster it goes, the less is
# left. So the acceleration is **largest at the start** and dies away, by the same share in each
# equal piece of time. Such a curve is called *exponential*, and kA/kV is its time scale.
#
# (After each kA/kV, about 37 % of the acceleration is left. Noise makes the printed share stray a
# little.) In the plot above that is a straight line that falls: the faster, the less acceleration.
#
# > **Lesson says:** "Acceleration is relatively constant during the rising portion."
# >
# > **Source says:** "a successful dynamic graph will be an approximately exponential approach of
# > the steady-speed".
# > ([WPILib docs: Viewing Diagnostics](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/system-identification/viewing-diagnostics.html))
# >
# > **Try it:** in section 3, choose *current limit*. A **constant** acceleration is what that looks
# > like. It is a warning, not a good sign.

# %% [markdown]
# ## 3 Reading: nine ways to spoil a log
#
# The source lesson names four *contaminations*. Five more are common in the field.
#
# | fault | what happened | what to do |
# |---|---|---|
# | **the source lesson's four** | | |
# | encoder slip | the encoder loses its grip on the shaft for a while | fix it, run again |
# | brownout | the battery sinks, and the motors are cut for a moment | charge, run again |
# | hard stop | it hits its end, the voltage goes on | trim, or run again |
# | timing gaps | the robot program stalls, samples are missing | find the stall, run again |
# | **five from the field** | | |
# | asked-for voltage | the log holds a request, less arrived | log the applied voltage |
# | velocity filter | the sensor averages, and is late | set a shorter filter |
# | current limit | the motor gets less than the step | smaller step, or mind the start |
# | wheel slip | the wheels spin ahead of the robot | smaller step, on carpet |
# | repeated samples | the log is faster than the sensor's news | log at the sensor's pace |
#
# **Predict:**

# %%
guess_late = Prediction(
    "A velocity filter makes the velocity come late. Which plot shows it best?",
    "voltage over velocity",
    "the time steps",
    "the velocity beside the slope of the position",
)
guess_gap = Prediction(
    "A few samples are missing. Which gain suffers?",
    "kS most",
    "kV most",
    "kA most",
    "all alike",
)
display(guess_late, guess_gap)

# %% [markdown]
# The bench makes a log of each. Then choose a log and a plot. Look at *sound* first, in every plot.


# %%
def spoiled(fault: str, *, test: str | None = None, at: float | None = None) -> sim.Log:
    """The sound log with one fault in it, as strong as on an ordinary bad day."""
    return contaminate(sound, fault, test=test, at=at, rng=np.random.default_rng(2)).log


RAMP, STEP = "quasistatic-forward", "dynamic-forward"
all_cases = make_cases(rng=np.random.default_rng(0))
by_name = {case.name: case for case in all_cases}
late_sensor = replace(ROBOT, sensor=replace(ROBOT.sensor, filter=0.224))
limited = replace(ROBOT, stator=40.0)
weak = replace(ROBOT, battery=Battery(rest=11.6, resistance=0.035))
gallery = {
    "sound": sound,
    "encoder slip": spoiled("encoder-slip", test=RAMP, at=3.0),
    "brownout": spoiled("brownout", test=RAMP, at=3.0),
    "brownout, applied voltage": simulate(weak, ROUTINE, rng=np.random.default_rng(6)),
    "hard stop": spoiled("hard-stop", test=RAMP, at=4.5),
    "timing gaps": spoiled("loop-overrun", test=STEP, at=0.04),
    "asked-for voltage": spoiled("command-logged"),
    "velocity filter": simulate(late_sensor, ROUTINE, rng=np.random.default_rng(6)),
    "current limit": simulate(limited, ROUTINE, rng=np.random.default_rng(6)),
    "wheel slip": by_name["wheel slip, 7 V step"].log,
    "repeated samples": spoiled("stale-samples"),
}


def position_slope(log: sim.Log) -> Picture:
    """The first half second of a step: the logged velocity, and what the position says."""
    run = log.runs_of_test(STEP)[0]
    since = run.time - run.time[0]
    part = since < 0.5
    lines = {
        "velocity in the log": run.velocity[part],
        "slope of the position": np.gradient(run.position, run.time)[part],
    }
    return plot_curves(np.round(since[part], 2), lines, xlabel="time [s]", ylabel="velocity [m/s]")


PLOTS = {
    "over time": lambda log: plot_time_series(log, dynamic_seconds=0.6),
    "voltage over velocity": plot_voltage_velocity,
    "acceleration over velocity": plot_acceleration_velocity,
    "time steps": plot_timesteps,
    "velocity and position's slope": position_slope,
}


def look(log: str, plot: str) -> Picture:
    """One log in one plot."""
    return PLOTS[plot](gallery[log])


show_interactive(
    look,
    log=widgets.Dropdown(options=list(gallery), description="log"),
    plot=widgets.Dropdown(options=list(PLOTS), description="plot"),
)

# %% [markdown]
# No menus on your screen? Change the two names here, and run the cell:

# %%
look("current limit", "over time")

# %% [markdown]
# A velocity filter, in the plot that shows it:

# %%
look("velocity filter", "velocity and position's slope")

# %% [markdown]
# What each of them does to the gains. (The two **R²** are SysId's scores. 1 is perfect. 0 says: the
# gains explain nothing. Below zero it is worse than nothing. Section 5 is about them.)


# %%
def outcome(log: sim.Log) -> tuple[float, ...]:
    """Each gain over its true value, and SysId's two R²."""
    found = fit(log, method="sysid")
    ratios = [found.gains[gain] / TRUTH[gain] for gain in ("kS", "kV", "kA")]
    return (*ratios, found.acceleration_r2, found.simulated_velocity_r2)


HEADER = ("log", "kS ÷ true", "kV ÷ true", "kA ÷ true", "acceleration R²", "simulated velocity R²")
Table(HEADER, tuple((name, *outcome(log)) for name, log in gallery.items()))

# %% [markdown]
# ### What to look for
#
# Ask one question of every plot: **could the motor have done that?** A mass cannot change its speed
# within one sample.
#
# - **Encoder slip.** The velocity falls by a share of itself from one sample to the next, and comes
#   back as suddenly. Voltage over velocity gets a second branch.
# - **Brownout.** The velocity falls along a *curve*, as without a motor, and climbs back along one.
#   If the log holds the **asked-for** voltage, the voltage goes on as if nothing had happened.
#   If it holds the **applied** voltage (lesson 4), the voltage is chopped: it drops to 0 and comes
#   back, again and again. The **bus voltage**, if it is in the log, shows both: it falls below the
#   threshold.
# - **Hard stop.** From speed to zero within a few samples. The position stays, the voltage goes on.
# - **Timing gaps.** Only *time steps* shows them well.
# - **Asked-for voltage.** The step in the log is perfect, the rise starts in a straight line.
# - **Current limit.** The same rise, but the *voltage* shows the limit, because it is what arrived.
#   An honest log: look how little the gains suffer.
# - **Velocity filter.** The velocity runs behind the slope of the position. The position is not
#   filtered.
# - **Wheel slip.** A surge, a lull, then a slower climb: the wheels were ahead of the robot.
# - **Repeated samples.** Stairs: the same reading two or three times, then a jump. Some logs write
#   a value only when it *changes*; that looks alike.
#
# > **Lesson says:** "Voltage data suddenly drops mid-test, then recovers."
# >
# > **Source says:** in a brownout the robot controller disables its outputs until the battery
# > recovers. So the *applied* voltage drops and recovers. The asked-for voltage does not drop,
# > because nobody tells the routine.
# > ([WPILib docs: Brownouts](https://docs.wpilib.org/en/stable/docs/software/roborio-info/roborio-brownouts.html))
# >
# > **Try it:** look at both brownouts above in the plot *over time*.
#
# ### How bad are timing gaps?
#
# > **Lesson says:** "Timestamps in the log show gaps larger than 20 ms. The regression assumes
# > uniform sample timing; large gaps produce incorrect kA values".
# >
# > **Source says:** right in kind: SysId divides each difference of velocities by the *mean* time
# > step of the test. But 20 ms is the normal step, so half of all steps are a bit longer. Count the
# > steps that are longer than 1.5 times the usual one.
# > ([SysId's source: FilteringUtils.cpp](https://github.com/wpilibsuite/allwpilib/tree/v2026.2.2/sysid/src/main/native/cpp/analysis/FilteringUtils.cpp))
# >
# > **Try it:** the next cell makes ten logs each with few and many, short and long gaps.


# %%
def with_gaps(log: sim.Log, *, share: float, longest: float, rng: np.random.Generator) -> sim.Log:
    """The same log, where a share of the loops is late by up to so many seconds."""
    runs = []
    for run in log.runs:
        keep, place = np.ones(len(run), dtype=bool), 1
        while place < len(run) - 1:
            lost = int(rng.uniform(0.04, longest) / 0.02) - 1 if rng.random() < share else 0
            keep[place : place + lost] = False
            place += lost + 1
        keep[-1] = True
        runs.append(select_samples(run, keep))
    return replace(log, runs=tuple(runs))


rows = []
for share, longest in ((0.0, 0.05), (0.05, 0.1), (0.2, 0.1), (0.2, 0.3)):
    found = []
    for seed in range(10):
        rng = np.random.default_rng(seed)
        log = with_gaps(simulate(ROBOT, ROUTINE, rng=rng), share=share, longest=longest, rng=rng)
        found.append(fit(log, method="sysid").gains)
    kv, ka = (np.array([one[gain] / TRUTH[gain] for one in found]) for gain in ("kV", "kA"))
    name = f"{100 * share:.0f} % of the loops, up to {1000 * longest:.0f} ms" if share else "none"
    rows.append((name, float(np.mean(kv)), float(np.mean(ka)), float(ka.min()), float(ka.max())))

print(f"You said: {guess_late}; {guess_gap}.")
Table(("gaps", "kV ÷ true", "kA ÷ true, mean of ten", "smallest", "largest"), tuple(rows))

# %% [markdown]
# kV does not care. kA does, and by luck: it depends on whether a gap falls into the few samples of
# the rise. A single log cannot tell you how lucky you were.
#
# ### How bad are repeated samples?
#
# A motor controller sends its readings in *status frames*, 50 to 250 times a second. A program that
# logs faster writes each reading several times. The next cell logs every 5 ms.

# %%
rows = []
for rate in (50, 100, 250):
    framed = replace(ROBOT, sensor=replace(ROBOT.sensor, frame=1 / rate))
    log = simulate(framed, ROUTINE, rng=np.random.default_rng(3), period=0.005)
    ours, recipe = (fit(log, method=how).gains for how in ("output-error", "sysid"))
    rows.append((f"{rate} Hz", recipe["kA"] / TRUTH["kA"], ours["kA"] / TRUTH["kA"]))
Table(("status frames", "kA ÷ true, SysId's recipe", "kA ÷ true, sysid fit"), tuple(rows))

# %% [markdown]
# SysId takes the acceleration from neighboring rows, and between two repeated rows it is zero. So
# log as fast as the frames come, or set faster frames for the test. (`sysid fit` finds the repeated
# readings and leaves them out.)

# %% [markdown]
# ## 4 Doing it: trim what is not physics
#
# The equation V = kS·sgn(v) + kV·v + kA·a holds while **the motor alone** moves the mechanism.
#
# - At a stop, something else pushes. Not in the equation: **cut it.**
# - At rest, friction takes whatever voltage there is. Not in the equation: **drop it**, by a
#   *threshold* on the speed.
# - A single wild reading is a broken sensor. A **median filter** replaces it: of three neighbors it
#   takes the middle one.
# - A noisy stretch is only ugly. The equation holds in it. **Leave it.**
#
# > **Lesson says:** "You need to trim the data end point in the analyzer, or re-run the test with
# > more conservative travel limits."
# >
# > **Source says:** SysId's window has three knobs. *Velocity Threshold* works on quasistatic tests
# > only, *Window Size* is the median filter, *Test Duration* works on dynamic tests only. None of
# > them sets the end of a ramp. Samples at a stop vanish through the threshold, **if** the standing
# > encoder is quiet.
# > ([WPILib docs: Viewing Diagnostics](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/system-identification/viewing-diagnostics.html),
# > [SysId's source: FilteringUtils.cpp](https://github.com/wpilibsuite/allwpilib/tree/v2026.2.2/sysid/src/main/native/cpp/analysis/FilteringUtils.cpp))
# >
# > **Try it:** below is a log with a stop, a trembling standstill, and three wild readings. Which
# > of the knobs repairs what?

# %%
messy = contaminate(
    sound, "hard-stop", severity=2, test=RAMP, at=4.5, rng=np.random.default_rng(2)
).log
messy = contaminate(messy, "noisy-standstill", test=RAMP, rng=np.random.default_rng(2)).log
ramp = messy.runs_of_test(RAMP)[0]
wild = ramp.velocity.copy()
wild[[90, 150, 200]] += np.array([1.2, -1.0, 1.5])
messy = replace(messy, runs=(replace(ramp, velocity=wild), *messy.runs[1:]))

plot_time_series(messy, dynamic_seconds=0.6)


# %%
def kept(log: sim.Log, *, end: float, threshold: float) -> sim.Log:
    """The log without what comes after ``end`` in the ramps, and without their slow samples."""
    runs = []
    for run in log.runs:
        keep = np.ones(len(run), dtype=bool)
        if run.kind == "quasistatic":
            keep = (run.time - run.time[0] <= end) & (np.abs(run.velocity) >= threshold)
        runs.append(select_samples(run, keep))
    return replace(log, runs=tuple(runs))


def ratios(end: float, threshold: float, median: int) -> dict[str, float]:
    """The gains that come of a choice, each over its true value."""
    found = fit(kept(messy, end=end, threshold=threshold), method="sysid", median=median).gains
    return {gain: found[gain] / TRUTH[gain] for gain in ("kS", "kV", "kA")}


def trimmed(end: float, threshold: float, median: int) -> Picture:
    """The same as a picture."""
    return plot_choices(ratios(end, threshold, median), truth=1.0, name="found ÷ true")


WHOLE = {"description_width": "initial"}  # a slider's name is not cut off

show_interactive(
    trimmed,
    threshold=widgets.FloatSlider(
        min=0, max=1, step=0.05, description="threshold [m/s]", style=WHOLE, continuous_update=False
    ),
    end=widgets.FloatSlider(
        min=1,
        max=6,
        step=0.1,
        value=6,
        description="ramp ends [s]",
        style=WHOLE,
        continuous_update=False,
    ),
    median=widgets.SelectionSlider(options=[1, 3, 5, 9, 15], value=1, description="median of"),
)

# %% [markdown]
# No sliders on your screen? Change the numbers here:

# %%
trimmed(end=4.4, threshold=0.1, median=3)

# %%
tries = {
    "as recorded": (6.0, 0.0, 1),
    "end at 4.4 s, before the stop": (4.4, 0.0, 1),
    "threshold 0.1 m/s only": (6.0, 0.1, 1),
    "median of 3 only": (6.0, 0.0, 3),
    "all three": (4.4, 0.1, 3),
    "all three, but a median of 15": (4.4, 0.1, 15),
    "all three, but a threshold of 1 m/s": (4.4, 1.0, 3),
}
Table(HEADER[:4], tuple((name, *ratios(*choice).values()) for name, choice in tries.items()))

# %% [markdown]
# - Each knob repairs something else. None of them repairs all. (The threshold takes away both the
#   trembling and the stop, since at this stop the encoder is quiet. The wild readings stay.)
# - **More is not better.** A median of 15 samples is longer than the rise itself: it flattens what
#   you came to measure, and half of kA is gone. A threshold of 1 m/s drops the part of the ramp
#   where kS shows.
#
# ### Do not trim for beauty
#
# The fast end of a ramp is its most valuable part: kV is a slope, and a slope needs a long line.
# Here is the **sound** log. We keep less and less of its ramps. *One standard error* is how far an
# estimate typically is from the truth by mere noise.

# %%
rows = []
for end in (6.0, 4.0, 2.0, 1.0):
    part = kept(sound, end=end, threshold=0.05)
    top = float(part.runs_of_test(RAMP)[0].velocity.max())
    errors = fit(part, method="sysid").errors
    rows.append((f"{end:g} s of each ramp", top, errors["kV"], errors["kS"]))
Table(
    ("kept", "fastest sample [m/s]", "one standard error of kV [V·s/m]", "of kS [V]"),
    tuple(rows),
)

# %% [markdown]
# ## 5 R² is not a lie detector
#
# Now the plots are put away, and you see only a score: SysId's **simulated velocity R²**. Below are
# many logs of one drivetrain. One is sound. One was spoiled and then repaired. In all others
# something is wrong, from a single bad reading to an encoder that counts backward.
#
# > **Source says:** "A value north of .9 indicates a good fit."
# > ([WPILib docs: Viewing Diagnostics](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/system-identification/viewing-diagnostics.html))
#
# **Predict:**

# %%
wrong = [case for case in all_cases if case.harmful]
guess_count = Prediction(
    f"Of the {len(wrong)} logs that are wrong, how many get a simulated velocity R² above 0.9?",
    "none",
    "about 5",
    "about 10",
    "nearly all",
)
guess_robust = Prediction(
    "Which gain is off the most, as a rule?",
    "kS",
    "kV",
    "kA",
)
display(guess_count, guess_robust)

# %% [markdown]
# Sort the logs as you like. First decide which ones you would use. Then choose *reveal*.

# %%
SIM, ACC = "simulated velocity R²", "acceleration R²"
SCORES = {
    SIM: {case.name: case.fit.simulated_velocity_r2 for case in all_cases},
    ACC: {case.name: case.fit.acceleration_r2 for case in all_cases},
}
OFF = {
    gain: {case.name: case.gain_error(gain) for case in all_cases} for gain in ("kS", "kV", "kA")
}
KEYS = {
    "as made": lambda _: 0.0,
    SIM: lambda name: -SCORES[SIM][name],
    ACC: lambda name: -SCORES[ACC][name],
    "error of kA": lambda name: abs(OFF["kA"][name]),
}


def grid(sort: str, truth: str) -> Picture:
    """All logs with their badges, and how far off their gains are if that is to be told."""
    scores = {name: SCORES[SIM][name] for name in sorted(SCORES[SIM], key=KEYS[sort])}
    return plot_r2_vs_gain_error(
        scores, good=GOOD, score=SIM, off=OFF if truth == "reveal" else None
    )


show_interactive(
    grid,
    truth=widgets.Dropdown(options=["hide", "reveal"], description="truth"),
    sort=widgets.Dropdown(options=list(KEYS), description="sort by"),
)

# %% [markdown]
# No menus on your screen? Here, sorted by the error of kA:

# %%
grid(sort="error of kA", truth="reveal")

# %% [markdown]
# Here is what was done to each log, and the whole table with both R²:


# %%
def percent(share: float) -> str:
    """A share with its sign, on one line; no minus before a zero."""
    whole = round(100 * share)
    return f"{whole:+d}\N{NO-BREAK SPACE}%".replace("-", "−") if whole else "0\N{NO-BREAK SPACE}%"


display(
    Table(
        ("log", "what happened"),
        tuple((case.name, case.story) for case in all_cases),
        caption="60 kg, four Kraken X60; ramp 1 V/s for 7 s, step 3.5 V if not said otherwise",
    ),
    Table(
        ("log", "kS off", "kV off", "kA off", ACC, SIM),
        tuple(
            (
                case.name,
                *(percent(case.gain_error(gain)) for gain in OFF),
                case.fit.acceleration_r2,
                case.fit.simulated_velocity_r2,
            )
            for case in all_cases
        ),
        caption="What SysId's recipe makes of it",
    ),
)

# %%
passing = [case for case in wrong if case.has_good_r2]
damage = [
    case for case in wrong if abs(case.gain_error("kV")) < 0.2
]  # without mere changes of units
typical = {gain: float(np.median([abs(case.gain_error(gain)) for case in damage])) for gain in OFF}
best = max(wrong, key=lambda case: case.fit.acceleration_r2)
print(f"You said: {guess_count}; {guess_robust}.")
print(f"{len(passing)} of {len(wrong)} wrong logs have a {SIM} above {GOOD:g}.")
print("Half of them are off by more than this:", end=" ")
print(", ".join(f"{gain} {100 * size:.1f} %" for gain, size in typical.items()))
print(f"The highest {ACC} among the wrong ones: {best.fit.acceleration_r2:.2f}, {best.name}.")

# %% [markdown]
# ### Explain
#
# - **The simulated velocity R² asks:** is the simulated velocity near the measured one? Velocity is
#   mostly kV·v, and kV comes out right in nearly all of them. kA decides a fraction of a second.
#   So kA may be off by half, and the score hardly changes.
# - **kV is robust, kA is fragile, kS in between.** Many samples tell kV. A handful tells kA.
# - **The acceleration R² is the more sensitive of the two.** Sort by it: spikes, lurch and the
#   worst slips sink to the bottom. But it is *blind* to a wrong voltage, a wrong ratio and a wrong
#   sign. And a low one proves nothing: the docs say that it "rarely goes above 0.5, even on very
#   good datasets".
# - A repaired log can have a **lower** R² than a wrong one. SysId compares the simulation with what
#   was recorded, wild readings and all.
#
# These are single logs of our bench. How far off a log is depends on luck, too: where a gap falls,
# which sample comes first. The course's own tests make this table five times, and hold the middle
# values against those of another simulation. Nearly all rows say the same there. Three do not: the
# repaired spikes, the slow velocity filter, and friction that differs. How a filter is built, and
# how long the ramps are, matters. So take the *kind* of error from this table, not its digits.
#
# ## 6 What does catch them
#
# Five checks that ask something else than "does it fit?":
#
# 1. **Signs.** kV and kA positive, kS not negative.
# 2. **kV against motors and gears**, within 10 %. (Lesson 1. The bench has no drag; a real robot is
#    often a few percent above.)
# 3. **kA against motors and mass**, within 25 %.
# 4. **Acceleration R² not below 0.2**: below that, the docs call kA dubious.
# 5. **Somebody looked:** at the plots of section 3. Here a program looks, `inspect`.

# %%
CHECKS = {
    "signs": lambda case: min(case.fit.gains.values()) < 0,
    "kV": lambda case: abs(case.gain_error("kV")) > 0.10,
    "kA": lambda case: abs(case.gain_error("kA")) > 0.25,
    "acceleration R²": lambda case: case.fit.acceleration_r2 < 0.2,
    "looked": lambda case: bool(inspect(case.log).damages),
}
caught = {
    case.name: {name: check(case) for name, check in CHECKS.items()}
    for case in all_cases
    if case.name != "10 spikes, median of 5"
}
Table(
    ("log", *CHECKS),
    tuple(
        (name, *("caught" if c else "·" for c in found.values())) for name, found in caught.items()
    ),
)

# %%
escaped = [name for name, found in caught.items() if not any(found.values())]
by_signs = sum(found["signs"] for found in caught.values())
print(f"Caught by their signs alone: {by_signs}.  By nothing: {'; '.join(escaped)}.")

# %% [markdown]
# The sound log is in the list of those that nothing catches, as it should be. The others in that
# list are spoiled, and only a person who knows the robot will find out. A velocity filter, for
# example: look into your motor controller's settings.
#
# A sixth check costs one line: **fit forward and reverse apart.** Friction that differs does not
# show in R², and one kS fits neither direction:

# %%
leaning = by_name["friction differs"].log
for way in ("forward", "reverse"):
    run = leaning.runs_of_test(f"quasistatic-{way}")[0]
    moving = np.abs(run.velocity) > 0.1
    _, volts = np.polyfit(np.abs(run.velocity[moving]), np.abs(run.voltage[moving]), 1)
    print(f"{way}: the ramp's line leaves standstill at {volts:.2f} V")

# %% [markdown]
# And one trap before any data: SysId's menu *Analysis Type* starts on **Elevator**. Fit a
# drivetrain as an elevator, and it looks for gravity where there is none (lesson 2).
#
# ### Let the program look, after you did
#
# `inspect` says which fault it sees, where, how sure it is, and what to do:

# %%
print(f"It knows {len(FAULTS)} faults.")
seen = inspect(gallery["encoder slip"])
for damage in seen.damages:
    print(f"{damage.fault} in {damage.where.test}, confidence {damage.confidence:.2f}")
    for text in (damage.evidence, damage.advice):
        print(fill(text, width=90, initial_indent="  ", subsequent_indent="  "))
plot_time_series(gallery["encoder slip"], dynamic_seconds=0.6, damages=seen.damages)

# %% [markdown]
# In a terminal: `sysid inspect drive.wpilog`. It is a second pair of eyes. It has never seen *your*
# robot, so look yourself first.

# %% [markdown]
# ## 7 System check
#
# Before you fit, all five:
#
# - [ ] **Signs:** plus volts, plus velocity, in all four tests.
# - [ ] **Over time:** nothing that a motor cannot do to a mass. The rise bends from the start.
# - [ ] **Time steps:** none longer than 1.5 times the usual, or you know how many.
# - [ ] **Position:** its slope is the velocity, and on time.
# - [ ] **The voltage** is the one that arrived at the motor.
#
# ## 8 Knowledge check
#
# First one to click; you are told at once. (No buttons on your screen? Type
# `quick.answer("voltage over velocity")`, or another of the answers, in a cell.)

# %%
from grader import QuickCheck

quick = QuickCheck(
    "Samples come late, some of them by 100 ms. Which plot shows it at a glance?",
    {
        "voltage over velocity": "Time is in neither axis.",
        "time steps over time": "Every late sample is a point above the line.",
        "the R² badge": "It may stay green: that is the point of this lesson.",
    },
    right="time steps over time",
)
quick

# %% [markdown]
# **1.** Which plot reveals which fault? Match: (a) time steps, (b) velocity beside the slope of the
# position, (c) velocity over time, close up, (d) voltage over time; with (1) a current limit in an
# honest log, (2) timing gaps, (3) encoder slip, (4) a velocity filter.
#
# <details><summary>Answer</summary>
#
# a2, b4, c3, d1. A current limit shows in the voltage only if the log holds what arrived. If it
# holds what was asked for, the rise gives it away: it starts as a straight line.
# </details>
#
# **2.** In the quasistatic forward test the velocity jumps halfway through; the mechanism lurched.
# The rest is clean. What was it, and what does it do to the gains?
#
# <details><summary>Answer</summary>
#
# Something mechanical stuck and let go: slack in a chain, a skipped tooth, a tight bearing. (An
# encoder that slipped only if position, a second sensor or the current show that the mechanism did
# *not* move.) The few samples of the jump
# count a lot, because a fit squares its misses: three times as far off counts nine times. So kS
# comes out too small or negative, kA too large, kV hardly changes, and R² stays above 0.9. See
# "lurch" in the table. Fix the mechanism and run again. A median filter or a trim only salvages.
# </details>
#
# **3.** "All our R² are above 0.97, so the gains are fine." What do you ask?
#
# <details><summary>Answer</summary>
#
# Which R²? Are kV and kA near what motors, gears and mass predict? Was the applied voltage logged?
# Did anybody look at the plots? In our table nearly all wrong logs would pass.
# </details>
#
# **4.** The end of the ramp is noisy. A teammate wants to cut it, "so that the line looks clean".
#
# <details><summary>Answer</summary>
#
# No. The equation holds in noisy samples, and the fast ones tell kV best. Cut where something
# *else than the motor* moves or holds the mechanism: at a stop, at rest.
# </details>
#
# **5.** The battery was weak in a test. Do you have to run it again?
#
# <details><summary>Answer</summary>
#
# If the motors were cut (a brownout): yes, with a charged battery. You see it by the velocity that
# falls along a curve, or by an applied voltage that drops to 0 and comes back. Either way, the bus
# voltage shows it. If the voltage only sagged, and
# the log holds the voltage that arrived: no, the row is true. If it holds the voltage that was
# asked for: yes, and change the log.
# </details>

# %% [markdown]
# ## 9 Practice
#
# **Exercise 7, Detective.** Twelve logs, most of them spoiled. Name the fault, where it is, and
# what to do. Read `exercises/exercise7/README.md`, then
#
# ```
# grade exercise7
# ```
#
# **Exercise 8, Trim and clean.** One log with a stop, a trembling standstill and wild readings. You
# choose what to keep. Read `exercises/exercise8/README.md`, then
#
# ```
# grade exercise8
# ```
#
# From a notebook, if you like that better (the values are made up, yours differ):
#
# ```python
# from grader import submit
#
# submit("exercise7", log01="clean", log02="hard-stop, dynamic-forward, 1.2 to 1.7, trim")
# submit("exercise8", quasistatic_forward="0 to 4.4", threshold=0.1, median=3)
# ```
#
# It writes into the exercise's `answers.toml` and shows the result. Hints cost nothing:
# `grade exercise7 --hint`.
#
# **On your own robot:** open an old log in AdvantageScope, drag velocity and voltage into a line
# graph, and go through the list of section 7. Fit it, and note both R². If the simulated velocity
# R² is below 0.9, write down which of the nine you suspect, and what you would check first. Then
# run `sysid inspect` on it.
#
# Next: lesson 7, fit it yourself.
