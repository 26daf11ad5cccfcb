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
# # Lesson 3: Test design
#
# *About 40 minutes. You need lessons 1 and 2. You need no robot today.*
#
# ![The voltage of two tests. In the first test it grows slowly. In the second test it
# jumps.](attachment:picture.png)
#
# **At the end you can**
#
# - say which gains you get from the slow ramp and which from the sudden step, and why you need
#   both;
# - read kS off a ramp, and say how large the error of this kS is, and why;
# - say which gains become unknown when a test is missing, and give three reasons for tests in
#   reverse;
# - choose the voltage ramp, the voltage step, the timeout and a mark on the floor for a room.

# %% [markdown]
# ## 1 Why: a test is a question
#
# SysId cannot find what the data do not contain. If a robot never accelerates in the log, no
# mathematics will find its kA. So before you press a button you decide how fast the voltage rises,
# how much it jumps, and how far and how long the robot drives. This is *test design*. You need ten
# minutes to make a plan. Without a plan, you may need an evening to repeat all tests.
#
# Today's mechanisms are simulated, so we know their true gains. (You do not need to read the code.
# Run each cell, and read what it prints.)

# %%
from dataclasses import replace
from textwrap import fill

import numpy as np
from IPython.display import display

import sim
from grader import ask_question, enable_checkboxes
from sim.bench.mechanism import Mechanism
from sim.bench.mechanisms import MECHANISMS
from sim.bench.simulate import move_gains_only, simulate
from sim.fit import fit
from sim.physics.model import Part
from sim.physics.motors import find_motor
from sim.plot import (
    Line,
    Table,
    plot_time_series,
    tabulate_gains,
)
from sim.plot.animation import (
    Choice,
    Gain,
    Knob,
    Motion,
    Panel,
    Rule,
    Scene,
    TestPlan,
    animate_mechanism,
)
from sim.plot.animation.charts import Chart, Curve, animate_charts, chart_gain_errors
from sim.teaching.gain_errors import compute_gain_errors, simulate_rows

drivetrain, shooter = MECHANISMS["drivetrain"], MECHANISMS["shooter"]
truth = drivetrain.gains
print(drivetrain.summary)
tabulate_gains({"our drivetrain": truth})

# %% [markdown]
# ## 2 The model: two tests, four runs
#
# > **V = kS·sgn(v) + kV·v + kA·a**
#
# There are three unknown gains, and two kinds of test to find them:
#
# - **Quasistatic** ("as if static"). The voltage rises slowly from zero. The mechanism hardly
#   accelerates, so kA·a is small, and V ≈ kS + kV·v. This test shows **kS and kV**.
# - **Dynamic.** The voltage jumps to a *step* and stays constant. At first the speed is zero, so
#   nearly all of the voltage goes into acceleration. This test shows **kA**.
#
# You run each test forward and in reverse. That makes four runs. **Predict** how the speed rises in
# the dynamic test:

# %%
ask_question("lesson3.rise")

# %%
routine = sim.Routine(ramp=1.0, step=2.0, timeout=8.0)
log = simulate(drivetrain, routine, rng=np.random.default_rng(3))
plot_time_series(log, dynamic_seconds=1.0)

# %%
tau, top = truth["kA"] / truth["kV"], (2.0 - truth["kS"]) / truth["kV"]
_, speed = move_gains_only(truth, time=np.array([0.0, tau]), voltage=np.full(2, 2.0))
print(f"kA/kV is {1000 * tau:.0f} ms. This long after the step the robot has", end=" ")
print(f"{100 * speed[-1] / top:.0f} % of its final speed.")

# %% [markdown]
# The picture shows only the first second of each step. Look at the dynamic tests, on the right: the
# voltage jumps at once, but the speed does not. It rises steeply at first, then less and less,
# until it is constant. In the quasistatic tests, on the left, voltage and speed rise together along
# straight lines.
#
# When the robot gets faster, kV·v takes more volts, and fewer volts are left for acceleration. So
# the curve is steep at first and then gets flatter: the speed approaches its final value
# *exponentially*. The **time constant τ = kA/kV** of lesson 1 says how quickly the speed rises.
# After τ the speed has reached about two thirds of its final value. After 3τ the speed has nearly
# reached its final value.
#
# **Myth check.** "In a clean dynamic test the acceleration is constant while the speed rises."
# *False:* constant acceleration would give a straight line up to the final speed. WPILib describes
# a good test as "an approximately exponential approach of the steady-speed". If *your* data look
# like a straight line, look for the cause: a current limit or slipping wheels can keep the
# acceleration constant (section 7).
#
# <details><summary>For mentors: the rise of a dynamic test, with source</summary>
#
# > **Lesson says:** in a clean dynamic test "Acceleration is relatively constant during the rising
# > portion."
# >
# > **Source says:** no: "a successful dynamic graph will be an approximately exponential approach
# > of the steady-speed". ([WPILib docs: Viewing
# > Diagnostics](https://github.com/wpilibsuite/frc-docs/blob/c94b51df80ed991bdb634ed20dbf758e31dc0d3c/source/docs/software/advanced-controls/system-identification/viewing-diagnostics.rst))
# >
# > **Try it:** hold a ruler against the rise in the picture: it is no straight line. If *your* data
# > look like a straight line, look for the cause: a current limit or slipping wheels can keep the
# > acceleration constant.
# </details>

# %% [markdown]
# ## 3 Reading the ramp: is the intercept kS?
#
# Plot the voltage of a ramp test against the velocity. V ≈ kS + kV·v is a straight line. Its slope
# is kV, and the voltage where it meets velocity 0 (its *intercept*) should be kS. To *read kS off*
# the ramp means to use this intercept as kS.
#
# Is the intercept really kS? We test a drivetrain and a shooter's flywheel (its heavy wheel). The
# flywheel is heavy for its motors, so its τ is much longer than the drivetrain's.
#
# **Predict:**

# %%
ask_question("lesson3.drift")


# %%
def read_off(mechanism: Mechanism, ramp: float) -> tuple[sim.Log, Line]:
    """A log with this ramp, and the straight line through its moving samples, per meter or turn."""
    slow = simulate(mechanism, sim.Routine(ramp=ramp, step=2.0), rng=np.random.default_rng(1))
    run = slow.list_runs_of_test("quasistatic-forward")[0]
    per = 1.0 if mechanism.units == "meters" else 2.0 * np.pi
    moving = np.abs(run.velocity) > 0.05 * np.abs(run.velocity).max()
    slope, intercept = np.polyfit(run.velocity[moving] / per, run.voltage[moving], 1)
    return slow, Line(float(intercept), float(slope))


RAMPS = [round(0.1 * number, 1) for number in range(1, 11)]
SHOWN = {"drivetrain": drivetrain, "flywheel": shooter}
drifts = {
    name: {ramp: read_off(mechanism, ramp) for ramp in RAMPS} for name, mechanism in SHOWN.items()
}


def drift_charts(name: str, ramp: float) -> list[Chart]:
    """The ramp with its line, and the kS of that line for each ramp."""
    gains, (slow, line) = SHOWN[name].gains, drifts[name][ramp]
    run = slow.list_runs_of_test("quasistatic-forward")[0]
    speed = run.velocity / (1.0 if name == "drivetrain" else 2.0 * np.pi)
    few = slice(None, None, max(1, len(run) // 100))
    ends = np.array([0.0, speed.max()])
    found = [line.intercept for _, line in drifts[name].values()]
    tau = gains["kA"] / gains["kV"]
    rule = [gains["kS"] + tau * one for one in RAMPS]
    unit = "m/s" if name == "drivetrain" else "rot/s"
    return [
        Chart(f"velocity [{unit}]", "voltage [V]", (
            Curve("samples", speed[few], run.voltage[few], "dots", 0),
            Curve("straight line", ends, line.intercept + line.slope * ends, "line", 1),
        ), title=f"τ = {1000 * tau:.0f} ms"),
        Chart("ramp [V/s]", f"kS of the {name} [V]", (
            Curve("true kS", [0.0, 1.0], [gains["kS"], gains["kS"]], "dashed"),
            Curve("true kS + τ·ramp", RAMPS, rule, "line", 2),
            Curve("kS of each line", RAMPS, found, "dots", 0),
            Curve("this ramp", [ramp], [line.intercept], "dots", 1, [f"{line.intercept:.3f} V"]),
        )),
    ]  # fmt: skip


animate_charts(
    drift_charts,
    choices=(Choice("mechanism", tuple(SHOWN)),),
    knobs=(Knob("ramp", "ramp [V/s]", low=0.1, high=1.0, step=0.1, value=0.5),),
)

# %% [markdown]
# ### Explain
#
# During a ramp the robot accelerates all the time. The voltage rises by `ramp` volts each second,
# so the speed rises by ramp/kV each second. This small, constant acceleration takes
#
# > kA · (ramp/kV) = **τ·ramp** volts, during the whole ramp.
#
# The intercept of the straight line is kS plus these volts. So the error of the intercept is
# proportional to the ramp: with twice the ramp, the error is twice as large.
#
# <details><summary>Want to know why the error in the picture is a little larger?</summary>
#
# The small difference has two causes. Each row contains the speed at one moment, and the voltage
# of the 20 ms after it, which is already a little larger. And noise in the velocity makes the line
# a little flatter (lesson 7).
# </details>
#
# SysId itself does not read an intercept: it fits all runs at once, and its model has a kA term for
# the ramps, too. If you read an intercept by eye, use a slow ramp. How slow must the flywheel's
# ramp be to keep the error of kS below 0.03 V? Solve τ·ramp = 0.03 V.
#
# <details><summary>Answer</summary>
#
# The ramp must be slower than 0.03 V / 0.267 s = 0.11 V/s.
# </details>
#
# <details><summary>For mentors: is the intercept kS?</summary>
#
# > **Lesson says:** the quasistatic test moves "so slowly that it's essentially never
# > accelerating", so that "the intercept is kS".
# >
# > **Source says:** with a slow ramp, the voltage for acceleration is *negligible*. SysId itself
# > does not read an intercept: it fits all runs at once, and its model has a kA term for the ramps,
# > too. ([WPILib docs: Creating a
# > Routine](https://github.com/wpilibsuite/frc-docs/blob/d57699ab3bc9612521fb1cd8edf9db348c3ddbc1/source/docs/software/advanced-controls/system-identification/creating-routine.rst),
# > [SysId's source:
# > FeedforwardAnalysis.cpp](https://github.com/wpilibsuite/allwpilib/tree/v2026.2.2/sysid/src/main/native/cpp/analysis/FeedforwardAnalysis.cpp))
# >
# > **Try it:** how slow must the flywheel's ramp be to keep the error of kS below 0.03 V? Solve
# > τ·ramp = 0.03 V.
# </details>

# %% [markdown]
# ## 4 What does each test add?
#
# Every row of a log gives one equation: the model with the V, v and a of this row. A fit can
# separate the gains only if the equations differ. So it needs rows with many different v and a.
#
# If you repeated the tests, noise would change each fitted gain a little. In the next picture, the
# bar of a gain shows its *standard error* (the typical error from noise alone). A bar as long as
# the gain itself means: this gain is **unknown**.
#
# **Predict** what happens when a test is missing:

# %%
display(ask_question("lesson3.drop"), ask_question("lesson3.ramps"))

# %%
all_rows = simulate_rows(drivetrain, routine)


def show_gain_errors(*kept: float) -> Chart:
    """Bars of the gains' errors in a fit of a part of each test."""
    used = {
        test: rows.select(slice(round(percent / 100 * len(rows))))
        for (test, rows), percent in zip(all_rows.items(), kept, strict=True)
    }
    return chart_gain_errors(compute_gain_errors(drivetrain, used))


animate_charts(
    show_gain_errors,
    knobs=[Knob(test, f"{test} [%]", 0.0, 100.0, 25.0, 100.0) for test in all_rows],
)

# %% [markdown]
# Set a test to 0 %, and back to 100 %. Which single test can you leave out? Then leave out both
# step tests, and then both ramps.

# %% [markdown]
# ### Explain
#
# - **Without step tests** kA and kS are very uncertain, because a ramp shows mainly the sum kS +
#   τ·ramp (section 3).
# - **Without ramps**, you can find no gain. With one constant voltage the rows only show the final
#   speed and how quickly the robot reaches it. These two numbers are not enough for three unknown
#   gains. (If you knew kS, you could compute kV and kA.)
# - **Without one test**, whichever it is, the errors grow only a little. In this simulation the
#   robot behaves the same forward and in reverse.
#
# But SysId accepts only a log with all four runs:

# %%
three = replace(log, runs=tuple(run for run in log.runs if run.test != "dynamic-reverse"))
try:
    fit(three, method="sysid")
except sim.Refusal as refusal:
    print(fill(str(refusal)))

# %% [markdown]
# So you need both ramps and steps.
#
# <details><summary>For mentors: one test alone, with source</summary>
#
# > **Lesson says:** "Running only one of them produces incomplete data and poor regression
# > results."
# >
# > **Source says:** in the quasistatic test "the voltage corresponding to acceleration is
# > negligible". The dynamic test is there "so that the behavior while accelerating can be
# > determined". So you need both tests. ([WPILib docs: Creating a
# > Routine](https://github.com/wpilibsuite/frc-docs/blob/d57699ab3bc9612521fb1cd8edf9db348c3ddbc1/source/docs/software/advanced-controls/system-identification/creating-routine.rst))
# >
# > **Try it:** leave only the two dynamic tests in the picture above. Each bar is as long as its
# > gain.
# </details>

# %% [markdown]
# ## 5 Why reverse? Three reasons
#
# If a robot behaves the same forward and in reverse, why do you test both? On a real robot you do
# not know that both are the same.
#
# **Reason 1: gravity.** For an elevator, only the way down separates kS from kG (lesson 2).
#
# **Reason 2: asymmetry.** A brake that rubs, a worm gear or a tilted bearing can make friction
# different in each direction. Here is a drivetrain with three times as much friction in reverse.
# **Predict:**

# %%
ask_question("lesson3.lean")

# %%
LEAN = -0.15  # [V] on top of 0.30 V: 0.15 V forward, 0.45 V in reverse
lean = Part("asymmetric-friction", {"lean": LEAN})
uneven = replace(drivetrain, friction=0.30, hidden=(lean,))
uneven_log = simulate(uneven, routine, rng=np.random.default_rng(1))
rows = []
for way in ("forward", "reverse"):
    half = replace(uneven_log, runs=tuple(r for r in uneven_log.runs if r.direction == way))
    found = fit(half)
    rows.append((f"{way} only", *(found.gains[name] for name in truth), "–"))
both = fit(uneven_log, method="sysid")
gains = (both.gains[name] for name in truth)
rows.append(("all four, SysId's recipe", *gains, both.simulated_velocity_r2))
rows.append(("truth", f"{0.30 + LEAN:.2f} and {0.30 - LEAN:.2f}", truth["kV"], truth["kA"], "–"))
Table(("runs", "kS [V]", "kV [V·s/m]", "kA [V·s²/m]", "simulated velocity R²"), tuple(rows))

# %% [markdown]
# A fit of one direction alone gives good gains. A fit of both directions together has only one kS
# for both. So its kA becomes much too large. And its kS becomes nearly 0: during a ramp, kS and
# kA·a are both constant voltages, so a fit can put nearly all of them into kA (lesson 7, section
# 8). The simulated velocity R² (SysId's score; 1 is perfect, lesson 7) stays high. So compare the
# gains of the forward runs with the gains of the reverse runs.
#
# Without the reverse runs you would know only the first row of the table. In reverse, your
# feedforward would give only a third of the voltage that friction needs.
#
# **Reason 3: the way back.** The reverse run brings the robot back to where it started, so the next
# test has room again.
#
# <details><summary>For mentors: may you skip the reverse runs?</summary>
#
# > **Lesson says:** "Skipping the reverse runs produces gains that only model the forward direction
# > accurately".
# >
# > **Source says:** a backward test right after a forward test "will more or less reset the
# > mechanism to its original position" ([Creating a Routine, at one
# > commit](https://github.com/wpilibsuite/frc-docs/blob/d57699ab3bc9612521fb1cd8edf9db348c3ddbc1/source/docs/software/advanced-controls/system-identification/creating-routine.rst)).
# > SysId's maintainer has called backward tests not required for the fit of an elevator or arm
# > ([sysid issue 492](https://github.com/wpilibsuite/sysid/issues/492)). But SysId's window
# > requires all four tests: it looks for each test, and lists the tests that are missing
# > ([DataSelector.cpp, at one
# > commit](https://github.com/wpilibsuite/allwpilib/blob/79096e63a005e096b2acd4774a8ab145058c24c0/sysid/src/main/native/cpp/view/DataSelector.cpp)).
# >
# > **Try it:** open the code above, set `LEAN` to 0, and run it again: for a *symmetric*
# > drivetrain, does each row of the table show about the same gains?
# </details>

# %% [markdown]
# ## 6 Choose the ramp: how far will it go?
#
# With a slow ramp, the kS that you read off is precise (section 3). Is a slow ramp also safe? Your
# room has a certain length, and the robot should reach 1 m/s. **Predict:**

# %%
ask_question("lesson3.way")

# %%
TEN_FEET = 3.05  # [m]


def ramp_run(ramp: float, *, lasts: float = 30.0) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Time, position and speed of the drivetrain in a ramp, on a floor without an end."""
    time = np.arange(0.0, min(lasts, 12.0 / ramp), 0.01)
    return time, *move_gains_only(truth, time=time, voltage=ramp * time)


rows = []
for ramp in (0.25, 0.5, 1.0, 2.0):
    time, place, speed = ramp_run(ramp)
    rule = truth["kV"] * 1.0**2 / (2 * ramp)
    volts = ramp * float(np.interp(TEN_FEET, place, time))
    ten_seconds = float(np.interp(10.0, time, place)) if time[-1] >= 9.9 else "–"
    rows.append((ramp, float(np.interp(1.0, speed, place)), rule, volts, ten_seconds))
Table(
    (
        "ramp [V/s]",
        "distance to 1 m/s [m]",
        "kV·v²/(2·ramp) [m]",
        "voltage after 10 ft [V]",
        "distance in 10 s [m]",
    ),
    tuple(rows),
    caption="A ramp of 2 V/s ends after 6 s, because it has reached the battery's 12 V.",
)

# %% [markdown]
# With half the ramp the robot needs twice the time to reach any speed, and also twice the distance:
#
# > **d ≈ kV·v² / (2·ramp)**
#
# So "slow is safe" is wrong if your room is short. With a very slow ramp the robot reaches the end
# of the room before it is fast. A log with only low speeds tells you little about kV. Choose the
# slowest ramp that fits into your room. WPILib recommends "at least 10' of space, ideally closer to
# 20'" (3 to 6 m). Never run the tests on blocks, with the wheels in the air: then the robot's mass
# does not move. Look at the row for 0.5 V/s in the table: how far does this drivetrain go in 10 s?
#
# <details><summary>For mentors: 10 feet and 0.5 V/s, with source</summary>
#
# > **Lesson says:** clear "at least 10 feet forward and 10 feet back", with a ramp that is
# > "typically 0.5 V/s" and a timeout of 10 s.
# >
# > **Source says:** WPILib recommends "at least 10' of space, ideally closer to 20'", and never on
# > blocks, because there the robot's mass does not move. The library's default ramp is 1 V/s.
# > ([WPILib docs: Running the
# > Routine](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/system-identification/running-routine.html),
# > [Creating a
# > Routine](https://github.com/wpilibsuite/frc-docs/blob/d57699ab3bc9612521fb1cd8edf9db348c3ddbc1/source/docs/software/advanced-controls/system-identification/creating-routine.rst))
# >
# > **Try it:** look at the row for 0.5 V/s in the table. How far does this drivetrain go in 10 s?
# > Which voltage has the ramp reached after 10 feet?
# </details>

# %% [markdown]
# ## 7 Choose the step: hard enough, not too hard
#
# A large voltage step gives a large acceleration, which is easy to tell from noise. But three
# things limit the step:
#
# 1. **Grip.** Wheels slip when the motors push harder than the carpet can hold. From standstill
#    they slip if the voltage is above `V_slip = kS + kA·μ·g`. The grip μ is about 1.1 on carpet
#    (measure yours), and g is 9.81 m/s². When wheels spin, the encoder counts meters that the robot
#    does not move.
# 2. **Current.** At standstill a motor draws `stall_current · step / 12 V`. (The *stall current* is
#    on the motor's data sheet: the current at 12 V when the motor cannot turn.) To keep the current
#    below its limit, the controller reduces the voltage. Then the speed rises in a straight line at
#    first. (Phoenix 6, the library for the TalonFX, sets a limit of 120 A unless you change it.)
# 3. **Room.** The top speed is (step − kS)/kV. At this speed the robot drives on until you let go
#    of the button.
#
# (Source for 120 A: `CurrentLimitsConfigs` in [Phoenix 6, release
# 26.3.0](https://pypi.org/project/phoenix6/26.3.0/).)
#
# The step must not be too small either. SysId computes the acceleration from differences of speeds,
# so the acceleration is noisy. ([SysId's source:
# FilteringUtils.cpp](https://github.com/wpilibsuite/allwpilib/blob/v2026.2.2/sysid/src/main/native/cpp/analysis/FilteringUtils.cpp))
# The acceleration at the start should be at least ten times as large as this noise. For our robot 2
# V is enough and 0.6 V is not: with a step of 0.6 V, SysId finds a kA that is far too large.

# %%
rows = []
for name, count, motor_name in (("4 Kraken X60", 4, "krakenX60"), ("4 NEO", 4, "neo")):
    built = replace(drivetrain, motor=find_motor(motor_name), motor_count=count)
    gains = built.gains
    slip = gains["kS"] + gains["kA"] * 1.1 * 9.81
    scatter = built.sensor.velocity_noise / (np.sqrt(2) * 0.02)
    least = gains["kS"] + 10 * scatter * gains["kA"]
    cut = 12 * 120 / built.motor.stall_current
    rows.append((name, gains["kA"], least, slip, cut if cut < 12 else "never"))
Table(
    ("motors", "kA [V·s²/m]", "smallest step [V]", "wheels slip from [V]", "120 A limit from [V]"),
    tuple(rows),
)

# %% [markdown]
# Both robots weigh 60 kg and have a ratio of 6.75. With a step of 3.5 V, the wheels of one robot
# slip, and the wheels of the other do not. Stay at 90 % of V_slip or less. To compute V_slip, you
# need kA *before* the test: compute kA from mass and motors (lesson 1), or start with a small step.
#
# <details><summary>For mentors: typical steps and the default of 7 V</summary>
#
# > **Lesson says:** "applies a large voltage step — typically 3–7V", and "Start with a step voltage
# > of 3–4V, not 7V".
# >
# > **Source says:** the library's default is 7 V. Its maintainer writes: "7 V is almost always too
# > much, but users should also be picking a good value specific to their system". A default of 4 V
# > has been proposed. ([allwpilib issue
# > 7794](https://github.com/wpilibsuite/allwpilib/issues/7794))
# >
# > **Try it:** change the mass: `replace(drivetrain, load=30.0, …)`. Do the wheels of a light robot
# > slip at a lower voltage or at a higher voltage? (Look at kA in the formula.)
# </details>
#
# (Our simulated drivetrain never slips. Lesson 6 shows what slipping looks like in a log.)

# %% [markdown]
# ## 8 Choose when to stop: mark and timeout
#
# Two things end a test. You let go of the button when the robot passes a **mark** on the floor. If
# you do not let go, the **timeout** stops the robot. Set the timeout a little longer than the test
# needs.
#
# Does a long dynamic test make the gains worse? The next table uses only the first seconds of the
# same step test:

# %%
hall = simulate(replace(drivetrain, travel=None), routine, rng=np.random.default_rng(1))


def first_seconds(run: sim.Run, seconds: float) -> sim.Run:
    """The beginning of a dynamic run; other runs whole."""
    if run.kind != "dynamic":
        return run
    end = int(np.searchsorted(run.time, run.time[0] + seconds))
    signals = ("time", "voltage", "position", "velocity")
    return replace(run, **{name: getattr(run, name)[:end] for name in signals})


rows = []
for seconds in (0.2, 0.5, 1.0, 2.0, 7.0):
    cut = replace(hall, runs=tuple(first_seconds(run, seconds) for run in hall.runs))
    found = fit(cut, method="sysid")
    step = cut.list_runs_of_test("dynamic-forward")[0]
    used = found.samples_used["dynamic-forward"]
    rows.append((f"{seconds:g} s", len(step), used, found.gains["kA"], float(step.position[-1])))
Table(
    ("step lasts", "rows", "rows used", "kA found [V·s²/m]", "distance [m]"),
    tuple(rows),
    caption=f"True kA: {truth['kA']:.3f} V·s²/m",
)

# %% [markdown]
# kA is nearly the same in all rows: the first 0.2 s already show it. (0.1 s would be too few
# samples for a fit.) A longer test does not change kA, because SysId uses only the samples up to 90
# % of the final speed. But it needs a longer room: look at the last column. (A fit that uses the
# later samples, too, finds a wrong kA: lesson 7.)
#
# <details><summary>For mentors: does a long dynamic test spoil kA?</summary>
#
# > **Lesson says:** "Running the dynamic test too long lets the mechanism overshoot its physical
# > limits or reach free speed, where acceleration collapses to zero and kA becomes unobservable."
# >
# > **Source says:** the physical limits are the real danger: stop early "if it exceeds safe
# > limits". Free speed does not affect SysId's kA, because SysId trims the step by itself. It
# > affects fits that use all rows (lesson 7). ([Running the
# > Routine](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/system-identification/running-routine.html),
# > [SysId's source:
# > FilteringUtils.cpp](https://github.com/wpilibsuite/allwpilib/tree/v2026.2.2/sysid/src/main/native/cpp/analysis/FilteringUtils.cpp))
# >
# > **Try it:** compare kA, and the rows used, in the rows "0.2 s" and "7 s" of the table.
# </details>

# %% [markdown]
# ## 9 Plan your tests
#
# Now plan a ramp test and a step test for the drivetrain. You let go of the button 0.3 s after the
# robot passes the mark. Above the picture you see five rules. (Exercise 6 has two more.) Find a
# plan that follows all five rules in a room of 4 m. Then try a room of 2.5 m.
#
# **Choose your current limit first.** It protects the motors and the battery. If a step is too
# large, the limit reduces the voltage at the start. So set the current limit that you will use in a
# match. Then plan a step that stays below this limit.

# %%
REACTION = 0.3  # [s] from the mark to the thumb off the button
FREE = (12.0 - truth["kS"]) / truth["kV"]  # [m/s]
SLIP = truth["kS"] + truth["kA"] * 1.1 * 9.81
OHMS = drivetrain.motor.resistance  # [Ω] of one motor: what limits its current from standstill


test_ends = {"mark": Gain("mark"), "reaction": REACTION, "timeout": 8.0}
animate_mechanism(
    "drivetrain",
    Scene(
        np.arange(0.0, 10.0, 0.02),
        (
            Motion("ramp", gains=truth, plan=TestPlan(ramp=Gain("ramp"), **test_ends)),
            Motion("step", gains=truth, plan=TestPlan(step=Gain("step"), **test_ends)),
        ),
    ),
    panels=(Panel("velocity", "velocity [m/s]", low=0.0, high=4.0),),
    knobs=(
        Knob("ramp", "ramp [V/s]", low=0.2, high=2.0, step=0.05, value=0.5),
        Knob("step", "step [V]", low=0.5, high=7.0, step=0.1, value=3.5),
        Knob("mark", "mark [m]", low=0.5, high=8.0, step=0.1, value=2.5),
        Knob("room", "room [m]", low=2.0, high=10.0, step=0.5, value=4.0),
        Knob("limit", "limit [A]", low=20.0, high=120.0, step=5.0, value=120.0),
    ),
    rules=(
        Rule("both robots have stopped after [m]", "farthest", at_most=Gain("room")),
        Rule("in the ramp the robot moves for [s]", "moving", motion="ramp", at_least=3),
        Rule("top speed of the ramp [% of free speed]", "fastest", 100 / FREE, "ramp", at_least=25),
        Rule("step [% of V_slip]", "step", 100 / SLIP, at_most=90),
        Rule(
            "current of a motor when the step begins [A]", "step", 1 / OHMS, at_most=Gain("limit")
        ),
    ),
    span=(-1.0, 10.5),
    wall=Gain("room"),
    marks={"mark": Gain("mark")},
    alt="The picture shows a room with a mark on the floor and a wall at its end. One robot drives "
    "the ramp test, the other drives the step test. The motors of each robot are switched off "
    "0.3 s after the mark. Above the room you see five rules, and whether your plan follows them. "
    "With 0.5 V/s and 3.5 V in a room of 4 m, the plan breaks two rules.",
)

# %% [markdown]
# With 0.5 V/s and 3.5 V in a room of 4 m, the plan breaks two rules: the ramp is too slow for the
# room, and the step is so large that the wheels of this strong drivetrain slip. Which slider must
# you move to follow each rule?
#
# (This is simplified: the motors brake at 0 V, the floor is flat, and the battery voltage does not
# drop. Leave more room than the plan says.)
#
# **A shooter** needs no room: only the timeout limits how slow its ramp may be. **An elevator** can
# move only a short way, and it has less time on the way down, because gravity pulls it.

# %% [markdown]
# ## 10 System check
#
# Before you press the first button, check these five points:
#
# - [ ] You computed how far the robot drives in the ramp, `kV·v²/(2·ramp)`, and the room is longer.
# - [ ] The step is below 90 % of V_slip, and below the current limit.
# - [ ] The mark is on the floor. Behind it there is enough room for your reaction time. The timeout
#   is set.
# - [ ] Four runs are planned: ramp and step, forward and reverse, each reverse run right after its
#   forward run.
# - [ ] The robot stands on the carpet that it will drive on, not on blocks.
#
# ## 11 Knowledge check
#
# Click an answer to the first question; you get feedback at once.

# %%
display(ask_question("lesson3.quick"), enable_checkboxes())

# %% [markdown]
# **1.** A flywheel has τ = 0.4 s and a true kS of 0.10 V. You read kS off a ramp of 0.5 V/s. About
# how large is the kS that you read off?
#
# <details><summary>Answer</summary>
#
# You get kS + τ·ramp = 0.10 + 0.4·0.5 = 0.30 V, three times the true value. SysId's fit has a term
# for kA, so it does not make this mistake.
# </details>
#
# **2.** A teammate says: "We have only 3 m, so we use a very slow ramp, to be safe." What do you
# answer?
#
# <details><summary>Answer</summary>
#
# The distance to reach a speed is kV·v²/(2·ramp): with half the ramp, it is twice as long. With a
# very slow ramp, the robot is still slow after 3 m. Use a steeper ramp, put a mark on the floor,
# and let go of the button quickly.
# </details>
#
# **3.** A log holds only the two dynamic tests. Why can you find no gain?
#
# <details><summary>Answer</summary>
#
# The ramps are missing. With one constant voltage, the rows only show the final speed and how
# quickly the robot reaches it. Two numbers are not enough for three gains.
# </details>
#
# **4.** A fit of the forward runs gives kS = 0.14 V. A fit of the reverse runs gives 0.38 V. What
# do you do?
#
# <details><summary>Answer</summary>
#
# Look for the cause on the robot. A part rubs in one direction: a brake, a chain or a bearing. A
# fit with one kS for both directions gives a wrong kA, and its R² may stay high.
# </details>
#
# **5.** After a voltage step, the speed rises in a straight line and then suddenly stays constant.
# What happened?
#
# <details><summary>Answer</summary>
#
# Something kept the acceleration constant: a current limit, or slipping wheels. Use a smaller step.
# In a good test the speed rises exponentially.
# </details>

# %% [markdown]
# ## 12 Practice
#
# **Exercise 6, part (a)** ([exercises/exercise6/README.md](../exercises/exercise6/README.md)). You
# get four mechanisms and plan their tests. In a terminal, in the course's folder:
#
# ```
# grade exercise6
# ```
#
# Any plan that follows the rules passes. You can also answer in a notebook:
#
# ```python
# from grader import submit
# submit("exercise6", turret_ramp=0.8, turret_step=2.5, turret_timeout=6, turret_release=0.5)
# ```
#
# You need section 6 for the ramp and the mark, section 7 for the step, and section 8 for the
# timeout. Part (b) comes with lesson 5. Hints cost nothing: `grade exercise6 --hint`. If you write
# into `answers.toml` with an editor, start `grade watch exercise6`: it grades the file each time
# you save it.
#
# <details><summary>More, if you like</summary>
#
# - Draw the picture of section 3 for a turret: add `"turret": MECHANISMS["turret"]` to `SHOWN`.
# - Bring `LEAN` closer to 0. At which `LEAN` is the error of kA below 10 %?
# - Plan the ramp of your own robot for the longest hallway of your school. Then measure how long
#   the hallway is.
# </details>
#
# **Next:** [Lesson 4, wire a SysIdRoutine](04_wire_sysidroutine.ipynb). Write the code that runs
# these tests.
