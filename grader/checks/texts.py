"""Texts that stand in a TOML file beside the code, as misconceptions and slips do."""

import tomllib
from pathlib import Path
from typing import Any


def read_texts(path: Path) -> Any:  # noqa: ANN401 - tables, lists and texts, as the file has them
    """The content of a TOML file; every line end and run of spaces in its texts is one space."""
    return _join_lines(tomllib.loads(path.read_text(encoding="utf-8")))


def _join_lines(found: Any) -> Any:  # noqa: ANN401 - the same
    if isinstance(found, dict):
        return {name: _join_lines(one) for name, one in found.items()}
    if isinstance(found, list):
        return [_join_lines(one) for one in found]
    return " ".join(found.split()) if isinstance(found, str) else found
