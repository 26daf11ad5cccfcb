"""The data of a log that the page shows: runs, faults, and gains with their doubts.

Samples are in SI; gains and their unit are those of the log, with the factor between both.
"""

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, replace
from typing import Any

import numpy as np

from sim.cli.entries import describe_entry
from sim.cli.inspect import SURE, name_confidence
from sim.cli.open.session import OpenLog, Reading, Session
from sim.core.advice import Action
from sim.core.doubt import Doubt, sort_doubts
from sim.core.errors import BadRequest, Refusal, refuse_unknown
from sim.core.leave_out import cut_run
from sim.core.log import Array, Log
from sim.core.units import compute_unit_ratio, find_unit
from sim.estimation.measurements import MIN_SAMPLES
from sim.feedback import PRESETS
from sim.fit import Fit
from sim.fit.feedback_trial import (
    NO_START,
    find_better_gains,
    format_gain_pair,
    try_feedback_gains,
)
from sim.fit.physics import Parts
from sim.fit.physics.parts import check_radius_unit
from sim.fit.replay import replay_fit
from sim.inspect.detect_faults import Inspection
from sim.io.entries.entry import NUMBERS, SECOND, STRING, Entry
from sim.physics.engine import engine_can_compile, engine_is_cached
from sim.physics.motors import MOTORS, find_motor
from sim.reconcile.model_variant import ModelVariant
from sim.reconcile.thresholds import LEAST_FLOOR
from sim.report.fit_terminal import format_gains
from sim.report.gain_verdicts import judge_gains, write_gain_verdict
from sim.report.robot_code_snippet import ORDER, write_robot_code
from sim.support.printable import finite_or_none, join_names

SIGNALS = ("time", "voltage", "position", "velocity")
MOST_ENTRIES = 400  # entries listed to choose from
PICTURE = 120  # [points] of an entry's small plot
LONGEST_UNIT = 40  # [characters] longer metadata is not a unit
MEANS = {
    "kS": "friction: the volts before the mechanism moves",
    "kV": "the volts for a steady speed, for each unit of speed",
    "kA": "the volts for acceleration, for each unit of acceleration",
    "kG": "gravity: the volts that hold it where gravity pulls most",
    "offset_rad": "what to add to the sensor's angle, to count from horizontal",
}
WORDS = ("type", "preset", "units", "before", "motor")  # of a request for feedback gains
ALLOWED = ("position_error", "velocity_error", "volts")  # weights of the regulator
DELAYS = ("position_delay", "velocity_delay")  # [s] of a feedback loop
LAGS = 1e-5  # [s] a shorter lag is shown as 0


def answer_request(
    one: OpenLog,
    reading: Reading,
    what: str,
    query: Mapping[str, str],
    chosen: ModelVariant | None = None,
) -> Any:  # noqa: ANN401 - JSON
    """The data that a request of the page asks for; None if there are no such data.

    Args:
        one: the log.
        reading: how to read it.
        what: last part of the request's address.
        query: options in the address.
        chosen: a model with effects, for gains and code.

    Raises:
        Refusal: the log cannot be read or fitted.
    """
    answers: Mapping[str, Any] = {
        "summary": lambda: describe_log(one, reading),
        "entries": lambda: describe_entries(one.list_entries()),
        "faults": lambda: describe_faults(one.inspect(reading), one, one.combine_runs(reading)),
        "fit": lambda: describe_fit(one, reading, chosen),
        "directions": lambda: describe_directions(one, reading),
        "code": lambda: write_code(one, reading, query, chosen),
    }
    return answers[what]() if what in answers else None


def describe_log(one: OpenLog, reading: Reading) -> dict[str, Any]:
    """Unit, type and runs of a log.

    Raises:
        Refusal: the log cannot be read with these options.
    """
    log = one.combine_runs(reading)
    unit = find_unit(log.units)
    runs = [
        {"part": name, "test": run.test, "samples": len(run)}
        for name, part in one.read_parts(reading).items()
        for run in part.runs
    ]
    return {
        "type": log.type or "simple",
        "units": {"name": unit.name, "symbol": unit.symbol, "si": unit.si, "angular": unit.angular},
        "mechanism": log.mechanism,
        "runs": runs,
        "samples": sum(map(len, log.runs)),
        "compiles": not engine_is_cached(),
        "compiled": engine_can_compile(),
    }


def describe_session(session: Session) -> dict[str, Any]:
    """The open logs, what the page shows of them, and the source that is followed."""
    return {
        "logs": [name_log(one) for one in session.logs],
        "view": asdict(session.view)
        | {"motors": list(MOTORS), "presets": {key: one.name for key, one in PRESETS.items()}},
        "live": _describe_live(session),
    }


def name_log(one: OpenLog) -> dict[str, Any]:
    """The number and the name of a log."""
    return {"id": one.number, "name": one.name}


def _describe_live(session: Session) -> dict[str, Any]:
    """The status of the source that is followed, and its growing logs with their revisions."""
    live = session.live
    logs = [name_log(one) | {"revision": one.revision} for one in session.logs if one.revision]
    return {"follows": live is not None, "logs": logs} | (asdict(live) if live else {})


def pack_samples(log: Log) -> bytes:
    """Time, voltage, position and velocity of every run, one after another, as doubles in SI.

    The least significant byte comes first.
    """
    signals = [getattr(run, signal) for run in log.runs for signal in SIGNALS]
    return b"".join(np.asarray(one, dtype="<f8").tobytes() for one in signals)


def pack_entry(one: OpenLog, log: Log, name: str) -> bytes:
    """The last value of an entry at each sample of every run, one after another, as doubles.

    Raises:
        BadRequest: the log has no such entry with numbers.
    """
    named = (entry for entry in one.list_entries() if entry.name == name and len(entry))
    entry = next((entry for entry in named if entry.type in NUMBERS), None)
    if entry is None:
        raise BadRequest(f"the log has no numbers named {name!r}", advice="Choose from the list.")
    at = np.concatenate([run.time for run in log.runs]) * SECOND
    last = np.searchsorted(entry.time, np.rint(at), side="right") - 1
    return entry.numbers()[np.maximum(last, 0)].astype("<f8").tobytes()


def describe_faults(found: Inspection, one: OpenLog, log: Log) -> dict[str, Any]:
    """The faults of a log with their times, and its other warnings, with those of its repair."""
    data = found.to_json()
    for fault, damage in zip(data["faults"], found.faults, strict=True):
        if isinstance(damage.advice, Action):
            fault["advice"] = damage.advice.on_page
        fault["evidence"] = _without_path(fault["evidence"], one)
        fault["sureness"] = name_confidence(fault["confidence"])
    doubts = tuple(dict.fromkeys((*found.doubts, *log.doubts)))
    return data | {"doubts": _describe_doubts(doubts, one)}


def describe_fit(
    one: OpenLog, reading: Reading, chosen: ModelVariant | None = None
) -> dict[str, Any]:
    """The gains with verdict and doubts, and the simulated initial state of each run.

    Args:
        one: the log.
        reading: how to read it.
        chosen: a model with effects, whose gains and simulated velocities are shown instead.

    Raises:
        Refusal: the log cannot be read or fitted.
    """
    pooled, log = one.fit(reading), one.combine_runs(reading)
    plain = pooled.found.in_log_units()
    found = chosen.apply_to(plain) if chosen else plain
    gains = [
        {
            "name": name,
            "label": label,
            "value": found.gains[name],
            "text": text.replace("-", "−"),
            "error": finite_or_none(found.errors.get(name, math.nan)),
            "error_text": error,
            "unit": unit,
            "means": MEANS[name],
        }
        for name, (label, text, error, unit) in zip(found.gains, format_gains(found), strict=True)
    ]
    return {
        "type": found.type,
        "gains": gains,
        **_describe_verdict(found, log),
        "doubts": _describe_doubts(found.list_doubts(), one),
        "notes": [] if chosen else list(pooled.notes),
        "tracks": _list_tracks(chosen, log) if chosen else None,
        "parts": [] if chosen else sorted(part.effect for part in found.parts),
        "lag": found.position_delay if found.position_delay > LAGS else 0.0,
        "window": max(2.0 * (found.velocity_delay - found.position_delay), 0.0),
        "delays": {name: getattr(found, name) for name in DELAYS},
        **({} if chosen else _describe_starts(found, log, reading)),
    }


def _list_tracks(chosen: ModelVariant, log: Log) -> list[list[float]]:
    """The simulated velocity [SI] of each run; empty if it has other samples.

    A model of the mean of two sides stands for the runs of each side.
    """
    tracks = [run[:, 1].tolist() for run in chosen.tracks]
    tracks *= len(log.runs) // max(len(tracks), 1)
    return tracks if list(map(len, tracks)) == list(map(len, log.runs)) else []


def _describe_verdict(found: Fit, log: Log) -> dict[str, str]:
    return {"word": judge_gains(found), "verdict": write_gain_verdict(found, log)}


def describe_directions(one: OpenLog, reading: Reading) -> dict[str, Any]:
    """The places where separate fits of forward and reverse runs disagree, and their verdict.

    Raises:
        Refusal: the log cannot be read or fitted.
    """
    found, (doubted, notes) = one.fit(reading).found, one.compare_directions(reading)
    more = [doubt for doubt in doubted.doubts if doubt not in found.doubts]
    verdict = _describe_verdict(doubted.in_log_units(), one.combine_runs(reading))
    return verdict | {"doubts": _describe_doubts(more, one), "notes": list(notes)}


def _describe_starts(found: Fit, log: Log, reading: Reading) -> dict[str, Any]:
    """Simulated position and velocity at the start of each piece of a run that is fitted, in SI.

    With them, the top speed in the log's unit, and the velocity noise in SI, which is None if
    nothing is simulated. It has the least value that a search for effects gives it, so that both
    count the same noise.
    """
    pieces = [(k, one) for k, run in enumerate(log.runs) for one in cut_run(run, reading.left_out)]
    rest = replace(log, runs=tuple(piece for _, piece in pieces))
    top = log.top_speed / find_unit(log.units).si  # a share of it stays comparable
    try:
        done = replay_fit(found, rest)
        whole = replay_fit(found, log) if reading.left_out else done  # its noise stays the same
    except BadRequest:  # the doubts say which gain is below zero
        return {"starts": [], "noise": None, "top": top}
    starts: list[list[dict[str, float]]] = [[] for _ in log.runs]
    replays = iter(done)
    noise = max(whole[0].velocity_noise, LEAST_FLOOR * log.top_speed) if done else None
    for k, piece in pieces:
        replay = next(replays, None) if len(piece) >= MIN_SAMPLES else None
        if replay is not None:
            start = {
                "first": int(np.searchsorted(log.runs[k].time, replay.run.time[0])),
                "count": len(replay.run),
                "position": float(replay.position[0]),
                "velocity": float(replay.velocity[0]),
            }
            starts[k].append(start)
    return {"starts": starts, "noise": noise, "top": top}


def write_code(
    one: OpenLog,
    reading: Reading,
    query: Mapping[str, str],
    chosen: ModelVariant | None = None,
) -> dict[str, str]:
    """Robot code for the gains of a log, or for values that the user set with the sliders.

    Args:
        one: the log.
        reading: how to read it.
        query: language or motor controller, season, radius, and gains that were set by hand.
        chosen: a model with effects, whose gains are written instead.

    Raises:
        Refusal: the log cannot be fitted, or its gains cannot be written as code.
    """
    language, season = query.get("language", "java"), query.get("season", "2026")
    if not season.isdecimal():
        raise BadRequest("this season is not supported", advice="Choose 2026.")
    compared = one.fit(reading).found if chosen else one.compare_directions(reading)[0]
    plain = compared.in_log_units()
    found = chosen.apply_to(plain) if chosen else plain
    moved = {name: value for name, value in read_moved_gains(query).items() if name in found.gains}
    errors = {name: error for name, error in found.errors.items() if name not in moved}
    # A value set by hand has no standard error
    known = (*found.doubts, *_doubt_faults(one, reading, known=found.doubts))
    doubts = tuple(replace(some, message=_without_path(some.message, one)) for some in known)
    found = replace(found, gains={**found.gains, **moved}, errors=errors, doubts=doubts)
    radius = float(query["radius"]) if _is_number(query.get("radius", "")) else None
    code = write_robot_code(
        found, target=language, season=int(season), radius=radius, left_out=reading.left_out,
        moved=[*moved],
    )  # fmt: skip
    return {"code": code}


def read_moved_gains(query: Mapping[str, str]) -> dict[str, float]:
    """The gains that a request of the page names, moved by hand."""
    return {name: float(query[name]) for name in MEANS if _is_number(query.get(name, ""))}


def _doubt_faults(one: OpenLog, reading: Reading, *, known: Sequence[Doubt]) -> Iterator[Doubt]:
    """A doubt for each kind of fault that is sure, not left out, and not doubted already."""
    for kind in one.inspect(reading).group_by_kind():
        left = [
            where.test or "the whole log"
            for where in (fault.where for fault in kind if fault.confidence >= SURE)
            if not any(part.covers(where.test, where.start, where.end) for part in reading.left_out)
        ]
        if left and kind[0].fault not in {doubt.code for doubt in known}:
            tests = join_names(list(dict.fromkeys(left)))
            yield Doubt(
                kind[0].fault, f"{kind[0].fault.replace('-', ' ').capitalize()} in {tests}."
            )


def _is_number(text: str) -> bool:
    """Whether a text is a finite number."""
    try:
        return math.isfinite(float(text))
    except ValueError:
        return False


def describe_feedback(query: Mapping[str, str]) -> dict[str, Any]:
    """Feedback gains for gains that the user typed, or that theory gives for a motor.

    Args:
        query: kS, kV, kA, type, units, preset, delays, the regulator's allowed errors and volts;
            a motor with count, ratio, radius and load takes the place of kV and kA.

    Raises:
        Refusal: there are no feedback gains for these numbers.
    """
    type_, chosen = query.get("type", "simple"), query.get("preset", "default")
    refuse_unknown("preset", chosen, PRESETS)
    texts = {name: text for name, text in query.items() if text and name not in WORDS}
    wrong = [
        name
        for name, text in texts.items()
        if not _is_number(text) or (name in ALLOWED and float(text) <= 0.0)
    ]
    if wrong:
        label = wrong[0].replace("_", " ")
        raise BadRequest(f"{texts[wrong[0]]!r} is no {label}", advice="Type a number above zero.")
    numbers = {name: float(text) for name, text in texts.items()}
    delays = {name: numbers.get(name, 0.0) for name in DELAYS}
    gains = {name: numbers.get(name, 0.0) for name in (*ORDER.get(type_, ()), "offset_rad")}
    units = query.get("units", "meters")
    before = query.get("before") or units
    given = units if query.get("motor") else before  # theory's gains replace those that are given
    typed = Fit.from_gains(gains, type=type_, units=given, **delays)
    found, per = typed.in_units(units, radius=numbers.get("radius")), find_unit(units)
    if query.get("motor"):
        count, ratio, radius = (numbers.get(name, 1.0) for name in ("count", "ratio", "radius"))
        motor = find_motor(query["motor"])
        parts = Parts(motor, int(count), ratio, radius=radius, load=numbers.get("load"))
        check_radius_unit(parts, found)
        theory = {"kV": parts.kv * per.si, "kA": (parts.ka or 0.0) * per.si}
        found = replace(found, gains=gains | theory)
    allowed = {name: numbers[name] for name in ALLOWED if name in numbers}
    turned = compute_unit_ratio(per, find_unit(before), radius=numbers.get("radius"))
    for name in allowed.keys() - {"volts"}:  # the unit of these has changed as that of the gains
        allowed[name] /= 1.0 if math.isnan(turned) else turned
    rows = []
    for trial in try_feedback_gains(found, PRESETS[chosen], allowed=allowed):
        best = find_better_gains(found, trial)
        shown = format_gain_pair(best, per.symbol) if best else "no good start"
        late = f"In simulation with {1e3 * trial.delay:.0f} ms of delay"
        step = f"{late}, it {best.verdict.description}." if best else NO_START
        own = f"{format_gain_pair(trial, per.symbol)}: with them, it {trial.verdict.description}"
        instead = "" if trial.is_good else f"Do not use SysId’s own suggestion, {own}."
        rows.append({"loop": trial.loop, "gains": shown, "step": step, "instead": instead})
    return {"gains": {**found.gains, **allowed}, "rows": rows, "symbol": per.symbol}


def describe_entries(entries: Sequence[Entry]) -> list[dict[str, Any]]:
    """Entries that can be signals, each with points for a small plot; likely signals first.

    Numbers that never change are left out.
    """
    rows = []
    for entry in entries:
        if not len(entry) or entry.type not in (*NUMBERS, STRING):
            continue
        picture = [] if entry.type == STRING else _decimate(entry.numbers())
        if entry.type == STRING or len(set(picture)) > 1:
            row = describe_entry(entry)
            unit = row["unit"] if len(str(row["unit"])) <= LONGEST_UNIT else ""
            rows.append(row | {"text": entry.type == STRING, "unit": unit, "picture": picture})
    rows.sort(key=lambda row: (not row["signal"], row["name"]))
    return rows[:MOST_ENTRIES]


def _decimate(values: Array) -> list[float]:
    """Every n-th value, 120 to 240 of a long entry; values that are not finite are left out."""
    step = max(1, values.size // PICTURE)
    return [float(f"{value:.4g}") for value in values[::step].tolist() if math.isfinite(value)]


def describe_refusal(refusal: Refusal, folder: str) -> dict[str, Any]:
    """An error as plain data: what went wrong, where, and what to do.

    The temporary folder of the session is removed from the file's path.
    """
    where = refusal.where.partition(folder)[2] or refusal.where
    place = where.replace("\\", "/").rpartition("/")[2]
    advice = refusal.action.on_page if refusal.action else refusal.advice
    return {
        "what": refusal.what,
        "where": place,
        "advice": advice,
        "kind": type(refusal).__name__,
        "asks": refusal.action.name if refusal.action else "",
    }


def _describe_doubts(doubts: Sequence[Doubt], one: OpenLog) -> list[dict[str, Any]]:
    return [
        {
            "code": doubt.code,
            "message": _without_path(doubt.message, one),
            "grave": doubt.grave,
            "advice": doubt.action.on_page if doubt.action else "",
            "type": doubt.action.argument
            if doubt.action and doubt.action.name == "gravity-type"
            else "",
        }
        for doubt in sort_doubts(doubts)
    ]


def _without_path(text: str, one: OpenLog) -> str:
    """A message without the file's path: the page shows its name."""
    short = re.sub(f"{re.escape(str(one.path))}[:,] ", "", text)
    start = short[:1].upper() if short != text else short[:1]
    return f"{start}{short[1:]}".replace(str(one.path), one.name)
