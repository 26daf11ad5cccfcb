"""Decision thresholds of reconcile, with their reasons."""

SURE = 20.0
"""[of -2 log L] by which an effect must make the model likelier, prices paid: odds of e¹⁰, about
twenty thousand to one, because some twenty candidates are asked several times."""

NARROWER = 0.985
"""[1] of the gap before: the validation's gap, geometric mean of velocity's and position's, must
shrink by more than a refit by chance does."""

SURER = 60.0
"""[of -2 log L] the same as ``SURE``, of an effect that hardly narrows the gap of velocities.

What is everyday on a robot (a little sag, a little more friction at a start) adds up to half of it
in disguise, and being silent harms less than a wrong name."""

MUCH_NARROWER = 0.6
"""[1] of the likeliest effect's gap, from which another one is taken, if it has ``HALF`` of its
score: what a simulation of other runs says is as good as what the next sample does."""

HALF = 0.5
"""[1] of the likeliest effect's score: with less, what closes the gap resembles what is missing."""

ONCE = 130.0
"""[of -2 log L] the same of an effect that begins at a moment.

It may happen in a single run, and then no other run has a say: a snag or a push looks a little like
it. On 430 logs, where no encoder slipped and no moment remained, inertia changes that were none
came to 106 at most, but for 142, 147 and, beside free play, 230 and 344; true ones to 245 and more,
but for seven that hardly show (below 0 to 170). By as much it has to be likelier than an effect
that lasts, or that one is added first: a motor that warms up is not a load that joined once.
Whether it narrows the gap of runs that know nothing of it is not asked.
"""

KNOCK, AFTER = 2.0, 0.5
"""[samples], [s] after the moment at which something is said to happen: if what the last model
explains least begins between them, that was something else."""

NOT_WIDER = 1.005
"""[1] the same of a gap that must not grow: half a percent is what another start changes."""

SHOWN_WIDER = 1.05
"""[1] of the shown log's gap without an effect, beyond which it is not named: friction that
differs from run to run changes that gap by some percent."""

LIKELIER_RIGHT = 0.5
"""[1] probability from which an effect is a finding. Each is told with its own: whom a wrong name
costs much reads the number. Named only from 5/6 on (a wrong name costs five silences), a quarter of
the right names of the logs it was learnt on would not be told."""

# What an effect's probability is told by, within bounds beyond which nothing more is told apart.

NARROWEST = 0.05  # [1] of a gap over another; and its inverse
SIZES = (-2.0, 3.0)  # ln of an effect's size [everyday sizes]
FEWEST_NOISES, MOST_NOISES = 0.5, 3.0
"""[noises of a velocity] of the last model's gap. Logs of real robots leave more, and none of those
is among what the probability is learnt from: beyond three, one is as far off as another."""

MAJOR = 0.87
"""[1] of the gap before: an effect that shrinks the validation's velocity gap by more is major.
Everyday effects that nobody has to name (50 mV of Stribeck friction, 8 % of sag, 4 ms of delay)
shrink it by up to a tenth."""

FAR_MAJOR = 0.6
"""[1] the same while something remains (``STRAYS``, ``ALIKE``, ``SHAKEN``): what nobody has named
looks a little like many things, and none of them is worth a name that does not take much of it
away."""

CLOSE = 10.0
"""[of -2 log L] within which another effect explains as much: odds below 150 to one."""

SIMPLER = 8.0
"""[of -2 log L] within which the effect with fewer parameters is taken."""

AS_GOOD = 0.97
"""[1] of the score of an effect, with which its simpler sister is taken in its place: the rest is
what a spring or a cosine makes of drift and of what else is missing."""

SEARCH = 0.7
"""[1] of a time limit after which no further effect is tried: the model so far is refitted without
each of its effects, to say what each is worth."""

MOST = 4
"""Effects that are added at most: with more, anything can be explained."""

PART = 0.5
"""[1] of the score of an effect that stays quiet, which an admitted one needs to go before it."""

USUAL = 0.5
"""[1] of the likeliest one's score, with which an effect of everyday size goes before it.

A limit of the current comes to 491 where a late command does to 357 and a weak battery to 283: with
the command taken first the battery is 265 ahead of the limit."""

MOST_QUIET = 2
"""Effects that are kept in the model without being named: a delay of 2 ms makes a log much likelier
and shrinks no gap, but what else is there shows better beside it. What comes to less than ``SURER``
is left out; what is larger than on any robot is added like any other effect."""

SLIPPED = 0.97
"""[1] confidence above which an encoder's slip is cut out: a start that sticks looks alike."""

LOST = 0.4
"""[1] of the motion on runs it was not fitted to that a model misses: it has not understood the
log, and what it contains is no finding. The last models of 128 logs with hidden effects miss an
eighth at most."""

UNDRIVEN = 100.0
"""[s] kA/kV of a base model that is lost, beyond which voltage drives nothing in it, and no effect
is tried on top. Shuffled voltages make it a day and more, a hidden bound of the voltage five
seconds at most; a heavy flywheel has one."""

WANDERS = 0.1
"""[top speeds in a second] by which a mechanism is pushed at random at most, where a base model
would else be nothing but pushes."""

SPOILT = 0.9
"""[1] the same of other faults of the record."""

TOLD_FIRST = 0.75
"""[1] confidence from which a fault is told before any effect: what seems to lean on a stop (0.7)
may be a chain or an arm that gives, and is left out of the fit in either case."""

SHAKEN = 7.0
"""[robust standard deviations] of the largest windowed innovation, at least those of independent
innovations: beyond it a moment is not explained. A normal deviate among some thousand windows stays
below 5. Of the given logs, those in which nothing is missing come to 6.2 at most, everyday dirt
included, and those that hold something unknown to 7.4 and more, unless another test finds it."""

STRAYS = 2.5
"""[noises of a velocity] of the gap that the last model leaves on runs it was not fitted to.

A complete model of an arm, whose runs end where small errors of friction have added up, leaves two.
"""

ALIKE = 6.0
"""[standard deviations of chance] by which runs that go the same way miss alike: beyond it physics
is missing. Last models of 42 complete logs with everyday dirt in half came to 3.6 at most, of logs
with a bump, a brake or a band of friction that no effect has to 3 to 15, two of three beyond 6."""

RHYTHM = 100.0
"""[1] -log of the odds that noise has such a line in its spectrum. On 210 logs, given and made
here, last models came to 80 at most where nothing swung (complete ones to 45), and to 150 and more
where something did."""

MOSTLY = 0.5
"""[1] of the base model's gap: where the last model strays and leaves more than that of it, what
was named is not what is missing, and the verdict is that nothing explains it."""

FAR_OFF, FAR_OFF_SPEED = 3.0, 0.03
"""[noises of a velocity], [of the top speed] of the gap that the last model leaves: beyond both,
a person sees the curves apart, and the log is not explained, whatever was named."""

NEAR = 0.25
"""[1] of the best score of its round, from which an effect may begin another path where the first
one strays: what resembles two effects at once is far likelier than each of them alone."""

PATHS = 1
"""Other paths that are gone where the first one strays: each takes as long as the first."""

# Logs that are refused (``input_checks.py``).

FEWEST_RUNS, FEWEST_SAMPLES = 2, 60
SHORTEST_RUN = 4  # samples of a run that says anything, as ``measure_runs`` takes them
BEYOND_TRAVEL = 1.1  # [of the travel] that positions may span
OTHER_VOLTAGES = 1.8
"""[factor] between what a speed costs in two logs of one mechanism, once the first one's kS, kA and
gravity are paid. Among 256 pairs it was 0.72 to 1.23, whatever was hidden in them; a foot taken for
a meter makes it 3.3, a rotation for a radian 6.3."""
TENTH = 0.1  # [1] a smaller factor is told in words
OBEYS_VOLTAGE, LEAST_KS = 0.35, -0.1
"""[of the voltage's size] that a first guess may miss, and [of the largest voltage] friction, of a
log that is a mechanism's at all: only such a log has a price of a speed that others can be held
against. Of 512 logs with voltages of other moments none is, of 256 others 254 are."""
HARDLY_MOVES = 0.03  # [of the first log's top speed] slower than which nothing moves

# Voltage drop-outs (``dropout_intervals.py``).

DROPOUT_MEDIAN = 0.22  # [s] of voltages whose median is what a sample ought to read
DROPOUT_FALLEN = 0.75  # [share of that median] below which it has dropped
DROPOUT_ANSWER = 0.06  # [s] in which a velocity has answered
DROPOUT_ANSWERED = 0.9  # [share of the speed before] below which it has

# Residuals that runs share (``residual_tests/repeatability.py``).

REPEAT_CELLS = 24  # of the way, or of all speeds
FEWEST_IN_CELL = 2  # samples of a run in a cell
SHORTEST_ONE_WAY = 20  # samples of a run that goes one way
HELD_BY_FRICTION = 0.02  # [1] of the top speed, below which friction holds as it likes

# Windows of innovations (``residual_tests/whiteness.py``).

WINDOWS = (0.1, 0.2, 0.4)  # [s]
STEP_JUMP, SOON_AFTER_STEP = 1.0, 0.15  # [V] of a step, and [s] after it
FEWEST_WINDOWS = 20  # windows that tell what is ordinary
LEAST_SPREAD = 1.0  # [1] of what independent innovations add up to
CLOCK_PART = 0.5  # of a sample, by which a run may be late or early

# Peaks of the spectrum (``residual_tests/spectrum.py``).

FASTEST_PEAK = 5.0  # [Hz] faster is a joint that swings, or a wave along the way
FEWEST_TURNS = 2.0  # that a run has to last
PEAK_FINER = 0.5  # [1] of the steps that the longest run can tell apart
SHORTEST_FOR_PEAK = 20  # samples of a run

# Earlier effects (``backward_elimination.py``).

LOOKED_ALIKE = 0.3  # [of the best score in its round] from which an effect looked alike

# Repetitions (``forward_selection.py``).

SECOND_THOUGHTS = 2  # times that an earlier effect may give way to another

# Prediction of runs (``cross_validation.py``).

MOST_VARIED = 0.12  # [of kS] by which a run's friction may differ

# The held-out log (``held_out.py``).

OTHER_MATTER = 5.0  # [of the gap of fitted runs] from which a held-out log is another matter
