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
# ![Speed over time: a log, and two simulations of it. With the gains alone, the simulation becomes
# too fast. With gains and drag, it follows the log.](attachment:picture.png)
#
# **At the end you can**
#
# - measure the **gap**: how much a simulation with your gains differs from your robot;
# - plot the remaining error in five ways, and say which effect could cause it;
# - add an effect to the model, and decide with *other* data whether to keep it;
# - explain what a missing effect does to kA;
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
from dataclasses import replace
from pathlib import Path
from textwrap import fill

import numpy as np
from IPython.display import display

import sim
from grader import ask_question, enable_checkboxes
from sim.bench.mechanisms import MECHANISMS
from sim.fit import fit
from sim.physics.effects import EFFECTS
from sim.physics.model import Model, Part
from sim.physics.replay import replay_log
from sim.plot import Table, make_residual_views
from sim.plot.animation import Choice, Knob, Motion, Panel, Scene, animate_mechanism
from sim.plot.animation.charts import Chart, Curve, animate_charts
from sim.plot.animation.of_logs import animate_model
from sim.plot.decimate import decimate_cloud
from sim.plot.effect_search import EffectSearch
from sim.plot.story import make_findings_table, plot_remaining_gap
from sim.reconcile import reconcile
from sim.reconcile.by_hand import HandSearch
from sim.support.extras import format_install_command
from sim.teaching.logs import read_own_log
from sim.teaching.reality_gap import (
    forget_position,
    make_team_robot,
    record_limited_robot,
    record_suspects,
    record_team_logs,
)

truth = MECHANISMS["drivetrain"].gains
log, validation, held_out = record_team_logs()
known = f"This course knows {len(EFFECTS)} effects: {', '.join(EFFECTS)}."
print(fill(known, 80, break_on_hyphens=False))

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
# Why three logs? A model with more parameters can fit more of the noise of one log. (A *parameter*
# is a number in the model, such as kS.) Only new data can show whether the model describes the
# robot, or only this one log. (After each choice, the gains and parameters that we print are fitted
# to `log` and `validation` together.)

# %% [markdown]
# ## 2 Measure the gap
#
# **Simulate:** give the model the voltages of the log, and simulate each test from its first sample
# to its last. The simulation never uses the measured velocity.
#
# **Fit:** change kS, kV and kA until the simulation is as close as possible to the log. In lesson 7
# you fitted accelerations row by row. This fit compares whole tests. It is the one that `sysid
# reconcile` uses.

# %%
search = EffectSearch(log, validation=validation, held_out=held_out, truth=make_team_robot().hidden)
base = search.model  # kS, kV and kA, and no effect

# %% [markdown]
# The fit looks at the velocity *and* at the position. A teammate fits only the velocity.
#
# **Predict:**

# %%
ask_question("lesson9.ka")

# %%
velocity_alone = EffectSearch(forget_position(log), validation=forget_position(validation)).model
for name, gains in (("velocity alone", velocity_alone.gains), ("our fit", base.gains)):
    print(f"{name}: kA = {gains['kA']:.3f} V·s²/m. The true kA is {truth['kA']:.3f} V·s²/m.")
animate_model(
    log,
    base.gains,
    tests={"step": ("dynamic-forward", 1.0), "ramp": ("quasistatic-forward", 3.0)},
    alt="The solid robot is the log. The dashed robot is the model with the same voltage. For "
    "0.3 s after the step the model is faster, then both are equally fast: the two velocity curves "
    "have different shapes.",
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
for name, gap in search.gaps.items():
    print(f"Gap of the {name}, with gains alone: {gap:.1f} times the noise.")

# %% [markdown]
# ## 3 The residual microscope
#
# Subtract the simulation from the log. The difference is called the **residual**. If the residual
# is large, something is missing in the model. The places where the residual is large show *what* is
# missing.
#
# We convert the residual into volts, the **voltage residual**. If you add these volts to the
# simulation, it moves like the robot. If they are below zero, the robot moves as if it got too few
# volts: volts are *missing*. If they are above zero, the robot moves as if it got too many volts.
# We plot the voltage residual in five ways:
#
# | plotted against | an effect that you see there |
# |---|---|
# | speed | friction that changes with speed |
# | time since the voltage jumped | something late: a delay, a filter |
# | battery voltage | volts that did not reach the motor |
# | position | something that is at a place: a spring, a bump in the gears |
# | direction | something that acts differently forward and backward |
#
# First practice on four robots with **one** effect each. Here we use the true gains, so the
# residual shows nothing but this effect.

# %%
true_model = Model("simple", truth)
suspects = record_suspects()

# %% [markdown]
# The four hidden effects are, in no particular order:
#
# - **a velocity that is averaged** over the last tenth of a second;
# - **a weak battery**, and a log of the commanded voltage;
# - **breakaway friction**: the friction is larger at very low speed (also called *Stribeck*
#   friction);
# - **friction that differs forward and reverse** (*one-way friction*).
#
# Choose each robot in turn.

# %%
UNITS = ("speed [m/s]", "time [s]", "position [m]", "voltage [V]", "−1 reverse, 1 forward")


def under_the_microscope(which: str) -> list[Chart]:
    """The voltage residual of one of the four robots, in five plots."""
    views = make_residual_views(suspects[which], true_model).views
    high = 1.5 * float(np.quantile(np.abs(views["speed"].volts), 0.98))
    charts = []
    for label, (name, view) in zip(UNITS, views.items(), strict=True):
        kept = decimate_cloud(np.nan_to_num(view.at), view.volts, most=60)
        middle = 0.5 * (view.edges[:-1] + view.edges[1:])
        curves = (
            Curve("samples", view.at[kept], view.volts[kept], "dots", 4),
            Curve("mean of nearby samples", middle, view.mean, "line", 1),
        )
        title = f"{name}: {100 * view.explains:.0f} %"
        charts.append(Chart(label, "residual [V]", curves, title=title, y=(-high, high)))
    return charts


animate_charts(
    under_the_microscope,
    choices=(Choice("robot", tuple(suspects)),),
)

# %% [markdown]
# The line shows the mean of nearby samples. The percentage above each plot says how much of the
# squared residual this line explains; noise does not count. Compare the percentages of each robot.
# They can be more than 100 % together, because one effect can show in two plots.
#
# Which robot has which effect?

# %%
display(*(ask_question(f"lesson9.{robot}") for robot in "abcd"))

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
# <details><summary>Want to know why? Points that form a straight line</summary>
#
# Some points of robot D form a straight line. They come from the start of the ramp. There the
# simulation already moves, but the robot still stands.
# </details>

# %% [markdown]
# ## 4 Doing it: name, add, fit again
#
# Now it is your turn. The team's robot hides two effects. Its gains were **fitted**. So the gains
# already describe a part of the effects, and the pattern is less clear.
#
# 1. **Look** at the plot with the largest percentage. Which effects could cause it?
# 2. **Choose** one of them in the menu. Read what it does, and press *Add and fit*. All gains and
#    the parameters of the effect are fitted again. This takes one to three seconds.
# 3. **Compare** the gaps of the *validation* log: press *Take back*, and try the other effects in
#    the same line of the list below. Keep the one with the smallest gap. If none helps, take the
#    plot with the next percentage. If the title says that most of the gap shows in *no* plot, try
#    every line.
# 4. **Look again.** Repeat this until the gap of the validation log is about 1, or until no other
#    effect makes it smaller.
# 5. **Check.** If you have several effects, choose each in the menu, and press *Take back*. Does
#    the gap stay the same without it? Then leave it out: another effect does its work. If not, add
#    it again.
# 6. **Stop.** But before you press the last button, read section 5.
#
# Effects that can cause the largest percentage:
#
# - **speed:** drag, stribeck, velocity-scale, voltage-limit, deadband, heating;
# - **time since the voltage jumped:** velocity-filter, delay, compliance, backlash, current-limit,
#   wheel-slip, inertia-change;
# - **position:** cogging, spring, gravity-cosine;
# - **battery voltage:** battery-sag;
# - **direction:** asymmetric-friction, asymmetric-back-emf, constant-load.

# %%
search

# %% [markdown]
# In plain code: `search.add("NAME")`, `search.take_back()`, `search.open()`, and to look:
# `display(*search.pictures)`.
#
# **What the bars show:**
#
# - An effect that the robot does not have can make the gap on the *log* smaller: it fits some of
#   the noise. (It can also make it larger: a fit looks at position, too, and the gap does not.)
# - The gap on the *validation* log is measured with a model that was fitted to the log alone. It
#   shows which models are really better.
#
# If the gap is about 1 for both logs, **stop**. A further effect would only describe the noise.

# %% [markdown]
# ## 5 The held-out log, once
#
# Until now you have not looked at `held_out`. In one test of this log the voltage rises and falls
# in a straight line. In the other test it makes jumps of many sizes. **Predict:**

# %%
ask_question("lesson9.held")

# %% [markdown]
# Now press *Stop, open the held-out log* in section 4. It shows the gap before and after, and the
# truth beside your numbers. Then run the next cells.

# %%
for name in ("log", "held_out"):
    print(f"{name}: {search.hand.measure_gap(search.hand.fit(), name):.1f} times the noise")

# %% [markdown]
# You never fitted these motions. If an effect makes the gap smaller here, too, it is in the robot.
# A model that is better on the log, but not here, describes the log and not the robot.
#
# ### What the missing effects did to kA

# %%
steps = {"velocity alone": velocity_alone, **search.steps}
Table(
    ("model", "kS [V]", "kV [V·s/m]", "kA [V·s²/m]", "kA ÷ true"),
    (
        *((name, *m.gains.values(), m.gains["kA"] / truth["kA"]) for name, m in steps.items()),
        ("the truth", *truth.values(), 1.0),
    ),
)

# %% [markdown]
# Look at the column *kA ÷ true*. With the velocity alone, kA is far too large: the robot seems
# heavier than it is. Each effect that you added has its own row.
#
# <details><summary>Open this after the held-out log: why?</summary>
#
# It is the **sensor that is slow**: it averages the velocity. In a model of gains alone, only kA
# can make the robot react slowly, so the fit made kA too large. The **position** confirms this: the
# filter does not change it. So a fit that uses the position, too, has a better kA.
#
# If a kA is too large, look for filters first: a motor controller that averages its velocity, or a
# log that is late. (With the breakaway friction in the model, kS is right, too.)
# </details>

# %% [markdown]
# ## 6 A gentle log and a strong one
#
# The drivetrain of another team *does* have a current limit: its motors cannot push with more than
# a certain force. A motor's current depends on the voltage minus the back-EMF. So the model limits
# this difference. The team records a gentle log with a 2.5 V step. Later it records a 6 V step.
#
# In the next picture you choose the limit in the model. Above each plot is the gap of that log.
#
# **Predict:**

# %%
ask_question("lesson9.limit")

# %%
steps = record_limited_robot()
hands = {name: HandSearch(one) for name, one in steps.items()}


def limit_charts(limit: float) -> list[Chart]:
    """A step of each log beside a model with this limit, the gains being the true ones."""
    model = true_model + Part("current-limit", {"limit": limit})
    charts = []
    for name, hand in hands.items():
        gap = hand.measure_gap(hand.evaluate_model(model), "log")
        run = steps[name].list_runs_of_test("dynamic-forward")[0].select(slice(50))
        (track,) = replay_log(model, replace(steps[name], runs=(run,)))
        curves = (
            Curve("measured", run.time - run.time[0], run.velocity, "dots", 4),
            Curve("model", run.time - run.time[0], track.seen, "line", 1),
        )
        charts.append(Chart("time [s]", "speed [m/s]", curves, title=f"{name}: gap {gap:.1f}"))
    return charts


animate_charts(
    limit_charts,
    knobs=(Knob("limit", "limit in the model [V]", low=1.0, high=6.0, step=0.25, value=1.0),),
)

# %% [markdown]
# Raise the limit. Above about 2 V, the gap of the gentle test **stays the same**. The gentle test
# never reached the limit, so every higher limit is equally good. The data do not contain the
# answer, so no program can find it. We say that the parameter is *not identifiable* from these
# data. (A book about tests that do contain the answer: Ljung, *System Identification*, 2nd edition
# (1999), chapter 13.)
#
# The gap of the 6 V step is clearly smallest at the true limit, 3 V. You do not need a better
# method. You need **another test.** (On your robot you know the limit, because you set it. Choose
# the limit first, then measure: lesson 3.)
#
# Many pairs of effects look alike. For each pair there is a test that separates them, and the
# program in section 7 names this test.

# %% [markdown]
# ## 7 Let the program do it
#
# `sim.reconcile` does what you did, with the same fit and the same gap, and with all effects that
# it knows: fit, simulate, try every effect, keep the effect that the *validation* confirms, and
# repeat until no further effect helps. The last column of the next table compares two gaps of the
# held-out log: without this effect, and with all effects.

# %%
story = reconcile(log, validation=validation, held_out=held_out, type="simple")
make_findings_table(story)

# %% [markdown]
# The next pictures are those of section 3, for the held-out log: with gains alone, and with all
# effects that reconcile found.

# %%
display(*plot_remaining_gap(story))

# %% [markdown]
# ### Compare its numbers with your numbers

# %%
search.compare_with(story.model.parts, "reconcile")

# %% [markdown]
# If you chose the same effects, both ways give nearly the same numbers.
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
# The next cell is the search of section 4, with your logs of exercise 12. What it prints when you
# open the held-out log is your answer to this exercise. For other logs, write
# `EffectSearch(sim.read("monday.wpilog"), validation=sim.read("faster.wpilog"))`.

# %%
mine = list(Path("..", "exercises", "exercise12", "data").glob("*/log.wpilog"))
if mine:
    newest = max(mine, key=lambda path: path.stat().st_mtime).parent
    print(f"The logs in {newest}:")
    display(EffectSearch.read(newest))
else:
    print("No log of your own yet. Make it in a terminal, in the course's folder:  grade start")

# %% [markdown]
# ### Your gains in WPILib's simulation
#
# WPILib has simulations of its own: with `FlywheelSim` your robot code spins its wheel on your
# computer. ([WPILib docs: Physics Simulation, at one
# commit](https://github.com/wpilibsuite/frc-docs/blob/01297402d0a2406bb70e95e13d2620759a69e385/source/docs/software/wpilib-tools/robot-simulation/physics-sim.rst))
# It needs only kV and kA. If they are measured, does it move like *your* wheel? The next cells fit
# your log of exercise 9, and give `FlywheelSim` the same volts. **Predict:**

# %%
ask_question("lesson9.wpilib")


# %%
def spin_in_wpilib(gains: dict[str, float], run: sim.Run, friction: float) -> np.ndarray:
    """The speed of WPILib's wheel with the volts of a run; friction takes some of them."""
    plant = LinearSystemId.identifyVelocitySystemRadians(gains["kV"], gains["kA"])
    wheel, speeds = FlywheelSim(plant, DCMotor.krakenX60(2)), []
    for volts, span in zip(run.voltage, np.diff(run.time, append=run.time[-1]), strict=True):
        speeds.append(wheel.getAngularVelocity())
        wheel.setInputVoltage(np.sign(volts) * max(abs(volts) - friction, 0.0))
        wheel.update(span)
    return np.array(speeds)


# %%
try:
    from wpilib.simulation import FlywheelSim
    from wpimath.system.plant import DCMotor, LinearSystemId
except ImportError:
    print(f"This cell needs RobotPy. In a terminal:  {format_install_command('robot')}")
else:
    own, where = read_own_log()
    print(where)
    gains, run = fit(own).gains, own.list_runs_of_test("quasistatic-forward")[0]
    speeds = {
        "kV and kA alone": spin_in_wpilib(gains, run, 0.0),
        "kS taken from the volts": spin_in_wpilib(gains, run, gains["kS"]),
    }
    for name, speed in speeds.items():
        print(f"{name}: the typical error is {np.sqrt(np.mean((speed - run.velocity) ** 2)):.3g}")
    real = Motion("your log", velocity=run.velocity)
    scenes = {
        (name,): Scene(run.time - run.time[0], (real, Motion("WPILib", velocity=speed, ghost=True)))
        for name, speed in speeds.items()
    }
    moving = animate_mechanism(
        "drivetrain" if own.units == "meters" else "flywheel",
        scenes,
        choices=(Choice("FlywheelSim with", tuple(speeds)),),
        panels=(Panel("velocity", "speed [m/s or rad/s]"),),
        slow=20.0,
        alt="Your log and WPILib's simulation in a ramp test. With kV and kA alone, WPILib moves "
        "before your mechanism does, and stays too fast. With kS taken from the volts, both are "
        "the same.",
    )
    display(moving)

# %% [markdown]
# WPILib's simulation has no friction. So subtract kS from the volts yourself, as the cell above the
# picture does. Then only the noise of the sensor remains.
#
# <details><summary>The same in Java, and an elevator</summary>
#
# ```java
# private final FlywheelSim m_sim =
#     new FlywheelSim(LinearSystemId.identifyVelocitySystem(kV, kA), DCMotor.getKrakenX60(2));
#
# @Override
# public void simulationPeriodic() {
#   double volts = m_motor.getMotorVoltage().getValueAsDouble();
#   m_sim.setInputVoltage(Math.signum(volts) * Math.max(Math.abs(volts) - kS, 0.0));
#   m_sim.update(0.02);
#   // in turns of the motor: with gears, multiply by the gear ratio
#   m_motor.getSimState().setRotorVelocity(m_sim.getAngularVelocityRPM() / 60.0);
# }
# ```
#
# The gains are per radian. An `ElevatorSim` takes `LinearSystemId.identifyPositionSystem(kV, kA)`.
# In WPILib 2027 the two are `Models.flywheelFromSysId(kV, kA)` and `Models.elevatorFromSysId(kV,
# kA)`. ([Models of WPILib 2027, at one
# commit](https://github.com/wpilibsuite/allwpilib/blob/28083c504ae638b084277ffb46259e51f0b73454/wpimath/src/main/java/org/wpilib/math/system/Models.java))
#
# It adds a gravity of 9.8 m/s² by itself, whatever your kG is. This is right only if kG/kA is 9.8
# m/s² (lesson 2). With a counterweight or a second stage, switch `simulateGravity` off, and
# subtract kG from the volts, too. ([LinearSystemId of WPILib
# 2026.2.2](https://github.com/wpilibsuite/allwpilib/blob/v2026.2.2/wpimath/src/main/java/edu/wpi/first/math/system/plant/LinearSystemId.java))
#
# **Try it:** in the cell above the picture, divide kA by 2. In which part of which test do you see
# it?
# </details>

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
display(ask_question("lesson9.quick"), enable_checkboxes())

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
# No. It fitted the noise of one log. A smaller gap on the fitted log proves nothing, because the
# model was fitted to this log.
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
#
# Outside quotes, write the name of an effect with `_` instead of `-`: `velocity_filter={…}`.
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
# Hide two effects that both change with speed. In a terminal:
# `sysid simulate drivetrain --hide drag --hide stribeck --step 2 -o slow.wpilog`. Then
# `sysid reconcile slow.wpilog`. Do the same with `--step 7`. Which of the two logs leaves a doubt?
# </details>
#
# Now you can measure gains, say how far to trust them, and find out what is missing in your model.
# `grade` in a terminal shows which exercises are left. **Next:** [Lesson 10,
# swerve](10_swerve.ipynb), if your robot has a swerve drive.
