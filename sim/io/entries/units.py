"""The unit of an entry, from its metadata as Java or Python writes it, or from its name.

    Java     Volt   Rotation   Rotation per Second   Meter   Meter per Second
    Python   volt   turn       turns_per_second      meter   meters_per_second

Other loggers put the same into JSON (``{"unit": "rad/s"}``), at the end of a sentence (``Units:
rotations``), or into the name of the entry (``DriveVelocityRadPerSec``).
"""

import json
import math
import re
from collections.abc import Mapping
from dataclasses import dataclass

from sim.core.advice import Action
from sim.core.doubt import OF_POSITION, Doubt
from sim.core.errors import BadRequest
from sim.core.units import UNITS
from sim.io.entries.entry import NEEDED, Entry
from sim.io.entries.names import split_unit, split_words
from sim.io.format import ReadOptions

_WORDS = {  # our unit -> other names of it
    "meters": "meter meters metre metres m",
    "feet": "foot feet ft",
    "inches": "inch inches in",
    "radians": "radian radians rad rads",
    "rotations": "rotation rotations turn turns revolution revolutions rot rots rev revs r",
    "degrees": "degree degrees deg degs °",
}
LENGTHS = {word: (unit, 1.0) for unit, words in _WORDS.items() for word in words.split()} | {
    "centimeter": ("meters", 0.01),
    "centimeters": ("meters", 0.01),
    "cm": ("meters", 0.01),
    "millimeter": ("meters", 0.001),
    "millimeters": ("meters", 0.001),
    "mm": ("meters", 0.001),
}
SECONDS = {  # unit of time -> [s] its size
    **dict.fromkeys(("minute", "minutes", "min"), 60.0),
    **dict.fromkeys(("s", "sec", "second", "seconds"), 1.0),
    **dict.fromkeys(("ms", "msec", "millisecond", "milliseconds"), 1e-3),
    **dict.fromkeys(("us", "µs", "usec", "microsecond", "microseconds"), 1e-6),
}
VOLTS = "volts"
VOLTAGES = {
    **dict.fromkeys(("volt", "volts", "v"), 1.0),
    **dict.fromkeys(("millivolt", "millivolts", "mv"), 1e-3),
}
PHOENIX = {"position": "rotations", "velocity": "rotations per second"}
"""Units of CTRE's Phoenix 6, which are missing in an export as CSV."""
_PHOENIX = re.compile(r"phoenix ?6|talonfxs?\b|cancoder", re.IGNORECASE)
PIGEON = {"position": "degrees", "velocity": "degrees per second"}
"""Units of CTRE's gyro, which differ from those of other Phoenix 6 devices."""
_PIGEON = re.compile(r"pigeon", re.IGNORECASE)
_RATE = re.compile(r"rotational[ _]?rate", re.IGNORECASE)
ACTIONS = {"units-assumed": Action("units"), "contradicting-units": Action("own-units")}
SHORT = {
    "rpm": "rotation per minute",
    "rps": "rotation per second",
    "mps": "meter per second",
}


@dataclass(frozen=True)
class StatedUnit:
    """A unit stated in metadata, in our units.

    Args:
        units: our unit; for a velocity, this unit per second.
        factor: the stated unit in our unit.
    """

    units: str
    factor: float


@dataclass(frozen=True)
class EntryScale:
    """Factors from the numbers of a motor's entries to the unit of its log.

    Args:
        units: unit of the log, a name in ``sim.core.units.UNITS``.
        factors: signal -> factor of its numbers.
        doubts: warnings about assumed or converted units.
    """

    units: str
    factors: Mapping[str, float]
    doubts: tuple[Doubt, ...]


def find_unit_in_metadata(metadata: str) -> str:
    """The unit in metadata, as written there; empty if there is none."""
    text = metadata.strip()
    if not text.startswith("{"):
        stated = re.search(r"\bunits?:\s*(.+?)\.?\s*$", text, re.IGNORECASE)
        return stated[1] if stated else text
    keyed = _parse_metadata(text)
    properties = keyed.get("properties")  # properties of a NetworkTables topic
    keyed = {**properties, **keyed} if isinstance(properties, dict) else keyed
    found = next((keyed[key] for key in ("unit", "units") if key in keyed), "")
    return found.strip() if isinstance(found, str) else ""


def is_from_network_tables(entry: Entry) -> bool:
    """Whether an entry is a topic of NetworkTables, by the metadata that DataLogManager writes.

    NetworkTables does not send a repeated value by default.
    """
    return _parse_metadata(entry.metadata.strip()).get("source") == "NT"


def _parse_metadata(text: str) -> dict[str, object]:
    """The content of metadata in JSON; empty if it is not a JSON object."""
    try:
        content = json.loads(text)
    except (ValueError, RecursionError):
        return {}
    return content if isinstance(content, dict) else {}


def parse_signal_unit(text: str, signal: str) -> StatedUnit | None:
    """Parse the unit of a voltage, position or velocity; None if it is not known."""
    plain = text.lower()
    if signal == "voltage":
        return StatedUnit(VOLTS, VOLTAGES[plain]) if plain in VOLTAGES else None
    rate = 1.0
    if signal == "velocity":
        plain = re.sub(r"[_\s]+", " ", plain.replace("/", " per "))
        plain, _, time = SHORT.get(plain, plain).partition(" per ")
        plain, rate = plain.strip(), 1.0 / SECONDS.get(time.strip(), math.inf)
    elif signal != "position":
        return None
    found = LENGTHS.get(plain)
    return StatedUnit(found[0], found[1] * rate) if found and rate else None


def find_unit_text(entry: Entry, signal: str) -> str:
    """The unit in an entry's metadata, or else at the end of its name; empty if in neither."""
    text = find_unit_in_metadata(entry.metadata)
    if text:
        return text
    name, unit = split_unit(entry.name)
    if unit and parse_signal_unit(unit, signal):
        return unit
    words = split_words(re.split(r"[/:]", name)[-1])
    ends = (" ".join(words[first:]) for first in range(len(words)))
    found = next((end for end in ends if parse_signal_unit(end, signal)), "")
    if _PIGEON.search(entry.name):
        return found or PIGEON.get(signal, "")
    return found or (PHOENIX.get(signal, "") if _PHOENIX.search(entry.name) else "")


def choose_scale(signals: Mapping[str, Entry], *, options: ReadOptions, where: str) -> EntryScale:
    """The scale of a motor's entries: by the user's unit, else by their units, else the default.

    Raises:
        BadRequest: the position is an angle and the velocity a length, or the reverse.
    """
    texts = {name: find_unit_text(signals[name], name) for name in NEEDED if name in signals}
    parsed = {signal: parse_signal_unit(text, signal) for signal, text in texts.items()}
    stated = [found.units for name in ("position", "velocity") if (found := parsed.get(name))]
    if options.units is None and len({UNITS[units].angular for units in stated}) > 1:
        raise BadRequest(
            f"the position is in {texts['position']!r} and the velocity in {texts['velocity']!r}, "
            "an angle and a length",
            where=where,
            advice=Action("units", before="Let the robot log both in the same unit."),
        )
    units = options.units or (stated[0] if stated else options.units_or_default)
    factors: dict[str, float] = {}
    doubts: dict[str, Doubt] = {}  # of a contradiction, one for all signals
    for signal, text in texts.items():
        unit = VOLTS if signal == "voltage" else units
        ordered = options.units is not None and unit != VOLTS
        factors[signal], code, what = _scale_signal(
            signals[signal].name, parsed[signal], text, unit, ordered=ordered
        )
        gains = OF_POSITION if code == "contradicting-units" else ()
        doubt = Doubt(code, f"{where}: {what}", action=ACTIONS.get(code), gains=gains)
        if code:
            doubts.setdefault(code if code == "contradicting-units" else signal, doubt)
    if _RATE.search(signals["voltage"].name):
        doubts["rate"] = _rate_doubt(signals["voltage"].name, where)
    return EntryScale(units, factors, tuple(doubts.values()))


def _scale_signal(
    name: str, found: StatedUnit | None, text: str, unit: str, *, ordered: bool
) -> tuple[float, str, str]:
    """The factor to ``unit``, and code and text of the doubt about it, empty if there is none.

    Args:
        name: name of the entry.
        found: the stated unit, if it is known.
        text: the stated unit as it is written.
        unit: the unit of the log.
        ordered: whether the user chose it, so that it replaces the file's.
    """
    if found is None and text:
        what = f"the unit of {name!r} is {text!r}, which is not understood; it was taken as {unit}."
        return 1.0, "unknown-unit", what
    if found is None:
        what = f"the unit of {name!r} is not stated and was taken as {unit}."
        return 1.0, "" if ordered or unit == VOLTS else "units-assumed", what
    if found.units != unit and ordered:
        what = f"the file says {found.units} for {name!r}, but you chose {unit}."
        return 1.0, "contradicting-units", what
    if found.units == unit:
        factor = found.factor
    else:
        factor = found.factor * (UNITS[found.units].si / UNITS[unit].si)
    what = (
        f"the unit of {name!r} is {text!r} and was converted to {unit}. SysId itself does not "
        "convert: there, log all signals in one unit, and velocities per second."
    )
    return factor, "" if found.units == unit and factor == 1.0 else "converted-units", what


def _rate_doubt(name: str, where: str) -> Doubt:
    """The doubt about a rate in place of the voltage, as CTRE's example program logs it."""
    return Doubt(
        "rate-as-voltage",
        f"{where}: {name!r} is not a voltage but the rate, in rad/s, that CTRE's rotation "
        "routine asks for. The gains describe how the modules follow it: kV is about 1 for "
        "each rad/s, and you cannot compute a moment of inertia from this kA. For that, take "
        "the MotorVoltage of a drive motor as the voltage.",
    )
