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
# # Lesson 1: The motor model
#
# *About 40 minutes. You need lesson 0. No physics class is needed, and no calculus.*
#
# ![A voltage over time, and the three terms that it is the sum of. While the robot speeds up, all
# three are above zero. At a steady speed, kA·a is zero.](attachment:picture.png)
#
# **At the end you can**
#
# - say what kS, kV and kA mean, and in which unit each is;
# - split any voltage into its three parts;
# - compute the expected kV from the motor, the gears and the wheel, and say what to check when the
#   measured kV is very different;
# - say what the time constant kA/kV tells you;
# - recognize a kS that means "stop and repair the robot";
# - convert a gain per rotation into a gain per radian, in the right direction.

# %% [markdown]
# ## 1 Why: a gain is a price
#
# Each gain has a meaning and a unit. You can read a gain as a **price**: kV = 2.5 V·s/m says that
# each m/s of speed needs 2.5 volts.
#
# The analyzer (the window of WPILib's SysId) shows kV = 0.4. Can this kV be right? After this
# lesson you can answer this question in a minute, with the motor's data sheet and a calculator.

# %%
import math
from dataclasses import replace

import numpy as np
from IPython.display import display

import sim
from grader import ask_question, enable_checkboxes
from sim.bench.duty_cycle import Battery, simulate_duty_cycle
from sim.bench.mechanism import Mechanism
from sim.bench.mechanisms import MECHANISMS
from sim.bench.simulate import move_gains_only, simulate
from sim.fit import fit
from sim.physics.motors import MOTORS, compute_theoretical_kv
from sim.plot import Table, tabulate_gains
from sim.plot.animation import Choice, Gain, Knob, Motion, Panel, Scene, animate_mechanism
from sim.plot.animation.charts import Chart, animate_charts, chart_bands, compare_values
from sim.teaching.logs import apply_mistake

drivetrain = MECHANISMS["drivetrain"]
gains = drivetrain.gains
print(drivetrain.summary)

# %% [markdown]
# ## 2 The model: three prices
#
# > **V = kS·sgn(v) + kV·v + kA·a**
#
# V is the voltage at the motor, v is the velocity, and a is the acceleration (by how much v grows
# each second). sgn(v) is the *sign* of v: +1 forward and −1 backward. The model has three *terms*,
# one for each gain:
#
# | term | gives the voltage for | unit of the gain | is zero when |
# |---|---|---|---|
# | kS·sgn(v) | friction in bearings, gears, belts | V | the robot stands still |
# | kV·v | speed | V·s/m: volts for each m/s | the robot stands still |
# | kA·a | *changing* the speed | V·s²/m: volts for each m/s² | the speed is steady |
#
# Each term is in volts: V·s/m times m/s is V. If your mechanism turns, use rotations or radians
# instead of meters (section 8). A mechanism that moves up and down also needs volts for gravity:
# lesson 2.
#
# The kS term is the same at any speed; only its sign changes. (Real friction also has a part that
# grows with speed. That part is included in kV.)
#
# The next table shows the three terms of our simulated drivetrain in four moments. Cover the last
# row with your hand and compute it first (2 m/s *backward*).


# %%
def bill(v: float, a: float) -> dict[str, float]:
    """What each term takes at a velocity and an acceleration [V]."""
    return {"kS·sgn(v)": gains["kS"] * np.sign(v), "kV·v": gains["kV"] * v, "kA·a": gains["kA"] * a}


MOMENTS = {
    "2 m/s, steady": (2.0, 0.0),
    "2 m/s, and 3 m/s faster every second": (2.0, 3.0),
    "2 m/s, braking by 3 m/s every second": (2.0, -3.0),
    "2 m/s backward, steady": (-2.0, 0.0),
}
print(f"kS = {gains['kS']:.3f} V   kV = {gains['kV']:.3f} V·s/m   kA = {gains['kA']:.3f} V·s²/m")
rows = []
for name, (v, a) in MOMENTS.items():
    terms = bill(v, a)
    rows.append((name, *(float(volts) for volts in terms.values()), float(sum(terms.values()))))
Table(("moment", "kS·sgn(v) [V]", "kV·v [V]", "kA·a [V]", "together [V]"), tuple(rows))

# %% [markdown]
# While the robot brakes, v is still positive (it still moves forward), but a is negative. So the
# third term is negative: the robot needs fewer volts.
#
# A log shows this drivetrain at 2 m/s, with **7 V** on its motors. But the first row of the table
# says that a steady 2 m/s needs less than 7 V.
#
# **Predict:**

# %%
ask_question("lesson1.seven")

# %%
left = 7.0 - sum(bill(2.0, 0.0).values())
Table(
    ("rest of 7 V [V]", "if kA·a takes these volts, a is [m/s²]", "if a is zero, kV is [V·s/m]"),
    ((left, left / gains["kA"], (7.0 - gains["kS"]) / 2),),
)

# %% [markdown]
# We know this robot's gains. So kA·a takes the volts that are left: the robot is getting faster.
# For a robot with unknown gains, "7 V at 2 m/s" has a second explanation: the speed is steady, and
# kV is larger. To decide, check whether the velocity is still changing.

# %% [markdown]
# ## 3 Doing it: the voltage budget
#
# The next picture shows a drive. For every moment it computes the three terms from the robot's
# *motion*, and draws them as three colored areas, one on top of the other. The thick line is the
# voltage that the motors really got (the *applied* voltage). If the model is right, the areas reach
# this line.
# Move the slider below the picture: it sets the time, and the robot moves.
#
# There are three drives:
#
# - a **slow ramp**: the voltage grows slowly (SysId's *quasistatic* test);
# - a **sudden step**: the voltage jumps at once (SysId's *dynamic* test);
# - **there and back**: 5 V, then nothing, then −3 V, then nothing.
#
# **Predict:**

# %%
display(ask_question("lesson1.step"), ask_question("lesson1.ramp"))

# %%
DRIVES = {"slow ramp": 6.0, "sudden step": 0.6, "there and back": 3.0}  # and how long [s]


def voltage(which: str, time: np.ndarray) -> np.ndarray:
    """The voltage of a drive at each time."""
    if which == "slow ramp":
        return 0.5 * time
    if which == "sudden step":
        return np.where(time < 0.1, 0.0, 3.5)
    return np.select([time < 1.0, time < 1.5, time < 2.5], [5.0, 0.0, -3.0], 0.0)


def budget(which: str) -> Scene:
    """A drive of a robot whose mass and friction the sliders set: kA grows with the mass."""
    step = 0.002 if which == "sudden step" else 0.01  # [s] a jump must not look like a slope
    time = np.arange(0.0, DRIVES[which] + step / 2, step)
    price = {"kS": Gain("kS"), "kV": gains["kV"], "kA": Gain("mass", gains["kA"] / drivetrain.load)}
    return Scene(time, (Motion("robot", gains=price, voltage=voltage(which, time)),))


animate_mechanism(
    "drivetrain",
    {(name,): budget(name) for name in DRIVES},
    choices=(Choice("drive", tuple(DRIVES), value="sudden step"),),
    panels=(
        Panel("voltage", "voltage [V]", low=-5.0, high=6.0, terms=True),
        Panel("velocity", "velocity [m/s]", low=-1.5, high=2.5),
    ),
    knobs=(
        Knob("mass", "mass [kg]", low=20.0, high=80.0, step=5.0, value=60.0),
        Knob("kS", "kS [V]", low=0.05, high=1.0, step=0.05, value=0.15),
    ),
    alt="A robot drives. Below it, three colored areas show how many volts each term takes: "
    "kS·sgn(v), kV·v and kA·a. Right after a sudden step, nearly all volts are in kA·a. Then kV·v "
    "grows and kA·a shrinks. In the slow ramp, nearly all volts are in kV·v.",
)

# %%
print(f"In the slow ramp, kA·a soon takes {0.5 * gains['kA'] / gains['kV']:.2f} V.")

# %% [markdown]
# ### Explain
#
# - **Sudden step.** At first there is no speed, so nearly all volts go into kA·a. As the robot gets
#   faster, kV·v grows. Fewer volts are left for kA·a, so the acceleration gets smaller. SysId needs
#   this test, because **kA·a takes many volts only in this test.**
# - **Slow ramp.** The acceleration is small the whole time. Most volts go into kS and kV·v, so this
#   test shows **kS and kV**.
# - **The gap at the start of the ramp.** Until the voltage reaches kS, friction holds the robot.
#   Nothing moves, so there is no colored area.
# - **There and back.** When the voltage drops to 0 V, kA·a is negative, and the robot gets slower.
#
# Make the robot heavy, then light. Which area changes? Then increase the friction (kS). In the
# ramp, kA·a is small, but never zero: lesson 3 shows why this matters for kS.
#
# <details><summary>For mentors: is kS the intercept of the quasistatic test?</summary>
#
# > **Lesson says:** in the quasistatic test, kS "shows up as the initial voltage intercept before
# > velocity develops".
# >
# > **Source says:** nearly. WPILib says that kS is the voltage "to just barely get it moving". But
# > during a ramp the robot always accelerates a little, so the voltage also contains a little kA·a.
# > ([WPILib docs: Introduction to DC Motor
# > Feedforward](https://github.com/wpilibsuite/frc-docs/blob/250e32128d9a93f27d58bc3cd1d0b3ab5eec43cd/source/docs/software/advanced-controls/introduction/introduction-to-feedforward.rst))
# >
# > **Try it:** how many volts does kA·a take in the slow ramp? The cell above printed it. Lesson 3
# > shows how kA·a changes a kS that you find with a straight line.
# </details>

# %% [markdown]
# ## 4 Where the prices come from
#
# The table below says what each gain depends on. Its letters mean: R is the electrical resistance
# of the motor; Ke and Kt are two more constants from the motor's data sheet; G is the gear ratio
# (6.75:1 means that the motor turns 6.75 times for one turn of the wheel); r is the radius of the
# wheel; n is the number of motors; m is the mass.
#
# <details><summary>Want to know why? The derivation in three sentences</summary>
#
# An electric motor does three things, and each is a simple product:
#
# 1. **It pushes back.** A motor that turns is also a generator. It produces a voltage that acts
#    against yours and is proportional to its speed ω ("omega"): **Ke·ω**. This is called
#    *back-EMF*.
# 2. **The remaining voltage drives a current** through the winding's resistance R: I = (V − Ke·ω) /
#    R.
# 3. **The current makes torque**, a turning force: T = Kt·I.
#
# With gears of ratio G and a wheel of radius r, the torque T of n motors gives the force n·G·T/r.
# Part of that force works against friction, and the rest accelerates the mass m:
#
# > n·G·Kt·I / r = friction + m·a
#
# Combine the three equations, use ω = G·v/r, and solve for V:
#
# > V = R·r/(n·G·Kt) · friction + Ke·G/r · v + R·r·m/(n·G·Kt) · a
#
# This *is* the model.
# </details>
#
# | gain | is | so it depends on |
# |---|---|---|
# | kS | R·r/(n·G·Kt) · friction | friction, motors, gears, wheel |
# | kV | Ke·G/r | the kind of motor, gears, wheel |
# | kA | R·r·m/(n·G·Kt) | mass, motors, gears, wheel |
#
# In the table, the mass m is only in kA, as you saw in lesson 0. (We leave out losses in the gears,
# and the mass of the spinning parts.)
#
# The next cell computes kV and kA from the motor's data, and compares them with a log:

# %%
kraken = drivetrain.motor
G, r, n, m = drivetrain.ratio, drivetrain.radius, drivetrain.motor_count, drivetrain.load
volts_per_newton = kraken.resistance * r / (n * G * kraken.torque_constant)
by_hand = {"kV": kraken.back_emf * G / r, "kA": volts_per_newton * m}

log = simulate(drivetrain, sim.Routine(ramp=1.0, step=2.0), rng=np.random.default_rng(1))
measured = fit(log, method="sysid").gains
print(f"R = {1000 * kraken.resistance:.1f} mΩ   Ke = {kraken.back_emf:.5f} V·s/rad")
print(f"Kt = {kraken.torque_constant:.5f} N·m/A   G = {G}   r = {r} m   n = {n}   m = {m:g} kg")
for gain, unit in (("kV", "V·s/m"), ("kA", "V·s²/m")):
    print(f"{gain}: {by_hand[gain]:.3f} {unit} from the data, {measured[gain]:.3f} from the log")

# %% [markdown]
# You have to measure kS: no data sheet contains your robot's friction.
#
# **Predict:**

# %%
ask_question("lesson1.gears")


# %%
def other_parts(ratio: str, motors: str, wheel: str, mass: float) -> Chart:
    """How kS, kV and kA change with other parts; ``wheel`` is a diameter in inches."""
    radius, gears = float(wheel) * 0.0254 / 2, float(ratio)
    per_newton = (radius / (int(motors) * gears)) / (r / (n * G))  # the force of friction stays
    turns = (gears / radius) / (G / r)  # of the motor for a meter
    change = {"kS": per_newton, "kV": turns, "kA": per_newton * mass / m}
    return compare_values(change, truth=1.0, xlabel="now ÷ before (dashed: the same)")


animate_charts(
    other_parts,
    choices=(
        Choice("gears : 1", ("6.75", "8.14", "5.36")),
        Choice("motors", ("4", "2", "6")),
        Choice("wheel [in]", ("4", "3", "6")),
    ),
    knobs=(Knob("mass", "mass [kg]", low=20.0, high=80.0, step=5.0, value=60.0),),
)

# %% [markdown]
# With the 8.14:1 gears the motor turns faster for each m/s, so each m/s needs **more** volts. But
# the gears make more force from the same motor torque, so acceleration needs **fewer** volts. With
# half the motors, each motor has twice the load, so kS and kA double. kV stays the same.

# %% [markdown]
# ## 5 Is this kV possible?
#
# A data sheet gives the **free speed**: how fast the motor turns at 12 V with nothing attached.
# From the free speed you can compute the expected kV, the **theoretical kV**:
#
# > theoretical kV = 12 V / (free speed of the *mechanism*)
#
# The data sheet gives the speed of the motor alone, without gears, in rpm (rotations per minute).
# So the next cell converts it to the mechanism's speed:

# %%
rpm = kraken.free_speed * 60 / (2 * math.pi)
motor_turns = rpm / 60
wheel_turns = motor_turns / G
free_speed = wheel_turns * math.pi * 2 * r
print(f"{rpm:.0f} rpm are {motor_turns:.2f} turns of the motor per second")
print(f"... divided by the ratio {G}: {wheel_turns:.2f} turns of the wheel per second")
print(f"... times the circumference {math.pi * 2 * r:.4f} m: {free_speed:.2f} m/s")
print(f"theoretical kV: 12 V / {free_speed:.2f} m/s = {12 / free_speed:.3f} V·s/m")
print(f"With kV = 0.4 V·s/m, 12 V would give 12 / 0.4 = {12 / 0.4:.0f} m/s: no robot is so fast.")

# %% [markdown]
# The next table has the theoretical kV of eight motors without gears. WPILib's class for motor
# data, `DCMotor`, has a slightly lower kV: it first subtracts the voltage that is lost inside the
# motor. The last column says how much lower. (FOC is a mode of the Kraken that needs a paid
# license.)
#
# <details><summary>For mentors: 12 V ÷ free speed, with source</summary>
#
# > **Lesson says:** "kV_theoretical = 12V ÷ free_speed_in_your_units."
# >
# > **Source says:** this formula is a good first check. More exactly, kV follows from a constant of
# > the motor. WPILib's `DCMotor` first subtracts the small voltage drop that the free current
# > causes, so its kV is a little lower. ([WPILib's source:
# > DCMotor.java](https://github.com/wpilibsuite/allwpilib/blob/v2026.2.2/wpimath/src/main/java/edu/wpi/first/math/system/plant/DCMotor.java))
# >
# > **Try it:** the table's last column says how much lower this kV is, for eight motors without
# > gears.
# </details>

# %%
NAMES = ["krakenX60", "krakenX60FOC", "krakenX44", "falcon500", "neo", "neoVortex", "minion", "cim"]
TURN = 2 * math.pi  # [rad]
rows = []
for name in NAMES:
    one = MOTORS[name]
    theory, exact = compute_theoretical_kv(one, ratio=1.0) * TURN, one.back_emf * TURN
    lower = f"{100 * (1 - exact / theory):.1f} %"
    rows.append((name, f"{one.free_speed * 60 / TURN:.0f}", f"{theory:.4f}", f"{exact:.4f}", lower))
Table(
    ("motor", "free speed [rpm]", "12 V ÷ free speed [V·s/rot]", "DCMotor [V·s/rot]", "lower by"),
    tuple(rows),
)

# %% [markdown]
# ### Measured kV against theory
#
# A real kV is a little **above** the theoretical kV, because a part of the friction grows with the
# speed. If the measured kV is far above theory, something is wrong. If it is **below**, somebody
# wrote down a wrong number, because a motor cannot turn faster than its free speed.
#
# | measured kV | verdict | what to do |
# |---|---|---|
# | below the theoretical kV | *bookkeeping* (a wrong number) | find the wrong number |
# | 0 to 8 % above | *ok* | nothing |
# | 8 to 20 % above | *watch* | compare again next week |
# | more than 20 % above | *inspect* | look for the cause before the next test |
#
# (These limits are rough rules. Data sheets are rounded, so 1 or 2 % below proves nothing.)
#
# Here are seven robots with the same drivetrain. All except the first have one fault. Which robots
# have a kV more than 20 % above theory? The picture shows three of the seven robots, and the table
# shows all of them.
#
# **Predict:**

# %%
ask_question("lesson1.cause")

# %%
sound = replace(drivetrain, drag=0.05)
quick = sim.Routine(ramp=1.0, step=2.0)
THEORY = 12 / free_speed


def bench(robot: Mechanism, seed: int) -> sim.Log:
    """The four tests of a robot."""
    return simulate(robot, quick, rng=np.random.default_rng(seed))


tired = Battery(rest=11.0, resistance=0.02)
sagging = simulate_duty_cycle(sound, quick, battery=tired, rng=np.random.default_rng(6))
STORIES = {
    "no fault": bench(sound, 1),
    "10 kg more": bench(replace(sound, load=sound.load + 10), 2),
    "a part that rubs": bench(replace(sound, friction=0.8), 3),
    "thick grease in the gears": bench(replace(sound, drag=0.30), 4),
    "code says 8.14, robot has 6.75": apply_mistake(bench(sound, 5), factor=6.75 / 8.14),
    "diameter used as radius": apply_mistake(bench(sound, 7), factor=2.0),
    "set(volts / 12), logs volts": apply_mistake(sagging, commanded=True),
}
VERDICTS = {"bookkeeping": 0.0, "ok": 8.0, "watch": 20.0, "inspect": 40.0}
SETS = {story: fit(log, method="sysid").gains for story, log in STORIES.items()}
ABOVE = {story: 100 * (found["kV"] / THEORY - 1) for story, found in SETS.items()}  # [%]

SHORT = {"no fault": "no fault", "thick grease in the gears": "grease"}
SHORT |= {"diameter used as radius": "wrong wheel"}
marks = {name: ABOVE[story] for story, name in SHORT.items()}
animate_charts(lambda: chart_bands(marks, VERDICTS, xlabel="kV above theory [%]"))

# %%
above = [f"{share:+.0f} %".replace("-", "−") for share in ABOVE.values()]
tabulate_gains(SETS, first="robot", more={"kV above theory": above})

# %% [markdown]
# ### Explain
#
# - **Mass** changes kA. **Constant friction** changes kS. Neither changes kV.
# - **Friction that grows with speed** increases kV. Examples are thick grease, a dry bearing or
#   some belts. (A belt that is only too tight increases kS.)
# - **Wrong numbers** (gear ratio, wheel size, unit) multiply kV *and* kA by the same factor. They
#   do not change kS.
# - **A voltage that never reached the motors** makes the robot look slower than it is.
#   `set(volts / 12)` sets a fraction of the battery voltage, not a voltage. With an 11 V battery
#   the motors get at most 11/12 of what the log says, and less when a large current pulls the
#   battery voltage down. All three gains are wrong.
#
# When kV is more than 20 % above the theoretical kV, check the easiest things first:
#
# 1. **Numbers** (at a desk): check gear ratio, wheel size, units and the kind of motor.
# 2. **Electrical** (in the log): did the logged voltage really reach the motors, and all of them?
#    If one motor gets no voltage, the others do its work, and kS and kA grow. If its controller
#    is in *brake mode*, that motor also slows the others down, and kV grows, too.
# 3. **Mechanical** (with a wrench): check belt, chain, bearings and grease. Turn the mechanism by
#    hand. Is any part hot after a test?
#
# ### Check somebody else's numbers
#
# One published lesson gives a drivetrain with kV = 2.68 V·s/m, a ratio of 8.46, 4 inch wheels and
# TalonFX motors. A TalonFX is a controller that is built into three kinds of motor: Falcon 500,
# Kraken X60 and Kraken X44. Which of the three could it be?
#
# <details><summary>For mentors: the source lesson's drivetrain</summary>
#
# > **Lesson says:** "kV = 2.68", "GEAR_RATIO = 8.46" and a wheel of "4 in", with TalonFX motors.
# >
# > **Source says:** WPILib gives the free speeds of these motors (see the table above). ([WPILib's
# > source:
# > DCMotor.java](https://github.com/wpilibsuite/allwpilib/blob/v2026.2.2/wpimath/src/main/java/edu/wpi/first/math/system/plant/DCMotor.java))
# >
# > **Try it:** which of these motors could have been in that robot?
# </details>

# %%
rows = []
for name in ("falcon500", "krakenX60", "krakenX44"):
    theory = compute_theoretical_kv(MOTORS[name], ratio=8.46, radius=0.0508)
    rows.append((name, theory, f"{100 * (2.68 / theory - 1):+.0f} %".replace("-", "−")))
Table(("motor", "theoretical kV [V·s/m]", "2.68 is above it by"), tuple(rows))

# %% [markdown]
# With kV = 2.68, the first two motors would have to turn faster than they can. Either that robot
# had Kraken X44 motors, or one of its numbers is wrong.

# %% [markdown]
# ## 6 How fast is it: τ = kA/kV
#
# Divide kA by kV and look at the units: V·s²/m divided by V·s/m is **seconds**. This time is called
# the **time constant**, τ ("tau"). SysId's window calls it *Response Timescale* and shows it in
# milliseconds.
#
# After a step of voltage, the velocity rises fast, then slower and slower. After one τ the velocity
# has reached 63 % of the final speed. In each further τ it gains 63 % of what is still missing.
# (Such a curve is called *exponential*.) After 3 τ the velocity has almost reached the final speed.
# In the picture, four mechanisms get the same step of 4 V, in slow motion. Which has the longest τ?

# %%
KINDS = ["drivetrain", "shooter", "intake", "turret"]


def tau(kind: str) -> float:
    """The time constant of a mechanism [s]."""
    return MECHANISMS[kind].gains["kA"] / MECHANISMS[kind].gains["kV"]


def spin_up(kind: str, time: np.ndarray) -> Motion:
    """How a mechanism gets up to speed after a step of 4 V, as a share of its final speed."""
    price = MECHANISMS[kind].gains
    _, velocity = move_gains_only(price, time=time, voltage=np.full(time.size, 4.0))
    return Motion(kind, velocity=velocity / ((4.0 - price["kS"]) / price["kV"]))


since = np.arange(0.0, 1.501, 0.01)
animate_mechanism(
    "flywheel",
    Scene(since, tuple(spin_up(kind, since) for kind in KINDS)),
    panels=(Panel("velocity", "share of its final speed [%]", low=0.0, high=105.0, scale=100.0),),
    slow=12.0,
    alt="Four wheels show how four mechanisms speed up after a step of 4 V. Each reaches its final "
    "speed at another time.",
)

# %%
Table(
    ("mechanism", "τ [ms]", "rows of the log during one τ", "3 τ [ms]"),
    tuple((kind, 1000 * tau(kind), tau(kind) / 0.02, 3000 * tau(kind)) for kind in KINDS),
)

# %% [markdown]
# Look at the third column. A robot program writes one row of the log every 20 ms. If τ is only two
# or three rows long, the log hardly shows the acceleration, and kA is uncertain. Then the robot
# must write more rows each second.

# %% [markdown]
# ## 7 kS: when to get a wrench
#
# A low kS means that the mechanism turns easily. A high kS means friction: a tilted bearing, a bent
# shaft, a screw that rubs. Do not just put a high kS into the code: then nobody notices which part
# is wearing out.
#
# How high is too high? One rule says: stop if kS is much higher than kV × typical velocity. Our
# drivetrain's typical velocity is 2 m/s. How large must kS be before the rule says *stop*?
#
# <details><summary>For mentors: the rule, and its source</summary>
#
# > **Lesson says:** a kS "that's much higher than kV × typical velocity suggests something is
# > mechanically wrong".
# >
# > **Source says:** the units agree: kV·v is in volts, and kS is in volts, too. WPILib calls kS the
# > voltage to "just barely get it moving", and gives no upper limit. The next cell shows how much
# > friction this rule allows. ([WPILib docs: Introduction to DC Motor
# > Feedforward](https://github.com/wpilibsuite/frc-docs/blob/250e32128d9a93f27d58bc3cd1d0b3ab5eec43cd/source/docs/software/advanced-controls/introduction/introduction-to-feedforward.rst))
# >
# > **Try it:** our drivetrain's typical velocity is 2 m/s. How large must kS be before this rule
# > says *stop*?
# </details>

# %%
TYPICAL = 2.0  # [m/s] in a match
flag = gains["kV"] * TYPICAL
print(f"kV × {TYPICAL:g} m/s = {flag:.1f} V. The rule says stop only if kS is above this voltage,")
print(f"which is {100 * flag / 12:.0f} % of 12 V. Our drivetrain's kS is {gains['kS']:.2f} V.")

# %% [markdown]
# So this rule warns very late. Add a second rule that warns earlier, named **watch**: kS is above
# 0.5 V, which is about 4 % of 12 V. (This rule is our own. Some healthy mechanisms with a high gear
# ratio are above it.)
#
# Two more signs warn you, even if kS is below both limits:
#
# - **kS has grown since last week.** Write kS down each time.
# - **Left and right differ.** They are built the same, so they should have the same friction. For
#   example, 0.15 V on the left and 0.45 V on the right are both below our limit. But the right side
#   has three times the friction of the left side.

# %% [markdown]
# ## 8 Units: per rotation, per radian, per meter
#
# A full turn is 1 rotation, or 2π = 6.28 radians, or 360 degrees.
#
# **Predict:**

# %%
shooter = MECHANISMS["shooter"].gains
per_rotation = shooter["kV"] * TURN
ask_question("lesson1.unit", kV=per_rotation)

# %%
SPEEDS = {"rot/s": 50.0, "rad/s": 50.0 * TURN, "deg/s": 50.0 * 360.0, "rpm": 50.0 * 60.0}
rows = [
    (name, f"{speed:.0f}", per_rotation * 50.0 / speed, per_rotation * 50.0)
    for name, speed in SPEEDS.items()
]
Table(("unit", "the same speed in this unit", "kV [V for one unit]", "kV·v [V]"), tuple(rows))

# %% [markdown]
# The same speed needs the same volts in every unit: look at the last column. 50 rot/s is 314 rad/s,
# so each rad/s needs fewer volts. **The number of the speed gets 6.28 times larger, and the gain
# gets 6.28 times smaller.**
#
# - From V·s/rot to V·s/rad: **divide** by 2π. Do the same with kA. kS is in volts, so it stays.
# - From V·s/rot of a wheel to V·s/m: divide by the wheel's circumference.
#
# Two traps:
#
# - WPILib's `Units.rotationsToRadians(x)` *multiplies* by 2π. It is for positions and speeds. If
#   you use it on a **gain**, the gain changes in the wrong direction and is (2π)² = 39.5 times too
#   large.
# - kV and the velocity that you pass to the feedforward must be in the **same** unit. The code does
#   not notice when they differ.

# %%
per_radian = per_rotation / TURN
wrong = per_rotation * TURN
wheel = 4 * 0.0254  # [m] a 4 inch wheel
print(f"right:  {per_rotation:.4f} V·s/rot / 2π = {per_radian:.5f} V·s/rad")
print(f"wrong:  {per_rotation:.4f} · 2π = {wrong:.4f}, {wrong / per_radian:.1f} times too large")
print(f"4 inch wheel: kV = 0.8 V·s/rot is the same as {0.8 / (math.pi * wheel):.3f} V·s/m")

# %% [markdown]
# ## 9 System check
#
# Before you trust any gains, check all five:
#
# - [ ] Each gain has its **unit** written next to it.
# - [ ] kV is positive, and 0 to 8 % above the theoretical kV. If it is not, you know why.
# - [ ] kS is below 0.5 V, the same left and right, and the same as last week.
# - [ ] kA/kV fits the mechanism: tens of milliseconds if it is light, hundreds if it is heavy for
#   its motors.
# - [ ] The velocity that you pass to the feedforward has the same length or angle unit as kV.
#
# ## 10 Knowledge check
#
# Type an answer to the first question; you get feedback at once. (If you see no box, type
# `ask_question("lesson1.quick").answer("0.5 V·s/rad")` in a cell.)

# %%
display(ask_question("lesson1.quick"), enable_checkboxes())

# %% [markdown]
# **1.** A mechanism has kS = 0.2 V and kV = 3.4 V·s/m. It moves at a steady 2 m/s with 7 V. How
# many volts does each term take?
#
# <details><summary>Answer</summary>
#
# Friction takes 0.2 V, and speed takes 3.4 · 2 = 6.8 V. The acceleration needs 0 V, because at a
# steady speed there is no acceleration.
# </details>
#
# **2.** A turret has kA = 0.05 V·s²/rad. How large is this kA in V·s²/rot?
#
# <details><summary>Answer</summary>
#
# Multiply by 2π: 0.05 · 6.283 = 0.314 V·s²/rot. 1 rot/s² is a larger acceleration than 1 rad/s², so
# it needs more volts.
# </details>
#
# **3.** A drivetrain's kV is 25 % above the theoretical kV. A teammate says: "It is the new
# bumpers, they are heavy." What do you say, and where do you look first?
#
# <details><summary>Answer</summary>
#
# Mass changes kA; it cannot change kV. First check the numbers: gear ratio, wheel, units, kind of
# motor. Then check the log: did the logged voltage reach the motors? Then check belts and bearings.
# </details>
#
# **4.** Another drivetrain's kV is 15 % *below* the theoretical kV. A teammate says: "Great, our
# robot is better than theory." Is that right?
#
# <details><summary>Answer</summary>
#
# No. A motor does not turn faster than its free speed at 12 V. A number is wrong: the ratio, the
# wheel, the unit or the kind of motor.
# </details>
#
# **5.** Last week the left side of a drivetrain had kS = 0.15 V. Today its kS is 0.40 V. Typical
# speed times kV is 5 V. Is the left side fine?
#
# <details><summary>Answer</summary>
#
# No, although 0.40 V is below both limits of section 7: kS has more than doubled in a week. Compare
# it with the kS of the right side, and look for the part that rubs.
# </details>
#
# **6.** An intake has τ = 15 ms, and the robot logs every 20 ms. What does that mean for kA?
#
# <details><summary>Answer</summary>
#
# In 20 ms, the intake reaches three quarters of its final speed. So at most one or two rows of the
# log show an acceleration, and kA is uncertain. kV is not affected. Let the robot write more rows
# each second.
# </details>

# %% [markdown]
# ## 11 Practice
#
# **Exercise 1: voltage budget**
# ([exercises/exercise1/README.md](../exercises/exercise1/README.md)). You compute the voltages of
# your own mechanism in four moments. You need sections 2 and 8. In a terminal, type:
#
# ```
# grade exercise1
# ```
#
# You can also answer in a notebook, with your own numbers in place of the dots:
#
# ```python
# from grader import submit
# submit("exercise1", forward=..., accelerating=..., braking=..., backward=...)
# submit("exercise1", kV_unit="...", largest="...")
# ```
#
# **Exercise 2: kV against theory**
# ([exercises/exercise2/README.md](../exercises/exercise2/README.md)). You get the numbers of a team
# that may have made a mistake. You need sections 5 and 7.
#
# ```
# grade exercise2
# ```
#
# Hints cost nothing: `grade exercise1 --hint`. If you write into `answers.toml` with an editor,
# start `grade watch exercise1`: it grades each time you save.
#
# **On your own robot:** compute its theoretical kV today. Write it into your constants file as a
# comment, so your team can compare when you measure it again.
#
# <details><summary>More, if you like</summary>
#
# - In which drive of section 3 is kA·a the most negative?
# - Which mass would give our drivetrain a τ of 200 ms?
# - Look up your robot's motors in `sim/physics/motors.py`. Do the free speeds agree with the data
#   sheets?
# </details>
#
# **Next:** [Lesson 2, gravity](02_gravity.ipynb). What holds an elevator up?
