"""The robots and logs of lesson 9; what they hide stands in ``lesson_answers.toml``."""

from dataclasses import replace

import numpy as np

from sim.bench.duty_cycle import Battery, simulate_duty_cycle
from sim.bench.mechanism import Mechanism
from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.core.log import Log, integrate_velocity
from sim.physics.model import Part
from sim.teaching.answers import hide_effects
from sim.teaching.logs import apply_mistake

FOUR = ("quasistatic", "dynamic")
PRACTICE = Routine(0.5, 3.5, timeout=3.0, kinds=(*FOUR, "multistep"))
TIRED = Battery(rest=12.2, resistance=0.035)
LIMIT = 3.0  # [V] current limit of the other team, above the back-EMF


def make_team_robot() -> Mechanism:
    """The drivetrain that does not follow its paths."""
    return hide_effects(MECHANISMS["drivetrain"], "lesson9.team")


def record_team_logs() -> tuple[Log, Log, Log]:
    """The logs of this drivetrain: to fit, to validate, and held out."""
    rng = np.random.default_rng(2)
    routines = (
        Routine(1.0, 3.0, timeout=3.0, kinds=FOUR),
        Routine(1.0, 2.0, timeout=3.0, kinds=FOUR),
        Routine(step=3.5, timeout=4.0, kinds=("triangle", "multistep")),
    )
    robot = make_team_robot()
    log, validation, held_out = (
        simulate(robot, routine, rng=rng, electrical=True) for routine in routines
    )
    return log, validation, held_out


def record_suspects() -> dict[str, Log]:
    """Robot -> log of a drivetrain with one effect; the log of robot C is of commanded voltage."""
    rng, robot = np.random.default_rng(3), MECHANISMS["drivetrain"]
    sagging = simulate_duty_cycle(robot, replace(PRACTICE, step=5.0), battery=TIRED, rng=rng)
    logs = {
        name: simulate(
            hide_effects(robot, f"lesson9.suspects.{name}"), PRACTICE, rng=rng, electrical=True
        )
        for name in ("robot A", "robot B", "robot D")
    }
    return dict(sorted({**logs, "robot C": apply_mistake(sagging, commanded=True)}.items()))


def record_limited_robot() -> dict[str, Log]:
    """A gentle and a hard step test of a drivetrain with a current limit of ``LIMIT``."""
    robot = replace(
        MECHANISMS["drivetrain"], stator=np.inf, supply=np.inf, brownout=0.0,
        hidden=(Part("current-limit", {"limit": LIMIT}),),
    )  # fmt: skip
    rng = np.random.default_rng(1)
    gentle = simulate(robot, Routine(1.0, 2.5, timeout=3.0), rng=rng)
    hard = simulate(robot, Routine(1.0, 6.0, timeout=2.0, kinds=("dynamic",)), rng=rng)
    return {"2.5 V step (fitted)": gentle, "6 V step (other data)": hard}


def forget_position(log: Log) -> Log:
    """A log whose positions are the integral of its velocities: they say nothing of their own."""
    runs = (replace(r, position=integrate_velocity(r.time, r.velocity)) for r in log.runs)
    return replace(log, runs=tuple(runs))
