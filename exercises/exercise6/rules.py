"""The rules of a plan with their figures, and the sentences about broken ones."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

from .plan import BATTERY, Machine, Plan, Test, dynamic, quasistatic

LONGEST = 10.0  # [s] of a test: the last thing that ends it when nobody does
MOVES = 3.0  # [s] that the ramp has to move
QUARTER = 0.25  # [share] of the free speed that it has to reach
GRIP = 0.9  # [share] of the volts at which wheels slip
SIGNAL = 10.0  # [times] the acceleration is above its scatter
LESS, MORE = 0.995, 1.005  # [times] a bound: who rounds is not wrong
BIG, SLOW, UNITS = "M-BIG-STEP", "M-SLOW-SAFE", "M-UNITS"
SMALLER = {"m": ("centimeters", 100.0), "rot": ("degrees", 360.0)}  # how many are one of it
CLEARLY = 10.0  # [travels] a mark beyond the end is less of a slip of the pen than of the unit


@dataclass(frozen=True)
class BrokenRule:
    """A rule that a plan breaks: its message, and the misconception's code, or empty."""

    says: str
    misconception: str = ""


def find_broken_rules(machine: Machine, plan: Plan) -> tuple[BrokenRule, ...]:
    """The rules that a plan breaks; none if it may be run."""
    return (*_find_dangers(machine, plan), *_find_lacks(machine, plan))


def _find_dangers(machine: Machine, plan: Plan) -> Iterator[BrokenRule]:
    if plan.timeout > LONGEST:
        yield BrokenRule(
            f"a timeout of {plan.timeout:g} s; no test may be longer than {LONGEST:g} s"
        )
    if machine.travel is not None and MORE * machine.travel < plan.release < math.inf:
        room = f"{machine.travel:g} {machine.symbol}"
        says = f"your mark is at {plan.release:g} {machine.symbol}; the travel ends at {room}"
        named, times = SMALLER[machine.symbol]
        fits = CLEARLY * machine.travel < plan.release <= MORE * times * machine.travel
        yield BrokenRule(f"{says}. Is your number in {named}?" if fits else says, UNITS * fits)
    slow = quasistatic(machine, plan)
    asks = plan.ramp * (slow.still + slow.driven_time)
    if asks > MORE * BATTERY:
        yield BrokenRule(f"your ramp reaches {asks:.1f} V; the battery has {BATTERY:g} V")
    for name, test in (("ramp", slow), ("step", dynamic(machine, plan))):
        if machine.travel is not None and test.stop_position > MORE * machine.travel:
            yield BrokenRule(_explain_long_run(name, test, machine.travel))
    amps = plan.step / BATTERY * machine.stall
    if amps > MORE * machine.limit:
        says = f"at standstill your step draws {amps:.0f} A; the limit is {machine.limit:g} A. The "
        yield BrokenRule(
            (f"{says}controller reduces the voltage, and the mechanism starts more slowly"), BIG
        )
    if plan.step > MORE * GRIP * machine.slip_voltage:
        share = 100.0 * plan.step / machine.slip_voltage
        says = f"your step is {share:.1f} % of V_slip; at most 90 %"
        if plan.step > machine.slip_voltage:
            says += ". The wheels spin, and the encoder counts meters that the robot does not move"
        yield BrokenRule(says, BIG)


def _explain_long_run(name: str, test: Test, travel: float) -> str:
    """The run a test needs, and how it ends."""
    symbol = test.machine.symbol
    says = f"your {name} needs {test.stop_position:.2f} {symbol}; you have {travel:g} {symbol}. "
    hit = test.find_time(test.compute_position, travel)
    if hit < test.driven_time:
        says += f"It hits the end at {test.compute_speed(hit):.2f} {symbol}/s, "
        return says + f"{test.still + hit:.1f} s after the start, with the voltage still on"
    late = "the thumb needs time to react, and " if test.ends_at_mark else ""
    says += f"At its end it moves at {test.end_speed:.2f} {symbol}/s: "
    return f"{says}{late}it cannot stop at once"


def _find_lacks(machine: Machine, plan: Plan) -> Iterator[BrokenRule]:
    slow = quasistatic(machine, plan)
    end = "your mark" if slow.ends_at_mark else "the timeout"
    needs = "kS + kG" if machine.kind == "elevator" else "kS"
    if slow.driven_time < LESS * MOVES:
        says = f"your ramp moves it for {slow.driven_time:.2f} s until {end}; at least {MOVES:g} s"
        if slow.ends_at_mark:
            says += ". Use a slower ramp, or put the mark farther away"
        else:
            says += f". For the first {slow.still:.2f} s it stands still: until then, "
            says += f"your ramp is below {needs} ({machine.start_voltage:.2f} V)"
        yield BrokenRule(says)
    if slow.end_speed < LESS * QUARTER * machine.free_speed:
        yield _explain_slow_ramp(slow, end)
    push = plan.step - machine.start_voltage
    if push <= 0.0:
        yield BrokenRule(f"your step does not move it: {needs} is {machine.start_voltage:.2f} V")
    elif push / machine.ka < LESS * SIGNAL * machine.acceleration_noise:
        times = push / machine.ka / machine.acceleration_noise
        says = f"your step's acceleration is {times:.2f} times its noise; at least {SIGNAL:g}"
        yield BrokenRule(f"{says} times. Use a larger step")


def _explain_slow_ramp(slow: Test, end: str) -> BrokenRule:
    machine = slow.machine
    share = 100.0 * slow.end_speed / machine.free_speed
    says = f"your ramp reaches {share:.1f} % of the free speed at {end}; at least 25 %"
    run = slow.compute_position(slow.find_time(slow.compute_speed, QUARTER * machine.free_speed))
    fits = machine.travel is None or run <= machine.travel
    if fits and not slow.ends_at_mark:
        return BrokenRule(says)
    says += f". To reach that, your ramp needs {run:.2f} {machine.symbol}; "
    says += f"your mark is at {slow.release:g}" if fits else f"you have {machine.travel:g}"
    return BrokenRule(f"{says} {machine.symbol}", "" if fits else SLOW)
