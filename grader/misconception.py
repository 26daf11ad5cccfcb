"""Misconceptions the examiner can name: a code for statistics, a sentence that puts it right."""

MISCONCEPTIONS: dict[str, str] = {
    "M-UNITS": "A number means something only with its unit. Change the unit, and the number "
    "changes with it: one rotation is 2π radians, one minute is 60 seconds.",
    "M-ARGORDER": "Values that stand side by side are told apart only by their order. Look up "
    "which comes first.",
    "M-CMDVOLT": "What was asked for is not what the motor got: a weak battery or a current limit "
    "takes volts away, and a fit on asked-for volts puts the blame on kA.",
    "M-CLOSEDLOOP": "A closed loop chooses its own voltage. Then the test no longer decides what "
    "the motor gets, and the fit describes your controller instead of your mechanism.",
    "M-DUTY": "A duty cycle is a share of whatever the battery gives at that moment; a voltage is "
    "the same with a full battery and with a tired one.",
    "M-KS-INTERCEPT": "The straight line through a slow ramp crosses v = 0 above kS: the ramp "
    "accelerates the mechanism all the time, and that costs kA·a on top.",
    "M-KG-EDGE": "The voltage at which a mechanism just does not fall is not gravity alone: "
    "friction helps to hold it there, and is in the way where it just begins to rise. Gravity is "
    "the middle of that band, friction half its width.",
    "M-NO-KG-IN-SYSID": "SysId does find kG, once it is told that there is gravity. Simple has no "
    "place for gravity, and what gravity takes ends up in kS.",
    "M-NOISE-AVERAGES": "Noise in a column you fit with does not average out: it pulls the gain "
    "of that column toward zero. Let the noisiest column be the one you explain.",
    "M-REVERSE-WASTE": "The reverse runs show friction from the other side; without them kS is "
    "only half seen.",
    "M-R2": "There is more than one R²: say of which quantity, and look up how it is computed. "
    "None of them is a lie detector: it can be high on a damaged log, so look at the signals, too.",
    "M-BIG-STEP": "A big step spins the wheels, meets the current limit and drains the battery. "
    "A smaller one shows kA just as well.",
    "M-SLOW-SAFE": "A slower ramp is not the safer one: it covers more ground on its way to the "
    "same speed.",
    "M-KV-MASS": "kV is what the motor's own back-EMF takes at a speed; mass has no part in it. A "
    "heavier robot gets up to speed more slowly, which is kA, and then needs the same volts.",
    "M-BELOW-THEORY-OK": "No mechanism is faster than its motor's free speed allows. A kV below "
    "theory is not a good robot, but a mistake in what was written down.",
    "M-LIMITS-BYPASSED": "A test takes the place of your own commands, and goes around the limits "
    "in them. Limits set inside the motor controller go on acting, and then they are in your data.",
    "M-FF-EXACT": "A feedforward is as good as its model, its gains and the day: a few percent are "
    "always left, and feedback is there for them.",
    "M-KP-EXACT": "Proportional feedback makes its volts out of an error, so some of the error has "
    "to stay. A larger kP leaves less of it, never none.",
    "M-HEAVIER-MORE-KS": "Dry friction comes from bearings, gears and belts. Weight makes kG and "
    "kA larger, and kS hardly.",
    "M-SAG-ALWAYS-BAD": "A battery that sags does no harm to a fit on applied volts, as long as "
    "the volts asked for can still be had.",
    "M-TRIM-PRETTY": "Trim where the physics of the test ends, not where the picture stops being "
    "pretty: fast samples tell kV and the first rise of a step tells kA, however noisy they are.",
    "M-FILTER-FREE": "A filter is not free: a long one bends whatever is quicker than itself, and "
    "a step then looks like the start of a heavier mechanism.",
}
