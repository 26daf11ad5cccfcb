"""Files of unsupported formats that are often given as logs, and the advice for each."""

from typing import NamedTuple


class ForeignFormat(NamedTuple):
    """How to recognize a file of an unsupported format, and the advice for it."""

    starts: tuple[bytes, ...]
    suffixes: tuple[str, ...]
    what: str
    advice: str


_ROBOT_LOG = "Give the robot's own log: the .wpilog that DataLogManager writes."
FOREIGN = (
    ForeignFormat(
        (b"\x00\x00\x00\x04",),  # both kinds of Driver Station files begin with their version
        (".dslog", ".dsevents"),
        "a log of the Driver Station, which holds no motor's voltage or position",
        _ROBOT_LOG,
    ),
    ForeignFormat(
        (),
        (".rlog",),
        "a log of AdvantageKit's own format",
        "Open it in AdvantageScope, export it as WPILOG, and give that.",
    ),
    ForeignFormat(
        (b"PK\x03\x04", b"PK\x05\x06"),
        (),
        "a zip archive or a workbook of a spreadsheet program",
        "Unpack it, or save the sheet as CSV.",
    ),
    ForeignFormat((b"\x1f\x8b",), (), "packed with gzip", "Unpack it first."),
    ForeignFormat((b"\x89PNG", b"\xff\xd8\xff", b"GIF8"), (), "a picture", _ROBOT_LOG),
    ForeignFormat((b"%PDF",), (), "a PDF document", _ROBOT_LOG),
    ForeignFormat((b"\xff\xfe", b"\xfe\xff"), (), "text in UTF-16", "Save it as UTF-8."),
    ForeignFormat(
        (b"<!doctype html", b"<html"),
        (),
        "a web page (HTML)",
        "Download the file itself: on GitHub that is the button Raw.",
    ),
)
