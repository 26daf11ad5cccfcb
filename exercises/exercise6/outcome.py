"""The motion of a learner's plans: the travel of each test, and the available travel."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

from grader.checks.consequence import Consequence, show_motions
from sim.feedback.response import MovingPlant, Plant

from .plan import Machine, Plan, Test, dynamic, quasistatic
from .rules import LESS, MORE, QUARTER

STEPS = 200  # of a motion
FAR = 50.0  # [times the travel] what needs more is no plan but a slip of the pen
STANDS = 4.0  # [timescales kA/kV] after which it stands again, about
TESTS = {"the ramp": quasistatic, "the step": dynamic}


def find_outcome(plans: Mapping[str, Plan], machines: Mapping[str, Machine]) -> Consequence | None:
    """The test that travels too far; None if none does.

    Args:
        plans: those that can be read, by mechanism.
        machines: all mechanisms.
    """
    found = [one for kind, plan in plans.items() for one in _find_overruns(machines[kind], plan)]
    if not found:
        return None
    return show_motions([motion for motion, _ in found], words=" ".join(says for _, says in found))


def _find_overruns(machine: Machine, plan: Plan) -> Iterator[tuple[tuple[Any, ...], str]]:
    """The tests that go too far, as a panel and in words."""
    if machine.travel is None:
        return
    tests = {name: make(machine, plan) for name, make in TESTS.items()}
    tests |= _lengthen_ramp(tests["the ramp"])
    near, most = MORE * machine.travel, FAR * machine.travel
    far = {name: test for name, test in tests.items() if near < test.stop_position < most}
    if far:
        lasts = max(_find_end(test) for test in far.values())
        time = tuple(lasts * k / STEPS for k in range(STEPS + 1))
        runs = {name: _simulate_run(test, time) for name, test in far.items()}
        words = " ".join(
            f"The {machine.kind}: {name} needs {_format_size(test.stop_position)} "
            f"{machine.symbol}; you have {machine.travel:g} {machine.symbol}."
            for name, test in far.items()
        )
        limit = (machine.travel,) * len(time)
        yield (machine.kind, f"run [{machine.symbol}]", time, limit, runs, True), words


def _lengthen_ramp(ramp: Test) -> dict[str, Test]:
    """A ramp that ends before it has told enough, as it would have to go on."""
    enough = QUARTER * ramp.machine.free_speed
    if ramp.end_speed >= LESS * enough:
        return {}
    lasts = ramp.still + ramp.find_time(ramp.compute_speed, enough)
    return {"the ramp until it is fast enough": replace(ramp, release=math.inf, timeout=lasts)}


def _format_size(run: float) -> str:
    """Three digits, and no powers of ten."""
    return f"{run:.3g}" if run < 100.0 else f"{run:.0f}"


def _find_end(test: Test) -> float:
    """[s] after which it stands again, nearly."""
    return test.still + test.driven_time + STANDS * test.machine.tau


def _simulate_run(test: Test, time: tuple[float, ...]) -> tuple[float, ...]:
    """The positions of a run: driven, then with 0 V in brake mode until it stands."""
    machine, places, ends = test.machine, [], test.still + test.driven_time
    # On its way up, friction and gravity both hold it.
    gains = {"kS": machine.start_voltage, "kV": machine.kv, "kA": machine.ka}
    moving = MovingPlant(
        Plant("simple", gains), step=time[1] - time[0],
        start=test.compute_position(test.driven_time), speed=test.end_speed,
    )  # fmt: skip
    for t in time:
        if t <= ends:
            places.append(test.compute_position(max(t - test.still, 0.0)))
            continue
        places.append(moving.path[-1])
        moving.apply_voltage(0.0)
    return tuple(places)
