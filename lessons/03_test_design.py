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
# *About 50 minutes. You need lessons 1 and 2. No robot is needed today; at the end you can plan the
# tests of one.*
#
# **At the end you can**
#
# - say what the slow ramp and the sudden step each tell, and what neither of them tells alone;
# - explain why the kS that one reads off a ramp is too large, and by how much;
# - say what becomes unknown when a test is missing, and give three reasons to run in reverse;
# - choose a ramp, a step, a timeout and a mark on the floor for a given room.

# %% [markdown]
# ## 1 Why: a test is a question
#
# SysId cannot find what the data do not hold. If a robot never accelerates in the log, no
# mathematics will find its kA. So before you press a button you decide: how fast, how hard, how
# far, how long. That is test design, and it costs ten minutes. Driving all tests again costs an
# evening.
#
# Our mechanisms today are simulated, on *the bench*. We know their true gains because
# we built them. (You need not read the code to follow. Run each cell, and read what it prints.)

# %%
from dataclasses import replace

import ipywidgets as widgets
import numpy as np
from IPython.display import display

import sim
from sim.bench.mechanism import Mechanism
from sim.bench.mechanisms import MECHANISMS
from sim.bench.simulate import move_gains_only, simulate
from sim.fit import fit
from sim.fit.information_matrix import compute_information
from sim.fit.sysid_rows import prepare_rows
from sim.physics.model import Part
from sim.physics.motors import find_motor
from sim.plot import (
    Line,
    Picture,
    Table,
    plot_curves,
    plot_information_map,
    plot_time_series,
    plot_voltage_velocity,
    show_interactive,
)
from sim.teaching.prediction import Prediction

drivetrain, shooter = MECHANISMS["drivetrain"], MECHANISMS["shooter"]
truth = drivetrain.gains
print(drivetrain.summary)
Table(
    ("gain", "true value", "unit"),
    (("kS", truth["kS"], "V"), ("kV", truth["kV"], "V·s/m"), ("kA", truth["kA"], "V·s²/m")),
)

# %% [markdown]
# ## 2 The model: two tests, four runs
#
# > **V = kS·sgn(v) + kV·v + kA·a**
#
# Three unknown gains. Two kinds of test ask for them:
#
# - **Quasistatic** ("as if static"). The voltage climbs slowly from zero. The mechanism is hardly
#   ever accelerating, so kA·a is small, and V ≈ kS + kV·v. This is about **kS and kV**.
# - **Dynamic.** The voltage jumps to a *step* and stays. At first the speed is zero, so nearly all
#   of the voltage goes into acceleration. This is about **kA**.
#
# Each is run forward and in reverse. That makes four runs.

# %%
routine = sim.Routine(ramp=1.0, step=2.0, timeout=8.0)
log = simulate(drivetrain, routine, rng=np.random.default_rng(3))
plot_time_series(log, dynamic_seconds=1.0)

# %% [markdown]
# Only the first second of the steps is drawn. **Predict** how the speed rises in it, before you
# zoom in. (No buttons? Type `guess_rise.value = "…"` in a cell, with one of the answers.)

# %%
guess_rise = Prediction(
    "After the step, how does the speed rise to its top?",
    "evenly, then suddenly flat",
    "quickly first, then slower and slower",
    "slowly first, then faster and faster",
)
guess_rise

# %%
since = np.round(np.arange(0.0, 0.5, 0.005), 3)
_, speed = move_gains_only(truth, time=since, voltage=np.full(since.size, 2.0))
top = (2.0 - truth["kS"]) / truth["kV"]
tau = truth["kA"] / truth["kV"]
at_tau = float(np.interp(tau, since, speed))

print(f"You said: {guess_rise}.")
print(
    f"kA/kV = {1000 * tau:.0f} ms (the star). By then: {100 * at_tau / top:.0f} % of its top speed."
)
plot_curves(
    since,
    {
        "speed after the step": speed,
        "if it went on as it began": np.minimum(top, top * since / tau),
    },
    xlabel="time since the step [s]",
    ylabel="speed [m/s]",
    levels={"top speed": top},
    marked=(round(tau, 3), at_tau),
)

# %% [markdown]
# The faster it goes, the more of the voltage kV·v takes, and the less is left for acceleration. So
# the rise is steep at first and gets flatter: an *exponential* approach. Its pace is the
# **timescale τ = kA/kV** ("tau"): after τ about two thirds are done, after 3τ nearly all. SysId
# shows it as *Response Timescale*.
#
# > **Lesson says:** in a clean dynamic test "Acceleration is relatively constant during the rising
# > portion."
# >
# > **Source says:** "a successful dynamic graph will be an approximately exponential approach of
# > the steady-speed".
# > ([WPILib docs: Viewing Diagnostics](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/system-identification/viewing-diagnostics.html))
# >
# > **Try it:** the dashed line above is constant acceleration. If *your* data look like that, ask
# > why: a current limit and slipping wheels both hold the acceleration at one value.

# %% [markdown]
# ## 3 Reading the ramp: the intercept drifts
#
# Draw voltage over velocity for the ramp. V ≈ kS + kV·v is a straight line. Its slope is kV, and
# where it meets standstill (its *intercept*) one reads off kS. A high intercept means much
# friction, a low one means it moves easily.
#
# That is a good first look. Now hold it against the truth: is the kS that you read off the kS of
# the robot? The flywheel of a shooter is heavy for its motors: its τ is much longer than that of
# the drivetrain.
#
# **Predict:**

# %%
guess_drift = Prediction(
    "Which kS, read off a ramp of 1 V/s, is further from the truth?",
    "the drivetrain's",
    "the flywheel's",
    "neither, both are right",
)
guess_drift


# %%
def read_off(mechanism: Mechanism, ramp: float) -> tuple[sim.Log, Line]:
    """A log with this ramp, and the straight line through its moving samples, per meter or turn."""
    slow = simulate(mechanism, sim.Routine(ramp=ramp, step=2.0), rng=np.random.default_rng(1))
    run = slow.runs_of_test("quasistatic-forward")[0]
    per = 1.0 if mechanism.units == "meters" else 2.0 * np.pi
    moving = np.abs(run.velocity) > 0.05 * np.abs(run.velocity).max()
    slope, intercept = np.polyfit(run.velocity[moving] / per, run.voltage[moving], 1)
    return slow, Line(float(intercept), float(slope))


RAMPS = [0.1, 0.25, 0.5, 0.75, 1.0]
SHOWN = {"drivetrain": drivetrain, "flywheel": shooter}
drifts = {
    name: [read_off(mechanism, ramp)[1].intercept for ramp in RAMPS]
    for name, mechanism in SHOWN.items()
}


def drift_picture(name: str, ramp: float) -> list[Picture]:
    """The ramp with its line, and the kS of that line over all ramps."""
    gains = SHOWN[name].gains
    slow, line = read_off(SHOWN[name], ramp)
    rule = [gains["kS"] + gains["kA"] / gains["kV"] * one for one in RAMPS]
    return [
        plot_voltage_velocity(slow, lines={"straight line": line}),
        plot_curves(
            RAMPS,
            {"kS read off": drifts[name], "true kS + τ·ramp": rule},
            xlabel="ramp [V/s]",
            ylabel="kS [V]",
            levels={"the true kS": gains["kS"]},
            marked=(ramp, line.intercept),
        ),
    ]


show_interactive(
    drift_picture,
    name=widgets.Dropdown(options=list(SHOWN), description="mechanism"),
    ramp=widgets.SelectionSlider(
        options=RAMPS, value=0.5, description="ramp [V/s]", continuous_update=False
    ),
)

# %% [markdown]
# No controls on your screen? Change name and number here:

# %%
display(*drift_picture("flywheel", 1.0))

# %%
print(f"You said: {guess_drift}.")
rows = []
for name, mechanism in SHOWN.items():
    gains = mechanism.gains
    rows.append(
        (name, 1000 * gains["kA"] / gains["kV"], gains["kS"], drifts[name][-1], drifts[name][0])
    )
Table(
    ("mechanism", "τ [ms]", "true kS [V]", "read off at 1 V/s [V]", "read off at 0.1 V/s [V]"),
    tuple(rows),
)

# %% [markdown]
# ### Explain
#
# A ramp never stops accelerating. The voltage climbs by `ramp` volts each second, so the speed
# climbs by ramp/kV each second. That is an acceleration, small but constant, and it costs
#
# > kA · (ramp/kV) = **τ·ramp** volts, all the way along.
#
# The straight line cannot know, and counts them as kS. So what you read off lies on a line of slope
# τ over the ramp: twice the ramp, twice the error. (The small rest in the picture has
# two causes. A row holds the speed of now and the voltage that is applied from now on, which is
# half a loop, 10 ms, too early. And noise in the velocity bends the line a little: lesson 7.)
#
# > **Lesson says:** the quasistatic test moves "so slowly that it's essentially never
# > accelerating", so that "the intercept is kS".
# >
# > **Source says:** the ramp makes the voltage of the acceleration *negligible*. SysId itself does
# > not read an intercept: it fits all runs at once, with a kA term for the ramps, too.
# > ([WPILib docs: Creating a Routine](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/system-identification/creating-routine.html),
# > [SysId's source: FeedforwardAnalysis.cpp](https://github.com/wpilibsuite/allwpilib/tree/v2026.2.2/sysid/src/main/native/cpp/analysis/FeedforwardAnalysis.cpp))
# >
# > **Try it:** how slow must the flywheel's ramp be for an error below 0.03 V? Solve τ·ramp = 0.03.

# %% [markdown]
# ## 4 The information map: what each run tells
#
# Every row of a log is one equation: so much voltage, for this velocity v and this acceleration a.
# Draw each row as a dot, v to the right and a upward. If the dots lie in different corners, the
# equations differ, and the gains can be told apart. If all dots lie on one line, some gains cannot.
#
# Beside it, the **confidence ellipse** of lesson 2: noise would move a fit about, and 95 of 100
# fits fall inside. Small is good. A band without ends means: unknown.
#
# **Predict**, before you switch runs off:

# %%
guess_drop = Prediction(
    "We lose the dynamic reverse run of this drivetrain. What becomes unknown?",
    "kA",
    "kS",
    "kV",
    "nothing, the errors grow a little",
)
guess_ramps = Prediction(
    "We lose both ramps instead, and keep both steps. What becomes unknown?",
    "kA only",
    "kS only",
    "all three gains",
    "nothing",
)
display(guess_drop, guess_ramps)

# %% [markdown]
# (You may skip the code. It takes rows without noise, because noise in an acceleration looks like
# acceleration, and computes how far noise could push a fit.)

# %%
sensor = replace(drivetrain.sensor, velocity_noise=0.0, jitter=0.0, resolution=1e-9)
quiet = simulate(replace(drivetrain, sensor=sensor), routine, rng=np.random.default_rng(0))
all_rows = dict(prepare_rows(quiet).rows)
NOISE = truth["kA"] * drivetrain.sensor.velocity_noise / (np.sqrt(2) * 0.02)  # [V] of a row
REACH = {"kS": 0.15, "kV": 0.02, "kA": 0.25}
UNIT = {"kS": "kS [V]", "kV": "kV [V·s/m]", "kA": "kA [V·s²/m]"}


def map_of(tests: list[str], pair: tuple[str, str]) -> Picture:
    """Where the rows of some runs lie, and how well two gains follow from them."""
    rows = {test: all_rows[test] for test in tests}
    told = compute_information(rows, type="simple", noise=NOISE).information_on_pair(*pair)
    return plot_information_map(
        rows,
        told,
        names=(UNIT[pair[0]], UNIT[pair[1]]),
        truth=(truth[pair[0]], truth[pair[1]]),
        reach=(REACH[pair[0]], REACH[pair[1]]),
    )


SETS = {
    "1 ramp: quasistatic forward": ["quasistatic-forward"],
    "2 ramps": ["quasistatic-forward", "quasistatic-reverse"],
    "2 ramps and 1 step (no dynamic reverse)": [
        "quasistatic-forward",
        "quasistatic-reverse",
        "dynamic-forward",
    ],
    "all four": list(all_rows),
    "no ramps: 2 steps": ["dynamic-forward", "dynamic-reverse"],
    "forward only": ["quasistatic-forward", "dynamic-forward"],
}


def map_picture(runs: str, gains: str) -> Picture:
    """The information map of a set of runs."""
    first, second = gains.split(" and ")
    return map_of(SETS[runs], (first, second))


show_interactive(
    map_picture,
    runs=widgets.Dropdown(options=list(SETS), description="runs", layout={"width": "25em"}),
    gains=widgets.Dropdown(options=["kS and kA", "kS and kV", "kV and kA"], description="gains"),
)

# %% [markdown]
# No menus? Change the names here:

# %%
map_picture("all four", "kS and kA")

# %% [markdown]
# Add runs one by one: the first four lines of the menu. With one ramp, kS and kA lie on a long
# slanted ellipse: the ramp knows kS + τ·ramp, as in section 3, and not how it splits up. A single
# step ends that. Now all the sets, in numbers:

# %%
rows = []
for name, tests in SETS.items():
    errors = compute_information(
        {test: all_rows[test] for test in tests}, type="simple", noise=NOISE
    ).errors
    shares = (100 * errors[gain] / truth[gain] for gain in ("kS", "kV", "kA"))
    rows.append((name, *(share if share < 100 else "unknown" for share in shares)))
print(f"1. You said: {guess_drop}.")
print(f"2. You said: {guess_ramps}.")
Table(
    ("runs", "kS ± [%]", "kV ± [%]", "kA ± [%]"),
    tuple(rows),
    caption="One standard error, the typical miss by noise alone, as a share of the gain",
)

# %% [markdown]
# ### Explain
#
# - **Without steps** (the row "2 ramps") kA is poor, and drags kS along.
# - **Without ramps** all is lost. Under one constant voltage the rows have only one message: where
#   the speed ends and how quickly. Two numbers for three unknowns. (If you knew kS from
#   elsewhere, the other two would follow: the band in the map is narrow.)
# - **Without the dynamic reverse** this drivetrain loses almost nothing. Forward and reverse are
#   twins *here*, because the bench made them so.
#
# SysId insists on all four anyway:

# %%
three = replace(log, runs=tuple(run for run in log.runs if run.test != "dynamic-reverse"))
try:
    fit(three, method="sysid")
except sim.Refusal as refusal:
    print(refusal)

# %% [markdown]
# > **Lesson says:** "Running only one of them produces incomplete data and poor regression
# > results."
# >
# > **Source says:** in the quasistatic test "the voltage corresponding to acceleration is
# > negligible". The dynamic test is there "so that the behavior while accelerating can be
# > determined". Neither does the other's work.
# > ([WPILib docs: Creating a Routine](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/system-identification/creating-routine.html))
# >
# > **Try it:** "no ramps: 2 steps" in the map. The dots lie on two lines. Turn the picture upside
# > down: what changes?

# %% [markdown]
# ## 5 Why reverse? Three reasons
#
# If forward and reverse are twins, why bother? Because you do not know that they are.
#
# **Reason 1: gravity.** For an elevator, down is what separates kS from kG (lesson 2).
#
# **Reason 2: asymmetry.** A dragging brake, a worm gear, a bearing pressed to one side: friction
# can differ by direction. Here is a drivetrain whose friction is three times as large in reverse.
# **Predict:**

# %%
guess_lean = Prediction(
    "We fit all four runs with one kS. Which gain suffers the most?",
    "kS",
    "kV",
    "kA",
)
guess_lean

# %%
lean = Part("asymmetric-friction", {"lean": -0.15})
uneven = replace(drivetrain, friction=0.30, hidden=(lean,))  # 0.15 V forward, 0.45 V in reverse
uneven_log = simulate(uneven, routine, rng=np.random.default_rng(1))
rows = []
for way in ("forward", "reverse"):
    half = replace(uneven_log, runs=tuple(r for r in uneven_log.runs if r.direction == way))
    found = fit(half)
    rows.append((f"{way} only", *(found.gains[name] for name in truth), "–"))
both = fit(uneven_log, method="sysid")
gains = (both.gains[name] for name in truth)
rows.append(("all four, SysId's recipe", *gains, both.simulated_velocity_r2))
rows.append(("truth", "0.15 and 0.45", truth["kV"], truth["kA"], "–"))
print(f"You said: {guess_lean}.")
Table(("runs", "kS [V]", "kV [V·s/m]", "kA [V·s²/m]", "simulated velocity R²"), tuple(rows))

# %% [markdown]
# Each direction alone gives a good fit. Together they cannot, with one kS for both, and kA takes
# the blame. The simulated velocity R² (SysId's score; 1 is perfect, lesson 7) stays high. So the
# numbers of one direction, compared with those of the other, tell you more than any score.
#
# Had you skipped the reverse runs, the table would have one row. Driving backward,
# your feedforward would give a third of what friction takes, and you would not know why.
#
# **Reason 3: the way back.** The reverse run brings the robot to where it started, so the next test
# has room again.
#
# > **Lesson says:** "Skipping the reverse runs produces gains that only model the forward direction
# > accurately".
# >
# > **Source says:** a backward test right after a forward test "will more or less reset the
# > mechanism to its original position"
# > ([Creating a Routine](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/system-identification/creating-routine.html)).
# > SysId's maintainer has called backward tests not required for the fit of an elevator or arm
# > ([sysid issue 492](https://github.com/wpilibsuite/sysid/issues/492)).
# >
# > **Try it:** the last row of section 4's table is forward only. For a *symmetric* drivetrain it
# > is fine. Now set `lean` to 0 above: do the rows agree?

# %% [markdown]
# ## 6 Choose the ramp: how far will it go?
#
# Slow is precise (section 3). Is slow also safe? You have a hall of a certain length, and you want
# the robot to reach 1 m/s in the ramp. **Predict:**

# %%
guess_way = Prediction(
    "We halve the ramp, from 1 V/s to 0.5 V/s. How far does the robot travel until it does 1 m/s?",
    "half as far",
    "just as far",
    "twice as far",
    "four times as far",
)
guess_way

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
print(f"You said: {guess_way}.")
Table(
    (
        "ramp [V/s]",
        "distance to 1 m/s [m]",
        "kV·v²/(2·ramp) [m]",
        "voltage after 10 ft [V]",
        "distance in 10 s [m]",
    ),
    tuple(rows),
    caption="A ramp of 2 V/s reaches the battery's 12 V after 6 s, and ends there",
)

# %% [markdown]
# Twice as far. At half the ramp it takes twice the time to any speed, and so twice the distance:
#
# > **d ≈ kV·v² / (2·ramp)**
#
# So "slow is safe" is wrong where room is short. A ramp that is too slow runs out of floor before
# it has any speed, and a log without speed says little about kV. Choose the ramp so that it *just*
# fits.
#
# > **Lesson says:** clear "at least 10 feet forward and 10 feet back", with a ramp that is
# > "typically 0.5 V/s" and a timeout of 10 s.
# >
# > **Source says:** "at least 10' of space, ideally closer to 20'", and never on blocks, where the
# > robot's mass does not move. The library's default ramp is 1 V/s.
# > ([WPILib docs: Running the Routine](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/system-identification/running-routine.html),
# > [Creating a Routine](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/system-identification/creating-routine.html))
# >
# > **Try it:** in the table, row 0.5: how far does this drivetrain get in 10 s? And how many volts
# > does it see in 10 feet?

# %% [markdown]
# ## 7 Choose the step: hard enough, not too hard
#
# A large step gives a large acceleration, which stands out from the noise. Three things limit it.
#
# 1. **Grip.** Wheels slip when the motors push harder than the carpet holds. From standstill that
#    is above `V_slip = kS + kA·μ·g`, with the grip μ (about 1.1 on carpet; measure yours) and
#    g = 9.81 m/s², if all wheels are driven. When wheels spin, the encoder counts meters that the
#    robot does not go.
# 2. **Current.** At standstill a motor draws `stall_current · step / 12 V`. (The *stall current* is
#    on its data sheet: what it draws at 12 V when it cannot turn.) Above the controller's limit the
#    voltage is cut, and the rise begins as a straight line. (Phoenix 6 limits the current in a
#    motor to 120 A unless you change it.)
# 3. **Room.** The top speed is (step − kS)/kV, and your thumb needs its time.
#
# (For the limit see
# [CTRE's docs: CurrentLimitsConfigs](https://api.ctr-electronics.com/phoenix6/stable/csharp/api/CTRE.Phoenix6.Configs.CurrentLimitsConfigs.html).)
#
# And from below: **signal.** SysId takes the acceleration from neighboring speeds, so it is noisy.
# Let the first acceleration be ten times that noise or more.

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
    (
        "60 kg, 6.75:1",
        "kA [V·s²/m]",
        "step: at least [V]",
        "slips from [V]",
        "a limit of 120 A cuts from [V]",
    ),
    tuple(rows),
)

# %% [markdown]
# The same robot, other motors, another step. Strong motors slip early: 3.5 V is harmless for one of
# these two and spins the wheels of the other. Stay at 90 % of V_slip or less. You need kA for that
# *before* the test: compute it from mass and motors (lesson 1), or start with a small step.
#
# > **Lesson says:** "applies a large voltage step — typically 3–7V", and "Start with a step voltage
# > of 3–4V, not 7V".
# >
# > **Source says:** the library's default is 7 V. Its maintainer: "7 V is almost always too much,
# > but users should also be picking a good value specific to their system". A default of 4 V has
# > been proposed.
# > ([allwpilib issue 7794](https://github.com/wpilibsuite/allwpilib/issues/7794))
# >
# > **Try it:** change the mass: `replace(drivetrain, load=30.0, …)`. Does a light robot slip
# > earlier or later? (Look at kA in the formula.)
#
# The wheels of today's drivetrain never slip: its bench leaves that out. Lesson 6 shows what
# slipping looks like in a log.

# %% [markdown]
# ## 8 Choose when to stop: mark and timeout
#
# Two things end a test: your thumb at a **mark** on the floor, and the **timeout**. The timeout is
# for the day on which the thumb fails. Set it a little longer than the test needs.
#
# Does a long dynamic test harm the fit? We cut the same step after different times:

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
    step = cut.runs_of_test("dynamic-forward")[0]
    used = found.samples_used["dynamic-forward"]
    rows.append((f"{seconds:g} s", len(step), used, found.gains["kA"], float(step.position[-1])))
Table(
    ("step lasts", "rows", "rows used", "kA found [V·s²/m]", "it has gone [m]"),
    tuple(rows),
    caption=f"True kA: {truth['kA']:.3f} V·s²/m",
)

# %% [markdown]
# SysId uses the rows up to 90 % of the top speed and drops the rest, so kA does not mind a long
# test. Your wall does: look at the last column. After 3τ, everything about kA has been said.
#
# > **Lesson says:** "Running the dynamic test too long lets the mechanism overshoot its physical
# > limits or reach free speed, where acceleration collapses to zero and kA becomes unobservable."
# >
# > **Source says:** the first half is the real danger: stop early "if it exceeds safe limits". The
# > second half is not SysId's problem: it trims the step by itself. It *is* one of fits that do not
# > trim (lesson 7).
# > ([Running the Routine](https://docs.wpilib.org/en/stable/docs/software/advanced-controls/system-identification/running-routine.html),
# > [SysId's source: FilteringUtils.cpp](https://github.com/wpilibsuite/allwpilib/tree/v2026.2.2/sysid/src/main/native/cpp/analysis/FilteringUtils.cpp))
# >
# > **Try it:** compare the rows "0.2 s" and "7 s" of the table.

# %% [markdown]
# ## 9 Plan one
#
# Now all together: the drivetrain, a room of your choice, a thumb that is 0.3 s late. The picture
# shows where the robot is in both tests until it stands again; the table below it holds
# four of the rules of exercise 6, and the current limit. Find a plan that keeps them all in a room
# of 4 m. Then try 2.5 m.
#
# **Choose your limit first.** The current limit of the motor controller protects the motors and the
# battery, and it is a part of the robot that you measure. A step above it is cut at its start. So
# set the limit that you will drive with, then plan the step below it.

# %%
REACTION = 0.3  # [s] from the mark to the thumb off the button
FREE = (12.0 - truth["kS"]) / truth["kV"]  # [m/s]
SLIP = truth["kS"] + truth["kA"] * 1.1 * 9.81
OHMS = drivetrain.motor.resistance  # [Ω] of one motor: what limits its current from standstill


def driven(volts: np.ndarray, *, time: np.ndarray, mark: float) -> tuple[np.ndarray, np.ndarray]:
    """Position and speed of a test that a thumb ends; then 0 V, in brake mode."""
    place, _ = move_gains_only(truth, time=time, voltage=volts)
    if place[-1] > mark:
        off = time[int(np.argmax(place > mark))] + REACTION
        volts = np.where(time < off, volts, 0.0)
    return move_gains_only(truth, time=time, voltage=volts)


def plan(ramp: float, step: float, mark: float, room: float, limit: float = 120.0) -> Picture:
    """Both tests of a plan with a timeout of 8 s, and the rules it keeps or breaks."""
    time = np.arange(0.0, 10.0, 0.02)
    on = time < 8.0
    slow, slow_speed = driven(np.where(on, ramp * time, 0.0), time=time, mark=mark)
    hard, _ = driven(np.where(on, step, 0.0), time=time, mark=mark)
    far, moves = float(max(slow[-1], hard[-1])), 0.02 * int(np.count_nonzero(slow_speed > 0.02))
    share, slips, amps = 100 * float(slow_speed.max()) / FREE, 100 * step / SLIP, step / OHMS
    rules = (
        ("it stands again after [m]", far, f"at most {room:g}", far <= room),
        ("the ramp moves it for [s]", moves, "at least 3", moves >= 3),
        ("speed of the ramp [% of free speed]", share, "at least 25", share >= 25),
        ("step [% of the volts that slip]", slips, "at most 90", slips <= 90),
        ("a motor's current as the step begins [A]", amps, f"at most {limit:g}", amps <= limit),
    )
    rows = tuple(
        (rule, value, bound, "yes" if kept else "NO") for rule, value, bound, kept in rules
    )
    drawn = plot_curves(
        time,
        {"ramp": slow, "step": hard, "the mark on the floor": np.full(time.size, mark)},
        xlabel="time [s]",
        ylabel="position [m]",
        levels={"the end of the room": room},
    )
    return replace(drawn, table=Table(("rule", "your plan", "asked for", "kept"), rows))


show_interactive(
    plan,
    ramp=widgets.FloatSlider(
        min=0.2, max=2.0, step=0.05, value=0.5, description="ramp [V/s]", continuous_update=False
    ),
    step=widgets.FloatSlider(
        min=0.5, max=7.0, step=0.1, value=3.5, description="step [V]", continuous_update=False
    ),
    mark=widgets.FloatSlider(
        min=0.5, max=8.0, step=0.1, value=2.5, description="mark [m]", continuous_update=False
    ),
    room=widgets.FloatSlider(
        min=2.0, max=10.0, step=0.5, value=4.0, description="room [m]", continuous_update=False
    ),
    limit=widgets.FloatSlider(
        min=20.0, max=120.0, step=5.0, value=120.0, description="limit [A]", continuous_update=False
    ),
)

# %% [markdown]
# No sliders? Change the numbers here:

# %%
plan(ramp=0.5, step=3.5, mark=2.5, room=4.0)

# %% [markdown]
# The source lesson's 0.5 V/s and 3.5 V, in 4 m, break two rules: the ramp is too slow for the room,
# and the step spins the wheels of this strong drivetrain. Which slider repairs which rule?
#
# (What is simplified: the motors brake at 0 V, the floor is even, and the battery never sags. Leave
# more room than the plan says.)
#
# **A shooter has no end to its travel**, so its ramp may be as slow as the timeout allows. **An
# elevator** goes down by itself: it has the ends of its travel, and less time on the way down.

# %% [markdown]
# ## 10 System check
#
# Before you press the first button, all five:
#
# - [ ] You computed how far the ramp goes, `kV·v²/(2·ramp)`, and the room is longer than that.
# - [ ] The step is below 90 % of V_slip, and below the current limit.
# - [ ] The mark is on the floor, with room behind it for a late thumb. The timeout is set.
# - [ ] Four runs are planned: ramp and step, forward and reverse, each reverse right after its
#   forward.
# - [ ] The robot stands on the carpet it will drive on, not on blocks.
#
# ## 11 Knowledge check
#
# First one to click; you are told at once. (No buttons on your screen? Type
# `quick.answer("half as far")`, or another of the answers, in a cell.)

# %%
from grader import QuickCheck

quick = QuickCheck(
    "You halve the ramp and go to the same speed. How far does the mechanism travel?",
    {
        "half as far": "It takes longer to get there. Does it stand still meanwhile?",
        "just as far": "The speed at the end is the same, but the time to get there is not.",
        "twice as far": "It takes twice as long, at the same mean speed.",
    },
    right="twice as far",
)
quick

# %% [markdown]
# **1.** A flywheel has τ = 0.4 s and a true kS of 0.10 V. You read kS off a ramp of 0.5 V/s. What
# do you read, about?
#
# <details><summary>Answer</summary>
#
# kS + τ·ramp = 0.10 + 0.4·0.5 = 0.30 V, three times too much. SysId's fit knows about kA and does
# not make this mistake.
# </details>
#
# **2.** "We have only 3 m, so we ramp very slowly, to be safe." What do you say?
#
# <details><summary>Answer</summary>
#
# The distance to a speed is kV·v²/(2·ramp): half the ramp, twice the distance. In 3 m a very slow
# ramp hardly gets moving. Use a steeper ramp, a mark and a ready thumb.
# </details>
#
# **3.** In the information map the dots of each direction lie on one slanted line. Which runs are
# missing?
#
# <details><summary>Answer</summary>
#
# The ramps: under one constant voltage, acceleration falls evenly as the speed rises. Without a
# ramp, no gain can be told.
# </details>
#
# **4.** Forward alone gives kS = 0.14 V, reverse alone 0.38 V. What now?
#
# <details><summary>Answer</summary>
#
# Look at the robot, not at the fit. Something rubs in one direction: a brake, a chain, a bearing.
# A fit with one kS for both will spoil kA, and its score may stay high.
# </details>
#
# **5.** The rise after a step is a straight line that ends in a corner. What happened?
#
# <details><summary>Answer</summary>
#
# Something held the acceleration at one value: a current limit, or wheels that slip. Use a smaller
# step. A clean rise is exponential.
# </details>

# %% [markdown]
# ## 12 Practice
#
# **Exercise 6, part (a)** (`exercises/exercise6/README.md`). You get four mechanisms and plan their
# tests. In a terminal, in the course's folder:
#
# ```
# grade exercise6
# ```
#
# Any plan that keeps the rules passes. You may also answer from a notebook:
#
# ```python
# from grader import submit
# submit("exercise6", turret_ramp=0.8, turret_step=2.5, turret_timeout=6, turret_release=0.5)
# ```
#
# For the ramp and the mark you need section 6, for the step section 7, for the timeout section 8.
# Part (b) comes with lesson 5. Hints cost nothing: `grade exercise6 --hint`.
#
# **More, if you like.**
#
# - Draw section 3's drift for `MECHANISMS["turret"]`.
# - Make `lean` smaller. How small must it be until kA is off by less than 10 %?
# - Plan the ramp of your own robot for the longest hallway of your school. Then measure the
#   hallway.
#
# Next: lesson 4, wire a SysIdRoutine.
