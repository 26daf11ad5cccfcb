"""What is asked about guessing and measuring, and about everyday questions of a team."""

from .question import Option, Question

SPREAD = "M-ERROR-BAR"
WEIGHT = "M-KV-MASS"

GUESS = Option(
    "Which gain makes it behave the way I like?",
    "That question is about behavior, so you have to answer it again whenever the mechanism "
    "or the battery changes. The other question is about the mechanism itself",
)
MODEL = Option(
    "Which model of the physics explains best what this mechanism did?",
    (
        "This question needs recorded tests. Somebody who turns a knob and looks again asks a "
        "simpler one"
    ),
)
SHEET = Option(
    "Which gain does the data sheet of the motor give?",
    "A data sheet describes the motor, but not your gears, wheels and bearings. Neither "
    "guessing nor SysId stops there",
)
OTHERS = Option(
    "Which gain do teams with a similar robot use?",
    (
        "Some people start to guess with the gains of other robots. But that is not the question "
        "itself"
    ),
)
ZERO = Option(
    "Which kP makes the error zero?",
    "kP belongs to feedback. This question is about the gains of a model: kS, kV and kA",
)


def _right(option: Option) -> Option:
    return Option(option.text, share=1.0)


EVERYDAY = (
    Question(
        "Q0_guess",
        "Somebody tries gains, deploys, watches, and tries again. Which question do they ask?",
        (_right(GUESS), MODEL, SHEET, OTHERS, ZERO),
    ),
    Question(
        "Q0_sysid",
        "Somebody runs the tests of SysId and fits their log. Which question do they ask?",
        (GUESS, _right(MODEL), SHEET, OTHERS, ZERO),
    ),
    Question(
        "Q0_brace",
        "In week 3 a steel brace makes the robot heavier. Which gain of the drivetrain has to "
        "change with it?",
        (
            Option("kA", share=1.0),
            Option(
                "kV",
                "kV depends on motor, gears and wheel. There is no mass in its formula: at a "
                "steady speed nothing accelerates",
                WEIGHT,
            ),
            Option(
                "kS",
                "kS is friction in bearings and gears. A brace adds little to it; look for the "
                "term that contains the acceleration",
                "M-HEAVIER-MORE-KS",
            ),
            Option(
                "none, as long as the motors stay the same",
                "The motors stay the same, but they have to move more mass. One of the three "
                "terms contains the mass",
            ),
        ),
    ),
    Question(
        "kA_use",
        "What else is a drivetrain's kA good for, besides the feedforward?",
        (
            Option(
                "It gives the robot's mass and, measured while turning, its moment of inertia, "
                "which a path planner needs.",
                share=1.0,
            ),
            Option(
                "It gives the robot's top speed.",
                "At top speed nothing accelerates, and the term of kA is zero. Which gain is left?",
            ),
            Option(
                "It shows how slippery the carpet is.",
                "The wheels either grip or slip; you measure kA while they grip. It depends on "
                "the mass to accelerate",
            ),
            Option(
                "It shows the state of the battery.",
                "kA is volts for each unit of acceleration, whatever battery they come from",
            ),
        ),
    ),
    Question(
        "kS_flag",
        "Last week the left side of a drivetrain had kS = {ks_before:.2f} V. Today it has "
        "kS = {ks_today:.2f} V, and the right side still has {ks_before:.2f} V. What now?",
        (
            Option(
                "First look for the part that rubs on the left side: bearing, belt, chain.",
                share=1.0,
            ),
            Option(
                "Nothing: it is still far below kV times the usual speed.",
                "That rule only warns when friction needs more voltage than the speed itself. "
                "kS grew within a week, and on one side only: that is reason enough to look",
            ),
            Option(
                "Put the new kS into the code: then the feedforward compensates for it.",
                "The feedforward would hide the problem. A part that rubs gets hot and wears "
                "out, and next week kS is different again",
            ),
            Option(
                "Take the mean of left and right for both sides.",
                "Then both sides get a wrong voltage, and the robot pulls to one side",
            ),
            Option(
                "Make kV larger on the left side.",
                "kV grows with speed; dry friction is the same at every speed",
            ),
        ),
    ),
    Question(
        "step_shape",
        "The voltage of a drivetrain jumps to 3.5 V and stays there. In the log its acceleration "
        "stays the same for most of a second, and then falls. What do you look at first?",
        (
            Option("Did a current limit act, or did the wheels slip?", share=1.0),
            Option(
                "Nothing: under a constant voltage the acceleration is constant.",
                "It would be if all the voltage went into acceleration. The faster it goes, the"
                " more kV·v takes. How much remains for kA·a?",
                "M-CONST-ACCEL",
            ),
            Option(
                "Whether kA is zero: nothing held it back.",
                "Without kA it would reach its speed at once. This one took most of a second",
            ),
            Option(
                "Whether the battery sagged as it got faster.",
                "The current is largest at the start and gets smaller with speed. The battery "
                "voltage would drop at the start and then recover",
            ),
            Option(
                "Whether the encoder counts in other units.",
                "Another unit multiplies every acceleration by one factor. The shape of the "
                "curve stays the same",
                "M-UNITS",
            ),
        ),
    ),
    Question(
        "step_length",
        "A drivetrain has kA/kV = 0.08 s. Its dynamic test took 1 s. Somebody wants a better kA"
        " and makes the test 5 s long. What happens?",
        (
            Option(
                (
                    "It needs much more room, and kA is no better: only the first moments contain "
                    "kA."
                ),
                share=1.0,
            ),
            Option(
                "Five times as many samples: kA gets clearly better.",
                "Count the samples in which it still gets faster. After a few times kA/kV it "
                "hardly does, and samples without acceleration contain nothing about kA",
                "M-LONG-DYN",
            ),
            Option(
                "SysId can no longer find kA, since the acceleration is zero most of the time.",
                "SysId drops everything after 90 % of the top speed, and fits the start, which "
                "a long test contains as well",
                "M-LONG-DYN",
            ),
            Option(
                "kA gets smaller, because the average acceleration is smaller.",
                "SysId does not use an average: every sample has its own voltage, speed and "
                "acceleration, and the sum of the terms must fit in each",
            ),
            Option(
                "kS gets better, because it moves for longer.",
                "At one steady speed nothing separates kS from kV·v. Which test shows kS?",
            ),
        ),
    ),
    Question(
        "null_consumer",
        "The last argument of SysIdRoutine.Config is null. Where does the name of the running test "
        "go?",
        (
            Option("Into the WPILog of the robot, as a separate text entry.", share=1.0),
            Option(
                "Nowhere: with null nothing is recorded.",
                "null means: use the default. If nothing were recorded, the analyzer could not "
                "find the four tests, and most teams use null there",
            ),
            Option(
                "To the Driver Station's own log only.",
                "A comment that many people copy says so. But the analyzer opens another file: "
                "which file do you load into it?",
            ),
            Option(
                "The robot program stops with an error.",
                "null is allowed there. It means WPILib's default",
            ),
        ),
    ),
    Question(
        "status_frames",
        "A motor controller sends its readings every {frame:d} ms, and the robot program logs "
        "every 5 ms. The log is sound otherwise. SysId finds kA = {ka_frames:.3f} V·s²/m, but from "
        "motors and mass you compute {ka_mass:.3f} V·s²/m. kV fits. What do you do?",
        (
            Option(
                "Log as fast as the readings come, or have them sent faster, and record again.",
                share=1.0,
            ),
            Option(
                "Use SysId's kA: a measured number is better than a computed one.",
                "Look at the rows: each reading stands in several of them, and between two equal "
                "rows SysId sees no acceleration. It measured the repetition, too",
                "M-MORE-ROWS",
            ),
            Option(
                "Log every 1 ms: more rows give a more accurate kA.",
                "The controller sends no more readings than before. Each one would only stand in "
                "more rows, and kA would be even smaller",
                "M-MORE-ROWS",
            ),
            Option(
                "Set a larger window for the median filter.",
                "A long median cuts off the start of the step, and kA gets smaller still. And "
                "equal rows stay equal",
                "M-FILTER-FREE",
            ),
            Option(
                "Find where samples are missing: the robot program is too slow.",
                "Then the time from row to row would be longer now and then. Here no row is "
                "missing: too many are alike",
            ),
        ),
    ),
    Question(
        "three_logs",
        "A team records the four tests three times and touches nothing in between. `sysid fit` "
        "finds kA = {ka_first:.3f}, {ka_second:.3f} and {ka_third:.3f} V·s²/m, each ± "
        "{ka_error:.3f}. What do these numbers say?",
        (
            Option(
                "Something changes between the recordings, and their spread is the honest error.",
                share=1.0,
            ),
            Option(
                "That is noise: the mean of all three is right to ± half of one error bar.",
                "The error bars already contain the noise, and these three differ by more. A mean "
                "hides what changed; it does not remove it",
                SPREAD,
            ),
            Option(
                "The error bars are wrong: the same mechanism has the same kA.",
                "Each error bar tells how well its own recording determines kA. What was warmer, "
                "emptier or stiffer on the next recording is not in it",
                SPREAD,
            ),
            Option(
                "The one with the best R² is right; the others are bad recordings.",
                "All three may follow their own log well. R² compares a model with one log; which "
                "of the logs is like your next match it cannot know",
                "M-R2",
            ),
            Option(
                "One recording would have been enough: three only confuse.",
                "With one recording you would trust its small error bar, and never see how much "
                "the next one differs",
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
                "kS, kG and kA are larger, as warm copper has more resistance; kV hardly differs.",
                share=1.0,
            ),
            Option(
                "kV: the tired battery gives less speed for each volt.",
                "A volt is a volt, whatever battery it comes from. This one can still give all the "
                "volts that your code sends",
                "M-SAG-ALWAYS-BAD",
            ),
            Option(
                "All of them, by the share that the battery has lost.",
                "That would be so if the code sent a share of the battery. It sends volts",
                "M-DUTY",
            ),
            Option(
                "None: gains belong to the mechanism, and it is the same mechanism.",
                "The motor belongs to it, and it is warmer now. How many volts does the same force "
                "take when the copper has more resistance?",
                "M-FF-EXACT",
            ),
            Option(
                "kG only: the elevator is heavier at the end of a match.",
                "Its weight is the same. What changed is how many volts a motor needs for a force, "
                "and three of the terms are forces",
            ),
        ),
    ),
    Question(
        "schedule",
        "When should a team characterize its drivetrain?",
        (
            Option("In the last two weeks of build season, once the robot is complete.", share=1.0),
            Option(
                "In the practice match of the first competition.",
                "A pit is as small as a parking space, there are eight minutes between matches,"
                " and a drivetrain needs ten feet in both directions",
            ),
            Option(
                "As soon as the bare frame drives, and then never again.",
                "Everything you add makes it heavier. One of the gains will then be wrong",
                WEIGHT,
            ),
            Option(
                "After every change of the code.",
                "The gains describe the mechanism. Code does not change its mass or its gears",
            ),
        ),
    ),
)
