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
# *About 45 minutes. You need lessons 1 and 7. In this lesson you find out what is missing in your
# model.*
#
# **At the end you can**
#
# - measure the **gap**: how much a simulation with your gains differs from your robot;
# - plot the remaining error in four ways, and say which effect could cause it;
# - add an effect to the model, and decide with *other* data whether to keep it;
# - explain how a slow sensor makes a robot look heavy;
# - say when your data cannot decide, and which test can;
# - use `sysid reconcile`, which does all of this, and judge its answer.

# %% [markdown]
# ## 1 Why: a good fit of the wrong model
#
# You have gains. You put them into a simulation and give it exactly the voltages that the robot
# had. If the simulation moves differently, something is missing in the model
#
# > V = kS·sgn(v) + kV·v + kA·a
#
# This model contains dry friction, *back-EMF* (the voltage that a turning motor produces) and
# inertia. On a real robot, the battery voltage drops, grease sticks, or a sensor is late. Each of
# these is called an **effect**. WPILib's docs say that this model "is not perfect", but usually
# good enough.
#
# <details><summary>For mentors: do the gains describe the real robot?</summary>
#
# > **Lesson says:** the gains are "grounded in the mechanism's true physics".
# >
# > **Source says:** WPILib's docs say that such a model "is not perfect", but usually good enough.
# > ([WPILib docs: Introduction to System
# > Identification](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/system-identification/introduction.html))
# >
# > **Try it:** today's robot has two hidden effects. Compare its fitted gains with the true gains.
# </details>
#
# You work in five steps: **fit, simulate, look at the remaining error, name the effect, add it to
# the model**. You repeat this until only noise remains. At the end, a program does the same.

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
    plot_curves,
    plot_gap_bars,
    plot_voltage_residual,
    show_interactive,
)
from sim.plot.animation import Choice, Gain, Knob, Motion, Panel, Scene, Score, animate_mechanism
from sim.plot.story import make_findings_table, plot_residual_maps
from sim.reconcile import reconcile
from sim.teaching.prediction import Prediction

drivetrain = MECHANISMS["drivetrain"]
truth = drivetrain.gains
# The names of the hidden effects are written backward, so that nobody reads them by accident.
robot = drivetrain.hide("retlif-yticolev"[::-1], 1.5).hide("kcebirts"[::-1], 1.0)

FOUR = ("quasistatic", "dynamic")
rng = np.random.default_rng(2)
log = simulate(robot, sim.Routine(1.0, 3.0, timeout=3.0, kinds=FOUR), rng=rng, electrical=True)
validation = simulate(robot, sim.Routine(1.0, 2.0, timeout=3.0, kinds=FOUR), rng=rng)
held_out = simulate(
    robot, sim.Routine(step=3.5, timeout=4.0, kinds=("triangle", "multistep")), rng=rng
)
print(fill(f"This course knows {len(EFFECTS)} effects: {', '.join(EFFECTS)}.", 90))

# %% [markdown]
# Today's robot has two of these effects. Its team does not know which. The robot is a drivetrain
# with four Kraken X60 and a mass of 60 kg, and it does not follow its paths.
#
# The team recorded **three logs**, and each has one job:
#
# | log | what it is | its job |
# |---|---|---|
# | `log` | the four SysId tests, 3 V step | we **fit** everything to it |
# | `validation` | the four tests, 2 V step | it decides which effects we **keep** |
# | `held_out` | other motions | we look at it **once**, at the end |
#
# Why three logs? On the data that you fitted, a model with more parameters always looks better. (A
# *parameter* is a number in the model, such as kS.) Only new data can show whether the model
# describes the robot, or only this one log.

# %% [markdown]
# ## 2 Measure the gap
#
# **Simulate:** give the model the voltages of the log, and simulate each test from its first sample
# to its last. The simulation never uses the measured velocity. `replay_log` does that.
#
# **Fit:** change kS, kV and kA until the simulated velocity is as close as possible to the measured
# one. In lesson 7 you fitted accelerations row by row. This fit compares whole tests.


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
#
# <details><summary>Want to know more? How the function works</summary>
#
# The function `fitted` is long, but the call of `least_squares` does the work. It changes all
# parameters a little, sees which changes make the sum of squared errors smaller, and repeats.
# </details>
#
# **Predict:**

# %%
guess_ka = Prediction(
    "Two effects are missing in the model. How good is the kA that the fit finds?",
    "it is about right",
    "it is too small by a third or more",
    "it is too large by a third or more",
)
guess_ka

# %%
FIRST = {"ramp": ("quasistatic-forward", 3.0), "step": ("dynamic-forward", 1.0)}  # and how long [s]


def beside_its_model(test: str, seconds: float) -> Scene:
    """The first seconds of a test, and a model that gets the same voltage."""
    run = log.list_runs_of_test(test)[0]
    time = run.time - run.time[0]
    shown = time <= seconds
    gains = {name: Gain(name) for name in truth}
    model = Motion("model", gains=gains, voltage=run.voltage[shown], ghost=True)
    real = Motion("robot", velocity=run.velocity[shown])
    return Scene(time[shown], (real, model), target=run.velocity[shown])


print(guess_ka.reveal("it is too large by a third or more"))
print(f"The fit finds kA = {base.gains['kA']:.3f} V·s²/m. The true kA is {truth['kA']:.3f} V·s²/m.")
knobs = [
    Knob(name, f"{name} [{unit}]", low=0.0, high=high, step=0.005, value=round(base.gains[name], 3))
    for name, unit, high in (("kS", "V", 0.6), ("kV", "V·s/m", 4.0), ("kA", "V·s²/m", 0.8))
]
animate_mechanism(
    "drivetrain",
    {(name,): beside_its_model(*which) for name, which in FIRST.items()},
    choices=(Choice("test", tuple(FIRST), value="step"),),
    panels=(Panel("velocity", "velocity [m/s]", low=0.0, high=1.4),),
    knobs=knobs,
    score=Score("model"),
    alt="The solid robot is the log. The dashed robot is the model with the same voltage. After "
    "the step the model is ahead at first, and behind later. Its velocity curve has a different "
    "shape.",
)

# %% [markdown]
# The solid robot shows the log, the dashed robot the model. Their two curves have different
# *shapes*. Move the sliders: no values of kS, kV and kA make the curves equal.
#
# ### How large is the gap?
#
# The **gap** is the typical error of the simulated velocity. A gap in meters per second is hard to
# judge. So we divide it by the **noise** of the sensor. A gap of 1 means that only noise remains,
# and the model explains all of this log.
#
# <details><summary>Want to know more? How we measure the noise</summary>
#
# Compute the changes from sample to sample. Then compute the changes of these changes, and then
# once more. If the motion is smooth, these three differences remove nearly all of it. So what
# remains is noise.
# </details>


# %%
def noise(one: sim.Log) -> float:
    """The noise of a velocity, without any model: from third differences, without extremes."""
    jerks = [np.diff(run.velocity, 3)[np.abs(run.velocity[3:]) > 0.1] for run in one.runs]
    return 1.4826 * float(np.median(np.abs(np.concatenate(jerks)))) / np.sqrt(20)


shaking = noise(log)


def gap(model: Model, one: sim.Log) -> float:
    """How far a simulation is from a log: the typical error, divided by the noise."""
    return float(np.sqrt(np.mean(off(model, one) ** 2))) / shaking


print(f"The noise of the velocity is {shaking:.4f} m/s.")
print(f"Gap with gains alone: log {gap(base, log):.1f}, validation {gap(base, validation):.1f}.")

# %% [markdown]
#
# <details><summary>Want to know why? The numbers in this cell</summary>
#
# (The standard deviation is the usual measure of noise. It is 1.4826 times the median of the
# absolute values of the errors. A third difference multiplies the square of the noise by 1² + 3² +
# 3² + 1² = 20.)
# </details>

# %% [markdown]
# ## 3 The residual microscope
#
# Subtract the simulation from the log. The difference is called the **residual**. If the residual
# is large, something is missing in the model. The places where the residual is large show *what* is
# missing.
#
# We convert the residual into a **voltage residual**: the volts that you would have to add to the
# simulation so that it moves like the robot. If it is below zero, the robot moves as if it got too
# few volts: volts are *missing*. If it is above zero, the robot moves as if it got too many volts.
# We plot the voltage residual in four ways:
#
# | plotted against | an effect that you see there |
# |---|---|
# | speed | friction that changes with speed |
# | time since the voltage jumped | something late: a delay, a filter |
# | battery voltage | volts that did not reach the motor |
# | direction | something that pulls in one direction only |
#
# (If you plot it against the position, you see a spring, or a bump in the gears: section 7.)
#
# First practice on four robots with **one** effect each. Here we use the true gains, so the
# residual shows nothing but this effect.


# %%
def as_asked(one: sim.Log) -> sim.Log:
    """The same log, but with the commanded voltage, not the applied one."""
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
# The four hidden effects are, in no particular order:
#
# - **friction that differs forward and reverse** (*one-way friction*);
# - **a velocity that is averaged** over the last tenth of a second;
# - **a weak battery**, and a log of the commanded voltage;
# - **breakaway friction**: the friction is larger at very low speed (also called *Stribeck*
#   friction).
#
# Look at each robot below. Then say which robot has which effect.

# %%
NAMES = ("one-way friction", "averaged velocity", "battery", "breakaway friction")
guess_a = Prediction("Robot A hides…", *NAMES)
guess_b = Prediction("Robot B hides…", *NAMES)
guess_c = Prediction("Robot C hides…", *NAMES)
guess_d = Prediction("Robot D hides…", *NAMES)
display(guess_a, guess_b, guess_c, guess_d)


# %%
def under_the_microscope(which: str) -> Picture:
    """The voltage residual of one of the four robots, in four plots."""
    one = suspects[which]
    return plot_voltage_residual(one, simulated(true_model, one), truth)


show_interactive(
    under_the_microscope, which=widgets.Dropdown(options=list(suspects), description="robot")
)

# %% [markdown]
# No menu? Change the name here:

# %%
under_the_microscope("robot B")

# %% [markdown]
# The line shows the mean of nearby samples. The percentage above each plot says how much of the
# (squared) voltage residual follows this line. Compare the four percentages of each robot.

# %%
print("A.", guess_a.reveal("one-way friction"))
print("B.", guess_b.reveal("averaged velocity"))
print("C.", guess_c.reveal("battery"))
print("D.", guess_d.reveal("breakaway friction"))

# %% [markdown]
# ### Explain
#
# - **A, direction.** Volts are missing when the robot goes forward. In reverse, there are too many
#   volts. (A floor with a slope looks the same in the plot. To find out which it is, turn the robot
#   around.)
# - **B, time since the jump.** An averaged velocity is *late*. Right after a jump of the voltage,
#   many volts seem to be missing. A moment later, none are missing.
# - **C, battery.** The lower the battery voltage, the more volts are missing. The plot against time
#   shows this, too, because the battery voltage is lowest just after a jump. If two plots show an
#   effect, take the plot with the higher percentage.
# - **D, speed.** The robot moves as if it got too few volts only at very low speed.
#
# No plot explains 100 %. The rest is noise.
#
# <details><summary>Want to know why? Points that form a straight line</summary>
#
# Some points of robot D form a straight line. They come from the start of the ramp. There the
# simulation already moves, but the robot still stands.
# </details>

# %% [markdown]
# ## 4 Doing it: name, add, fit again
#
# Now look at the team's robot. Its gains were **fitted**. So the gains already describe a part of
# the effects, and the pattern is less clear.

# %%
plot_voltage_residual(log, simulated(base, log), base.gains)

# %% [markdown]
# The plot against the time since the jump explains the largest share of the residual. Look at its
# shape: first the robot seems to get too few volts, then too many. A late sensor causes such a
# shape. A weak battery does not. At very low speed, about 0.1 V is missing, too.
#
# **Predict** the first effect to add:

# %%
guess_first = Prediction(
    "Which effect makes the gap smallest?",
    "drag",
    "stribeck",
    "velocity-filter",
    "asymmetric-friction",
    "current-limit",
)
guess_first

# %% [markdown]
# The next cell tries seven effects. It adds one effect at a time, and fits all gains again. Compare
# two numbers: the gap on `log`, which was fitted, and the gap on `validation`, which the fit never
# used.

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


print(guess_first.reveal("velocity-filter"))
plot_gap_bars({name: both_gaps(model) for name, model in models.items()})

# %% [markdown]
# **What the bars show:**
#
# - An additional effect never makes the gap on the *log* larger, because one more parameter never
#   makes the fit worse. If you judge by this gap, every effect looks like an improvement.
# - The gap on the *validation* log shows which models are really better. `current-limit` makes the
#   gap on the fitted log smaller, but the gap on the validation log larger. So do not keep it.
# - `delay` is almost as good as `velocity-filter`, because it also makes the velocity late (section
#   6).
#
# Choose a model, and look at its voltage residual:


# %%
def with_it(model: str) -> list[Picture]:
    """The voltage residual of a model, and its gaps next to those of gains alone."""
    chosen = models[model]
    shown = {"gains alone": both_gaps(base), model: both_gaps(chosen)}
    return [plot_voltage_residual(log, simulated(chosen, log), chosen.gains), plot_gap_bars(shown)]


show_interactive(
    with_it,
    model=widgets.Dropdown(options=list(models), value="+ velocity-filter", description="model"),
)

# %% [markdown]
# No menu? Change the name:

# %%
display(*with_it("+ velocity-filter"))

# %% [markdown]
# With the filter in the model, the error right after the jumps is gone. Now the plot against speed
# shows something else: volts are missing at very low speed. So add a second effect:

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
# Now no plot shows a pattern, and the gap is about 1 for both logs. **Stop here.** A third effect
# would only describe the noise.
#
# ### A slow sensor makes the robot look heavy

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
    ("model", "kS [V]", "kV [V·s/m]", "kA [V·s²/m]", "kA ÷ true", "position error [cm]"),
    (*rows, ("the truth", *truth.values(), 1.0, "")),
)

# %% [markdown]
# Look at the column *kA ÷ true*. In the model "gains alone", kA is far too large: the robot seems
# heavier than it is. But it is the **sensor that is slow**. In the model, only kA can make the
# robot react slowly, so the fit made kA too large.
#
# The **position** confirms this. The fits did not use the position, and the filter does not change
# it. With gains alone, the position error is much larger than with the filter.
#
# So if a kA is too large, look for filters first: a motor controller that averages its velocity, or
# a log that is late. (With breakaway friction in the model, kS is right, too.)

# %% [markdown]
# ## 5 The held-out log, once
#
# Until now you have not looked at `held_out`. In one test of this log the voltage rises and falls
# in a straight line. In the other test it makes jumps of many sizes. **Predict:**

# %%
guess_held = Prediction(
    "With gains alone, compare the gap on the held-out log with the gap on the fitted log.",
    "it is about the same",
    "it is twice as large or more",
    "it is smaller",
)
guess_held

# %%
print(guess_held.reveal("it is twice as large or more"))
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
# You never fitted these motions. Even so, the gap becomes smaller when the filter is in the model,
# and smaller again when breakaway friction is in it, too. So these two effects are in the robot.
# The current limit looked good on the log, but here it is worse than no effect at all: that model
# describes the log, not the robot.

# %% [markdown]
# ## 6 When your data cannot decide
#
# The drivetrain of another team *does* have a current limit: its motors cannot push with more than
# a certain force. (In the model, this limit is in volts: the voltage minus the back-EMF.) The team
# records a gentle log with a 2.5 V step. Later it records a 6 V step.
#
# The next cell tries limits from very low to very high, and plots the gap on both logs.
#
# **Predict:**

# %%
guess_limit = Prediction(
    "How well do you know the limit from the gentle log alone?",
    "to a few percent",
    "you only know that it is above some value",
    "you know nothing about it",
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


print(guess_limit.reveal("you only know that it is above some value"))
plot_curves(
    LIMITS,
    {"2.5 V step (fitted)": gaps_of(gentle), "6 V step (other data)": gaps_of(hard)},
    xlabel="limit in the model [V above the back-EMF]",
    ylabel="gap [times the noise]",
    levels={"the noise": 1.0},
    log_scale=True,
)

# %% [markdown]
# Follow the curve of the gentle log to the right: above about 2 V it is **flat**. The gentle test
# never reached the limit, so every higher limit is equally good. The data do not contain the
# answer, so no program can find it. We say that the parameter is *not identifiable* from these
# data. (A book about tests that do contain the answer: Ljung, *System Identification*, 2nd edition
# (1999), chapter 13.)
#
# The curve of the 6 V step has a clear minimum at the true limit, 3 V. You do not need a better
# method. You need **another test.** (On your robot you know the limit, because you set it. Choose
# the limit first, then measure: lesson 3.)
#
# Many pairs of effects look alike. For each pair there is a test that separates them, and the
# program in section 7 names this test.

# %% [markdown]
# ## 7 Let the program do it
#
# `sim.reconcile` does what you did, with all effects that it knows: fit, simulate, try every
# effect, keep the effect that the *validation* confirms, and repeat until no further effect helps.
# It uses the position as well as the velocity. In the next table, the last column shows the gap
# without and with each effect.

# %%
story = reconcile(log, validation=validation, held_out=held_out, type="simple")
make_findings_table(story)

# %% [markdown]
# The next maps show where simulation and log differ, with gains alone (left) and with both effects
# (right). Where a map is blue, the robot is slower than the model. Where it is orange, the robot is
# faster.

# %%
plot_residual_maps(story)

# %% [markdown]
# ### Compare its numbers with your numbers

# %%
theirs = {part.effect: part.parameters for part in story.model.parts}
window = [1000 * found["velocity-filter"]["window"] for found in (last, theirs)]
print(f"kA: {second.gains['kA']:.3f} by hand, {story.model.gains['kA']:.3f} by reconcile,", end=" ")
print(f"{truth['kA']:.3f} is true [V·s²/m]")
print(f"Window of the filter: {window[0]:.0f} ms by hand, {window[1]:.0f} ms by reconcile")

# %% [markdown]
# Both ways give nearly the same numbers.
#
# <details><summary>Want to know why? The first gap of reconcile</summary>
#
# Without effects, reconcile has a *larger* gap than your fit. Reconcile also fits the position,
# which the filter does not change, so kA cannot hide the slow sensor.
# </details>
#
# **What its verdict means**
#
# | verdict | what it means | what you do |
# |---|---|---|
# | nothing-missing | no big effect is missing | nothing |
# | explained | the named effects explain the log and other runs | look at that part of the robot |
# | ambiguous | two effects explain it equally well | run the test that it proposes |
# | unexplained | a gap remains that no known effect explains | look at the robot |
#
# Reconcile can be wrong. So it says how likely each effect is: if it says "90 % likely" for ten
# effects, about nine of them are real. (We counted this on hundreds of simulated logs with known
# effects.) So ask two questions. Does the gap on other data become smaller (section 4)? And can you
# find the cause on the robot?

# %% [markdown]
# ## 8 Your own robot
#
# Run the four tests **twice, with two step voltages**. This separates most effects that look alike.
# Record a third log with another ramp. Log the **applied** voltage (lesson 4). Then type in a
# terminal:
#
# ```
# sysid inspect monday.wpilog
# sysid reconcile monday.wpilog --validation faster.wpilog --held-out other.wpilog --html gap.html
# ```
#
# The first command looks for damage in the log (lesson 6). `gap.html` contains every picture of
# section 7 and works offline. For an arm or an elevator, add `--type arm` or `--type elevator`.
#
# The next cell plots the voltage residual of your log of exercise 12. To use another log, write its
# name into the list: `mine = ["my_log.wpilog"]`. (If the log has no battery voltage, the plot
# against the battery voltage is missing.)

# %%
mine = sorted(Path("..", "exercises", "exercise12", "data").glob("*/log.wpilog"))
if mine:
    own = sim.read(mine[0])
    print(f"Read {mine[0]}: {len(own.runs)} runs, in {own.units}.")
    start = fit(own, type="simple", method="sysid").gains
    own_base = fitted((), Model("simple", start), own)
    display(plot_voltage_residual(own, simulated(own_base, own), own_base.gains))
else:
    print("No log of your own yet. Make it in a terminal, in the course's folder:  grade start")

# %% [markdown]
# ## 9 System check
#
# Before you believe an effect, check all five:
#
# - [ ] The log is good: `sysid inspect` found no damage, or you cut off the damaged part.
# - [ ] The effect makes the gap smaller for data that it was **not** fitted to.
# - [ ] No parameter is at the end of its range, and each standard error is smaller than its
#   parameter.
# - [ ] You know which effects look alike, and you ran the test that separates them.
# - [ ] You looked at that part of the robot.
#
# ## 10 Knowledge check
#
# Click an answer to the first question.

# %%
from grader import QuickCheck

quick = QuickCheck(
    (
        "Volts are missing only in the first tenths of a second after the voltage jumps. "
        "What is the cause?"
    ),
    {
        "drag": "Drag grows with speed, and it also acts while the speed is constant.",
        "a late or filtered sensor": "You see it only where the velocity changes fast.",
        "a weak battery": "That depends on the battery voltage, not on the time since the jump.",
    },
    right="a late or filtered sensor",
)
quick

# %% [markdown]
# **1.** The voltage residual is near zero everywhere, except in the first tenth of a second after
# each jump. Which effects look like this?
#
# <details><summary>Answer</summary>
#
# The velocity is late, because of a delay or because it is averaged. Look at the position. A delay
# makes the position late, too. A velocity filter does not.
# </details>
#
# **2.** The fitted kA is 60 % larger than the kA that you compute from motors and mass. kV is
# right. A teammate wants to weigh the robot. What do you check first?
#
# <details><summary>Answer</summary>
#
# First check the velocity filter in the motor controller, and how the log is written. A slow sensor
# looks like inertia. (Other causes that you know: the commanded voltage in the log, a slipping
# wheel, noise.)
# </details>
#
# **3.** You add "cogging" (magnets pull the rotor), and the gap on your log falls from 1.3 to 1.1.
# The gap on the validation log rises from 1.4 to 1.6. Do you keep this effect?
#
# <details><summary>Answer</summary>
#
# No. It fitted the noise of one log. The gap on the fitted log nearly always falls, so that proves
# nothing.
# </details>
#
# **4.** Reconcile says "battery-sag or drag". Your log has only one step voltage. What do you do?
#
# <details><summary>Answer</summary>
#
# Record the four tests with a second step voltage, or log the applied voltage. The battery sag
# grows with the step voltage, and drag grows with the speed. The old log cannot show which of them
# it is.
# </details>
#
# **5.** The gap is 1.05 times the noise. Are your gains the true ones?
#
# <details><summary>Answer</summary>
#
# Your gains explain *these* motions. They do not contain what did not happen in your tests: a
# current limit, heat, a battery at the end of a match. Before you drive with more voltage than in
# your tests, test with more voltage, too.
# </details>

# %% [markdown]
# ## 11 Practice
#
# **Exercise 12: reality gap**
# ([exercises/exercise12/README.md](../exercises/exercise12/README.md)). You get your own mechanism
# with one to three hidden effects, and three logs. Look at the gap with gains alone, then try the
# names of effects:
#
# ```
# python exercises/exercise12/try_it.py
# python exercises/exercise12/try_it.py delay
# grade exercise12
# ```
#
# <details><summary>Or answer from a notebook</summary>
#
# ```python
# from grader import submit
#
# submit("exercise12", effects=["delay"], delay={"lag": 0.03}, gap_before=6.5, gap_after=1.2)
# ```
# </details>
#
# If you use an editor, `grade watch exercise12` grades each time you save. Each time you run `grade
# mystery`, it makes a new log with a hidden problem.
#
# **Practice: characterize one mechanism**
# ([exercises/practice/README.md](../exercises/practice/README.md), `grade practice`). Do everything
# once, from the first line of code to the final gains. Use your own robot, or the drivetrain in
# that folder. You get the same points for both.
#
# <details><summary>More, if you like</summary>
#
# Change the robot in section 1 so that it hides `drag` and `stribeck`. Both change with speed. Can
# you separate them with a 1 V step?
# </details>
#
# Now you can measure gains, say how far to trust them, and find out what is missing in your model.
# `grade` in a terminal shows which exercises are left. **Next:** [Lesson 10,
# swerve](10_swerve.ipynb), if your robot has a swerve drive.
