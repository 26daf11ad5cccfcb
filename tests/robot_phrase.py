"""A subsystem around one phrase of robot code, read."""

from pathlib import Path

from grader.robotcode import read
from grader.robotcode.facts import RoutineFacts

JAVA = """
import static edu.wpi.first.units.Units.*;

public class Arm extends SubsystemBase {{
  {fields}
  private final SysIdRoutine m_routine = new SysIdRoutine(
      new SysIdRoutine.Config(null, {step}, null),
      new SysIdRoutine.Mechanism({drive}, {log}, this));
}}
"""
PYTHON = """
from commands2 import Subsystem
from commands2.sysid import SysIdRoutine
from wpimath.units import millisecondsToSeconds, volts
{top}

class Arm(Subsystem):
    {fields}

    def __init__(self):
        {body}
        self.routine = SysIdRoutine(
            SysIdRoutine.Config(1.0, {step}),
            SysIdRoutine.Mechanism({drive}, {log}, self),
        )

    {methods}
"""


def java(
    folder: Path, *, step: str = "null", fields: str = "", drive: str = "null", log: str = "null"
) -> RoutineFacts:
    path = folder / "Arm.java"
    text = JAVA.format(step=step, fields=fields, drive=drive, log=log)
    path.write_text(text, encoding="utf-8")
    return read(path)


def python(
    folder: Path,
    *,
    step: str = "7.0",
    top: str = "",
    fields: str = "pass",
    body: str = "pass",
    drive: str = "None",
    log: str = "None",
    methods: str = "pass",
) -> RoutineFacts:
    path = folder / "arm.py"
    text = PYTHON.format(
        step=step, top=top, fields=fields, body=body, drive=drive, log=log, methods=methods
    )
    path.write_text(text, encoding="utf-8")
    return read(path)
