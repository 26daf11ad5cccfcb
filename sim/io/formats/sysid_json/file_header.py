"""The header of a file of the tools before 2024: units, type and test of its data."""

from collections.abc import Mapping
from dataclasses import dataclass

from sim.core.advice import Action
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
        mechanism: the file's name of it; may be empty.
        type: ``simple``, ``elevator``, ``arm``, or empty.
        units: the unit of position, after multiplication by ``per_rotation``.
        per_rotation: units per rotation of the position in the rows.
        sysid: whether SysId wrote the file, not an older tool.
        doubts: warnings about units and mechanism.
    """

    mechanism: str
    type: str
    units: str
    per_rotation: float
    sysid: bool
    doubts: tuple[Doubt, ...]

    @property
    def drivetrain(self) -> bool:
        """Whether the file says that it is of a drivetrain."""
        return self.mechanism.lower().startswith("drivetrain")

    @property
    def angular(self) -> bool:
        """Whether the drivetrain turned on the spot."""
        return "angular" in self.mechanism.lower()


def read_header(document: Mapping[str, object], options: ReadOptions, *, where: str) -> FileHeader:
    """Read the header of a file; the user's choice of units has priority.

    Raises:
        UnreadableFile: a value has the wrong type or range, or the units are unknown.
    """
    mechanism = document.get("test", "")
    if not isinstance(mechanism, str):
        raise UnreadableFile(
            'its "test" is no text, and should name the kind of mechanism',
            where=where,
            advice='Write "Simple", "Elevator" or "Arm".',
        )
    type_ = _TYPES.get(mechanism.lower(), "")
    doubts = []
    if mechanism and not type_:
        doubts.append(
            Doubt(
                "unknown-mechanism",
                f"{where} is of a mechanism named {mechanism!r}, which no tool wrote.",
                action=Action("state-type"),
            )
        )
    units, unsure = _read_units(document, options, type_=type_, where=where)
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


def _read_units(
    document: Mapping[str, object], options: ReadOptions, *, type_: str, where: str
) -> tuple[str, tuple[Doubt, ...]]:
    """The unit of position, and a doubt if it was assumed or contradicts the user's.

    Raises:
        UnreadableFile: the file's units are unknown.
    """
    found = document.get("units")
    known = found.strip().lower() if isinstance(found, str) else ""
    if options.units:
        doubt = Doubt(
            "contradicting-units",
            f"{where}: the file says {found}, but you chose {options.units}.",
            action=Action("own-units"),
        )
        return options.units, (doubt,) if found is not None and known != options.units else ()
    if found is None:
        default = "radians" if "arm" in (type_, options.type) else "meters"
        doubt = Doubt(
            "units-unknown",
            f"{where} does not say in which units it is, as no file of 2019 and 2020 does: taken "
            f"as {default}.",
            action=Action("units"),
        )
        return default, (doubt,)
    if known not in UNITS:
        raise UnreadableFile(
            f"its units are {found!r}, which are not known here",
            where=where,
            advice=Action("which-units", ", ".join(UNITS)),
        )
    return known, ()
