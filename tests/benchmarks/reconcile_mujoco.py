"""Move a case's mechanism by MuJoCo: physics that was written by others, for other robots.

Inertia, weight, dry friction, back-EMF, stops, springs, and joints that give or have play are
MuJoCo's, in volts instead of newtons. What a motor controller and a sensor make of a command and of
a motion are the effects' own functions, asked in every step. Nothing is exact as on the bench:
friction creeps a little at rest, stops and teeth give a little, steps are of a millisecond.
Motor and load each have a share of the friction, wheels that slip have all of it; what pulls does
so at the load.

Words of a scene: https://mujoco.readthedocs.io/en/stable/XMLreference.html#body-joint
"""

import inspect
import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace
from functools import partial
from types import SimpleNamespace
from xml.etree.ElementTree import Element, SubElement, tostring

import mujoco
import numpy as np
from reconcile_strangers import SHAKES

from sim.bench.mechanism import Mechanism
from sim.bench.routine import Routine
from sim.bench.sensor_model import read_sensor
from sim.bench.simulate import PAUSE, _find_end, _find_start, _make_loop_times
from sim.core.log import Array, Run
from sim.core.units import find_unit
from sim.physics.effect import HOOK_ARGUMENTS
from sim.physics.effects import find_effect as find
from sim.physics.engine.model_arrays import COARSEST
from sim.physics.model import Part

STEP = 0.001  # [s]
G = 9.81  # [m/s²]
FIRM = "0.004 1"  # [s], [1] in which stops and teeth give, and dry friction holds (solref)
GRIPS = "0.98 0.998 0.001"  # how much of it holds (solimp); the default lets it creep
STILL = 1e-6  # [unit/s] below which friction goes by where the voltage pushes
LOOKS = 20  # [samples] between two looks whether someone has ended the test
WIDEST = 2.5  # [standard deviations] by which friction differs from run to run at most
Act = Callable[[Mapping[str, object]], float]
MOVED_BY_SCENE = ("spring",)  # terms that are springs of MuJoCo


def moved(
    mechanism: Mechanism,
    routine: Routine,
    *,
    rng: np.random.Generator,
    period: float,
    wobble: float = 0.0,
) -> list[Run]:
    """The runs of a session.

    Args:
        mechanism: with what is hidden in it.
        routine: its voltages.
        rng: the source of chance.
        period: [s] between samples.
        wobble: [share] by which friction differs from run to run.
    """
    body = _Body(mechanism)
    runs: list[Run] = []
    start, last = PAUSE, 0.0
    for test in routine.tests:
        time = _make_loop_times(mechanism, routine, test, period=period, rng=rng)
        volts = np.array([routine.command_voltage(test, one) for one in time.tolist()])
        rubs = 1.0 + wobble * float(np.clip(rng.standard_normal(), -WIDEST, WIDEST))
        body.clock = float(start + time[0] - (runs[0].time[0] if runs else start + time[0]))
        position, velocity = body.run(test, last, time, volts, rubs=rubs)
        time, volts = time[: position.size], volts[: position.size]
        seen = body.sees(time, position, velocity)
        sensed = read_sensor(mechanism.sensor, position=position, velocity=seen, time=time, rng=rng)
        runs.append(Run(test, start + time, volts, *sensed))
        body.rests(PAUSE)
        start, last = start + float(time[-1]) + PAUSE, float(position[-1])
    return runs


def scene(mechanism: Mechanism) -> str:
    """The mechanism in MuJoCo's own words: a motor, and a load if something joins the two."""
    gains = mechanism.gains
    turns = find_unit(mechanism.units).angular
    joint = {"type": "hinge" if turns else "slide", "axis": "0 -1 0" if turns else "0 0 1"}
    weight, arm = gains.get("kG", 0.0), mechanism.type == "arm"
    between = _between(mechanism)
    share = between.parameters["share"] if between else 1.0
    heavy = gains["kA"] * ((1.0 - share) if between else 1.0)  # what weighs
    root = Element("mujoco")
    SubElement(root, "compiler", angle="radian")
    down = weight / heavy if not arm else G
    SubElement(
        root, "option", timestep=f"{STEP}", gravity=f"0 0 {-down}", integrator="implicitfast"
    )
    motor = SubElement(SubElement(root, "worldbody"), "body", name="motor")
    drive = SubElement(motor, "joint", name="motor", **joint)
    rubs = {"frictionloss": f"{gains['kS']}", "solreffriction": FIRM, "solimpfriction": GRIPS}
    drive.attrib |= {"damping": f"{gains['kV']}", **rubs}
    end = drive
    if between:  # what is moved in the end lies on its stops, and rubs
        end = SubElement(SubElement(root, "tendon"), "fixed", name="end", **rubs)
        for name in ("motor", "load"):
            SubElement(end, "joint", joint=name, coef="1")
    if mechanism.stops:
        low, high = mechanism.stops
        end.attrib |= {"limited": "true", "range": f"{low} {high}", "solreflimit": FIRM}
    for part in (one for one in mechanism.hidden if one.effect in MOVED_BY_SCENE):
        rate, preload = part.parameters["rate"], part.parameters["preload"]
        relaxed = "springlength" if between else "springref"
        end.attrib |= {"stiffness": f"{rate}", relaxed: f"{-preload / rate}"}
    if between:
        motor.set("gravcomp", "1")
        _filled(motor, gains["kA"] * share, out=0.0)
        load = SubElement(motor, "body", name="load")
        SubElement(load, "joint", name="load", **joint, **_joins(between, gains["kA"]))
    _filled(load if between else motor, heavy, out=G * heavy / weight if arm and weight else 0.0)
    return tostring(root, encoding="unicode")


def _filled(body: Element, inertia: float, *, out: float) -> None:
    """Give a body its inertia; ``out`` [m] from its axis as a point, if that is not zero."""
    if out:
        mass, rest = inertia / out**2, 1e-6 * inertia
    else:
        mass = rest = inertia
    place, around = f"{out} 0 0", f"{rest} {rest} {rest}"
    SubElement(body, "inertial", pos=place, mass=f"{mass}", diaginertia=around)


def _joins(part: Part, ka: float) -> dict[str, str]:
    """What joins motor and load."""
    values = part.parameters
    if part.effect == "backlash":
        half = 0.5 * values["slack"]
        return {"limited": "true", "range": f"{-half} {half}", "solreflimit": FIRM}
    if part.effect == "wheel-slip":  # the floor holds as dry friction does
        return {
            "frictionloss": f"{values['grip']}", "solreffriction": FIRM, "solimpfriction": GRIPS
        }  # fmt: skip
    stiff = 1.0 / values["softness"]
    reduced = ka * values["share"] * (1.0 - values["share"])
    damping = 2.0 * values["damping"] * math.sqrt(stiff * reduced)
    return {"stiffness": f"{stiff}", "damping": f"{damping}"}


def _between(mechanism: Mechanism) -> Part | None:
    """What stands between motor and load, if anything does."""
    joints = (part for part in mechanism.hidden if find(part.effect).kind == "two-body")
    return next(joints, None)


def _in_steps(part: Part) -> Part:
    """The same; what pushes at random in each step pushes as much in shorter ones, all in all."""
    if part.effect != SHAKES.name:
        return part
    volts = part.parameters["volts"] * math.sqrt(COARSEST / STEP)
    return replace(part, parameters={**part.parameters, "volts": volts})


class _Body:
    """A mechanism that moves, and what its effects remember."""

    def __init__(self, mechanism: Mechanism) -> None:
        self.mechanism = mechanism
        self.model = mujoco.MjModel.from_xml_string(scene(mechanism))
        self.data = mujoco.MjData(self.model)
        self.kv, self.ka = mechanism.gains["kV"], mechanism.gains["kA"]
        self.ks = mechanism.gains["kS"]
        between = _between(mechanism)
        joined = between and find(between.effect).is_joint
        self.share = between.parameters["motor_friction"] if joined else 1.0  # of friction
        self.memory = {part.effect: 0.0 for part in mechanism.hidden}
        self.clock = self.more = 0.0  # [s] since the log began; [V·s²/unit] of inertia beyond kA
        parts = sorted(mechanism.hidden, key=lambda part: find(part.effect).order)
        self.acts = {hook: list(_acts(parts, hook)) for hook in HOOK_ARGUMENTS}

    def run(
        self, test: str, last: float, time: Array, volts: Array, *, rubs: float
    ) -> tuple[Array, Array]:
        """Position and velocity (n,) at the samples until someone ends the test."""
        mujoco.mj_resetData(self.model, self.data)
        self.data.qpos[0] = _find_start(self.mechanism, test, last)
        arrives = time + sum(self._ask("command_delay"))
        motion, kept = np.empty((time.size, 2)), []
        now, command = float(time[0]), -1
        for sample, due in enumerate(time.tolist()):
            while now < due - 0.5 * STEP:
                while command + 1 < time.size and arrives[command + 1] <= now + 0.5 * STEP:
                    command += 1
                self._step(float(volts[command]) if command >= 0 else 0.0, rubs)
                now += STEP
            speed = float(self.data.qvel[0])
            motion[sample] = self.data.qpos[0] + (due - now) * speed, speed
            kept.append(dict(self.memory))
            if sample % LOOKS == LOOKS - 1 or sample == time.size - 1:
                track = SimpleNamespace(position=motion[: sample + 1, 0])
                end = _find_end(track, self.mechanism, test=test)
                if end <= sample:
                    break
        self.memory = kept[end - 1]
        return motion[:end, 0], motion[:end, 1]

    def sees(self, time: Array, position: Array, velocity: Array) -> Array:
        """(n,) the velocity that the sensor says."""
        seen = velocity
        motion = {"time": time, "position": position, "velocity": velocity}
        for _, act in self.acts["transform_velocity"]:
            seen = np.array(
                [act({"seen": one, "now": now, **motion}) for now, one in enumerate(seen.tolist())]
            )
        return seen

    def rests(self, pause: float) -> None:
        """Let what is remembered fade for so many seconds."""
        self._remember(0.0, 0.0, pause)

    def _step(self, volts: float, rubs: float) -> None:
        v, y, z = (float(one) for one in (self.data.qvel[0], *self._load))
        at_motor = volts
        for effect, act in self.acts["transform_voltage"]:
            known = {"u": at_motor, "v": v, "kv": self.kv, "memory": self.memory[effect]}
            at_motor = act(known)
        self._remember(at_motor, v, STEP)
        way = math.copysign(1.0, v if abs(v) > STILL else at_motor)
        grips = sum(self._ask("coulomb_friction", v=v, way=way))
        rub = max(rubs * self.ks + grips, 0.0)
        self.model.dof_frictionloss[0] = self.share * rub
        self.model.tendon_frictionloss[:] = (1.0 - self.share) * rub
        if self.acts["added_inertia"]:
            self._carry()
        self.data.qfrc_applied[:] = -sum(self._ask("force", x=y, v=z))
        self.data.qfrc_applied[0] += at_motor
        mujoco.mj_step(self.model, self.data)
        self.clock += STEP

    @property
    def _load(self) -> tuple[float, float]:
        """Position and velocity of what is moved in the end; a joint's is beside the motor's."""
        return self.data.qpos.sum(), self.data.qvel.sum()

    def _carry(self) -> None:
        """Take up inertia, or give it away; what was at rest takes its share of the momentum."""
        more = sum(self._ask("added_inertia", clock=self.clock))
        if more > self.more:
            kept = (self.ka + self.more) / (self.ka + more)
            self.data.qvel[:] *= 1.0 - sum(self._ask("impact")) * (1.0 - kept)
        self.model.dof_armature[0] = more
        self.model.dof_M0[0] += more - self.more  # what MuJoCo keeps where nothing else couples
        self.more = more

    def _remember(self, volts: float, v: float, dt: float) -> None:
        for effect, act in self.acts["update_memory"]:
            known = {"memory": self.memory[effect], "dt": dt, "u": volts, "v": v, "kv": self.kv}
            self.memory[effect] = act(known)

    def _ask(self, hook: str, **known: float) -> list[float]:
        """What each effect says that has something to say."""
        return [act(known) for _, act in self.acts[hook]]


def _acts(parts: Iterable[Part], hook: str) -> Iterator[tuple[str, Act]]:
    """Effects and what they do there, each a function of all that is known."""
    for part in map(_in_steps, parts):
        act = find(part.effect).hooks.get(hook)
        if act is not None and part.effect not in MOVED_BY_SCENE:
            yield part.effect, _given(act, part.parameters)


def _given(act: Callable[..., float], parameters: Mapping[str, float]) -> Act:
    """An effect's function, which takes what it asks for."""
    asked = inspect.signature(act).parameters
    own = partial(act, **{name: parameters[name] for name in asked if name in parameters})
    names = [name for name in asked if name not in parameters]
    return lambda known: own(**{name: known[name] for name in names})
