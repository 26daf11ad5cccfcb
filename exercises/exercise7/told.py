"""What a learner is told about a wrong log: how their fault would look, and where to look next.

Nothing here names what it really is.
"""

ACCEPTED = {  # fault -> what helps
    "encoder-slip": ("rerun", "trim"),
    "brownout": ("rerun",),
    "hard-stop": ("trim", "rerun"),
    "loop-overrun": ("rerun", "fix-config"),
    "stale-samples": ("fix-config",),
    "command-logged": ("fix-config",),
    "unit-error": ("fix-config",),
    "sign-flip": ("fix-config",),
    "mislabelled-test": ("fix-config",),
    "noisy-standstill": ("filter", "trim"),
    "voltage-dropout": ("fix-config", "rerun"),
    "stuck-sensor": ("rerun", "trim"),
    "wheel-slip": ("rerun", "fix-config"),
}

LOOKS = {  # fault -> how it would look, if it were there
    "encoder-slip": "the velocity hops by a share of itself within one sample and hops back, which "
    "no mass can do",
    "brownout": "the velocity sinks gradually, as with the motor off, and climbs back gradually, "
    "while the voltage stays as it was",
    "hard-stop": "the velocity is gone within a few samples, never comes back in that test, and "
    "the position stays, while the voltage pushes on",
    "loop-overrun": "samples are missing: two neighbors are 80 ms or more apart",
    "stale-samples": "every reading is repeated several times, all through the log: stairs",
    "command-logged": "the dynamic voltage is a perfect step, yet the velocity first rises along "
    "a straight line and only then bends",
    "unit-error": "the velocity is many times, or a small part of, the slope of the position",
    "sign-flip": "voltage and velocity, or velocity and the slope of the position, have opposite "
    "signs in a whole test",
    "mislabelled-test": "a test called dynamic has a ramp, or a test called forward goes backward "
    "with a negative voltage",
    "noisy-standstill": "the velocity trembles at the beginning of a ramp, while the position "
    "does not change",
    "voltage-dropout": "the voltage falls for a sample or two and is back, over and over, and the "
    "velocity does not care",
    "stuck-sensor": "position and velocity both freeze at one value, and then jump to where they "
    "should be",
    "wheel-slip": "a dynamic test surges at its start, lulls, and only then climbs as a mass does",
}

PLOTS = {  # what it really is -> which plot tells, without its name
    "encoder-slip": "Plot the velocity close up: from one sample to the next, how much can a mass "
    "change its speed?",
    "brownout": "Plot velocity and voltage one above the other: does the one do what the other "
    "says? How fast does it go, and how does it come back?",
    "hard-stop": "Plot velocity, voltage and position of each test's last second.",
    "loop-overrun": "Plot the time from each sample to the next.",
    "stale-samples": "Plot the velocity close up with a dot for each sample: is each one new?",
    "command-logged": "Plot voltage and velocity of the dynamic tests' first half second: which "
    "shape should the rise have?",
    "unit-error": "Plot the position: is its slope the velocity? Work it out at one place.",
    "sign-flip": "Plot all three signals of each test and write down their signs.",
    "mislabelled-test": "Plot the voltage of each test beside the name it has.",
    "noisy-standstill": "Plot velocity and position before the ramp begins to move.",
    "voltage-dropout": "Plot the voltage close up, with a dot for each sample.",
    "stuck-sensor": "Plot velocity and position close up with a dot for each sample.",
    "wheel-slip": "Plot the dynamic tests' first half second: does the velocity bend only once?",
}

APART = {  # (said, is) -> the question that tells the two apart
    ("encoder-slip", "wheel-slip"): "A sensor can slip at any speed. When did this begin?",
    ("wheel-slip", "encoder-slip"): "A lurch of the wheels belongs to the first push of a step. "
    "When did this begin?",
    ("brownout", "hard-stop"): "Without a motor it would coast, and speed up again. Does it?",
    ("hard-stop", "brownout"): "Who stands against metal does not move on. Does the position?",
    ("encoder-slip", "brownout"): "Is it gone at once, or along a curve?",
    ("brownout", "encoder-slip"): "Is it gone along a curve, or at once?",
    ("loop-overrun", "stale-samples"): "Count: are samples missing, or are there too many alike?",
    ("stale-samples", "loop-overrun"): "Count: are readings repeated, or are there too few?",
    ("stuck-sensor", "stale-samples"): "Once, or all the time?",
    ("stale-samples", "stuck-sensor"): "All the time, or once?",
    ("hard-stop", "stuck-sensor"): "At a stop the velocity is zero. Is it?",
    ("stuck-sensor", "hard-stop"): "A frozen sensor shows any velocity. Which does yours show?",
    ("brownout", "voltage-dropout"): "The log of a brownout goes on to tell the voltage. Does it?",
    ("voltage-dropout", "brownout"): "Does the velocity care?",
    ("command-logged", "wheel-slip"): "Too slow at first, or too fast?",
    ("wheel-slip", "command-logged"): "Too fast at first, or too slow?",
}

ACTS = {  # what an action is for
    "rerun": "rerun helps where the next recording would be better by itself, or once a part is "
    "mended",
    "trim": "trim helps where one part is bad and the rest of the test is sound",
    "filter": "filter helps where single samples tremble and the others are sound",
    "fix-config": "fix-config helps where the program or a setting makes every recording wrong",
}


def mixed_up(said: str, really: str) -> str:
    """What to say of a fault that was taken for another one."""
    asks = APART.get((said, really), "")
    return " ".join(part for part in (would_show(said), asks, PLOTS[really]) if part)


def would_show(said: str) -> str:
    """How a fault would look, if it were there."""
    return f"{said} would show like this: {LOOKS[said]}."


def overlooked(really: str) -> str:
    """What to say of a fault that nobody named."""
    return (
        f"Something is wrong here. A fit may have a fine R² all the same: look at the signals. "
        f"{PLOTS[really]}"
    )
