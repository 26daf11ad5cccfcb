"""Stories made by hand, so that every number on a page or a terminal can be worked out."""

from dataclasses import replace

import numpy as np

from sim.core.log import Log, Run
from sim.gap import Place
from sim.physics.model import Model, Part
from sim.reconcile.story import Chapter, Finding, ParameterEstimate, Story, TriedCandidate

FOOT = 0.3048  # [m]
NOISE = 0.01  # [m/s]
BASE = Model("simple", {"kS": 0.2, "kV": 2.0, "kA": 0.3})
SLOWER = 0.9  # of what the base model says, the robot reaches: the drag that it lacks
TESTS = ("quasistatic-forward", "dynamic-reverse", "dynamic-reverse")


def motion(test):
    """(n, 4) time, voltage, position and velocity without noise."""
    time = 0.02 * np.arange(150)
    size = 1.0 * time if test.startswith("quasistatic") else np.full(150, 4.0)
    volts = size if test.endswith("forward") else -size
    speed = SLOWER * np.sign(volts) * np.maximum(np.abs(volts) - 0.2, 0.0) / 2.0
    return np.column_stack([time, volts, 0.02 * np.cumsum(speed), speed])


MOTIONS = [motion(test) for test in TESTS]
RIGHT = tuple(one[:, 2:] for one in MOTIONS)  # what a model with drag says
WRONG = tuple(one[:, 2:] / SLOWER for one in MOTIONS)  # and one without


def shown():
    """The log that was held out, which its owner thinks of in feet."""
    rng = np.random.default_rng(1)
    runs = []
    for test, one in zip(TESTS, MOTIONS, strict=True):
        time, volts, position, speed = one.T
        runs.append(
            Run(
                test, time, volts, position + 1e-4 * rng.normal(size=150),
                speed + NOISE * rng.normal(size=150),
            )
        )  # fmt: skip
    return Log(tuple(runs), units="feet", source="held out.csv")


def gap_of(log, tracks):
    """[ft/s] RMS of the velocities missed."""
    missed = [run.velocity - track[:, 1] for run, track in zip(log.runs, tracks, strict=True)]
    return float(np.sqrt(np.mean(np.concatenate(missed) ** 2))) / FOOT


DRAG = Finding(
    effect="drag",
    kind="effect",
    size="major",
    ambiguous_with=(),
    parameters={"drag": ParameterEstimate(0.11234, 0.0021, "V·s²/ft²")},
    gap_before=1.0,
    gap_after=0.0328,
    sentence="Drag pushes back with the square of speed.",
    inspect="Check whether grease has become stiff.",
    separating_test="",
    probability=1.0,
)
SLIP = Finding(
    effect="encoder-slip",
    kind="fault",
    size="major",
    ambiguous_with=(),
    parameters={},
    gap_before=1.0,
    gap_after=1.0,
    sentence="The velocity reads 40% too little for 0.1 s.",
    inspect="Tighten what holds the sensor.",
    separating_test="",
    probability=1.0,
)
SAG = replace(
    DRAG,
    effect="battery-sag",
    size="minor",
    parameters={"share": ParameterEstimate(0.04, 0.01, "1")},
    sentence="A battery that gives way.",
    inspect="Check whether the battery is old.",
)
UNSURE = replace(
    DRAG,
    ambiguous_with=("stribeck",),
    separating_test="Record a coast. Only the voltage that drag takes grows with the speed.",
)
GAINS = {
    "kS": ParameterEstimate(0.2, 0.004, "V"),
    "kV": ParameterEstimate(2.0, 0.01, "V·s/ft"),
    "kA": ParameterEstimate(0.3, 0.02, "V·s²/ft"),
}
WITHOUT = GAINS | {"kV": ParameterEstimate(2.2, 0.05, "V·s/ft")}
TRIED = (
    TriedCandidate("drag", 812.0, 0.03, admitted=True, why=""),
    TriedCandidate("stribeck", 400.0, 1.2, admitted=False, why="widens the gap"),
    TriedCandidate("battery-sag", 120.0, 0.9, admitted=True, why=""),
    TriedCandidate("delay", -9.0, 1.0, admitted=False, why="explains too little"),
)
PLACE = Place("run", "dynamic-reverse, 0.2 to 0.4 s", -12.0, 31.0)


def story(*findings, verdict="explained", chapters=2, **changes):
    """A story in which drag was missing, or whatever is said instead."""
    log = shown()
    first = Chapter("", BASE, TRIED, gap_of(log, WRONG), WRONG)
    model = BASE + Part("drag", {"drag": 0.1})
    after = tuple(replace(one, admitted=False, improvement=-5.0) for one in TRIED[1:])
    second = Chapter("drag", model, after, gap_of(log, RIGHT), RIGHT)
    told = (first, second)[:chapters]
    made = Story(
        verdict=verdict,
        findings=findings,
        remainder=False,
        remains="",
        noise_floor=NOISE / FOOT,
        gap_before=told[0].gap,
        gap_after=told[-1].gap,
        where=(PLACE,),
        chapters=told,
        shown=log,
        how="The gap is shown on the held-out log, which was not used for any fit.",
        gains=GAINS,
        gains_without=GAINS if chapters == 1 else WITHOUT,
        notes=("One run was too short.",),
    )
    return replace(made, **changes)


def complete(**changes):
    """A story of a base model that is right."""
    made = story(verdict="nothing-missing", chapters=1, **changes)
    (base,) = made.chapters
    right = replace(base, tracks=RIGHT, gap=gap_of(made.shown, RIGHT), tried=TRIED[3:])
    return replace(made, chapters=(right,), gap_before=right.gap, gap_after=right.gap, where=())


REMAINS = {"remainder": True, "remains": "In dynamic-reverse, 1.0 to 1.2 s, an error remains."}
STORIES = {
    "nothing missing": complete(),
    "a little missing": story(SAG, verdict="nothing-missing"),
    "explained": story(DRAG),
    "explained, twice": story(DRAG, replace(DRAG, effect="cogging")),
    "only damage": story(SLIP, chapters=1),
    "damage and drag": story(SLIP, DRAG, SAG),
    "ambiguous": story(UNSURE, verdict="ambiguous"),
    "unexplained": story(verdict="unexplained", chapters=1, **REMAINS),
    "unexplained and damaged": story(SLIP, verdict="unexplained", chapters=1, **REMAINS),
    "explained, and something remains": story(DRAG, **REMAINS),
}
