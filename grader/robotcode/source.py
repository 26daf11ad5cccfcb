"""Read a source file, or refuse it with the reason."""

from pathlib import Path

from sim.core.errors import UnreadableFile

LARGEST = 1_000_000  # [bytes] a whole robot program is smaller; one class is a fiftieth of it
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
        UnreadableFile: missing, not a file, empty, too large, or not UTF-8 text.
    """
    content = _content(path)
    if content.startswith(UTF_16):
        raise UnreadableFile(
            "the text is UTF-16, not UTF-8",
            where=path.name,
            advice="In the editor choose Save with encoding: UTF-8.",
        )
    if b"\0" in content:
        raise UnreadableFile(
            "this is a binary file, not source text",
            where=path.name,
            advice="Give the .java or .py source itself, not something built from it.",
        )
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        raise UnreadableFile(
            f"byte 0x{content[error.start]:02x} is not UTF-8 text",
            where=f"{path.name}, line {line}",
            advice="Retype that character, or save the file with encoding UTF-8.",
        ) from None
    if not text.strip():
        raise UnreadableFile(
            "the file is empty", where=path.name, advice="Save your code in it, then try again."
        )
    return text.replace("\r\n", "\n").replace("\r", "\n")


def _content(path: Path) -> bytes:
    """The bytes of a regular file, at most LARGEST of them."""
    if not path.exists():
        raise UnreadableFile(
            "there is no such file", where=str(path), advice="Check the path and its spelling."
        )
    if not path.is_file():
        raise UnreadableFile(
            "this is not a file", where=str(path), advice="Give the .java or .py file itself."
        )
    try:
        with path.open("rb") as file:
            content = file.read(LARGEST + 1)
    except OSError as error:
        raise UnreadableFile(
            f"the file cannot be opened ({error.strerror})",
            where=str(path),
            advice="Close other programs that hold it, and check that you may read it.",
        ) from None
    if len(content) > LARGEST:
        raise UnreadableFile(
            f"the file is larger than {LARGEST // 1_000_000} MB, which no robot class is",
            where=path.name,
            advice="Give the one source file that holds the SysIdRoutine.",
        )
    return content
