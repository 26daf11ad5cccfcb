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
    "encoder-slip": (
        "the velocity jumps by a share of its value within one sample and later jumps back, "
        "faster than any mass can"
    ),
    "brownout": "the velocity falls gradually, as with the motor off, and rises again "
    "gradually, while the voltage stays as it was",
    "hard-stop": "the velocity drops to zero within a few samples and stays there, the position"
    " stays, and the voltage stays on",
    "loop-overrun": "samples are missing: two neighbors are 80 ms or more apart",
    "stale-samples": "every reading is repeated several times in the whole log: stairs",
    "command-logged": "the dynamic voltage is a perfect step, but the velocity first rises "
    "along a straight line and bends only later",
    "unit-error": "the velocity is much larger or much smaller than the slope of the position",
    "sign-flip": "voltage and velocity, or velocity and the slope of the position, have opposite "
    "signs in a whole test",
    "mislabelled-test": "a test called dynamic has a ramp, or a test called forward goes backward "
    "with a negative voltage",
    "noisy-standstill": "the velocity is noisy at the start of a ramp, while the position does "
    "not change",
    "voltage-dropout": "the voltage drops for a sample or two, again and again, and the "
    "velocity does not react",
    "stuck-sensor": "position and velocity both freeze at one value, and then jump to where they "
    "should be",
    "wheel-slip": (
        "in a dynamic test the velocity jumps up at the start, pauses, and only then "
        "rises like that of a mass"
    ),
}

PLOTS = {  # what it really is -> which plot tells, without its name
    "encoder-slip": "Plot the velocity close up: from one sample to the next, how much can a mass "
    "change its speed?",
    "brownout": "Plot velocity and voltage one above the other: does the velocity follow the "
    "voltage? How does it fall, and how does it rise again?",
    "hard-stop": "Plot velocity, voltage and position of the last second of each test.",
    "loop-overrun": "Plot the time from each sample to the next.",
    "stale-samples": "Plot the velocity close up with a dot for each sample. Is each dot a new "
    "reading, or does it repeat the one before?",
    "command-logged": "Plot voltage and velocity of the first half second of the dynamic tests:"
    " which shape should the rise have?",
    "unit-error": "Plot the position: is its slope the velocity? Compute it at one point.",
    "sign-flip": "Plot all three signals of each test and write down their signs.",
    "mislabelled-test": (
        "Plot the voltage of each test, and compare it with the name of the test."
    ),
    "noisy-standstill": "Plot velocity and position before the mechanism starts to move.",
    "voltage-dropout": "Plot the voltage close up, with a dot for each sample.",
    "stuck-sensor": "Plot velocity and position close up with a dot for each sample.",
    "wheel-slip": (
        "Plot the first half second of the dynamic tests. How many bends does the velocity curve "
        "have?"
    ),
}

APART = {  # (said, is) -> the question that tells the two apart
    ("encoder-slip", "wheel-slip"): "A sensor can slip at any speed. When did this begin?",
    ("wheel-slip", "encoder-slip"): "Wheels slip at the start of a step. When did this begin?",
    ("brownout", "hard-stop"): (
        "Without power the mechanism would coast, and later speed up again. Does it?"
    ),
    ("hard-stop", "brownout"): (
        "At a hard stop the mechanism cannot move. Does the position change?"
    ),
    ("encoder-slip", "brownout"): "Does the velocity drop at once, or along a curve?",
    ("brownout", "encoder-slip"): "Does the velocity drop along a curve, or at once?",
    ("loop-overrun", "stale-samples"): "Count: are samples missing, or are many samples equal?",
    ("stale-samples", "loop-overrun"): "Count: are readings repeated, or are samples missing?",
    ("stuck-sensor", "stale-samples"): "Does it happen once, or all the time?",
    ("stale-samples", "stuck-sensor"): "Does it happen all the time, or once?",
    ("hard-stop", "stuck-sensor"): "At a stop the velocity is zero. Is it?",
    ("stuck-sensor", "hard-stop"): "A frozen sensor can show any velocity. Which does yours show?",
    ("brownout", "voltage-dropout"): "In a brownout the log still shows a voltage. Does yours?",
    ("voltage-dropout", "brownout"): "When the voltage drops, does the velocity react?",
    ("command-logged", "wheel-slip"): "At first, is the mechanism too slow or too fast?",
    ("wheel-slip", "command-logged"): "At first, is the mechanism too fast or too slow?",
}

ACTS = {  # what an action is for
    "rerun": "rerun helps if the next recording will be better, or after you repaired a part",
    "trim": "trim helps if one part is bad and the rest of the test is good",
    "filter": "filter helps if single samples are noisy and the others are good",
    "fix-config": "fix-config helps if the program or a setting makes every recording wrong",
}


def explain_mixed_up(said: str, really: str) -> str:
    """What to say of a fault that was taken for another one."""
    asks = APART.get((said, really), "")
    return " ".join(part for part in (explain_false_alarm(said), asks, PLOTS[really]) if part)


def explain_false_alarm(said: str) -> str:
    """How a fault would look, if it were there."""
    return f"{said} would look like this: {LOOKS[said]}."


def explain_overlooked(really: str) -> str:
    """What to say of a fault that nobody named."""
    return (
        f"Something is wrong here. The R² may be good anyway: look at the signals. {PLOTS[really]}"
    )
