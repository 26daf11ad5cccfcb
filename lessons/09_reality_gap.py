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
# # Lesson 9: The reality gap
#
# *About 50 minutes. You need lessons 1 and 7. This is the last lesson: here you find out what your
# model does not know.*
#
# **At the end you can**
#
# - measure how far a simulation with your gains is from your robot: the **gap**;
# - look at what is missing from four sides, and say which effect leaves such a trace;
# - add an effect to the model, and decide with *other* data whether it earns its place;
# - explain how a slow sensor makes a robot look heavy;
# - say when your data cannot tell, and which test would;
# - let `sysid reconcile` do it, and judge what it says.

# %% [markdown]
# ## 1 Why: a good fit of the wrong model
#
# You have gains. You put them into a simulation, give it the very voltages that the robot had, and
# the simulation drives differently. Then something is missing in the model
#
# > V = kS·sgn(v) + kV·v + kA·a
#
# It knows dry friction, back-EMF and inertia, and nothing else. A real robot also has a battery
# that gives way, grease that sticks, a sensor that comes late. Each such thing is called an
# **effect**.
#
# > **Lesson says:** the gains are "grounded in the mechanism's true physics".
# >
# > **Source says:** WPILib's docs say of such a model that it "is not perfect", but usually good
# > enough.
# > ([WPILib docs: Introduction to System Identification](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/system-identification/introduction.html))
# >
# > **Try it:** today's robot has two hidden effects. See what the gains are worth.
#
# You work in five steps, and so does the program at the end:
# **fit, simulate, look at what is left, name it, add it**. Then again, until nothing is left.

# %%
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from textwrap import fill

import ipywidgets as widgets
import numpy as np
from IPython.display import display
from scipy.optimize import least_squares

import sim
from sim.bench.duty_cycle import Battery, simulate_duty_cycle
from sim.bench.mechanisms import MECHANISMS
from sim.bench.simulate import simulate
from sim.fit import fit
from sim.physics.effects import EFFECTS, find_effect
from sim.physics.model import Model, Part
from sim.physics.replay import replay_log
from sim.physics.voltage_residual import compute_voltage_residual
from sim.plot import (
    Picture,
    Table,
    make_residual_views,
    plot_curves,
    plot_gap_bars,
    plot_time_series,
    plot_voltage_residual,
    show_interactive,
)
from sim.plot.story import make_findings_table, plot_gap_by_round, plot_residual_maps
from sim.reconcile import reconcile
from sim.teaching.prediction import Prediction

drivetrain = MECHANISMS["drivetrain"]
truth = drivetrain.gains
# What is hidden is written backward, so that nobody reads it by accident.
robot = drivetrain.hide("retlif-yticolev"[::-1], 1.5).hide("kcebirts"[::-1], 1.0)

FOUR = ("quasistatic", "dynamic")
rng = np.random.default_rng(2)
log = simulate(robot, sim.Routine(1.0, 3.0, timeout=3.0, kinds=FOUR), rng=rng, electrical=True)
validation = simulate(robot, sim.Routine(1.0, 2.0, timeout=3.0, kinds=FOUR), rng=rng)
held_out = simulate(
    robot, sim.Routine(step=3.5, timeout=4.0, kinds=("triangle", "multistep")), rng=rng
)
print(fill(f"{len(EFFECTS)} effects are in the bench's catalogue: {', '.join(EFFECTS)}.", 90))

# %% [markdown]
# Two of them are in today's robot. Its team does not know which: they have four Kraken X60, 60 kg,
# and a drivetrain that does not follow its paths.
#
# They recorded **three logs**, and each has one job:
#
# | log | what it is | its job |
# |---|---|---|
# | `log` | the four SysId tests, 3 V step | everything is **fitted** to it |
# | `validation` | the four tests, 2 V step | decides which effects are **kept** |
# | `held_out` | other motions | is looked at **once**, at the end |
#
# Why three? Who chooses a model by the data it was fitted to always finds a winner: more knobs fit
# better. Only data that had no say can tell whether you learned about the robot or about the log.
# Section 4 shows it.

# %% [markdown]
# ## 2 Measure the gap
#
# **Simulate:** give the model the log's voltages and let it run, from the first sample of a test to
# its last. It gets no look at the robot on the way. `replay_log` does that.
#
# **Fit:** change kS, kV and kA until the simulated velocity misses the measured one least. Lesson 7
# fitted accelerations row by row; this fit follows the whole run.


# %%
def simulated(model: Model, one: sim.Log) -> list[np.ndarray]:
    """The velocity that a model's sensor would show, for each run of a log."""
    return [track.seen for track in replay_log(model, one)]


def off(model: Model, one: sim.Log) -> np.ndarray:
    """Measured minus simulated velocity, all samples of all runs."""
    pairs = zip(one.runs, simulated(model, one), strict=True)
    return np.concatenate([run.velocity - seen for run, seen in pairs])


def fitted(names: Sequence[str], begin: Model, one: sim.Log) -> Model:
    """Gains and the parameters of some effects, searched from where another model stands."""
    known = {part.effect: part.parameters for part in begin.parts}
    seen = compute_voltage_residual(
        one, begin.gains, type="simple"
    )  # what the log shows: for a good start
    starts = [known.get(name) or next(iter(find_effect(name).start_values(seen))) for name in names]
    first = np.array([*begin.gains.values(), *(v for start in starts for v in start.values())])
    bounds = [(p.least, p.most) for name in names for p in find_effect(name).parameters]
    least, most = np.array([(0.0, np.inf), (1e-6, np.inf), (1e-6, np.inf), *bounds]).T
    size = np.maximum(np.abs(first), 1e-6)

    def model(values: np.ndarray) -> Model:
        left = iter(np.clip(values * size, least, most).tolist())
        gains = {gain: next(left) for gain in begin.gains}
        parts = (Part(name, {p: next(left) for p in find_effect(name).names}) for name in names)
        return Model("simple", gains, tuple(parts))

    found = least_squares(
        lambda values: off(model(values), one),
        np.clip(first, least, most) / size,
        bounds=(least / size, most / size + 1e-9),
        diff_step=1e-3,
        max_nfev=40,
    )
    return model(found.x)


base = fitted((), Model("simple", truth), log)

# %% [markdown]
# (`fitted` is the longest function of this course. Half of it keeps the parameters in order. The
# work is done by one line, `least_squares`: turn all knobs a little, see which way the sum of
# squared misses falls, go there, repeat.)
#
# Before you look. The bench knows the true kA of the team's robot; the team does not. **Predict:**

# %%
guess_ka = Prediction(
    "Two effects are missing in the model. What does the fit make of kA?",
    "about right",
    "too small by a third or more",
    "too large by a third or more",
)
guess_ka

# %%
by_sysid = fit(log, method="sysid").gains
Table(
    ("gains", "kS [V]", "kV [V·s/m]", "kA [V·s²/m]", "kA ÷ true"),
    (
        ("fitted to whole runs", *base.gains.values(), base.gains["kA"] / truth["kA"]),
        ("SysId's recipe", *by_sysid.values(), by_sysid["kA"] / truth["kA"]),
        ("the truth", *truth.values(), 1.0),
    ),
)

# %%
model_log = replace(
    log,
    runs=tuple(
        replace(run, velocity=seen)
        for run, seen in zip(log.runs, simulated(base, log), strict=True)
    ),
)
print(f"You said: {guess_ka}.")
plot_time_series(log, beside=model_log, names=("log", "simulation"), dynamic_seconds=1.0)

# %% [markdown]
# The colored curves are the log, the dotted black ones the simulation. Look at the start of the
# steps: the curves have different *shapes*. No kA makes them agree.
#
# (SysId's kA looks fine here. That is luck. The two fits bend in different places: SysId's recipe
# starts each step at its peak of acceleration, and here it pays with kS instead. Look at it.)
#
# ### How large is that?
#
# In meters per second a gap says little. We count it in **noises**: how far the sensor shakes by
# itself. To find that, take the change from sample to sample, then the change of these changes, and
# once more. Of a smooth motion hardly anything is left after three rounds; what is left is shaking.
# Then a gap of 1 means: nothing is missing but noise.


# %%
def noise(one: sim.Log) -> float:
    """The shaking of a velocity, without any model: from third differences, extremes left out."""
    jerks = [np.diff(run.velocity, 3)[np.abs(run.velocity[3:]) > 0.1] for run in one.runs]
    return 1.4826 * float(np.median(np.abs(np.concatenate(jerks)))) / np.sqrt(20)


shaking = noise(log)


def gap(model: Model, one: sim.Log) -> float:
    """How far a simulation is from a log: the typical miss, in noises."""
    return float(np.sqrt(np.mean(off(model, one) ** 2))) / shaking


print(f"The velocity shakes by {shaking:.4f} m/s.")
print(f"Gap with gains alone: log {gap(base, log):.1f}, validation {gap(base, validation):.1f}.")

# %% [markdown]
# (1.4826 turns a median into a standard deviation, the usual measure of scatter. A third difference
# enlarges the square of noise by 1² + 3² + 3² + 1² = 20.)

# %% [markdown]
# ## 3 The residual microscope
#
# What is left when you subtract the simulation from the log is called the **residual**. How large
# it is tells you *that* something is missing. What it depends on tells you *what*.
#
# We turn the residual into something with a meaning: how many **volts** would you have to add to
# the simulation, at this moment, to make it move as the robot did? These are the **missing volts**.
# Below zero: the robot got less than the model believes. And we look from four sides:
#
# | seen over | an effect that shows there |
# |---|---|
# | speed | friction that changes with speed |
# | time since the voltage jumped | something late: a delay, a filter |
# | battery voltage | volts that never arrived |
# | direction | something that pulls one way only |
#
# (There is a fifth side, the position: a spring, a bump in the gears. The maps of section 7 have
# it.)
#
# First practice, on four robots with **one** effect each. Here the gains are the true ones (a
# luxury), so that all you see is the effect.


# %%
def as_asked(one: sim.Log) -> sim.Log:
    """The same log, but with the voltage that was asked for, not the one that arrived."""
    runs = (replace(run, voltage=12.0 * run.voltage / run.bus_voltage) for run in one.runs)
    return replace(one, runs=tuple(runs))


true_model = Model("simple", truth)
all_tests = sim.Routine(0.5, 3.5, timeout=3.0, kinds=(*FOUR, "multistep"))
tired = Battery(rest=12.2, resistance=0.035)
rng = np.random.default_rng(3)


def with_one(backward: str, size: float) -> sim.Log:
    """A log of a drivetrain that hides one effect; its name is written backward."""
    return simulate(drivetrain.hide(backward[::-1], size), all_tests, rng=rng, electrical=True)


sagging = simulate_duty_cycle(drivetrain, replace(all_tests, step=5.0), battery=tired, rng=rng)
suspects = {
    "robot A": with_one("noitcirf-cirtemmysa", 1.0),
    "robot B": with_one("retlif-yticolev", 1.5),
    "robot C": as_asked(sagging),
    "robot D": with_one("kcebirts", 3.0),
}

# %% [markdown]
# The four hidden things are, in no order:
#
# - **friction that differs forward and reverse**;
# - **a velocity that is averaged** over the last tenth of a second or so;
# - **a tired battery**, and a log of asked-for volts;
# - **breakaway friction**, more at a crawl than at speed (its name is *Stribeck*).
#
# Look at each robot below, then say which is which. (No buttons? `guess_a.value = "battery"`.)

# %%
NAMES = ("one-way friction", "averaged velocity", "battery", "breakaway friction")
guess_a = Prediction("Robot A hides…", *NAMES)
guess_b = Prediction("Robot B hides…", *NAMES)
guess_c = Prediction("Robot C hides…", *NAMES)
guess_d = Prediction("Robot D hides…", *NAMES)
display(guess_a, guess_b, guess_c, guess_d)


# %%
def under_the_microscope(which: str) -> Picture:
    """The missing volts of one of the four robots, from four sides."""
    one = suspects[which]
    return plot_voltage_residual(one, simulated(true_model, one), truth)


show_interactive(
    under_the_microscope, which=widgets.Dropdown(options=list(suspects), description="look at")
)

# %% [markdown]
# No menu on your screen? Change the name here:

# %%
under_the_microscope("robot B")

# %% [markdown]
# A percentage stands above each view: how much of the (squared) missing volts is explained if you
# know only *that*. All sixteen:

# %%
rows = []
for name, one in suspects.items():
    seen = make_residual_views(one, simulated(true_model, one), truth)
    rows.append((name, *(f"{100 * view.explains:.0f} %" for view in seen.values())))
sides = tuple(seen)

print(f"You said: A {guess_a}; B {guess_b}; C {guess_c}; D {guess_d}.")
print("They are: A one-way friction; B averaged velocity; C battery; D breakaway friction.")
Table(("robot", *sides), tuple(rows), caption="Share of the missing volts that a side explains")

# %% [markdown]
# ### Explain
#
# - **A, direction.** Forward lacks volts, reverse has too many, at every speed alike. (A slope
#   under the robot looks the same. To tell them apart, turn the robot around.)
# - **B, time since the jump.** The mean of the last velocities is *late*. Right after a jump the
#   robot seems to get volts too few by far, and a moment later nothing is missing.
# - **C, battery.** The lower the battery, the more is missing. The other view lights up, too: a
#   battery is lowest just after a jump. Two sides can see the same thing; take the brighter one,
#   and think of a test that moves one and not the other.
# - **D, speed.** Volts are missing at a crawl, and nowhere else. (The straight row of points is the
#   ramp's beginning: the simulation already moves, and the robot still stands.)
#
# None of them explains 100 %. The rest is noise: taking changes from sample to sample enlarges it.

# %% [markdown]
# ## 4 Doing it: name, add, fit again
#
# Now the team's robot. Its gains were **fitted**, so they have bent to hide what is missing. That
# is the hard part of real life: the fingerprint is smudged.

# %%
plot_voltage_residual(log, simulated(base, log), base.gains)

# %% [markdown]
# The brightest side is the time since the jump. And look at the shape: first volts are missing,
# then there are too many. Whoever is *late* first loses and then catches up; who is *weak* only
# loses. At a crawl something is missing, too, but faintly.
#
# **Predict** the first effect to add:

# %%
guess_first = Prediction(
    "Which one closes most of the gap?",
    "drag",
    "stribeck",
    "velocity-filter",
    "asymmetric-friction",
    "current-limit",
)
guess_first

# %% [markdown]
# Try seven, each alone, each with all gains fitted again. Look at two numbers: the gap of the `log`
# that it was fitted to, and the gap of the `validation`, which it has never seen.

# %%
TRIED = (
    "velocity-filter",
    "delay",
    "current-limit",
    "battery-sag",
    "stribeck",
    "drag",
    "asymmetric-friction",
)
models = {"gains alone": base}
models |= {f"+ {name}": fitted((name,), base, log) for name in TRIED}


def both_gaps(model: Model) -> dict[str, float]:
    """The gaps of the two logs that may be looked at."""
    return {"log": gap(model, log), "validation": gap(model, validation)}


print(f"You said: {guess_first}.")
plot_gap_bars({name: both_gaps(model) for name, model in models.items()})

# %% [markdown]
# **Read the bars.**
#
# - The gap of the *log* became narrower, or stayed, with every single effect. It must: another knob
#   never fits worse. If you judge by it, everything is an improvement.
# - The gap of the *validation* shows who understood something. Compare `current-limit` there with
#   the base model: on the log it looks like a find.
# - `delay` comes close to the best. It is late, too: the two look alike (section 6).
#
# Look through the microscope with any of them in place:


# %%
def with_it(model: str) -> list[Picture]:
    """What is missing once a model is in place, and its gaps beside those of gains alone."""
    chosen = models[model]
    shown = {"gains alone": both_gaps(base), model: both_gaps(chosen)}
    return [plot_voltage_residual(log, simulated(chosen, log), chosen.gains), plot_gap_bars(shown)]


show_interactive(with_it, model=widgets.Dropdown(options=list(models), description="model"))

# %% [markdown]
# No menu? Change the name:

# %%
display(*with_it("+ velocity-filter"))

# %% [markdown]
# With the filter in place, what happened right after the jumps is gone. And now something shows
# that it had covered: missing volts at a crawl. So add a second one:

# %%
first = models["+ velocity-filter"]
pairs = {"+ velocity-filter": first}
for name in ("stribeck", "drag", "delay", "current-limit", "asymmetric-friction"):
    pairs[f"  … and {name}"] = fitted(("velocity-filter", name), first, log)
plot_gap_bars({name: both_gaps(model) for name, model in pairs.items()})

# %%
second = pairs["  … and stribeck"]
models["+ velocity-filter, stribeck"] = second
plot_voltage_residual(log, simulated(second, log), second.gains)

# %% [markdown]
# Nothing bright is left from any side, and the gap is about 1 on both logs. **Stop here.** A third
# effect could only fit the noise.
#
# ### What the sensor did to the inertia

# %%
last = {part.effect: part.parameters for part in second.parts}
steps = {"gains alone": base, "+ velocity-filter": first, "+ stribeck": second}


def position_off(model: Model) -> float:
    """How far the simulated position is from the measured one, typically [cm]."""
    off_by = [
        (run.position - run.position[0]) - (track.position - track.position[0])
        for run, track in zip(log.runs, replay_log(model, log), strict=True)
    ]
    return 100 * float(np.sqrt(np.mean(np.concatenate(off_by) ** 2)))


rows = [
    (name, *m.gains.values(), m.gains["kA"] / truth["kA"], position_off(m))
    for name, m in steps.items()
]
print(f"The filter averages over {1000 * last['velocity-filter']['window']:.0f} ms.")
Table(
    ("model", "kS [V]", "kV [V·s/m]", "kA [V·s²/m]", "kA ÷ true", "position off by [cm]"),
    (*rows, ("the truth", *truth.values(), 1.0, "")),
)

# %% [markdown]
# Read the column *kA ÷ true* from the top. With gains alone the robot seems to have far more
# inertia than it has. Nothing is heavy: the **sensor is slow**, and a slow answer looks like a
# heavy robot. kA is the only knob the model has for "slow". So it took the blame.
#
# There is a second witness: the **position**. It was never used in these fits, and it does not pass
# through the filter. The model with the heavy robot misses it by far more than the others do.
#
# Remember this when a kA is too large. Before you look for mass, look for filters: a motor
# controller that averages its velocity, a log that is written late.
#
# And kS: it came down when breakaway friction got a name of its own.

# %% [markdown]
# ## 5 The held-out log, once
#
# Until now nobody looked at `held_out`. Its motions are others: a triangle, and jumps of many
# sizes. **Predict:**

# %%
guess_held = Prediction(
    "Gap of the held-out log with gains alone, compared with the fitted log's gap?",
    "about the same",
    "twice as wide or more",
    "narrower",
)
guess_held

# %%
print(f"You said: {guess_held}.")
every = {
    "gains alone": base,
    "+ current-limit": models["+ current-limit"],
    "+ velocity-filter": first,
    "+ stribeck": second,
}
plot_gap_bars(
    {name: {"log": gap(m, log), "held out": gap(m, held_out)} for name, m in every.items()}
)

# %% [markdown]
# The bars shrink term by term, on motions that nothing was fitted to. That is what "we understood
# the robot" looks like. And the model with a current limit, which had looked so good on the log, is
# worse than no effect at all. It learned the log, not the robot.
#
# (Why is the last bar a little above 1? The parameters have small errors, and a log full of jumps
# shows each of them many times.)

# %% [markdown]
# ## 6 What your data cannot tell
#
# Another team, another drivetrain, and this one *does* have a current limit: above a certain push,
# its motors give no more. (The model counts the limit in volts: those that are left to drive the
# current once the back-EMF is paid for.) They record a gentle log, with a 2.5 V step. Later they
# drive a 6 V step.
#
# We give the model limits from very low to very high, and draw the gap of both logs.
#
# **Predict:**

# %%
guess_limit = Prediction(
    "Fitted to the gentle log only, how well is the limit known?",
    "to a few percent",
    "only that it is above some value",
    "not at all, nor is any bound known",
)
guess_limit

# %%
unlimited = replace(drivetrain, stator=np.inf, supply=np.inf, brownout=0.0)
limited = replace(unlimited, hidden=(Part("current-limit", {"limit": 3.0}),))
rng = np.random.default_rng(1)
gentle = simulate(limited, sim.Routine(1.0, 2.5, timeout=3.0), rng=rng)
hard = simulate(limited, sim.Routine(1.0, 6.0, timeout=2.0, kinds=("dynamic",)), rng=rng)

LIMITS = np.array([1.0, 1.5, 2.0, 2.25, 2.5, 2.75, 3.0, 3.25, 3.5, 4.0, 5.0, 6.0, 8.0])


def gaps_of(one: sim.Log) -> list[float]:
    """The gap of a log for each limit, the gains being the true ones."""
    return [gap(true_model + Part("current-limit", {"limit": x}), one) for x in LIMITS.tolist()]


print(f"You said: {guess_limit}.")
plot_curves(
    LIMITS,
    {"2.5 V step (fitted)": gaps_of(gentle), "6 V step (other data)": gaps_of(hard)},
    xlabel="limit in the model [V that drive the current]",
    ylabel="gap [noises]",
    levels={"the noise": 1.0},
)

# %% [markdown]
# Follow the gentle log's curve to the right: from somewhere on it is **flat**. A limit that was
# never reached leaves no trace, so every limit above is equally good. The data do not contain the
# answer, and no program can take it out. People say: the parameter is *not identifiable* from these
# data.
#
# The hard log's curve has a sharp minimum at the true value. Not a better method: **another test.**
# (On your robot you know the limit, because you set it. Choose the limit first, then measure:
# lesson 3. With another limit, the hard step is another test.)
#
# The same holds for many pairs of look-alikes. The bench's catalogue says for each which test tells
# it apart:

# %%
some = ("battery-sag", "stribeck", "velocity-filter", "asymmetric-friction")
Table(
    ("effect", "looks like", "what tells them apart"),
    tuple((name, other, test) for name in some for other, test in EFFECTS[name].apart.items()),
)

# %% [markdown]
# ## 7 Let the bench do it
#
# `sim.reconcile` does what you did, with all effects of the catalogue: fit, simulate, try every
# suspect, keep the one that the *validation* confirms, again, until nothing passes. It looks at the
# position as well as at the velocity. (It takes a few seconds.)

# %%
story = reconcile(log, validation=validation, held_out=held_out, type="simple")
print(f"Verdict: {story.verdict}.")
make_findings_table(story)

# %%
plot_gap_by_round(story)

# %% [markdown]
# Where simulation and log disagree, before (left) and after (right). It is a microscope, too: blue
# where the robot is slower than the model says, orange where it is faster.

# %%
plot_residual_maps(story)

# %% [markdown]
# ### Compare with yours

# %%
true_parts = {part.effect: part.parameters for part in robot.hidden}
their_parts = {part.effect: part.parameters for part in story.model.parts}
UNITS = {"kS": "V", "kV": "V·s/m", "kA": "V·s²/m", "window": "s", "extra": "V", "slow": "m/s"}
rows = [
    (f"{gain} [{UNITS[gain]}]", second.gains[gain], story.model.gains[gain], value)
    for gain, value in truth.items()
]
rows += [
    (
        f"{name}: {key} [{UNITS[key]}]",
        last[name][key],
        their_parts.get(name, {}).get(key, "not named"),
        value,
    )
    for name, parameters in true_parts.items()
    for key, value in parameters.items()
]
Table(("number", "by hand", "reconcile", "the truth"), tuple(rows))

# %% [markdown]
# Two roads, nearly the same numbers. One difference: its base model starts with a *wider* gap than
# yours. It has to follow the position as well, which is not averaged and not late. A large kA would
# make the velocity fit and the position not, so it is torn between the two. That is how it notices
# a slow sensor.
#
# **How to read its verdict**
#
# | verdict | what it means | what you do |
# |---|---|---|
# | nothing-missing | gains alone explain the log | be glad |
# | explained | named, and confirmed by other runs | look at the part of the robot it names |
# | ambiguous | two effects explain it equally well | run the test that it proposes |
# | unexplained | a gap is left that nothing in the catalogue fits | look at the robot |
#
# It can be wrong. *Minor* findings are small, and on a clean log one of them is now and then a name
# for nothing. Ask of each what you asked in section 4: does the gap of other data shrink? And then:
# can I find it on the robot, with a wrench in my hand?

# %% [markdown]
# ## 8 Your own robot
#
# Run the four tests **twice, with two step voltages**; that tells most look-alikes apart. Drive
# some other motion for a third log. Log the **applied** voltage (lesson 4). Then, in a terminal:
#
# ```
# sysid inspect monday.wpilog
# sysid reconcile monday.wpilog --validation faster.wpilog --held-out other.wpilog --html gap.html
# ```
#
# The first line looks for damage in the record (lesson 6): an encoder that slipped is not physics.
# `gap.html` holds every picture of section 7 and needs no network. Logs of another type need
# `--type arm` or `--type elevator`.
#
# Or here, in the notebook. Put the files' names in; if there is a log of exercise 12, it is taken.
# (Where the battery was not recorded, its view is missing.)

# %%
mine = sorted(Path("..", "exercises", "exercise12", "data").glob("*/log.wpilog"))
if mine:
    own = sim.read(mine[0])
    print(f"Read {mine[0]}: {len(own.runs)} runs, in {own.units}.")
else:
    own = log
    print("No log of your own yet. Make it in a terminal, in the course's folder:  grade start")
    print("Until then, here is the team's log again.")
start = fit(own, type="simple", method="sysid").gains
own_base = fitted((), Model("simple", start), own)
plot_voltage_residual(own, simulated(own_base, own), own_base.gains)

# %% [markdown]
# ## 9 System check
#
# Before you believe an effect, all five:
#
# - [ ] The record is whole: `sysid inspect` found no damage, or it is cut out.
# - [ ] The effect narrows the gap of data that it was **not** fitted to.
# - [ ] No parameter stands at its bound, and none has an error as large as itself.
# - [ ] You know its look-alikes, and you ran the test that tells them apart.
# - [ ] You looked at the part of the robot that it blames.
#
# ## 10 Knowledge check
#
# First one to click; you are told at once. (No buttons on your screen? Type
# `quick.answer("drag")`, or another of the answers, in a cell.)

# %%
from grader import QuickCheck

quick = QuickCheck(
    (
        "What is missing shows only in the first tenths of a second after the voltage "
        "jumps. Which family is that?"
    ),
    {
        "drag": "Drag grows with speed, and is there at a steady speed, too.",
        "a late or filtered sensor": "It shows where the velocity changes fast, and nowhere else.",
        "a weak battery": "That follows the battery's voltage, not the time since the jump.",
    },
    right="a late or filtered sensor",
)
quick

# %% [markdown]
# **1.** The missing volts are near zero everywhere, except in the first tenth of a second after
# each jump. Which family of effects?
#
# <details><summary>Answer</summary>
#
# Something late: a delay, or a velocity that is averaged. Look at the position: a delay makes it
# late, too; a filter of the velocity does not.
# </details>
#
# **2.** kA is 60 % above what motors and mass predict, kV is right. A teammate wants to weigh the
# robot. What do you look at first?
#
# <details><summary>Answer</summary>
#
# The velocity's filter in the motor controller, and how the log is written. A slow sensor looks
# like inertia. (Other causes that you know: asked-for volts in the log, a slipping wheel, noise.)
# </details>
#
# **3.** You add "cogging" and the gap of your log falls from 1.3 to 1.1. The gap of the validation
# rises from 1.4 to 1.6. Keep it?
#
# <details><summary>Answer</summary>
#
# No. It fitted the noise of one log. The log's gap nearly always falls; it is no argument.
# </details>
#
# **4.** reconcile says "battery-sag or drag". Your log has one step voltage. What now?
#
# <details><summary>Answer</summary>
#
# Record the four tests with a second step voltage, or log the applied voltage. Sag grows with the
# step, drag with the speed. No thinking about the old log can decide it.
# </details>
#
# **5.** The gap is 1.05 noises. Are your gains the true ones?
#
# <details><summary>Answer</summary>
#
# They explain *these* motions. What was never excited is not in there: a current limit that no
# test reached, heat, a battery at the end of a match. Before you drive harder than you tested, test
# harder.
# </details>

# %% [markdown]
# ## 11 Practice
#
# **Exercise 12: reality gap** (`exercises/exercise12/README.md`). A mechanism that only you have,
# with one to three hidden effects, and three logs. Look at the gap with gains alone, then try
# names:
#
# ```
# python exercises/exercise12/try_it.py
# python exercises/exercise12/try_it.py delay
# grade exercise12
# ```
#
# Or answer from a notebook:
#
# ```python
# from grader import submit
#
# submit("exercise12", effects=["delay"], delay={"lag": 0.03}, gap_before=6.5, gap_after=1.2)
# ```
#
# **Practice: characterize one mechanism** (`exercises/practice/README.md`, `grade practice`).
# Everything from the first line of code to the last look at the numbers. Best on your own robot,
# with your own `.wpilog`; without a robot, with the log of exercise 9, for exactly the same points.
# Then reconcile it.
#
# **More, if you like.** Give section 2 a robot that hides `drag` and `stribeck`. Both change with
# speed. Can you tell them apart with a 1 V step?
#
# That was the last lesson. You can measure gains, say how far to trust them, and find out what your
# robot does that your model does not.
