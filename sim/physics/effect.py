"""The contract of an effect: physics that a model may contain, for simulation and for fitting.

    V = kS·sgn(v) + kV·v + kA·a + F(x, v)        all forces and torques are given in volts

The simulation of an effect is a set of small functions, the hooks, which are compiled into the
engine (``engine/``). A hook gets the quantities that it names as its arguments. For identification
an effect has a fingerprint in a log, start values for its parameters, and the tests that tell it
from similar effects.

A module of ``effects/`` defines one effect as ``EFFECT``. The arguments that a hook may have,
besides the effect's own parameters, are listed in ``HOOK_ARGUMENTS``; others are refused with a
message.
"""

import inspect
import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from sim.core.units import BATTERY
from sim.physics.voltage_residual import VoltageResidual

KINDS = ("term", "path", "sense", "two-body")
ONSET, UNTIL = "onset", "until"  # parameters of an effect that starts and ends at a moment
LATER = 1e6  # [s] end of an effect that does not end: later than any log
MOMENT = 1e-6  # [s] by how much an effect outlasts a run, so that it acts on the last sample, too

HOOK_ARGUMENTS: Mapping[str, tuple[str, ...]] = {
    # a term: [V] force beyond kS, kV and kA, at position ``x`` and velocity ``v``
    "force": ("x", "v"),
    # [V] dry friction beyond kS while moving, or about to move, in direction ``way`` (+1 or -1)
    "coulomb_friction": ("v", "way"),
    # [V·s²/unit] inertia beyond kA; ``clock`` is [s] since the log began
    "added_inertia": ("clock",),
    # [1] share of the added inertia that was at rest, and takes momentum from the mechanism
    "impact": (),
    # [s] time on the clock at which inertia changes next; a step of the engine ends there
    "next_change": ("clock",),
    # a path: [V] output voltage for the input voltage ``u``
    "transform_voltage": ("u", "v", "kv", "memory"),
    # [s] delay of a command
    "command_delay": (),
    # the ``memory`` of an effect after ``dt`` [s] under the voltage ``u``
    "update_memory": ("memory", "dt", "u", "v", "kv"),
    # two bodies: backlash [unit], compliance [unit/V] and damping [share of critical] of the joint,
    # and the motor's shares of the friction and of kA [1]
    "backlash_gap": (),
    "joint_compliance": (),
    "joint_damping": (),
    "motor_friction_share": (),
    "motor_inertia_share": (),
    # two bodies: [V] largest traction between wheels and floor
    "grip_limit": (),
    # a sense: [unit/s] velocity that the sensor reports instead of ``seen``, from the motion up to
    # sample ``now``
    "transform_velocity": ("seen", "now", "time", "position", "velocity"),
}
"""Hook -> names of the engine's quantities that may be its arguments, in SI."""


@dataclass(frozen=True)
class Parameter:
    """One parameter of an effect.

    Args:
        name: its Python name, which is an argument of the effect's functions.
        what: its meaning, in a few words.
        unit: its unit, with ``{u}`` for the unit of position: ``V·s²/{u}²``.
        power: exponent of the unit of position in the denominator: 2 for ``V·s²/{u}²``, -1 for
            ``{u}``.
        least: smallest physical value.
        most: largest physical value.
        neutral: value at which the effect is absent.
        everyday: size up to which it is normal on a robot in good order, at the free speed of 12 V
            if its unit contains a position; 0 if no size is.
        searched: whether a search changes it in small steps; if not, it keeps its start value.
        counts: whether the data determine it, so that it counts as a free parameter of a model.
        stepwise: whether the simulation jumps with it, so that a derivative needs a large step.
    """

    name: str
    what: str
    unit: str
    power: int = 0
    least: float = 0.0
    most: float = math.inf
    neutral: float = 0.0
    everyday: float = 0.0
    searched: bool = True
    counts: bool = True
    stepwise: bool = False


@dataclass(frozen=True)
class Scale:
    """Typical voltage, travel and gains of a mechanism, which set the sizes of effects.

    Args:
        ks: [V].
        kv: [V·s/unit].
        ka: [V·s²/unit].
        step: [V] voltage of an ordinary dynamic test.
        reach: [unit] distance that a test travels.
        angular: whether positions are angles.
        bounded: whether the travel has two ends.
        lowest: [unit] position of the lower end; None if a test may start anywhere.
        type: ``simple``, ``elevator`` or ``arm``.
    """

    ks: float
    kv: float
    ka: float
    step: float
    reach: float
    angular: bool
    bounded: bool
    lowest: float | None
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
        name: name on the command line: ``gravity-cosine``.
        kind: ``term``, ``path``, ``sense`` or ``two-body``.
        summary: one line for a list of effects.
        formula: its formula, with the symbols of ``parameters``.
        parameters: its parameters.
        fingerprint: how it shows in a log, in plain words.
        inspect: what to check on the robot.
        example: parameters of a typical case, from the scale of a mechanism and a size; size 1 is
            ordinary, more is stronger.
        start_values: start values of a search, from the voltage residual of a log; the best first.
        hooks: hook -> function; the hooks and their arguments are in ``HOOK_ARGUMENTS``.
        symmetric: whether negated voltages give a negated motion, for all parameters.
        stored_energy: [V·unit] potential energy, a function of ``x`` and the parameters, whose
            slope is ``force``; None if it stores none.
        shortest_time: [s] shortest time scale, from parameters and gains; infinite if it has none.
        shortest_length: [unit] shortest length scale, from parameters, of an effect that depends on
            position: it needs short steps only where the motion is fast. Infinite if it has none.
        smallest_speed_scale: [unit/s] smallest speed scale, from parameters: a search takes short
            steps where the speed changes fast. Infinite if it has none.
        order: place in the path from command to motor or from motion to sensor, for a chain.
        reason_against: why a mechanism cannot have it, from its scale; empty if it can.
        inertia_shares: [1] shares of kA with which the first start is tried as well, for an effect
            whose delay a model without it mistakes for inertia.
        apart: similar effect -> the test that tells the two apart; one of the two files says it.
        simpler: the effect with fewer parameters that acts about the same; empty if there is none.
        same_in_motion: the effect that is equal to it while the mechanism moves; empty if none is.
        simplify: parameters of ``simpler``, from those of this effect and the voltage residual.
    """

    name: str
    kind: str
    summary: str
    formula: str
    parameters: tuple[Parameter, ...]
    fingerprint: str
    inspect: str
    example: Callable[[Scale, float], Mapping[str, float]]
    start_values: Callable[[VoltageResidual], Iterable[Mapping[str, float]]]
    hooks: Mapping[str, Callable[..., Any]]
    symmetric: bool = True
    stored_energy: Callable[..., float] | None = None
    shortest_time: Callable[[Mapping[str, float], Mapping[str, float]], float] = lambda *_: math.inf
    shortest_length: Callable[[Mapping[str, float]], float] = lambda _: math.inf
    smallest_speed_scale: Callable[[Mapping[str, float]], float] = lambda _: math.inf
    order: int = 0
    reason_against: Callable[[Scale], str] = field(default=lambda _: "")
    inertia_shares: tuple[float, ...] = ()
    apart: Mapping[str, str] = field(default_factory=dict)
    simpler: str = ""
    same_in_motion: str = ""
    simplify: Callable[[Mapping[str, float], VoltageResidual], Mapping[str, float]] = field(
        default=lambda _values, _residual: {}
    )

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the parameters."""
        return tuple(parameter.name for parameter in self.parameters)

    @property
    def has_onset(self) -> bool:
        """Whether the effect starts and ends at a moment, like an added load."""
        return {ONSET, UNTIL} <= set(self.names)

    @property
    def is_joint(self) -> bool:
        """Whether it couples motor and load by backlash or compliance."""
        return not {"backlash_gap", "joint_compliance"}.isdisjoint(self.hooks)

    @property
    def slips(self) -> bool:
        """Whether it is slip of wheels on the floor."""
        return "grip_limit" in self.hooks

    @property
    def neutral(self) -> dict[str, float]:
        """Parameter -> the value at which the effect is absent."""
        return {parameter.name: parameter.neutral for parameter in self.parameters}

    def compute_everyday_size(self, values: Mapping[str, float]) -> float:
        """[1] size over the largest that is normal on a robot in good order; infinite if none is.

        Args:
            values: the model's gains, and ``effect.parameter`` -> value.
        """
        free_speed = BATTERY / max(values["kV"], 1e-9)
        sizes = [
            values[f"{self.name}.{one.name}"] * free_speed**one.power / one.everyday
            for one in self.parameters
            if one.everyday
        ]
        return math.hypot(*sizes) if sizes else math.inf

    def find_contract_breaches(self) -> list[str]:
        """Sentences that say how this effect breaks the contract; empty if it does not."""
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
            arguments = inspect.signature(act).parameters
            found.extend(
                f"{hook} asks for {name!r}; it may ask for: {', '.join(known)}"
                for name in arguments
                if name not in known
            )
        if "transform_voltage" in self.hooks and not self.order:
            found.append("order is 0; say where it acts on the path from command to motor")
        return found


def are_compatible(effects: Iterable[Effect]) -> bool:
    """Whether one model can hold these effects: it has at most two bodies.

    A joint couples motor and load, slip couples wheels and robot; both together would be three.
    """
    known = tuple(effects)
    return not (any(one.is_joint for one in known) and any(one.slips for one in known))
