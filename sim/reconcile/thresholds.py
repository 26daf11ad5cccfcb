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

LIKELIER_RIGHT = 0.5
"""[1] probability from which an effect is a finding. Each is told with its own: whom a wrong name
costs much reads the number. Named only from 5/6 on (a wrong name costs five silences), a quarter of
the right names of the logs it was learnt on would not be told."""

PROBABLY = 0.83
"""[1] Probability below which a finding is told with "probably": a wrong name costs a user as much
as five effects that are not named."""

FARTHEST = 3.0
"""[1] Largest logarithm, to both sides, of the ratios from which a probability is computed: a gap
20 times as wide, or an effect 20 times as large, as another proves no more than that."""

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

SEARCH = 0.7
"""[1] of a time limit after which no further effect is tried: the model so far is refitted without
each of its effects, to say what each is worth."""

MOST = 4
"""Effects that are added at most: with more, anything can be explained."""

MOST_QUIET = 2
"""Effects that are kept in the model without being named: a delay of 2 ms makes a log much likelier
and shrinks no gap, but what else is there shows better beside it. What comes to less than ``SURER``
is left out; what is larger than on any robot is added like any other effect."""

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

TOLD_FIRST = 0.75
"""[1] confidence from which a fault is told before any effect: what seems to lean on a stop (0.7)
may be a chain or an arm that gives, and is left out of the fit in either case."""

SHAKEN = 7.0
"""[robust standard deviations] of the largest windowed innovation, at least those of independent
innovations: beyond it a moment is not explained. A normal deviate among some thousand windows stays
below 5. Of the given logs, those in which nothing is missing come to 6.2 at most, everyday dirt
included, and those that hold something unknown to 7.4 and more, unless another test finds it."""

LEAST_FLOOR = 0.003
"""[1] of the top speed, for which a log's noise counts at least: friction alone differs by more
from run to run, and a velocity that a device averages has hardly any noise. None of the logs that
the probability is learnt from has less noise than that."""

ALIKE = 6.0
"""[standard deviations of chance] by which runs that go the same way miss alike: beyond it physics
is missing. Last models of 42 complete logs with everyday dirt in half came to 3.6 at most, of logs
with a bump, a brake or a band of friction that no effect has to 3 to 15, two of three beyond 6."""

RHYTHM = 100.0
"""[1] -log of the odds that noise has such a line in its spectrum. On 210 logs, given and made
here, last models came to 80 at most where nothing swung (complete ones to 45), and to 150 and more
where something did."""

FAR_OFF, FAR_OFF_SPEED = 2.5, 0.03
"""[noises of a velocity], [of the top speed] of the gap that the last model leaves: beyond both,
a person sees the curves apart, and the log is not explained, whatever was named."""

# Of logs and of runs, in all of reconcile.

FEWEST_SAMPLES = 20
"""Fewest samples of a run from which a spread or a rhythm is estimated. A log needs two runs of as
many: with fewer, every effect of the catalogue fits."""

STANDSTILL = 0.02
"""[of the top speed] A slower mechanism stands, or is about to: static friction holds it as it
likes, and its speed says nothing about a model."""

CELLS = 24
"""Parts into which the time of a run, the way, or all speeds are divided. With more, a part holds
too few samples to stand out of the noise; with fewer, a bump of some centimeters is averaged away.
"""

SHORTEST_WINDOW = 0.1
"""[s] A disturbance that is over sooner is noise or a clock's. Windows of one, two and four times
this length are searched; a rhythm of which half a turn is shorter is a vibration."""

OTHER_UNITS = 1.8
"""[factor] Two logs that differ by more are in different units, or of different mechanisms.

What a speed costs in volts differs by 0.72 to 1.23 among 256 pairs of logs, whatever effects they
contain; a foot taken for a meter makes it 3.3, a radian taken for a rotation 6.3."""

DAMAGED = 0.95
"""[1] Confidence of an inspection beyond which an interval is damaged and is cut out. On 900
logs, encoder slips that are true have 0.96 and more, false ones (starts that stick) 0.945 at
most."""

DROPPED = 0.9
"""[1] A voltage below this share of its median has dropped, and a speed below this share of what it
was has followed."""
