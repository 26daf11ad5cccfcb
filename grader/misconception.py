"""Misconceptions the examiner can name: a code for statistics, and what puts it right."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Misconception:
    """A wrong idea.

    Args:
        says: the sentence that puts it right.
        lesson: the name of the lesson's file that shows it, without its ending.
        section: a heading in that lesson, without its number.
    """

    says: str
    lesson: str
    section: str

    @property
    def where(self) -> str:
        """Where to read on: ``lesson 3, "Why reverse? Three reasons"``."""
        return f'lesson {int(self.lesson.partition("_")[0])}, "{self.section}"'


MISCONCEPTIONS: dict[str, Misconception] = {
    "M-UNITS": Misconception(
        "A number means something only with its unit. Change the unit, and the number changes "
        "with it: one rotation is 2π radians, one minute is 60 seconds.",
        lesson="01_motor_model",
        section="Units: per rotation, per radian, per meter",
    ),
    "M-ARGORDER": Misconception(
        "Values that stand side by side are told apart only by their order. Look up which comes "
        "first.",
        lesson="08_from_analyzer_to_robot",
        section="The class, and its slots",
    ),
    "M-CMDVOLT": Misconception(
        "What was asked for is not what the motor got: a weak battery or a current limit takes "
        "volts away, and a fit on asked-for volts puts the blame on kA.",
        lesson="04_wire_sysidroutine",
        section="Explain what you saw",
    ),
    "M-CLOSEDLOOP": Misconception(
        "A closed loop chooses its own voltage. Then the test no longer decides what the motor "
        "gets, and the fit describes your controller instead of your mechanism.",
        lesson="04_wire_sysidroutine",
        section="Mechanism, first callback: drive",
    ),
    "M-DUTY": Misconception(
        "A duty cycle is a share of whatever the battery gives at that moment; a voltage is the "
        "same with a full battery and with a tired one.",
        lesson="04_wire_sysidroutine",
        section="The virtual robot: one mistake at a time",
    ),
    "M-KS-INTERCEPT": Misconception(
        "The straight line through a slow ramp crosses v = 0 above kS: the ramp accelerates the "
        "mechanism all the time, and that costs kA·a on top.",
        lesson="03_test_design",
        section="Reading the ramp: the intercept drifts",
    ),
    "M-KG-EDGE": Misconception(
        "The voltage at which a mechanism just does not fall is not gravity alone: friction "
        "helps to hold it there, and is in the way where it just begins to rise. Gravity is the "
        "middle of that band, friction half its width.",
        lesson="02_gravity",
        section="Doing it: hold it still",
    ),
    "M-NO-KG-IN-SYSID": Misconception(
        "SysId does find kG, once it is told that there is gravity. Simple has no place for "
        "gravity: what gravity takes ends up in the other gains. With upward runs alone it is "
        "added to kS; with runs both ways kV may even come out negative.",
        lesson="02_gravity",
        section="From a log: choose the analysis type",
    ),
    "M-NOISE-AVERAGES": Misconception(
        "Noise in a column you fit with does not average out: it pulls that column's coefficient "
        "toward zero. In SysId's regression the coefficient of the voltage is 1/kA, so kA comes "
        "out too large. Let the noisiest column be the one you explain.",
        lesson="07_fit_it_yourself",
        section="Which side is noisy?",
    ),
    "M-REVERSE-WASTE": Misconception(
        "The reverse runs show whether friction is the same both ways, and gravity or a slope "
        "shows only as a difference between the two. SysId refuses to fit without them.",
        lesson="03_test_design",
        section="Why reverse? Three reasons",
    ),
    "M-R2": Misconception(
        "There is more than one R²: say of which quantity, and look up how it is computed. None "
        "of them is a lie detector: it can be high on a damaged log, so look at the signals, "
        "too.",
        lesson="06_read_the_data",
        section="R² is not a lie detector",
    ),
    "M-BIG-STEP": Misconception(
        "A big step spins the wheels, meets the current limit and drains the battery. A smaller "
        "one shows kA as well, as long as the motion stands out of the noise: 2 V does, 0.6 V "
        "does not.",
        lesson="03_test_design",
        section="Choose the step: hard enough, not too hard",
    ),
    "M-SLOW-SAFE": Misconception(
        "A slower ramp is not the safer one: it covers more ground on its way to the same speed.",
        lesson="03_test_design",
        section="Choose the ramp: how far will it go?",
    ),
    "M-LONG-DYN": Misconception(
        "A step has told all about kA after a few times kA/kV. What comes later is nearly "
        "steady speed: it costs room and tells only kV once more. SysId drops it; a fit that "
        "does not trim is none the better for it.",
        lesson="03_test_design",
        section="Choose when to stop: mark and timeout",
    ),
    "M-CONST-ACCEL": Misconception(
        "Under a constant voltage the acceleration dies away, with the timescale kA/kV: the "
        "faster it goes, the more volts kV·v takes. One that stays the same is the sign of a "
        "current limit or of wheels that slip.",
        lesson="03_test_design",
        section="The model: two tests, four runs",
    ),
    "M-KV-MASS": Misconception(
        "kV is what the motor's own back-EMF takes at a speed; mass has no part in it. A "
        "heavier robot gets up to speed more slowly, which is kA, and then needs the same "
        "volts.",
        lesson="01_motor_model",
        section="Where the prices come from",
    ),
    "M-BELOW-THEORY-OK": Misconception(
        "No mechanism is faster than its motor's free speed allows. A kV below theory is not a "
        "good robot, but a mistake in what was written down.",
        lesson="01_motor_model",
        section="Is this kV possible?",
    ),
    "M-LIMITS-BYPASSED": Misconception(
        "A test takes the place of your own commands, and goes around the limits in them. "
        "Limits set inside the motor controller go on acting, and then they are in your data.",
        lesson="05_preflight_and_run",
        section="Guard",
    ),
    "M-FF-EXACT": Misconception(
        "A feedforward is as good as its model, its gains and the day: a few percent are always "
        "left, and feedback is there for them.",
        lesson="08_from_analyzer_to_robot",
        section="Droop: what kP can do, and what not",
    ),
    "M-KP-EXACT": Misconception(
        "Proportional feedback makes its volts out of an error, so some of the error has to "
        "stay. A larger kP leaves less of it, never none.",
        lesson="08_from_analyzer_to_robot",
        section="Droop: what kP can do, and what not",
    ),
    "M-HEAVIER-MORE-KS": Misconception(
        "Dry friction comes mostly from bearings, gears and belts. Weight makes kG and kA larger. "
        "kS grows much less; on a drivetrain the carpet adds a little.",
        lesson="00_guess_or_measure",
        section="Week 3: a brace",
    ),
    "M-SAG-ALWAYS-BAD": Misconception(
        "A battery that sags does no harm to a fit on applied volts, as long as the volts asked "
        "for can still be had.",
        lesson="05_preflight_and_run",
        section="Battery",
    ),
    "M-TRIM-PRETTY": Misconception(
        "Trim where the physics of the test ends, not where the picture stops being pretty: "
        "fast samples tell kV and the first rise of a step tells kA, however noisy they are.",
        lesson="06_read_the_data",
        section="Do not trim for beauty",
    ),
    "M-FILTER-FREE": Misconception(
        "A filter is not free: a long one bends whatever is quicker than itself. A long median "
        "cuts away the start of a step, and kA comes out too small; an average makes the velocity "
        "late, and kA comes out too large.",
        lesson="07_fit_it_yourself",
        section="A filter is not free",
    ),
}
