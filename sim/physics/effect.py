"""The contract of an effect: physics that a model may contain, for simulation and for fitting.

    V = kS·sgn(v) + kV·v + kA·a + what an effect pulls        everything is priced in volts

*Forward* is how it acts: small functions that ask for what they need by the names of their
arguments, and are compiled into the engine (``engine/``). *Backward* is how it is found: what it
looks like, where a search for its parameters starts, which test tells it from its look-alikes.

A module of ``effects/`` defines one as ``EFFECT``. What a function may ask for, besides the
effect's own parameters, is listed in ``HOOK_ARGUMENTS``; a function that asks for anything else is
refused with a sentence.
"""

import inspect
import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from sim.physics.voltage_residual import VoltageResidual

KINDS = ("term", "path", "sense", "two-body")
ONSET, UNTIL = "onset", "until"  # parameters of what happens once
LATER = 1e6  # [s] end of an effect that lasts for good: later than any log
MOMENT = 1e-6  # [s] by how much an effect outlasts a run, so that it acts on the last sample, too

HOOK_ARGUMENTS: Mapping[str, tuple[str, ...]] = {
    # a term: volts that the motor must pay on top of kS, kV and kA
    "force": ("x", "v"),
    # dry friction beyond kS [V] when moving, or about to move, toward ``way`` (+1 or -1)
    "coulomb_friction": ("v", "way"),
    # inertia beyond kA [V·s²/unit]; ``clock`` is [s] since the log began
    "added_inertia": ("clock",),
    # share of the momentum that what joins takes from what moves: 1 if it was at rest
    "impact": (),
    # [s] of the clock at which inertia changes next: no step of the engine goes across it
    "next_change": ("clock",),
    # a path: the voltage that gets through, from the voltage ``u`` that arrives
    "transform_voltage": ("u", "v", "kv", "memory"),
    # [s] by which a command comes late
    "command_delay": (),
    # the next ``memory`` of an effect that has one, after ``dt`` [s] under the voltage ``u``
    "update_memory": ("memory", "dt", "u", "v", "kv"),
    # two bodies: free play [unit], softness [unit/V] and damping [1, of critical] of what joins
    # them, the motor's shares of the friction and of kA [1]
    "backlash_gap": (),
    "joint_compliance": (),
    "joint_damping": (),
    "motor_friction_share": (),
    "motor_inertia_share": (),
    # two bodies: [V] of push that the floor passes on from the wheels to the robot
    "grip_limit": (),
    # a sense: what the sensor says instead of ``seen``, from the motion up to sample ``now``
    "transform_velocity": ("seen", "now", "time", "position", "velocity"),
}
"""Hook -> the names of the engine's quantities that it may ask for, in SI."""


@dataclass(frozen=True)
class Parameter:
    """One number of an effect.

    Args:
        name: a Python name, which the effect's functions use.
        what: what it means, in a few words.
        unit: with ``{u}`` for the unit of position: ``V·s²/{u}²``.
        power: of the unit of position in the denominator: 2 for ``V·s²/{u}²``, -1 for ``{u}``.
        least: smallest value that is physics.
        most: largest.
        neutral: the value at which the effect is not there.
        searched: a search may move it a little at a time; if not, it takes what a start says.
        counts: the data decide on it, so that it makes a hypothesis less likely beforehand.
        stepwise: the simulation changes in jumps with it, so that a derivative needs a large step.
    """

    name: str
    what: str
    unit: str
    power: int = 0
    least: float = 0.0
    most: float = math.inf
    neutral: float = 0.0
    searched: bool = True
    counts: bool = True
    stepwise: bool = False


@dataclass(frozen=True)
class Scale:
    """Ordinary speeds, voltages and times of a mechanism, which set the sizes of effects.

    Args:
        ks: [V].
        kv: [V·s/unit].
        ka: [V·s²/unit].
        step: [V] of an ordinary dynamic test.
        reach: [unit] that a test travels.
        angular: positions are angles.
        bounded: the travel has two ends.
        type: ``simple``, ``elevator`` or ``arm``.
    """

    ks: float
    kv: float
    ka: float
    step: float
    reach: float
    angular: bool
    bounded: bool
    type: str

    @property
    def speed(self) -> float:
        """[unit/s] steady-state speed of the step."""
        return max(self.step - self.ks, 0.1 * self.step) / self.kv

    @property
    def timescale(self) -> float:
        """[s] time constant kA/kV of a step."""
        return self.ka / self.kv


@dataclass(frozen=True)
class Effect:
    """One physical effect: its parameters, its functions in the engine, and its start values.

    Args:
        name: as on the command line: ``gravity-cosine``.
        kind: ``term``, ``path``, ``sense`` or ``two-body``.
        summary: one line for a list.
        formula: as in a lesson, with the symbols of ``parameters``.
        parameters: the numbers it has.
        fingerprint: what it does to a log, in plain words.
        inspect: what to look at on the robot.
        apart: look-alike -> the test that tells the two apart.
        example: parameters of an ordinary case of a given size; 1 is ordinary, more is stronger.
        start_values: where to begin a search, from what a log shows; the best guess first.
        inertia_shares: [1] shares of kA with which the first start is tried as well, for an effect
            whose delay a model without it mistakes for inertia.
        hooks: hook -> function; the hooks and what they may ask for are in ``HOOK_ARGUMENTS``.
        symmetric: mirrored volts give mirrored motion, whatever the parameters.
        stored_energy: [V·unit] energy that it holds at a position, for what can give energy back: a
            function of ``x`` and the parameters. ``force`` is its slope.
        shortest_time: [s] the fastest it acts, from parameters and gains; None if it is never fast.
        shortest_length: [unit] way along which it stays much the same, from parameters, for what
            depends on places: its steps are long where the motion is slow. None if it has none.
        narrowest_speed: [unit/s] span of speed within which it stays much the same, from
            parameters: a search takes short steps where the speed changes fast. None if it has
            none.
        order: where it stands along the path from command to motor, for a path.
        reason_against: why a mechanism cannot have it, from its scale; empty if it can.
        simpler: the effect with fewer parameters that does about the same; empty if there is none.
        same_in_motion: the effect that is the same wherever the mechanism moves; empty if none is.
        simplify: its parameters, from this one's and what a log shows.
        is_ordinary: whether it is as small, with these parameters and beside these gains, as on any
            robot in good order.
    """

    name: str
    kind: str
    summary: str
    formula: str
    parameters: tuple[Parameter, ...]
    fingerprint: str
    inspect: str
    apart: Mapping[str, str]
    example: Callable[[Scale, float], Mapping[str, float]]
    start_values: Callable[[VoltageResidual], Iterable[Mapping[str, float]]]
    hooks: Mapping[str, Callable[..., Any]]
    symmetric: bool = True
    stored_energy: Callable[..., float] | None = None
    shortest_time: Callable[[Mapping[str, float], Mapping[str, float]], float] | None = None
    shortest_length: Callable[[Mapping[str, float]], float] | None = None
    narrowest_speed: Callable[[Mapping[str, float]], float] | None = None
    order: int = 0
    reason_against: Callable[[Scale], str] = field(default=lambda _: "")
    inertia_shares: tuple[float, ...] = ()
    simpler: str = ""
    same_in_motion: str = ""
    simplify: Callable[[Mapping[str, float], VoltageResidual], Mapping[str, float]] = field(
        default=lambda _values, _seen: {}
    )
    is_ordinary: Callable[[Mapping[str, float], Mapping[str, float]], bool] = field(
        default=lambda _, __: False
    )

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the parameters."""
        return tuple(parameter.name for parameter in self.parameters)

    @property
    def has_onset(self) -> bool:
        """Whether the effect can start and end during a run, like an added load."""
        return {ONSET, UNTIL} <= set(self.names)

    @property
    def is_joint(self) -> bool:
        """Whether it couples motor and load by backlash or compliance."""
        return not {"backlash_gap", "joint_compliance"}.isdisjoint(self.hooks)

    @property
    def slips(self) -> bool:
        """Whether it lets wheels slip on the floor."""
        return "grip_limit" in self.hooks

    @property
    def neutral(self) -> dict[str, float]:
        """Parameter values at which the effect vanishes."""
        return {parameter.name: parameter.neutral for parameter in self.parameters}

    def find_contract_breaches(self) -> list[str]:
        """What is wrong with this effect as it is written; empty if nothing is."""
        found = []
        if self.kind not in KINDS:
            found.append(f"kind is {self.kind!r}; choose one of: {', '.join(KINDS)}")
        if not self.hooks:
            found.append(f"hooks is empty; give one of: {', '.join(HOOK_ARGUMENTS)}")
        for hook, act in self.hooks.items():
            if hook not in HOOK_ARGUMENTS:
                found.append(
                    f"hooks has {hook!r}, which is not one of: {', '.join(HOOK_ARGUMENTS)}"
                )
                continue
            known = (*HOOK_ARGUMENTS[hook], *self.names)
            asked = inspect.signature(act).parameters
            found.extend(
                f"{hook} asks for {name!r}; it may ask for: {', '.join(known)}"
                for name in asked
                if name not in known
            )
        if "transform_voltage" in self.hooks and not self.order:
            found.append("order is 0; say where on the path from command to motor it stands")
        return found


def are_compatible(effects: Iterable[Effect]) -> bool:
    """Whether one model can hold these effects: it has at most two bodies.

    A joint has a motor and its load, slip has wheels and a robot; both together would be three.
    """
    known = tuple(effects)
    return not (any(one.is_joint for one in known) and any(one.slips for one in known))
