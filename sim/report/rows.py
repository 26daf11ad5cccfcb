"""The rows of a report's tables: gains, measures, feedback gains, code."""

import math
import re
from dataclasses import dataclass

from sim.core.errors import BadRequest
from sim.core.units import find_unit
from sim.feedback import PRESETS, Preset
from sim.fit import Fit
from sim.fit.feedback_trial import (
    SUGGESTED,
    FeedbackTrial,
    choose_feedback_delay,
    try_feedback_gains,
)
from sim.plot.table import to_text
from sim.report.fit_terminal import format_error, format_value
from sim.report.robot_code_snippet import LANGUAGES, SEASONS, write_robot_code

SURE = 1.96  # [standard errors] half width of a 95 % confidence interval
MEANS = {
    "kS": "friction: the volts before the mechanism moves",
    "kV": "the volts for a steady speed, for each unit of speed",
    "kA": "the volts for acceleration, for each unit of acceleration",
    "kG": "gravity: the volts that hold it where gravity pulls most",
    "offset_rad": "what to add to the sensor's angle, to count from horizontal",
}
CODE = {"java": "Java", "python": "Python"}


@dataclass(frozen=True)
class Gain:
    """A row of the table of gains, as text."""

    name: str
    value: str
    error: str
    between: str
    unit: str
    means: str


@dataclass(frozen=True)
class ControllerRow:
    """A row of the table of feedback gains, as text."""

    name: str
    counts: str
    delay: str
    velocity: tuple[str, str, str, bool]
    position: tuple[str, str, str, bool]


@dataclass(frozen=True)
class Snippet:
    """Code to paste, or the reason why there is none."""

    language: str
    season: int
    code: str
    refused: str


def make_gain_rows(found: Fit) -> list[Gain]:
    """The rows of the gains, with their errors, confidence intervals and meanings."""
    rows = []
    for name, value in found.gains.items():
        error = found.errors.get(name, math.nan)
        ends = (format_value(value + SURE * way * error, error) for way in (-1.0, 1.0))
        between = " to ".join(ends) if math.isfinite(error) else "not known"
        rows.append(
            Gain(
                "angle" if name == "offset_rad" else name,
                _use_minus_signs(format_value(value, error)),
                format_error(value, error),
                _use_minus_signs(between),
                found.format_gain_unit(name),
                MEANS[name],
            )
        )
    return rows


def make_measure_rows(found: Fit) -> list[tuple[str, str, str]]:
    """Rows about the goodness of fit: name, number, and what it means."""
    per = find_unit(found.units).symbol
    rows = [
        (
            "simulated velocity R²",
            _number(found.simulated_velocity_r2),
            "1 is perfect; below 0.9 look at the figures",
        ),
        (
            f"simulation error of the velocity, RMS [{per}/s]",
            _number(found.simulated_velocity_rmse),
            "it cannot be smaller than the sensor noise",
        ),
        (
            "acceleration: R²",
            _number(found.acceleration_r2),
            "low on nearly every robot, because differences are noisy",
        ),
        (
            f"error of the acceleration, RMS [{per}/s²]",
            _number(found.acceleration_rmse),
            "the same",
        ),
    ]
    late = found.method == "output-error" and max(found.velocity_delay, found.position_delay) > 0.0
    if late:
        rows.append(
            (
                "delay of the velocity [ms]",
                _number(1000.0 * found.velocity_delay),
                "found in the log; the gains account for it",
            )
        )
    return rows


def make_controller_rows(found: Fit) -> list[ControllerRow]:
    """The rows of feedback gains, one for each motor controller; empty if there are no gains."""
    rows = []
    for preset in PRESETS.values():
        tried = {
            trial.loop: trial
            for trial in try_feedback_gains(found, preset)
            if trial.owner == SUGGESTED
        }
        if {"velocity", "position"} <= set(tried):
            delays = {1000.0 * choose_feedback_delay(found, preset, loop=loop) for loop in tried}
            rows.append(
                ControllerRow(
                    preset.name,
                    _describe_units(preset),
                    " and ".join(f"{delay:.3g}" for delay in sorted(delays)),
                    _loop(tried["velocity"]),
                    _loop(tried["position"]),
                )
            )
    return rows


def _describe_units(preset: Preset) -> str:
    """The units in which a controller takes its gains."""
    full = 12.0 * preset.output
    output = "volts" if preset.output == 1.0 else f"{full:.4g} for 12 V"
    speeds = {1.0: "second", 60.0: "minute", 0.1: "100 ms"}
    derivative = "" if preset.normalized else f", kD per loop of {1000 * preset.period:.0f} ms"
    return f"{output}, speed per {speeds[preset.velocity_time]}{derivative}"


def _loop(trial: FeedbackTrial) -> tuple[str, str, str, bool]:
    """kP, kD, the simulated step response in words, and whether they are a good start."""
    numbers = (_format_four_digits(trial.gains.kp), _format_four_digits(trial.gains.kd))
    return (*numbers, trial.verdict.description, trial.is_good)


def make_snippet_rows(found: Fit) -> list[Snippet]:
    """The code of every language and season."""
    made = []
    for language in LANGUAGES:
        for season in SEASONS:
            code, refused = "", ""
            try:
                code = write_robot_code(found, language=language, season=season)
            except BadRequest as refusal:
                refused = str(refusal)
            made.append(Snippet(CODE[language], season, code, refused))
    return made


def _format_four_digits(value: float) -> str:
    return _use_minus_signs(f"{value:.4g}")


def _use_minus_signs(text: str) -> str:
    """The text with minus signs (−) for hyphens, except in exponents."""
    return re.sub(r"(?<![e\d])-", "−", text)


def _number(value: float) -> str:
    return (
        to_text(value)
        if math.isfinite(value)
        else "not known: the simulated motion grew without limit"
    )
