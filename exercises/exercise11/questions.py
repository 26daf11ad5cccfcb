"""What is asked about guessing and measuring, and about everyday questions of a team."""

from .question import Option, Question

SPREAD = "M-ERROR-BAR"
WEIGHT = "M-KV-MASS"

GUESS = Option(
    "With which gain does the mechanism behave as I want?",
    "This question is about behavior. You have to answer it again whenever the mechanism or the "
    "battery changes. SysId's question is about the mechanism itself",
)
MODEL = Option(
    "Which model of the physics explains best how this mechanism moved?",
    (
        "You can only answer this question with recorded tests. Somebody who changes a gain and "
        "looks again asks a simpler question"
    ),
)
SHEET = Option(
    "Which gain does the data sheet of the motor give?",
    "A data sheet describes the motor, but not your gears, wheels and bearings. Guessing and "
    "SysId both try to include these parts, too",
)
OTHERS = Option(
    "Which gain do teams with a similar robot use?",
    (
        "Some people begin with the gains of other robots. But that is only a start: it is not "
        "the question that they want to answer"
    ),
)
ZERO = Option(
    "Which kP makes the error zero?",
    "kP is a gain of feedback. But guessing and SysId look for the gains of a model: kS, kV and kA",
)


def _right(option: Option) -> Option:
    return Option(option.text, share=1.0)


EVERYDAY = (
    Question(
        "Q0_guess",
        "Somebody tries gains, deploys the code, watches the robot, and tries other gains. Which "
        "question do they want to answer?",
        (_right(GUESS), MODEL, SHEET, OTHERS, ZERO),
    ),
    Question(
        "Q0_sysid",
        "Somebody runs the tests of SysId and fits the log of these tests. Which question do "
        "they want to answer?",
        (GUESS, _right(MODEL), SHEET, OTHERS, ZERO),
    ),
    Question(
        "Q0_brace",
        "In week 3 the team adds a steel brace, and the robot becomes heavier. Which gain of the "
        "drivetrain changes?",
        (
            Option("kA", share=1.0),
            Option(
                "kV",
                "kV depends on the motor, the gears and the wheel. Its formula does not contain "
                "the mass, because at a steady speed nothing accelerates",
                WEIGHT,
            ),
            Option(
                "kS",
                "kS comes from friction: in bearings, in gears, and between wheels and carpet. A "
                "brace makes it only a little larger. Look for the term that contains the "
                "acceleration",
                "M-HEAVIER-MORE-KS",
            ),
            Option(
                "none, as long as the motors stay the same",
                "The motors stay the same, but they have to move more mass. One of the three "
                "terms depends on the mass",
            ),
        ),
    ),
    Question(
        "kA_use",
        "A feedforward uses a drivetrain's kA. What else can you find out from this kA?",
        (
            Option(
                "The robot's mass; and if you measure kA while the robot turns, also its moment "
                "of inertia. A path planner needs both.",
                share=1.0,
            ),
            Option(
                "The robot's top speed.",
                "At top speed nothing accelerates, so the term kA·a is zero. Which gain decides "
                "the top speed?",
            ),
            Option(
                "How slippery the carpet is.",
                "The wheels either grip or slip, and you measure kA while they grip. kA depends "
                "on the mass that the motors accelerate",
            ),
            Option(
                "The state of the battery.",
                "kA says how many volts you need for each unit of acceleration. This number is "
                "the same with every battery",
            ),
        ),
    ),
    Question(
        "kS_flag",
        "Last week the left side of a drivetrain had kS = {ks_before:.2f} V. Today it has kS = "
        "{ks_today:.2f} V, and the right side still has {ks_before:.2f} V. What should the team "
        "do?",
        (
            Option(
                "First look for a part that rubs on the left side: a bearing, a belt or a chain.",
                share=1.0,
            ),
            Option(
                "Nothing: kS is still far below kV times the usual speed.",
                "That rule gives a warning only if friction needs more voltage than the speed. "
                "But here kS grew within a week, and only on one side. This is a good reason to "
                "look for the cause",
            ),
            Option(
                "Put the new kS into the code: then the feedforward compensates for it.",
                "Then the feedforward hides the problem. A part that rubs gets hot and wears "
                "out, so kS will be different again next week",
            ),
            Option(
                "Use the mean of left and right for both sides.",
                "Then both sides get a wrong voltage, and the robot pulls to one side",
            ),
            Option(
                "Make kV larger on the left side.",
                "The voltage kV·v grows with the speed, but dry friction needs the same voltage "
                "at every speed",
            ),
        ),
    ),
    Question(
        "step_shape",
        "The voltage of a drivetrain jumps to 3.5 V and stays there. In the log, the "
        "acceleration of the drivetrain stays the same for most of a second, and then becomes "
        "smaller. What do you check first?",
        (
            Option("Whether a current limit acted, or the wheels slipped.", share=1.0),
            Option(
                "Nothing: with a constant voltage the acceleration is constant.",
                "That would be true if the motor needed all the voltage for acceleration. But "
                "the faster the drivetrain moves, the larger kV·v becomes. How much voltage "
                "remains for kA·a?",
                "M-CONST-ACCEL",
            ),
            Option(
                "Whether kA is zero, so that the drivetrain accelerates without any voltage.",
                "If kA were zero, the drivetrain would reach its speed at once. But it needed "
                "most of a second",
            ),
            Option(
                "Whether the battery voltage dropped while the drivetrain got faster.",
                "The current is largest at the start and gets smaller with speed. The battery "
                "voltage would drop at the start and then recover",
            ),
            Option(
                "Whether the encoder uses a different unit.",
                "A different unit multiplies every acceleration by the same factor. The shape of "
                "the curve does not change",
                "M-UNITS",
            ),
        ),
    ),
    Question(
        "step_length",
        "A drivetrain has kA/kV = 0.08 s. Its dynamic test took 1 s. Somebody wants a more exact "
        "kA, and makes the test 5 s long. What happens?",
        (
            Option(
                (
                    "The test needs much more room, and kA is not more exact, because only the "
                    "start of the test shows kA."
                ),
                share=1.0,
            ),
            Option(
                "The log has five times as many samples, so kA is much more exact.",
                "Count the samples in which the drivetrain still gets faster. After a few times "
                "kA/kV its speed is almost constant. Samples without acceleration say nothing "
                "about kA",
                "M-LONG-DYN",
            ),
            Option(
                "SysId can no longer find kA, since the acceleration is zero most of the time.",
                "SysId ignores all samples after 90 % of the top speed, and fits only the start. "
                "A long test contains this start, too",
                "M-LONG-DYN",
            ),
            Option(
                "kA gets smaller, because the average acceleration is smaller.",
                "SysId does not use an average: every sample has its own voltage, speed and "
                "acceleration, and the sum of the terms must fit in each",
            ),
            Option(
                "kS is more exact, because the drivetrain moves for a longer time.",
                "At only one steady speed, you cannot tell kS and kV·v apart. Which test shows kS?",
            ),
        ),
    ),
    Question(
        "null_consumer",
        "The last argument of SysIdRoutine.Config is null. Where does WPILib write the name of "
        "the running test?",
        (
            Option("Into the WPILog of the robot, as a separate text entry.", share=1.0),
            Option(
                "Nowhere: with null nothing is recorded.",
                "null means that WPILib uses its default. Most teams use null for this argument, "
                "and the analyzer finds their four tests. So something is recorded",
            ),
            Option(
                "To the Driver Station's own log only.",
                "Many teams copied a comment that says so. But the analyzer does not open this "
                "log. Which file do you load into the analyzer?",
            ),
            Option(
                "The robot program stops with an error.",
                "null is allowed here. It means that WPILib uses its default",
            ),
        ),
    ),
    Question(
        "status_frames",
        "A motor controller sends its readings every {frame:d} ms, and the robot program logs "
        "every 5 ms. The log has no other fault. SysId finds kA = {ka_frames:.3f} V·s²/m, but "
        "from the motors and the mass you compute {ka_mass:.3f} V·s²/m. Measured and computed kV "
        "are the same. What do you do?",
        (
            Option(
                "Make the times equal: write the log only as often as the controller sends, or "
                "let it send more often. Then record again.",
                share=1.0,
            ),
            Option(
                "Use SysId's kA: a measured number is better than a computed one.",
                "Look at the rows of the log: several rows contain the same value. Between two "
                "equal rows SysId sees no acceleration. So this kA comes partly from repeated "
                "values",
                "M-MORE-ROWS",
            ),
            Option(
                "Write the log every 1 ms: more rows give a more exact kA.",
                "The controller does not send more values than before. Each value would only be "
                "repeated in more rows, and kA would be even smaller",
                "M-MORE-ROWS",
            ),
            Option(
                "Set a larger window for the median filter.",
                "A median filter with a large window cuts off the start of the dynamic test, so "
                "kA becomes even smaller. And equal rows stay equal",
                "M-FILTER-FREE",
            ),
            Option(
                "Find out where samples are missing, because the robot program is too slow.",
                "If samples were missing, the time between two rows would sometimes be longer. "
                "But here no row is missing. The problem is that too many rows are equal",
            ),
        ),
    ),
    Question(
        "three_logs",
        "A team records the four tests three times, and changes nothing between the recordings. "
        "`sysid fit` finds kA = {ka_first:.3f}, {ka_second:.3f} and {ka_third:.3f} V·s²/m, each "
        "± {ka_error:.3f}. What do you learn from these numbers?",
        (
            Option(
                "Something changes between the recordings, so the difference between the three "
                "kA shows the real error.",
                share=1.0,
            ),
            Option(
                "The difference is only noise, and the mean of all three is right to ± half of "
                "one error bar.",
                "The error bars already contain the noise, but the three kA differ by more than "
                "that. A mean hides the change, but does not remove it",
                SPREAD,
            ),
            Option(
                "The error bars are wrong: the same mechanism has the same kA.",
                "Each error bar only says how well one recording determines kA. It does not know "
                "that the motor was warmer or the battery emptier in the next recording",
                SPREAD,
            ),
            Option(
                "The one with the best R² is right; the others are bad recordings.",
                "The fit of each log may have a high R². R² compares a model with one log. It "
                "does not know which of the logs is most like your next match",
                "M-R2",
            ),
            Option(
                "One recording would have been enough: three are only confusing.",
                "With only one recording you would trust its small error bar. You would never "
                "see how different the next recording is",
                SPREAD,
            ),
        ),
    ),
    Question(
        "match_heat",
        "At the end of a match the copper of an elevator's motors is {hotter:d} °C warmer than in "
        "your tests, and the battery gives {tired:.1f} V. Your code sends volts, never more than "
        "{most:d} V. Which gains are different now?",
        (
            Option(
                "kS, kG and kA are larger, because warm copper has more resistance. kV is almost "
                "the same.",
                share=1.0,
            ),
            Option(
                "kV: with a weak battery, each volt gives less speed.",
                "One volt has the same effect with every battery. This battery can still give "
                "all the volts that your code sends",
                "M-SAG-ALWAYS-BAD",
            ),
            Option(
                "All of them, by the same percentage as the battery voltage.",
                "That would be true if the code sent a percentage of the battery voltage. But "
                "this code sends volts",
                "M-DUTY",
            ),
            Option(
                "None: gains belong to the mechanism, and it is the same mechanism.",
                "The motor is a part of the mechanism, and it is warmer now. How many volts does "
                "it need for the same force when its copper has more resistance?",
                "M-FF-EXACT",
            ),
            Option(
                "kG only: the elevator is heavier at the end of a match.",
                "The weight is the same. But the motor now needs more volts for the same force. "
                "Three of the terms are volts for a force",
            ),
        ),
    ),
    Question(
        "schedule",
        "When should a team characterize its drivetrain?",
        (
            Option("In the last two weeks of build season, when the robot is complete.", share=1.0),
            Option(
                "In the practice match of the first competition.",
                "The pit is as small as a parking space, and a drivetrain needs ten feet in both "
                "directions. There are also only eight minutes between matches",
            ),
            Option(
                "As soon as the frame can drive, and then never again.",
                "Everything that you add later makes the robot heavier. One of the gains will "
                "then be wrong",
                WEIGHT,
            ),
            Option(
                "After every change of the code.",
                "The gains describe the mechanism. Code does not change its mass or its gears",
            ),
        ),
    ),
)
