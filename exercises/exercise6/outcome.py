"""What a learner's plans would do: the run each test takes, and the travel there is."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

from grader.consequence import Consequence, Picture

from .plan import Machine, Plan, Test, dynamic, quasistatic
from .rules import LESS, MORE, QUARTER

STEPS = 200  # of a motion
FAR = 50.0  # [times the travel] what needs more is no plan but a slip of the pen
STANDS = 4.0  # [timescales kA/kV] after which it stands again, about
TESTS = {"the ramp": quasistatic, "the step": dynamic}


@dataclass(frozen=True)
class Overrun:
    """A mechanism of which a test takes more run than there is.

    Args:
        machine: what moves.
        limit: the travel, in its unit.
        time: (n,) [s] since the start.
        runs: test -> (n,) place.
        words: what happens.
    """

    machine: Machine
    limit: float
    time: tuple[float, ...]
    runs: Mapping[str, tuple[float, ...]]
    words: str


def outcome(plans: Mapping[str, Plan], machines: Mapping[str, Machine]) -> Consequence | None:
    """What goes too far; None where nothing does.

    Args:
        plans: those that can be read, by mechanism.
        machines: all mechanisms.
    """
    found = [one for kind, plan in plans.items() for one in _overruns(machines[kind], plan)]
    if not found:
        return None
    words = " ".join(one.words for one in found)

    def draw() -> Picture:
        from sim.plot import consequence as plot  # noqa: PLC0415 - only who draws waits for it

        shown = [
            plot.Trace(
                one.machine.kind,
                f"run [{one.machine.symbol}]",
                one.time,
                (one.limit,) * len(one.time),
                one.runs,
                limit=True,
            )
            for one in found
        ]
        return plot.plot_consequence(shown, words=words)

    return Consequence(words, draw)


def _overruns(machine: Machine, plan: Plan) -> Iterator[Overrun]:
    """The mechanism, if one of its tests goes too far."""
    if machine.travel is None:
        return
    tests = {name: make(machine, plan) for name, make in TESTS.items()}
    tests |= _long_enough(tests["the ramp"])
    near, most = MORE * machine.travel, FAR * machine.travel
    far = {name: test for name, test in tests.items() if near < test.rests < most}
    if far:
        lasts = max(_ends(test) for test in far.values())
        time = tuple(lasts * k / STEPS for k in range(STEPS + 1))
        runs = {name: _places(test, time) for name, test in far.items()}
        told = [_words(name, test, machine.travel) for name, test in far.items()]
        yield Overrun(machine, machine.travel, time, runs, " ".join(told))


def _long_enough(ramp: Test) -> dict[str, Test]:
    """A ramp that ends before it has told enough, as it would have to go on."""
    enough = QUARTER * ramp.machine.free
    if ramp.fastest >= LESS * enough:
        return {}
    lasts = ramp.still + ramp.when(ramp.speed, enough)
    return {"the ramp until it is fast enough": replace(ramp, release=math.inf, timeout=lasts)}


def _words(name: str, test: Test, travel: float) -> str:
    symbol = test.machine.symbol
    says = f"The {test.machine.kind}: {name} needs {_size(test.rests)} {symbol}"
    return f"{says}; you have {travel:g} {symbol}."


def _size(run: float) -> str:
    """Three digits, and no powers of ten."""
    return f"{run:.3g}" if run < 100.0 else f"{run:.0f}"


def _ends(test: Test) -> float:
    """[s] after which it stands again, nearly."""
    return test.still + test.lasts + STANDS * test.machine.tau


def _places(test: Test, time: tuple[float, ...]) -> tuple[float, ...]:
    """Where it is: driven, then with 0 V in brake mode, until it stands."""
    from sim.feedback.response import MovingPlant, Plant  # noqa: PLC0415 - numpy only where it is needed

    machine, places, ends = test.machine, [], test.still + test.lasts
    gains = {"kS": machine.hold, "kV": machine.kv, "kA": machine.ka}  # on its way up: all hold it
    moving = MovingPlant(
        Plant("simple", gains), step=time[1] - time[0], start=test.place(test.lasts),
        speed=test.fastest,
    )  # fmt: skip
    for t in time:
        if t <= ends:
            places.append(test.place(max(t - test.still, 0.0)))
            continue
        places.append(moving.path[-1])
        moving.apply_voltage(0.0)
    return tuple(places)
