"""Four mechanisms for each learner, drawn so that every plan can be made."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from grader.student_data.variant import (
    cache_draws,
    choose,
    draw_until,
    make_student_rng,
    round_digits,
)
from sim.bench.mechanism import Mechanism
from sim.bench.mechanisms import MECHANISMS
from sim.core.units import convert_gains, find_unit
from sim.physics.motors import find_motor

from .plan import Machine, Plan, dynamic, quasistatic
from .rules import GRIP, QUARTER, SIGNAL, find_broken_rules

# Mechanisms differ so much, in so little room, that many plans fail for another student.
LIMITS = {  # [A] that teams set for one motor
    "krakenX60": (60.0, 80.0, 100.0),
    "neoVortex": (40.0, 60.0, 80.0),
    "neo": (40.0, 50.0, 60.0),
    "krakenX44": (50.0, 60.0, 80.0),
}
MOTORS = {
    "drivetrain": ("krakenX60", "neo", "neoVortex"),
    "elevator": ("neo", "neoVortex"),
    "turret": ("krakenX44", "neo"),
    "shooter": ("krakenX60", "neo", "neoVortex"),
}
SPREAD = {  # wider than the bench's own draws, of which some are too fast for any plan
    "drivetrain": {"ratio": (5.14, 7.4), "load": (40.0, 65.0)},
    "elevator": {"ratio": (4.0, 9.0), "radius": (0.016, 0.029), "load": (8.0, 20.0)},
    "turret": {"ratio": (45.0, 85.0), "load": (0.8, 2.4)},
    "shooter": {"ratio": (0.8, 1.5), "load": (0.004, 0.008)},
}
UNITS = {"drivetrain": "meters", "elevator": "meters", "turret": "rotations"}
ROOM = {  # [times the need]
    "drivetrain": (1.5, 2.2),
    "elevator": (1.2, 1.45),
    "turret": (1.2, 1.4),
}
MOST_TRAVEL = {"elevator": 2.0}  # [m] robots have no taller ones
NOISE = {  # [units/s]
    "drivetrain": (0.004, 0.016),
    "elevator": (0.003, 0.010),
    "turret": (0.003, 0.006),
    "shooter": (0.08, 0.25),
}
GRIPS = (1.0, 1.1, 1.2)
REACTION = (0.25, 0.40)  # [s]
LEAST_TAU = 0.045  # [s] below, samples 20 ms apart can hardly tell kA
MOST_TAU = 0.8  # [s] a ramp of some seconds shows little of a slower one
WIDE = 1.5  # [times] the largest step is above the smallest: room for a choice
LASTS = 3.4  # [s] that a sound ramp moves
BEYOND = 1.12  # [times] the wanted speed that it reaches


@dataclass(frozen=True)
class Variant:
    """One learner's mechanisms."""

    machines: Mapping[str, Machine]
    built: Mapping[str, Mechanism]


@cache_draws
def draw(student: str) -> Variant:
    """A learner's mechanisms, always the same; each drawn again until a plan can be made for it."""
    drawn = {kind: draw_until(partial(_draw_machine, student, kind), _has_plan) for kind in MOTORS}
    return Variant(
        {kind: machine for kind, (machine, _) in drawn.items()},
        {kind: built for kind, (_, built) in drawn.items()},
    )


def _draw_machine(student: str, kind: str, attempt: int) -> tuple[Machine, Mechanism]:
    rng = make_student_rng(student, f"exercise6 {kind}", draw=attempt)
    built = _draw_mechanism(kind, rng)
    return _describe_mechanism(kind, built, rng), built


def _has_plan(drawn: tuple[Machine, Mechanism]) -> bool:
    """Whether a plan can be made for a mechanism."""
    machine, _ = drawn
    low, high = find_steps(machine)
    fits = (machine.travel or 0.0) <= MOST_TRAVEL.get(machine.kind, math.inf)
    clear = LEAST_TAU < machine.tau < MOST_TAU and high > WIDE * low
    return fits and clear and not find_broken_rules(machine, make_sound_plan(machine))


def _draw_mechanism(kind: str, rng: np.random.Generator) -> Mechanism:
    plain = MECHANISMS[kind]
    plain = replace(
        plain,
        spread={**plain.spread, **SPREAD.get(kind, {})},
        motor=find_motor(choose(MOTORS[kind], rng)),
        travel=None,
        lowest=None,
    )
    return plain.draw(rng)


def _describe_mechanism(kind: str, built: Mechanism, rng: np.random.Generator) -> Machine:
    unit = find_unit(UNITS.get(kind, "rotations"))
    found = convert_gains(built.gains, factor=unit.si)
    gains = [round_digits(found.get(name, 0.0), 4) for name in ("kS", "kV", "kA", "kG")]
    limit = choose(LIMITS[built.motor.name], rng)
    machine = Machine(
        kind,
        unit.symbol,
        *gains,
        travel=None,
        stall=built.motor.stall_current,
        limit=limit * (1.5 if kind == "shooter" else 1.0),
        noise=round_digits(rng.uniform(*NOISE[kind]), 2),
        grip=choose(GRIPS, rng) if kind == "drivetrain" else 0.0,
        reaction=round(float(rng.uniform(*REACTION)), 2),
    )
    if kind not in ROOM:
        return machine
    slow = quasistatic(machine, make_sound_plan(machine))
    need = slow.stop_position * float(rng.uniform(*ROOM[kind]))
    return replace(machine, travel=round_digits(need, 2))


def find_steps(machine: Machine) -> tuple[float, float]:
    """[V] the smallest and the largest step that is allowed for any travel."""
    low = machine.start_voltage + SIGNAL * machine.acceleration_noise * machine.ka
    return low, min(12.0 * machine.limit / machine.stall, GRIP * machine.slip_voltage)


def make_sound_plan(machine: Machine) -> Plan:
    """A plan that keeps the rules, if there is room for one."""
    ramp = BEYOND * QUARTER * machine.free_speed * machine.kv / (LASTS - machine.tau)
    step = math.sqrt(math.prod(find_steps(machine)))
    timeout = machine.start_voltage / ramp + LASTS + 0.5
    plan = Plan(ramp, step, timeout, math.inf)
    mark = quasistatic(machine, plan).compute_position(LASTS - machine.reaction)
    plan = replace(plan, release=mark)
    return plan if dynamic(machine, plan).push else replace(plan, step=machine.start_voltage * 2.0)
