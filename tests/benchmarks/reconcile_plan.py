"""Which cases the benchmark of reconcile makes: effects × mechanisms × severities, and what else.

A case of one effect takes the next pair of effect and mechanism of one endless round, so that every
group meets every effect before it meets one twice, and the groups meet different mechanisms.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import cycle, islice

import numpy as np
from reconcile_strangers import ADMITTED, STRANGERS

from sim.bench.mechanisms import MECHANISMS
from sim.physics.effects import EFFECTS

FAULTS = ("encoder-slip", "hard-stop")  # damage that a solver names among its findings
SINGLES = (("real", False), ("subtle", False), ("real", True), ("subtle", True))
SHUFFLED = 20  # cases whose voltage is another's
REAL, SUBTLE = "real", "subtle"

ELEVATORS = tuple(name for name, one in MECHANISMS.items() if one.type == "elevator")
GIVEN_AS_SIMPLE = {("arm", "gravity-cosine"), *((name, "constant-load") for name in ELEVATORS)}
"""Mechanism, effect: gravity itself is what is hidden, so the solver is told type ``simple``."""

LEFT_OUT = {
    **{(name, "asymmetric-friction"): "while it moves it is part of kG" for name in ELEVATORS},
    ("shooter", "gravity-cosine"): "a wheel turns by more than half a turn between two samples",
    ("intake", "gravity-cosine"): "the same",
    ("shooter", "deadband"): "the noise of a wheel's velocity hides how it breaks away",
    ("shooter", "stribeck"): "the same",
    ("shooter", "backlash"): "the same",
}
"""Mechanism, effect: what no log of these tests can show."""

NESTED = (
    {"constant-load", "asymmetric-friction", "spring", "gravity-cosine"},  # one family
    {"backlash", "compliance"},  # one joint
    {"backlash", "wheel-slip"},  # three bodies
    {"compliance", "wheel-slip"},
)
"""Of these, two at once are one and another size of it, or more than a model can hold."""


@dataclass(frozen=True)
class Case:
    """What is made, and what a solver has to say of it.

    Args:
        number: names the case's own stream of chance.
        mechanism: its name.
        hidden: names of effects, faults or strangers that are in it.
        severity: ``real``, ``subtle``, or None where nothing is hidden.
        dirty: everyday effects and noise are in it that nobody has to name.
        shuffled: how its voltage was spoiled: ``permuted``, ``exchanged`` or not at all.
    """

    number: int
    mechanism: str
    hidden: tuple[str, ...] = ()
    severity: str | None = None
    dirty: bool = False
    shuffled: str = ""

    @property
    def effects(self) -> tuple[str, ...]:
        """What a solver is to name."""
        return tuple("unknown" if name in STRANGERS else name for name in self.hidden)

    @property
    def type(self) -> str:
        """The base type that a solver is told."""
        simple = any((self.mechanism, name) in GIVEN_AS_SIMPLE for name in self.hidden)
        return "simple" if simple else MECHANISMS[self.mechanism].type


def catalogue() -> tuple[str, ...]:
    """The names that a solver may have to say, strangers not among them."""
    return (*(name for name in EFFECTS if name not in ADMITTED), *FAULTS)


def why_not(mechanism: str, name: str) -> str:
    """Why a mechanism cannot have, or cannot show, an effect or a fault; empty if it can."""
    built = MECHANISMS[mechanism]
    if (mechanism, name) in LEFT_OUT:
        return LEFT_OUT[mechanism, name]
    if name in FAULTS:
        return "it has no stops" if name == "hard-stop" and built.stops is None else ""
    known = STRANGERS[name] if name in STRANGERS else EFFECTS[name]
    return known.reason_against(built.scale)


def plan(*, seed: int, cases: int, shuffled: int = SHUFFLED) -> tuple[Case, ...]:
    """All cases, in an order that tells nothing.

    Args:
        seed: same seed, same plan.
        cases: of each of the four groups of one effect; half as many of each other group, of which
            there is a clean and a dirty one.
        shuffled: controls with a voltage that is not theirs.
    """
    rng = np.random.default_rng(seed)
    chosen = [*_singles(rng, cases)]
    for dirty in (False, True):
        chosen += _others(rng, -(-cases // 2), dirty=dirty)
    for index, mechanism in enumerate(islice(_endless(rng, list(MECHANISMS)), shuffled)):
        how = ("permuted", "exchanged")[index % 2]
        chosen.append(Case(0, mechanism, dirty=index % 4 > 1, shuffled=how))
    order = rng.permutation(len(chosen)).tolist()
    return tuple(
        Case(place, c.mechanism, c.hidden, c.severity, c.dirty, c.shuffled)
        for place, c in enumerate(chosen[index] for index in order)
    )


def pairs(rng: np.random.Generator, names: Sequence[str]) -> Iterator[tuple[str, str]]:
    """Effect and mechanism, for ever: all effects once, then all with their next mechanism."""
    who = {name: _endless(rng, [m for m in MECHANISMS if not why_not(m, name)]) for name in names}
    order = [names[i] for i in rng.permutation(len(names))]
    for name in cycle(order):
        yield name, next(who[name])


def _singles(rng: np.random.Generator, cases: int) -> Iterator[Case]:
    """Four groups of one effect."""
    round_about = pairs(rng, catalogue())
    for severity, dirty in SINGLES:
        for name, mechanism in islice(round_about, cases):
            yield Case(0, mechanism, (name,), severity, dirty)


def _others(rng: np.random.Generator, cases: int, *, dirty: bool) -> Iterator[Case]:
    """Complete models, strangers, and two effects at once."""
    for mechanism in islice(_endless(rng, list(MECHANISMS)), cases):
        yield Case(0, mechanism, dirty=dirty)
    for name, mechanism in islice(pairs(rng, list(STRANGERS)), cases):
        yield Case(0, mechanism, (name,), REAL, dirty)
    for mechanism in islice(_endless(rng, list(MECHANISMS)), cases):
        yield Case(0, mechanism, _two(rng, mechanism), REAL, dirty)


def _two(rng: np.random.Generator, mechanism: str) -> tuple[str, str]:
    """Two effects that a mechanism can have and that are not one."""
    able = [n for n in catalogue() if n not in FAULTS and not why_not(mechanism, n)]
    while True:
        one, other = (able[i] for i in rng.choice(len(able), 2, replace=False))
        if not any({one, other} <= family for family in NESTED):
            return one, other


def _endless(rng: np.random.Generator, names: list[str]) -> Iterator[str]:
    """Names for ever, in an order of chance that does not change."""
    return cycle([names[i] for i in rng.permutation(len(names))])
