"""Read a source file, or refuse it with the reason."""

from pathlib import Path

from grader.answers.submission import read_text
from sim.core.errors import UnreadableFile

LANGUAGES = {".java": "java", ".py": "python"}  # suffix in lower case -> language
UTF_16 = (b"\xff\xfe", b"\xfe\xff")  # how Windows Notepad's "Unicode" files begin


def detect_language(path: Path) -> str:
    """The language of a file, by its suffix.

    Returns:
        ``java`` or ``python``.

    Raises:
        UnreadableFile: another suffix.
    """
    language = LANGUAGES.get(path.suffix.lower())
    if language is None:
        ending = f"a {path.suffix} file" if path.suffix else "a file without a suffix"
        raise UnreadableFile(
            f"this is {ending}, and only robot code in Java or Python can be read",
            where=path.name,
            advice="Give the .java or .py file of your subsystem.",
        )
    return language


def read_source(path: Path) -> str:
    r"""Read a source file: UTF-8, with or without a byte order mark, line ends made ``\n``.

    Raises:
        UnreadableFile: it is no text, or none in UTF-8.
    """
    text = read_text(path)
    if path.read_bytes().startswith(UTF_16):
        raise UnreadableFile(
            "the text is UTF-16, not UTF-8",
            where=path.name,
            advice="In the editor choose Save with encoding: UTF-8.",
        )
    return text.replace("\r\n", "\n").replace("\r", "\n").removeprefix("\ufeff")
