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
    def reference(self) -> str:
        """Where to read on: ``lesson 3, "Why reverse? Three reasons"``."""
        return f'lesson {int(self.lesson.partition("_")[0])}, "{self.section}"'


MISCONCEPTIONS: dict[str, Misconception] = {
    "M-UNITS": Misconception(
        "A number means something only with its unit. If you change the unit, the number "
        "changes, too: one rotation is 2π radians, one minute is 60 seconds.",
        lesson="01_motor_model",
        section="Units: per rotation, per radian, per meter",
    ),
    "M-GEARING": Misconception(
        "A motor and its mechanism do not move equally fast. Divide the motor's speed by the "
        "gear ratio. In one turn, a wheel or drum moves π times its diameter. The diameter is "
        "twice the radius.",
        lesson="01_motor_model",
        section="Is this kV possible?",
    ),
    "M-ARGORDER": Misconception(
        "In a list of arguments, only the order tells the code which value is which. Look up in "
        "the documentation which argument comes first.",
        lesson="08_from_analyzer_to_robot",
        section="The class, and its arguments",
    ),
    "M-CMDVOLT": Misconception(
        "The motor does not always get the commanded voltage: an empty battery or a current "
        "limit makes the applied voltage smaller. A fit with the commanded voltage gives a wrong "
        "kA.",
        lesson="04_wire_sysidroutine",
        section="Explain what you saw",
    ),
    "M-CLOSEDLOOP": Misconception(
        "A closed loop chooses the voltage itself. Then the test no longer decides which voltage "
        "the motor gets, and the fit describes your controller instead of your mechanism.",
        lesson="04_wire_sysidroutine",
        section="Mechanism, first callback: drive",
    ),
    "M-DUTY": Misconception(
        "A duty cycle is a fraction of the present battery voltage, so it gives fewer volts with "
        "an empty battery. A voltage is the same with a full battery and with an empty one.",
        lesson="04_wire_sysidroutine",
        section="The virtual robot: one mistake at a time",
    ),
    "M-KS-INTERCEPT": Misconception(
        "If you draw a straight line through the data of a quasistatic test, the line meets v = "
        "0 at a voltage that is larger than kS. The reason is that the mechanism accelerates "
        "during the whole test, and the acceleration needs the voltage kA·a.",
        lesson="03_test_design",
        section="Reading the ramp: is the intercept kS?",
    ),
    "M-KG-EDGE": Misconception(
        "The voltage at which a mechanism no longer falls is smaller than kG, because friction "
        "helps to hold the mechanism. The voltage at which it begins to rise is larger than kG, "
        "because friction acts against the motion. kG is the middle between these two voltages, "
        "and kS is half their difference.",
        lesson="02_gravity",
        section="Doing it: hold it still",
    ),
    "M-NO-KG-IN-SYSID": Misconception(
        "SysId does find kG, if you choose the type Elevator or Arm. The type Simple has no "
        "gravity term, so gravity makes the other gains wrong: kV may even be negative. From "
        "upward runs alone, a fit without a gravity term adds kG to kS. (SysId does not accept "
        "such a log.)",
        lesson="02_gravity",
        section="From a log: choose the analysis type",
    ),
    "M-NOISE-AVERAGES": Misconception(
        "Noise in a column of a fit does not average out: it makes the coefficient of that "
        "column too small. If the acceleration is a column, its coefficient is kA, so kA becomes "
        "too small. Put the noisiest signal alone on the left side of the equation.",
        lesson="07_fit_it_yourself",
        section="Which side is noisy?",
    ),
    "M-REVERSE-WASTE": Misconception(
        "You need the reverse runs to see whether friction is the same in both directions. On an "
        "elevator, only the difference between forward and reverse shows gravity; on a "
        "drivetrain, only this difference shows a floor that is not level. "
        "SysId does not accept a log without reverse runs.",
        lesson="03_test_design",
        section="Why reverse? Three reasons",
    ),
    "M-R2": Misconception(
        "There is more than one R²: say which one you mean, and look up how it is computed. A "
        "high R² does not prove that a log is good, because a log with faults can have a high "
        "R², too. So always look at the signals.",
        lesson="06_read_the_data",
        section="R² does not find every bad log",
    ),
    "M-BIG-STEP": Misconception(
        "With a big voltage step the wheels can slip, the current can reach its limit, and the "
        "battery voltage drops. A smaller step shows kA just as well, if the motion is clearly "
        "larger than the noise: 2 V is enough, 0.6 V is not.",
        lesson="03_test_design",
        section="Choose the step: hard enough, not too hard",
    ),
    "M-SLOW-SAFE": Misconception(
        "A slower quasistatic test is not safer, because it needs more room to reach the same "
        "speed.",
        lesson="03_test_design",
        section="Choose the ramp: how far will it go?",
    ),
    "M-LONG-DYN": Misconception(
        "A dynamic test shows kA only at its start, for a few times kA/kV. After that the speed "
        "is almost steady: this part of the test needs room, but only shows kV. SysId ignores "
        "this part. Other fits can become worse if you do not trim it.",
        lesson="03_test_design",
        section="Choose when to stop: mark and timeout",
    ),
    "M-CONST-ACCEL": Misconception(
        "With a constant voltage the acceleration becomes smaller and smaller, with the time "
        "constant kA/kV. The faster the mechanism moves, the more volts it needs for kV·v. If "
        "the acceleration stays the same, a current limit acts or the wheels slip.",
        lesson="03_test_design",
        section="The model: two tests, four runs",
    ),
    "M-KV-MASS": Misconception(
        "kV comes from the back-EMF of the motor, and does not depend on the mass. A heavier "
        "robot has a larger kA, so it needs more time to reach its speed. At this speed it needs "
        "the same volts as before.",
        lesson="01_motor_model",
        section="Where the prices come from",
    ),
    "M-BELOW-THEORY-OK": Misconception(
        "No mechanism is faster than its motor's free speed allows. A kV below theory does not "
        "mean that the robot is good. It means that somebody wrote down a wrong number.",
        lesson="01_motor_model",
        section="Is this kV possible?",
    ),
    "M-LIMITS-BYPASSED": Misconception(
        "While a test runs, your own commands do not run, so the limits in your commands do not "
        "act. Limits that you set inside the motor controller still act, and you can see their "
        "effect in your data.",
        lesson="05_preflight_and_run",
        section="Guard",
    ),
    "M-FF-EXACT": Misconception(
        "A feedforward is only as good as its model and its gains. An error of a few percent "
        "always remains, and feedback corrects it.",
        lesson="08_from_analyzer_to_robot",
        section="What kP can do, and what not",
    ),
    "M-KP-EXACT": Misconception(
        "Proportional feedback needs an error to give a voltage, so a part of the error remains. "
        "With a larger kP the remaining error is smaller, but never zero.",
        lesson="08_from_analyzer_to_robot",
        section="What kP can do, and what not",
    ),
    "M-HEAVIER-MORE-KS": Misconception(
        "Dry friction comes mostly from bearings, gears and belts. Weight makes kG and kA "
        "larger. Weight makes kS only a little larger, for example because the wheels of a "
        "drivetrain press harder on the carpet.",
        lesson="00_guess_or_measure",
        section="Week 3: a brace",
    ),
    "M-SAG-ALWAYS-BAD": Misconception(
        "A low battery voltage does not make a fit wrong if the log contains the applied "
        "voltage, and if the battery can still give the commanded voltage.",
        lesson="05_preflight_and_run",
        section="Battery",
    ),
    "M-TRIM-PRETTY": Misconception(
        "Trim the parts of a log in which the model is not true, not the parts that look ugly. "
        "You need the fast samples for kV, and the first rise of a dynamic test for kA, even if "
        "they are noisy.",
        lesson="06_read_the_data",
        section="Do not cut off good samples",
    ),
    "M-FILTER-FREE": Misconception(
        "Every filter changes the signal: a long filter flattens all changes that are shorter "
        "than the filter. A long median filter cuts off the start of a dynamic test, and kA "
        "becomes too small. Some sensors average the velocity, such as the encoder inside a NEO. "
        "Then the velocity in the log is late, and kA becomes too large.",
        lesson="07_fit_it_yourself",
        section="A filter has a disadvantage",
    ),
    "M-MORE-ROWS": Misconception(
        "A log contains only what the sensor sends. Rows that repeat a value add no information. "
        "Where a velocity is repeated, SysId computes an acceleration of zero, so kA becomes too "
        "small.",
        lesson="06_read_the_data",
        section="How bad are repeated samples?",
    ),
    "M-ERROR-BAR": Misconception(
        "An error bar says how well one recording determines a gain. But the battery, the heat "
        "or a bearing can change before the next recording. The error bar does not contain such "
        "changes: you only see them if you record the tests again.",
        lesson="08_from_analyzer_to_robot",
        section="Your own robot",
    ),
    "M-LEVER": Misconception(
        "The lever of a wheel is the distance from the middle of the robot to the line along "
        "which the wheel pushes. For a tank drive the lever is half the trackwidth. The modules "
        "of a square swerve drive are at the corners and push at a right angle to the diagonal, "
        "so the lever is half the diagonal: the trackwidth divided by √2.",
        lesson="10_swerve",
        section="Turning on the spot: the moment of inertia",
    ),
    "M-HELD-OUT": Misconception(
        "A log by which you choose effects cannot show how good the choice is: you kept what makes "
        "its gap small. Only a log that you did not use for fitting or choosing shows this.",
        lesson="09_reality_gap",
        section="The held-out log, once",
    ),
}
