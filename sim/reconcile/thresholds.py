"""Decision thresholds of reconcile, with their reasons.

Three kinds of evidence are compared: the decrease of -2 log L that an effect brings, less a price
for each of its parameters (its score); the gap, which is the velocity error of a simulation of runs
to which the model was not fitted; and the residual tests of what the last model leaves.
"""

# Scores: decreases of -2 log L.

LEAST_SCORE = 20.0
"""Least score of an effect that is added to the model. It means odds of e¹⁰, twenty thousand to
one, because some twenty candidates are tried in each round."""

LEAST_SCORE_UNSEEN = 60.0
"""Least score of an effect that hardly narrows the gap. Several small everyday effects (a little
battery sag, a little more friction at the start) can look like another effect with half of this
score, and a wrong name does more harm than none."""

LEAST_SCORE_ONCE = 130.0
"""Least score of an effect with an onset, and by how much it must beat an effect without one. It
may act in a single run, so other runs cannot confirm it, and a snag or a push resembles it. On 430
logs false ones reached 106, but for four of 142 to 344; true ones reached 245 and more, but for
seven that hardly show in their log. An effect that widens the gap also needs this score before it
is tried together with another one, or mentioned."""

EQUAL_SCORE = 10.0
"""Difference of scores below which two effects explain a log equally well: odds below 150 to one.
The other effect is then reported as a possible explanation, too."""

COMPARABLE = 0.5
"""Share of the best score from which an everyday effect is added first, or one that closes far more
of the gap; its square is enough for an alternative path. Also the share of the gap that may remain
in an explained log."""

# Gaps: velocity errors on runs to which the model was not fitted.

NARROWER = 0.985
"""Ratio of two gaps above which the gap has not become narrower, and below whose inverse it has not
become wider: refitting a model changes a gap by as much."""

MAJOR = 0.87
"""Ratio of the gap with an effect to the gap without it below which the effect is major. Everyday
effects (50 mV of Stribeck friction, 8 % of battery sag, 4 ms of delay) narrow it by up to a
tenth."""

MAJOR_UNEXPLAINED = 0.6
"""The same ratio where the last model leaves more than noise, and between an effect that closes far
more of the gap and the likeliest one. An unknown effect resembles many effects a little."""

LEAST_FLOOR = 0.003
"""Least noise of a velocity, as a share of the top speed. Friction differs by more between runs,
and a velocity that a device averages has hardly any noise. Of 216 logs from which the probability
was learnt, 12 have less noise, and none has less than two thirds of it."""

VISIBLE_FLOORS, VISIBLE_SPEED = 2.5, 0.03
"""Noise floors, and share of the top speed, beyond which a plot shows that a simulation misses the
log. Beyond both, the log is not explained, whatever was found."""

NOISE_ALONE = 1.25
"""[noise floors] Error of a fit that leaves only noise. Logs with frames of a controller leave
0.5 to 1.1, logs whose hidden backlash run lags imitate leave 1.5 to 3.3."""

LOST = 0.4
"""Share of the motion that a model may miss. A model that misses more is wrong, and its effects are
no findings. The last models of 128 logs with hidden effects miss at most an eighth."""

# Findings.

LEAST_PROBABILITY = 0.5
"""Least probability of a finding. Each finding is reported with its probability. With a limit of
5/6, a quarter of the right findings of the logs it was learnt on would be lost."""

PROBABLE = 0.83
"""Probability below which a finding is reported with "probably": a wrong name costs a user as much
as five effects that are not named."""

FARTHEST = 3.0
"""Largest logarithm, to both sides, of the ratios from which a probability is computed: a gap that
is 20 times as wide as another one proves no more than that."""

LARGEST_SIZE = 1.0
"""Largest logarithm of an effect's size over the largest everyday size: three times as much is
found on hardly any healthy robot, so more proves no more. In 700 effects of cross-validation, the
log loss is .161 with it, and .177 with the limit above."""

STRUCTURE = (0.7, 1.3)
"""[1] Ratios of a residual test's result to its threshold between which the probability changes. A
result a little beyond the threshold says little more than one a little below it."""

SOONEST, LATEST = 2.0, 0.5
"""Samples, and seconds, after the onset of an effect. If the residual that the last model explains
least begins between the two, something else happened at that moment."""

SURE_FAULT = 0.75
"""Confidence from which a fault of the log is reported before all effects. A mechanism that seems
to lean on a stop (confidence 0.7) may be a chain or an arm that bends. Either way those samples are
excluded from the fit."""

# The search.

SEARCH_BUDGET = 4e7
"""Simulated samples after which no further effect is tried. The compiled engine simulates two to
three million a second, so a search ends after some twenty seconds. Of logs with eight runs of a few
seconds, searches need four to eight million; of two logs of real arms, 36 and 78."""

MOST_EFFECTS = 4
"""Most effects that are added to a model, everyday ones included: with more, any log can be
explained."""

UNDRIVEN = 100.0
"""Time scale kA/kV [s] above which the voltage does not drive a base model that misses more than
``LOST``, so that no effect is tried. Shuffled voltages lead to a day and more, a hidden voltage
limit to five seconds at most, a heavy flywheel to one second."""

MOST_WANDERING = 0.1
"""Largest random acceleration of a model, in top speeds per √s: it changes the speed by a tenth of
the top speed within a second. With more, it would explain a smooth log without the voltage."""

# Residual tests of what the last model leaves.

UNLIKELY_WINDOW = 7.0
"""Robust standard deviations of the largest windowed innovation beyond which its window is not
explained. Among some thousand windows, normal noise stays below 5. Of the 128 given logs, complete
ones reach 6.2 at most, and those with an unknown effect 7.4 and more, unless another test finds it.
Of 134 complete logs of other seeds, two go beyond 7."""

REPEATED = 6.0
"""Standard deviations of chance of the residuals that runs share, beyond which physics is missing.
The last models of 42 complete logs reach 3.6 at most. Of logs with a bump, a brake or a band of
friction, two of three go beyond 6."""

PERIODIC = 100.0
"""-ln of the probability that noise has such a peak at one frequency, beyond which the residual is
periodic. On 210 logs, last models reach 80 at most where nothing oscillates, and 150 and more where
something does."""

# Limits for logs and runs.

FEWEST_SAMPLES = 20
"""Fewest samples of a run from which a spread or a period is estimated. A log needs two runs of as
many: with fewer, every effect of the catalogue fits."""

CELLS = 24
"""Bins into which the time of a run, the positions, or the speeds are divided. With more, a bin
holds too few samples to stand out of the noise; with fewer, a bump of some centimeters is averaged
away."""

SHORTEST_WINDOW = 0.1
"""[s] A shorter disturbance is noise or a timing error. Windows of one, two and four times this
length are searched; an oscillation of which half a period is shorter is a vibration."""

OTHER_UNITS = 1.8
"""[1] Ratio of the volts per speed of two logs beyond which their units or mechanisms differ.

It is 0.72 to 1.23 among 256 pairs of logs, whatever effects they contain. A foot taken for a
meter makes it 3.3, a radian taken for a rotation 6.3."""

DAMAGED = 0.95
"""[1] Confidence of an inspection from which an interval is damaged and is cut out. On 900 logs,
encoder slips that are true have 0.96 and more, false ones (starts that stick) 0.945 at most."""

STEP_VOLTAGE = 1.0
"""[V] A larger change of the voltage between two samples is a step: a ramp changes by less."""
