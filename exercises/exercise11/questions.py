"""What is asked about guessing and measuring, and about everyday questions of a team."""

from .question import Option, Question

WEIGHT = "M-KV-MASS"

GUESS = Option(
    "Which gain makes it behave the way I like?",
    "That question is about behavior, and so it has to be asked anew whenever the mechanism, the "
    "battery or the taste changes. The other way asks about the mechanism itself",
)
MODEL = Option(
    "Which model of the physics explains best what this mechanism did?",
    "Who asks that records tests first. Somebody who turns a knob and looks again asks for less",
)
SHEET = Option(
    "Which gain does the data sheet of the motor say?",
    "A data sheet knows the motor, and nothing of your gears, wheels and bearings. Neither of the "
    "two ways stops there",
)
OTHERS = Option(
    "Which gain do teams with a similar robot use?",
    "Other robots are where some begin to guess. It is not the question itself",
)
ZERO = Option(
    "Which kP makes the error zero?",
    "kP is feedback: it looks at an error. Here the gains of a model are meant, kS, kV and kA",
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
                "kV follows from motor, gears and wheel. How heavy the robot is does not stand in "
                "that formula: at a steady speed nothing is sped up",
                WEIGHT,
            ),
            Option(
                "kS",
                "kS is friction in bearings and gears. A brace adds little to that; look for the "
                "term that asks how hard it is to get the robot moving faster",
                "M-HEAVIER-MORE-KS",
            ),
            Option(
                "none, as long as the motors stay the same",
                "The motors stay the same, but they have more to move. One of the three terms is "
                "about that",
            ),
        ),
    ),
    Question(
        "kA_use",
        "Beside the feedforward, what is a drivetrain's kA good for?",
        (
            Option(
                "It tells the robot's mass and, measured while turning, its moment of inertia, "
                "which a path planner wants to know.",
                share=1.0,
            ),
            Option(
                "It tells the robot's top speed.",
                "At top speed nothing accelerates, and the term of kA is zero. Which gain is left?",
            ),
            Option(
                "It tells how slippery the carpet is.",
                "The wheels grip or they slip; kA is measured while they grip. It knows of what "
                "has to be sped up",
            ),
            Option(
                "It tells the state of the battery.",
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
                "Look for what drags on the left side before anything else: bearing, belt, chain.",
                share=1.0,
            ),
            Option(
                "Nothing: it is still far below kV times the usual speed.",
                "That rule only raises its flag when friction eats more than all the speed does. "
                "kS grew within a week, and on one side only: that alone is worth a look",
            ),
            Option(
                "Put the new kS into the code: the feedforward pays for it.",
                "The feedforward would hide it. What rubs gets hot, wears out, and is another "
                "kS next week",
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
        "A drivetrain gets 3.5 V at once, and keeps them. In the log its acceleration stays the "
        "same for most of a second, and then falls. What do you look at first?",
        (
            Option("Did a current limit act, or did the wheels slip?", share=1.0),
            Option(
                "Nothing: under a constant voltage the acceleration is constant.",
                "It would be if all the volts went into acceleration. The faster it goes, the more "
                "of them kV·v takes. What is left for kA·a then?",
                "M-CONST-ACCEL",
            ),
            Option(
                "Whether kA is zero: nothing held it back.",
                "Without kA it would be at its speed at once. This one took most of a second",
            ),
            Option(
                "Whether the battery sagged as it got faster.",
                "The current is largest at the start and gets smaller with speed. A sag would show "
                "in the first moments, and get better",
            ),
            Option(
                "Whether the encoder counts in other units.",
                "Another unit makes every acceleration larger or smaller by one factor. The shape "
                "of the curve stays as it is",
                "M-UNITS",
            ),
        ),
    ),
    Question(
        "step_length",
        "A drivetrain has kA/kV = 0.08 s. Its dynamic test took 1 s. Somebody wants a better kA "
        "and makes the test 5 s long. What comes of it?",
        (
            Option(
                "Much more room is used, and kA is no better: that was told in the first moments.",
                share=1.0,
            ),
            Option(
                "Five times as many samples: kA gets clearly better.",
                "Count those in which it still gets faster. After a few times kA/kV it hardly "
                "does, and what does not accelerate says nothing of kA",
                "M-LONG-DYN",
            ),
            Option(
                "SysId can no longer find kA, since the acceleration is zero most of the time.",
                "SysId drops what comes after 90 % of the top speed, and fits the beginning, which "
                "is in a long test as well",
                "M-LONG-DYN",
            ),
            Option(
                "kA gets smaller, because the average acceleration is smaller.",
                "Nobody takes an average: every sample has its own voltage, speed and "
                "acceleration, and the sum of the terms has to fit for each",
            ),
            Option(
                "kS gets better, because it moves for longer.",
                "Friction is one of three terms here, and at one steady speed nothing tells kS "
                "from kV·v. Which test is there for kS?",
            ),
        ),
    ),
    Question(
        "null_consumer",
        "The last argument of SysIdRoutine.Config is null. Where does the name of the running test "
        "go?",
        (
            Option("Into the WPILog of the robot, as a string of its own.", share=1.0),
            Option(
                "Nowhere: with null nothing is recorded.",
                "null means: do as usual. If nothing were recorded, the analyzer could not tell "
                "the four tests apart, and most teams leave null there",
            ),
            Option(
                "To the Driver Station's own log only.",
                "So says a comment that many copy. The analyzer opens another file: which one do "
                "you load into it?",
            ),
            Option(
                "The robot program stops with an error.",
                "null is allowed there. It stands for what WPILib does by default",
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
                "A pit is as large as a parking space, there are eight minutes between matches, "
                "and a drivetrain needs ten feet in both directions",
            ),
            Option(
                "As soon as the bare frame drives, and then never again.",
                "What comes on top makes it heavier. One of the gains will no longer be true",
                WEIGHT,
            ),
            Option(
                "After every change of the code.",
                "The gains describe the mechanism. Code does not change its mass or its gears",
            ),
        ),
    ),
)
