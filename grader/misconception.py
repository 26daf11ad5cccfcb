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
    "M-GEARING": Misconception(
        "A motor and its mechanism do not move equally fast. Divide the motor's speed by the gear "
        "ratio. One turn of a wheel or drum then goes π times its diameter, which is twice its "
        "radius.",
        lesson="01_motor_model",
        section="Is this kV possible?",
    ),
    "M-ARGORDER": Misconception(
        "Only their order separates values in a list of arguments. Look up which comes first.",
        lesson="08_from_analyzer_to_robot",
        section="The class, and its arguments",
    ),
    "M-CMDVOLT": Misconception(
        "The commanded voltage is not the applied voltage: an empty battery or a current limit "
        "reduces it, and a fit on commanded volts gives a wrong kA.",
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
        "A duty cycle is a share of the present battery voltage; a voltage is the same with a "
        "full battery and with an empty one.",
        lesson="04_wire_sysidroutine",
        section="The virtual robot: one mistake at a time",
    ),
    "M-KS-INTERCEPT": Misconception(
        "The straight line through a slow ramp meets v = 0 above kS: the ramp accelerates the "
        "mechanism all the time, and that takes kA·a in addition.",
        lesson="03_test_design",
        section="Reading the ramp: is the intercept kS?",
    ),
    "M-KG-EDGE": Misconception(
        "The voltage at which a mechanism no longer falls is not kG: friction helps to hold "
        "it there, and acts against you where it begins to rise. kG is the middle of that "
        "band, kS is half its width.",
        lesson="02_gravity",
        section="Doing it: hold it still",
    ),
    "M-NO-KG-IN-SYSID": Misconception(
        "SysId does find kG, if you choose the type Elevator or Arm. Simple has no gravity "
        "term, so gravity makes the other gains wrong. With upward runs alone kG is added to "
        "kS; with runs both ways kV may even be negative.",
        lesson="02_gravity",
        section="From a log: choose the analysis type",
    ),
    "M-NOISE-AVERAGES": Misconception(
        "Noise in a column of a fit does not average out: it makes the coefficient of that "
        "column too small. In SysId's regression the coefficient of the voltage is 1/kA, so kA "
        "becomes too large. Put the noisiest quantity on the left side.",
        lesson="07_fit_it_yourself",
        section="Which side is noisy?",
    ),
    "M-REVERSE-WASTE": Misconception(
        "Only the reverse runs show whether friction is the same in both directions, and only "
        "the difference between the directions shows gravity or a slope. SysId refuses to fit "
        "without them.",
        lesson="03_test_design",
        section="Why reverse? Three reasons",
    ),
    "M-R2": Misconception(
        "There is more than one R²: say which one, and look up how it is computed. A high R² "
        "does not prove a good log: it can be high on a damaged log, so look at the signals, "
        "too.",
        lesson="06_read_the_data",
        section="R² does not find every bad log",
    ),
    "M-BIG-STEP": Misconception(
        "A big step spins the wheels, reaches the current limit and drains the battery. A "
        "smaller one shows kA as well, as long as you see the motion above the noise: 2 V is "
        "enough, 0.6 V is not.",
        lesson="03_test_design",
        section="Choose the step: hard enough, not too hard",
    ),
    "M-SLOW-SAFE": Misconception(
        "A slower ramp is not safer: it needs more room to reach the same speed.",
        lesson="03_test_design",
        section="Choose the ramp: how far will it go?",
    ),
    "M-LONG-DYN": Misconception(
        "A step shows everything about kA in the first few times kA/kV. After that the speed is"
        " nearly steady: this needs room and shows only kV again. SysId drops it; a fit that "
        "does not trim becomes worse.",
        lesson="03_test_design",
        section="Choose when to stop: mark and timeout",
    ),
    "M-CONST-ACCEL": Misconception(
        "With a constant voltage the acceleration fades, with the time constant kA/kV: the "
        "faster it goes, the more volts kV·v takes. If it stays the same, a current limit acts "
        "or the wheels slip.",
        lesson="03_test_design",
        section="The model: two tests, four runs",
    ),
    "M-KV-MASS": Misconception(
        "kV is the motor's own back-EMF; it does not depend on mass. A heavier robot reaches "
        "its speed more slowly, which is kA, and then needs the same volts.",
        lesson="01_motor_model",
        section="Where the prices come from",
    ),
    "M-BELOW-THEORY-OK": Misconception(
        "No mechanism is faster than its motor's free speed allows. A kV below theory does not "
        "mean a good robot; somebody wrote down a wrong number.",
        lesson="01_motor_model",
        section="Is this kV possible?",
    ),
    "M-LIMITS-BYPASSED": Misconception(
        "A test replaces your own commands, and so it bypasses the limits in them. Limits set "
        "inside the motor controller still act, and then your data show them.",
        lesson="05_preflight_and_run",
        section="Guard",
    ),
    "M-FF-EXACT": Misconception(
        "A feedforward is only as good as its model and its gains. An error of a few percent "
        "always remains, and feedback corrects it.",
        lesson="08_from_analyzer_to_robot",
        section="Droop: what kP can do, and what not",
    ),
    "M-KP-EXACT": Misconception(
        "Proportional feedback needs an error to give a voltage, so a part of the error "
        "remains. A larger kP leaves less, but never zero.",
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
        "A low battery voltage does no harm to a fit on applied volts, as long as the battery "
        "can still give the commanded voltage.",
        lesson="05_preflight_and_run",
        section="Battery",
    ),
    "M-TRIM-PRETTY": Misconception(
        "Trim where the model is no longer true, not where the picture looks ugly: fast samples"
        " determine kV and the first rise of a step determines kA, however noisy they are.",
        lesson="06_read_the_data",
        section="Do not cut off good samples",
    ),
    "M-FILTER-FREE": Misconception(
        "A filter has a price: a long one flattens everything that is faster than itself. A "
        "long median cuts off the start of a step, and kA becomes too small. A sensor that "
        "averages, as a NEO's own encoder does, makes the velocity late, and kA becomes too large.",
        lesson="07_fit_it_yourself",
        section="A filter has a disadvantage",
    ),
    "M-MORE-ROWS": Misconception(
        "A log knows no more than the sensor sends. Rows that repeat a reading add nothing, and "
        "SysId takes each repetition for a moment without acceleration: kA becomes too small.",
        lesson="06_read_the_data",
        section="How bad are repeated samples?",
    ),
    "M-ERROR-BAR": Misconception(
        "An error bar tells how well one recording determines a gain. It does not know what "
        "changes until the next recording: battery, heat, a bearing. Only repeating shows that.",
        lesson="08_from_analyzer_to_robot",
        section="Your own robot",
    ),
    "M-LEVER": Misconception(
        "The lever of a wheel is how far its push passes from the middle. For a tank that is half "
        "the trackwidth; the modules of a square swerve push across the diagonal, so it is the "
        "trackwidth divided by √2.",
        lesson="10_swerve",
        section="Turning on the spot: the moment of inertia",
    ),
}
