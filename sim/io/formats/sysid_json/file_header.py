"""The header of a file of the tools before 2024: units, type and test of its data."""

from collections.abc import Mapping
from dataclasses import dataclass

from sim.core.doubt import Doubt
from sim.core.errors import UnreadableFile
from sim.core.log import LARGEST
from sim.core.units import UNITS
from sim.io.format import ReadOptions

_TYPES = {
    "simple": "simple",
    "simple motor": "simple",
    "flywheel": "simple",
    "elevator": "elevator",
    "arm": "arm",
    "drivetrain": "simple",
    "drivetrain (angular)": "simple",
}


@dataclass(frozen=True)
class FileHeader:
    """The settings that the file states besides its rows.

    Args:
        mechanism: as the file names it; empty if it does not.
        type: ``simple``, ``elevator``, ``arm``, or empty.
        units: the unit of position, after the multiplication.
        per_rotation: that many units in one rotation of what the file counts.
        sysid: whether SysId wrote it, and not the tool before.
        doubts: what a person should know about units and mechanism.
    """

    mechanism: str
    type: str
    units: str
    per_rotation: float
    sysid: bool
    doubts: tuple[Doubt, ...]

    @property
    def drivetrain(self) -> bool:
        """Whether the file says it logged two sides."""
        return self.mechanism.lower().startswith("drivetrain")

    @property
    def angular(self) -> bool:
        """Whether the drivetrain turned on the spot."""
        return "angular" in self.mechanism.lower()


def read_header(document: Mapping[str, object], options: ReadOptions, *, where: str) -> FileHeader:
    """Collect what the file says; what a person says about units goes before it.

    Raises:
        UnreadableFile: a word where a number belongs or the reverse, or units nobody knows.
    """
    mechanism = document.get("test", "")
    if not isinstance(mechanism, str):
        raise UnreadableFile(
            "its test is not a name", where=where, advice='Write "Simple", "Elevator" or "Arm".'
        )
    type_ = _TYPES.get(mechanism.lower(), "")
    doubts = []
    if mechanism and not type_:
        doubts.append(
            Doubt(
                "unknown-mechanism",
                f"{where} is of a mechanism named {mechanism!r}, which no tool wrote. Say what it "
                "is with --type simple, elevator or arm.",
            )
        )
    units, unsure = _units(document, options, type_=type_, where=where)
    per_rotation = document.get("unitsPerRotation", 1.0)
    if not isinstance(per_rotation, float) or not 0.0 < per_rotation < LARGEST:
        raise UnreadableFile(
            f"unitsPerRotation is {per_rotation!r}",
            where=where,
            advice="Write how far the mechanism goes in one rotation, a positive number.",
        )
    return FileHeader(
        mechanism, type_, units, per_rotation, "sysid" in document, (*doubts, *unsure)
    )


def _units(
    document: Mapping[str, object], options: ReadOptions, *, type_: str, where: str
) -> tuple[str, tuple[Doubt, ...]]:
    """The unit of position, and a doubt where it had to be guessed or was contradicted."""
    found = document.get("units")
    known = found.strip().lower() if isinstance(found, str) else ""
    if options.units:
        doubt = Doubt(
            "contradicting-units",
            f"{where}: the file says {found}, but --units says {options.units}, and --units does "
            "not convert. If the file is right, the gains are wrong: leave out --units.",
        )
        return options.units, (doubt,) if found is not None and known != options.units else ()
    if found is None:
        default = "radians" if "arm" in (type_, options.type) else "meters"
        doubt = Doubt(
            "units-unknown",
            f"{where} does not say in which units it is, as no file of 2019 and 2020 does: taken "
            f"as {default}. If they are others, say so with --units.",
        )
        return default, (doubt,)
    if known not in UNITS:
        raise UnreadableFile(
            f"its units are {found!r}, which are not known here",
            where=where,
            advice=f"Say what they are with --units, one of: {', '.join(UNITS)}.",
        )
    return known, ()
