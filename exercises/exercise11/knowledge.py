"""The three knowledge checks: what, and why; every wrong option says why it is wrong."""

from .question import Option, Question

KC1 = """A team runs the forward quasistatic test. In the middle of the test, the velocity
suddenly jumps up. Everybody saw the mechanism jump forward. The rest of the log looks clean."""

KC2 = """A shooter has kS = {ks:.2f} V, kV = {kv:.3f} V·s/rot and kA = 0.003 V·s²/rot, measured
with SysId. The code uses these gains in a SimpleMotorFeedforward, and uses no feedback. The
target speed is {target:d} rpm, but the wheel always reaches only {reached:d} rpm."""

KC3 = """A team measures the gains of an arm that holds no game piece. At the competition the arm
sinks a little as soon as it holds a game piece."""

SLIP = Option(
    "The encoder slipped, but only if a second sensor or the current shows that the mechanism "
    "did not jump.",
    (
        "You want a second sensor to confirm it, so this answer is a good one, too. Without that "
        "sensor, believe the people who saw the mechanism jump"
    ),
    share=1.0,
    needs_reason=True,
)

CHECKS = (
    Question(
        "KC1_answer",
        "What most likely happened?",
        (
            Option(
                "Some part got stuck and then suddenly came free, such as a tight bearing, or a "
                "belt or chain that skipped.",
                share=1.0,
            ),
            SLIP,
            Option(
                "The battery browned out.",
                "In a brownout the voltage would drop, too, and a mechanism without voltage gets "
                "slower. But this mechanism jumped forward",
            ),
            Option(
                "The log has a gap in time.",
                "You would see a gap in the time stamps of the log. And people cannot see such a "
                "gap, but they saw the mechanism jump",
            ),
            Option(
                "The mechanism hit its hard stop.",
                "At a hard stop the velocity falls to zero and stays there. But the rest of this "
                "log looks normal",
            ),
        ),
    ),
    Question(
        "KC1_reason",
        "What does this jump do to the gains?",
        (
            Option(
                "kS is too small, kA is too large, and kV is about right: a few samples with a "
                "large acceleration have a large effect, because errors are squared.",
                share=1.0,
            ),
            Option(
                "Almost nothing: one jump among hundreds of samples averages out.",
                "A fit squares the errors before it adds them up. So a sample with an error ten "
                "times as large counts a hundred times",
                "M-NOISE-AVERAGES",
            ),
            Option(
                "kV is wrong, but kS and kA are right.",
                "kV is the slope of voltage against speed, and this slope depends on the whole "
                "long test. Which gain depends on the few samples with a large acceleration?",
            ),
            Option(
                "Nothing, once that run is deleted: three runs are enough.",
                "SysId cannot use a log without that run. And without it you cannot see whether "
                "friction is the same in both directions. First repair the mechanism, then run "
                "the test again",
                "M-REVERSE-WASTE",
            ),
            Option(
                "The simulated velocity R² falls below 0.9, so you cannot overlook it.",
                "With a jump like this, it stays above 0.9. So look at the plots first, and at R² "
                "last",
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
                "Then this kV is right only for one speed, one battery and one day. It no longer "
                "describes the mechanism",
                "M-FF-EXACT",
            ),
            Option(
                "Raise kA.",
                "At a steady speed the acceleration is zero, and so is kA·a, however large kA is",
            ),
            Option(
                "Raise kS: friction must be larger than measured.",
                "kS is the same voltage at every speed. If kS were too small, the error in "
                "percent would be larger at low speed. You can check this with a second, lower "
                "target speed",
            ),
            Option(
                "Run SysId again: it failed.",
                (
                    "An error of a few percent is normal for a good model. Nothing here shows "
                    "that the fit failed"
                ),
                "M-FF-EXACT",
            ),
            Option(
                "Only add a kP, and check nothing else.",
                "Feedback is part of the answer. But what if the motor never gets the commanded"
                " voltage? And kP alone does not remove the whole error",
                "M-KP-EXACT",
                share=0.6,
                needs_reason=True,
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
                "The wheel had enough time, because its speed is steady. At a steady speed a is "
                "zero",
            ),
            Option(
                "Friction reduces every speed by the same percentage.",
                "The voltage kV·v is proportional to the speed. But dry friction needs the same "
                "voltage at every speed",
            ),
        ),
    ),
    Question(
        "KC3_answer",
        "What should the team do?",
        (
            Option(
                "Measure or compute gains with the game piece, and use these gains while a "
                "sensor sees the game piece.",
                share=1.0,
            ),
            Option(
                "Raise kP until the arm no longer sinks.",
                "With a larger kP the arm sinks less, but it still sinks: the error is the "
                "missing voltage divided by kP. And with a large kP the empty arm shakes",
                "M-KP-EXACT",
                share=0.4,
                needs_reason=True,
            ),
            Option(
                "Add kI.",
                "With kI the arm would come back slowly, and would swing up when the game piece "
                "is gone. You know this error before it happens, so do not wait for feedback",
                share=0.3,
                needs_reason=True,
            ),
            Option(
                "Use the mean of the gains with and without the piece.",
                "Then the gains are wrong in both cases: too small with the game piece, and too "
                "large without it. This is acceptable only if the game piece is light",
                share=0.5,
                needs_reason=True,
            ),
            Option(
                "Raise kV.",
                "An arm that only holds its place has no speed. How large is kV·v then?",
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
        "Why does the arm sink?",
        (
            Option(
                "The game piece adds weight and inertia, so kG and kA become larger; kV and kS "
                "stay almost the same.",
                share=1.0,
            ),
            Option(
                "A heavier arm needs a larger kV.",
                "kV depends on the motor and the gears. Its formula does not contain the mass",
                "M-KV-MASS",
            ),
            Option(
                "A heavier arm has more friction, so kS becomes larger.",
                "The friction in the bearings becomes a little larger. But friction helps an arm "
                "to stay where it is, and does not make it sink",
                "M-HEAVIER-MORE-KS",
            ),
            Option(
                "SysId does not know gravity, so these gains could never hold the arm.",
                "With the type Arm, SysId finds kG. And the gains did hold the empty arm",
                "M-NO-KG-IN-SYSID",
            ),
            Option(
                "The battery is weaker at the end of a match.",
                "Then the arm would also sink without a game piece, because the battery is the "
                "same",
                "M-SAG-ALWAYS-BAD",
            ),
        ),
    ),
)
STORIES = {"KC1": KC1, "KC2": KC2, "KC3": KC3}
