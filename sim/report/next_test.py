"""One sentence about what to do after a test: repeat it, run another one, or stop.

A fault of the last run comes first, because the test can be repeated at once. Then come missing
tests, and then what the gains need. The faults are those of ``sysid inspect``; the advice about
gains is that of the verdict.
"""

import math
from collections.abc import Mapping, Sequence

import numpy as np

from sim.core.log import LEAST_STEP, Log, Run
from sim.core.vocabulary import FOUR_TESTS
from sim.fit.result import Fit
from sim.inspect.detect_faults import Inspection
from sim.inspect.fault import Damage
from sim.inspect.launch import find_step_start
from sim.report.gain_verdicts import list_gain_advice
from sim.support.printable import join_names

SETTLES = 3.0  # [time constants] after which a step has almost reached its final speed
FEWEST = 2  # [samples] at reduced voltage that are taken as a limit
FINE = 0.1  # [V] resolution of an advised step
TOO_SHORT = ("little-motion", "short-rise")  # codes of doubts about a run
ENOUGH = "Enough: every gain is usable."


def advise_next(log: Log, *, found: Fit | None, inspection: Inspection, last: Sequence[str]) -> str:
    """Advice about the next test, in one sentence.

    Args:
        log: all runs so far, in the order they were recorded.
        found: the fit of the log; None if it cannot be fitted yet.
        inspection: faults and doubts of the log.
        last: the tests that have ended since the last advice.
    """
    for test in last:
        index = max((k for k, run in enumerate(log.runs) if run.test == test), default=None)
        if index is None:
            return f"Repeat {test}: its log contains no motion."
        problem = _judge_run(index, log, found=found, inspection=inspection)
        if problem:
            return problem
    missing = [test for test in FOUR_TESTS if not log.list_runs_of_test(test)]
    if missing:
        return f"{join_names(missing)} {'is' if len(missing) == 1 else 'are'} missing."
    if found is None:
        return "All four tests are there, but they give no gains. Look for faults in the log."
    grave = [doubt for doubt in found.doubts if doubt.grave]
    if grave:
        return grave[0].text
    advice = list_gain_advice(found, log)
    return f"{_capitalize_first('; '.join(advice))}." if advice else ENOUGH


def _judge_run(index: int, log: Log, *, found: Fit | None, inspection: Inspection) -> str:
    """Why and how a run has to be repeated; empty if it does not."""
    run = log.runs[index]
    faults = [one for one in inspection.faults if one.where.run == index]
    stop = next((one for one in faults if one.fault == "hard-stop"), None)
    if stop is not None and run.kind == "dynamic":
        return _advise_smaller_step(run, stop, found=found)
    if faults:
        worst = max(faults, key=lambda one: one.confidence)
        return f"Repeat {run.test}: {worst.evidence} {worst.advice}"
    limited = find_voltage_limit(run)
    if limited is not None:
        lasts, volts = limited
        return (
            f"{run.test} met a current limit or a weak battery: for {lasts * 1000.0:.0f} ms the "
            f"motor got less than the step, {volts:.1f} V at first. Repeat it with "
            f"{_round_down(volts):g} V."
        )
    for doubt in inspection.doubts:
        if doubt.code in TOO_SHORT and f"{run.test} " in doubt.message:
            return f"Repeat {run.test}: {doubt.text}"
    return ""


def find_voltage_limit(run: Run) -> tuple[float, float] | None:
    """Duration and lowest voltage of a voltage limit at the start of a step; None without one.

    The command of a step is constant. If the voltage at the motor is lower at first, by at least
    the share ``LEAST_STEP``, then the current was limited or the battery voltage dropped. A single
    low reading does not count: it may have been taken while the voltage rose.

    Returns:
        Duration [s] and lowest voltage in it [V]; None without a limit, or if the run is no step.
    """
    if run.kind != "dynamic" or not len(run):
        return None
    first = find_step_start(run)
    size = np.abs(run.voltage[first:])
    free = size > (1.0 - LEAST_STEP) * np.percentile(size, 90)
    count = int(np.argmax(free))
    if count < FEWEST:
        return None
    return float(run.time[first + count] - run.time[first]), float(size[:count].min())


def _advise_smaller_step(run: Run, stop: Damage, *, found: Fit | None) -> str:
    """Advice for a step that ended at a hard stop: a smaller step that settles before it."""
    first = find_step_start(run)
    after = max(stop.where.start - float(run.time[first]), 0.0)
    most = float(np.abs(run.voltage).max())
    way = abs(float(np.interp(stop.where.start, run.time, run.position) - run.position[first]))
    volts = 0.5 * most if found is None else find_settled_step(found.gains, way)
    volts = min(volts, 0.5 * most) if not 0.0 < volts < most else volts
    return (
        f"{run.test} reached its end after {after * 1000.0:.0f} ms. Repeat it with "
        f"{_round_down(volts):g} V, or let go earlier."
    )


def find_settled_step(gains: Mapping[str, float], way: float) -> float:
    """The largest step [V] that almost reaches its final speed within a distance.

    From rest, x(t) = v·(t - τ·(1 - exp(-t/τ))) with τ = kA/kV and v = (V - kS)/kV, solved for V at
    t = ``SETTLES``·τ.

    Args:
        gains: kS, kV and kA in SI.
        way: the distance [m or rad].

    Returns:
        The step; 0 if kV or kA is not positive.
    """
    kv, ka = gains["kV"], gains["kA"]
    if not (kv > 0.0 and ka > 0.0):
        return 0.0
    reach = ka / kv * (SETTLES - 1.0 + math.exp(-SETTLES))  # [s] per unit of the final speed
    return max(gains["kS"], 0.0) + kv * way / reach


def _round_down(volts: float) -> float:
    """The voltage [V] rounded down to a multiple of ``FINE``, at least ``FINE``."""
    return max(math.floor(volts / FINE + 1e-9) * FINE, FINE)


def _capitalize_first(text: str) -> str:
    return text[:1].upper() + text[1:]
