"""The three knowledge checks: what, and why; every wrong option says why it is wrong."""

from .question import Option, Question

KC1 = """A team runs the quasistatic test forward. Halfway through, the velocity jumps: everybody
saw the mechanism lurch. The rest of the log looks clean."""

KC2 = """A shooter has kS = {ks:.2f} V, kV = {kv:.3f} V·s/rot and kA = 0.003 V·s²/rot, measured with
SysId. They go into SimpleMotorFeedforward, and nothing else moves the wheel. Its target is
{target:d} rpm, but it always ends up at {reached:d} rpm."""

KC3 = """An arm is characterized without a game piece. At the competition it droops as soon as it
holds one."""

SLIP = Option(
    "The encoder slipped, if a second sensor or the current shows that nothing moved.",
    (
        "Accepted, because you ask for a second measurement. Without one, believe the people who "
        "saw the mechanism lurch"
    ),
    share=1.0,
)

CHECKS = (
    Question(
        "KC1_answer",
        "What most likely happened?",
        (
            Option(
                "Something stuck and broke loose: a belt or chain skipped, a tight bearing let go.",
                share=1.0,
            ),
            SLIP,
            Option(
                "The battery browned out.",
                "Then the voltage would drop as well, and a mechanism without voltage gets "
                "slower. This one jumped ahead",
            ),
            Option(
                "The log has a gap in time.",
                "A gap shows in the time stamps. And people do not see a gap: they saw it lurch",
            ),
            Option(
                "The mechanism hit its hard stop.",
                "At a hard stop the velocity falls to zero and stays there. The rest of this log "
                "goes on as if nothing had been",
            ),
        ),
    ),
    Question(
        "KC1_reason",
        "What does it do to the gains?",
        (
            Option(
                "A few samples with a large acceleration count a lot, because errors are "
                "squared: kS too small, kA too large, kV about right.",
                share=1.0,
            ),
            Option(
                "Hardly anything: one jump among hundreds of samples averages out.",
                "Errors are squared before they are added up: one sample that is ten times as far "
                "off counts a hundred times",
                "M-NOISE-AVERAGES",
            ),
            Option(
                "kV is wrong, kS and kA are not.",
                "The slope of voltage over speed depends on the whole long ramp. Which gain "
                "depends on the few samples that accelerate?",
            ),
            Option(
                "Nothing, once that run is deleted: three runs are enough.",
                "SysId refuses a log without that run, and nothing shows any more whether friction "
                "is the same both ways. First repair the mechanism, then run it again",
                "M-REVERSE-WASTE",
            ),
            Option(
                "R² falls below 0.9, so you cannot overlook it.",
                "With a lurch like this the simulated velocity R² stays above 0.9. Look at the "
                "plots first and at R² last",
                "M-R2",
            ),
        ),
    ),
    Question(
        "KC2_answer",
        "What do you do?",
        (
            Option(
                "Keep the gains, check the units and the applied voltage, and add feedback for "
                "the rest.",
                share=1.0,
            ),
            Option(
                "Raise kV until the display shows the target.",
                "Then kV is right for this speed, this battery and this day only. It no longer "
                "describes the mechanism",
                "M-FF-EXACT",
            ),
            Option(
                "Raise kA.",
                "At a steady speed the acceleration is zero, and so is kA·a, however large kA is",
            ),
            Option(
                "Raise kS: friction must be larger than measured.",
                "kS is the same voltage at every speed. If kS were too small, the error would "
                "be a larger share at low speed: try a second speed",
            ),
            Option(
                "Run SysId again: it failed.",
                (
                    "A few percent is a normal error of a good model. Nothing shows that the fit "
                    "failed"
                ),
                "M-FF-EXACT",
            ),
            Option(
                "Add a kP, and leave it at that.",
                "Feedback is part of the answer. But what if the motor never gets the commanded"
                " voltage? And kP alone does not remove the whole error",
                "M-KP-EXACT",
                share=0.6,
            ),
        ),
    ),
    Question(
        "KC2_reason",
        "Why?",
        (
            Option(
                "Feedforward never corrects an error, and a small error of the model or the "
                "conditions is normal.",
                share=1.0,
            ),
            Option(
                "With good gains the feedforward is exact, so a gain must be wrong.",
                "Battery, temperature and wear change from minute to minute, and no gain is known "
                "better than to a few percent",
                "M-FF-EXACT",
            ),
            Option(
                "Proportional feedback brings the error to zero.",
                "P feedback needs an error to give extra volts: 1/(1 + kP/kV) of the error remains",
                "M-KP-EXACT",
            ),
            Option(
                "Reaching the speed takes kA·a, and it did not get there.",
                "It had enough time: its speed is steady. At a steady speed a is zero",
            ),
            Option(
                "Friction takes the same share of every speed.",
                "kV·v takes the same share at every speed. Dry friction takes the same voltage",
            ),
        ),
    ),
    Question(
        "KC3_answer",
        "What is the fix?",
        (
            Option(
                "Measure, or compute, gains with the piece, and switch to them while a sensor sees "
                "it.",
                share=1.0,
            ),
            Option(
                "Raise kP until it no longer droops.",
                "A larger kP makes the droop smaller, but not zero: it is the missing voltage "
                "divided by kP. And a large kP shakes the empty arm",
                "M-KP-EXACT",
                share=0.4,
            ),
            Option(
                "Add kI.",
                "It would get there slowly, and the arm would swing up when the piece is gone. "
                "It corrects an error that you could know beforehand",
                share=0.3,
            ),
            Option(
                "Use the mean of the gains with and without the piece.",
                "Then it is half wrong in both cases: too little with the piece, too much "
                "without. That is acceptable only for a small piece",
                share=0.5,
            ),
            Option(
                "Raise kV.",
                "A drooping arm does not move. What is kV·v then?",
                "M-KV-MASS",
            ),
            Option(
                "Run SysId without a piece once more.",
                "The same arm gives the same gains. What is different at the competition?",
            ),
        ),
    ),
    Question(
        "KC3_reason",
        "Why does it droop?",
        (
            Option(
                "The piece adds weight and inertia: kG and kA grow, kV and kS hardly do.",
                share=1.0,
            ),
            Option(
                "A heavier arm needs a larger kV.",
                "kV depends on motor and gears. There is no mass in its formula",
                "M-KV-MASS",
            ),
            Option(
                "A heavier arm has more friction: kS grows.",
                "The friction in the bearings grows a little, but friction helps an arm to stay"
                " where it is. It does not make it droop",
                "M-HEAVIER-MORE-KS",
            ),
            Option(
                "SysId knows no gravity, so the gains never held the arm.",
                "With the type Arm, SysId finds kG. And the empty arm did hold",
                "M-NO-KG-IN-SYSID",
            ),
            Option(
                "The battery is weaker at the end of a match.",
                "Then the empty arm would droop, too: at that moment it has the same battery",
                "M-SAG-ALWAYS-BAD",
            ),
        ),
    ),
)
STORIES = {"KC1": KC1, "KC2": KC2, "KC3": KC3}
