"""What a person reads, word for word, in ``tests/snapshots``: one file a command or a test file.

Where a sentence was improved, SYSID_SNAPSHOTS=write pytest tests/test_NAME.py writes its parts
anew, and their difference is read as any other.
"""

import os
import re
from pathlib import Path

FOLDER = Path(__file__).parent / "snapshots"
WRITES = os.environ.get("SYSID_SNAPSHOTS") == "write"
AGAIN = "if the new text is right, write it: SYSID_SNAPSHOTS=write pytest tests/test_NAME.py"
HEAD = re.compile(r"^## (.*)\n\n", re.MULTILINE)


def read_parts(name):
    """Title -> text, of one file of snapshots."""
    path = FOLDER / f"{name}.txt"
    _, *found = HEAD.split(path.read_text(encoding="utf-8") if path.exists() else "")
    return {title: text.strip() for title, text in zip(found[::2], found[1::2], strict=True)}


def write_parts(name, parts):
    """Write one file of snapshots."""
    text = "\n\n".join(f"## {title}\n\n{said}".rstrip() for title, said in parts.items()) + "\n"
    (FOLDER / f"{name}.txt").write_text(text, encoding="utf-8", newline="\n")


def compare(name, parts):
    """These parts, and no others, are those of the file."""
    parts = {title: _trim(text) for title, text in parts.items()}
    if WRITES:
        write_parts(name, parts)

    assert parts == read_parts(name), AGAIN


def compare_part(name, title, text):
    """One part of the file is this text."""
    text = _trim(text)
    if WRITES:
        write_parts(name, dict(sorted((read_parts(name) | {title: text}).items())))

    assert text == read_parts(name).get(title), AGAIN


def _trim(text):
    return "\n".join(line.rstrip() for line in text.strip().splitlines())
