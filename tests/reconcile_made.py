"""Sessions of the bench with one thing hidden, short and quick to reconcile."""

from dataclasses import replace
from functools import cache

import numpy as np

from sim.bench.mechanisms import MECHANISMS
from sim.bench.routine import Routine
from sim.bench.simulate import simulate
from sim.core.log import Log, Run
from sim.estimation.likelihood import Estimate, PredictionErrorProblem
from sim.estimation.model_structure import ModelStructure
from sim.estimation.run_nuisance import RunNuisance
from sim.estimation.run_records import make_run_records
from sim.physics.battery import Battery
from sim.physics.effects import EFFECTS
from sim.physics.engine import State, simulate_run
from sim.physics.model import Model, Part
from sim.reconcile import reconcile

FOUR = ("quasistatic", "dynamic")
SESSIONS = {
    "log": (6.0, FOUR),
    "validation": (4.3, FOUR),
    "held_out": (5.0, (*FOUR, "coast", "triangle")),
}
"""Name of a log -> the step [V], and the tests."""
RAMP, TIMEOUT = 1.0, 4.0  # [V/s], [s]: short, so that a case takes some seconds
SLOWEST = 3.5  # [V] of a step, for which the catalogue's examples are made


PERIOD = 0.01  # [s], of what `recorded` records

NOWHERE = Estimate(
    ModelStructure("simple"),
    {},
    RunNuisance.at_first_samples(0),
    0.0,
    np.zeros((2, 2)),
    np.empty((0, 2)),
    np.eye(2),
    0.0,
)
"""A point where only its name is asked for."""


def recorded(kind, model, *, step, state, noise, rng, began=0.0, still=0):
    """The record of a model on one test, without a mechanism or its battery around it.

    Args:
        kind: "quasistatic-forward" and the like.
        model: what moves.
        step: [V] of a dynamic test; the others ramp at 0.5 V/s.
        state: in which it begins.
        noise: of position and velocity, in their units.
        rng: draws it.
        began: [s] at which its clock begins.
        still: samples without a voltage at first.
    """
    quick, way = kind.startswith("dynamic"), -1.0 if kind.endswith("reverse") else 1.0
    time = np.arange(0.0, 1.5 if quick else 6.0, PERIOD)
    volts = way * (np.full(time.size, step) if quick else 0.5 * time)
    volts[:still] = 0.0
    track = simulate_run(model, time=time, voltage=volts, state=state)
    noisy = (
        one + size * rng.standard_normal(time.size)
        for one, size in zip((track.position, track.velocity), noise, strict=True)
    )
    return Run(kind, began + time, volts, *noisy)


TESTS = ("quasistatic-forward", "quasistatic-reverse", "dynamic-forward", "dynamic-reverse")


def rubbing(gains, shares, *parts, noise, step, seed):
    """Four tests of a mechanism, of which every run has a share of the friction of its own."""
    rng = np.random.default_rng(seed)
    runs, clock = [], 0.0
    for test, share in zip(TESTS, shares, strict=True):
        model = Model("simple", {**gains, "kS": share * gains["kS"]}, parts)
        begun = {"state": State.cold_at(0.0), "began": clock}
        runs.append(recorded(test, model, step=step, noise=noise, rng=rng, **begun))
        clock = float(runs[-1].time[-1]) + 2.0
    return Log(tuple(runs), units="meters", type="simple")


def based(log, gains):
    """The problem of a log, and the point of gains without effects."""
    problem = PredictionErrorProblem.from_records(make_run_records(log))
    begun = RunNuisance.at_first_samples(len(problem.records))
    return problem, problem.evaluate(
        ModelStructure("simple"), gains, begun, problem.noise.velocity**2
    )


def bench(name, effect="", *, size=1.0, simple=False):
    """A mechanism that does what its log says, but for one effect that its team does not know.

    Args:
        name: of the mechanism.
        effect: hidden in it.
        size: 1 is ordinary.
        simple: it lies on its side, and its team takes it as ``simple``.
    """
    one = replace(MECHANISMS[name], battery=Battery(resistance=0.0), stator=1e4, supply=1e4)
    if simple:
        one = replace(one, lift=0.0, type="simple")
    if not effect:
        return one
    values = EFFECTS[effect].example(replace(one.scale, step=SLOWEST), size)
    return replace(one, hidden=(Part(effect, dict(values)),))


def session(mechanism, name):
    """One of the three logs."""
    step, kinds = SESSIONS[name]
    routine = Routine(ramp=RAMP, step=step, timeout=TIMEOUT, kinds=kinds)
    seed = [3, list(SESSIONS).index(name)]
    return simulate(mechanism, routine, rng=np.random.default_rng(seed))


@cache
def logs(name, effect="", *, simple=False):
    """All three of them."""
    mechanism = bench(name, effect, simple=simple)
    return {one: session(mechanism, one) for one in SESSIONS}


def told(sessions, **changes):
    """The story of three logs."""
    given = dict(sessions) | changes
    return reconcile(given.pop("log"), **{"type": "simple"} | given)


@cache
def solved(name, effect="", *, simple=False):
    """The story of a case, found once however many tests look at it."""
    mechanism = bench(name, effect, simple=simple)
    return told(logs(name, effect, simple=simple), type=mechanism.type)
