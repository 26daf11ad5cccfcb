"""Write the true gains and effects of a simulated mechanism, for instructors only."""

import json
from collections.abc import Iterable
from dataclasses import asdict
from pathlib import Path
from typing import Any

from sim.bench.mechanism import Mechanism
from sim.bench.routine import Routine
from sim.core.units import convert_gains, find_unit
from sim.inspect.fault import LogInterval
from sim.support.os_errors import refuse_os_errors


def describe_truth(mechanism: Mechanism) -> dict[str, Any]:
    """True gains and hidden effects of a mechanism, in the unit of its logs, as plain data."""
    per = find_unit(mechanism.units)
    return {
        "mechanism": mechanism.name,
        "type": mechanism.type,
        "units": per.name,
        "gains": convert_gains(mechanism.gains, factor=per.si),
        "hidden": [
            {"effect": part.effect, "parameters": part.to_json(per)} for part in mechanism.hidden
        ],
    }


def write_ground_truth(
    mechanism: Mechanism,
    routine: Routine,
    *,
    path: Path,
    faults: Iterable[tuple[str, float, LogInterval]] = (),
) -> None:
    """Write the true gains, in the unit of the logs, and hidden effects and faults, as JSON.

    Args:
        mechanism: the simulated mechanism.
        routine: its tests.
        path: the file.
        faults: name, severity and interval of each fault in the log.

    Raises:
        BadRequest: the file cannot be written.
    """
    content = {
        **describe_truth(mechanism),
        "routine": asdict(routine),
        "faults": [
            {"fault": name, "severity": severity, "run": where.run, "test": where.test,
             "start_s": where.start, "end_s": where.end}
            for name, severity, where in faults
        ],
    }  # fmt: skip
    advice = "Name a file in a folder that exists and may be written to."
    with refuse_os_errors("the truth cannot be written", path, advice=advice):
        path.write_text(json.dumps(content, indent=2) + "\n", encoding="utf-8")
