"""The answer key of a dataset: one entry a log, sealed against unnoticed changes.

The key is also written while logs are being made, so that an interrupted run can be continued. An
entry of a log that is not finished names its files without their digests.
"""

import hmac
import json
import os
from collections.abc import Iterable, Mapping
from importlib.metadata import version
from pathlib import Path
from typing import Any

from sim.core.errors import BadRequest
from sim.support.atomic_file import write_atomically
from sim.support.os_errors import refuse_os_errors
from sim.support.secret import Secret

ENDING = ".key.json"

Entry = Mapping[str, Any]

encode = json.JSONEncoder(  # canonical JSON, which is sealed
    sort_keys=True, separators=(",", ":"), ensure_ascii=False, allow_nan=False
).encode


def choose_key_path(folder: Path) -> Path:
    """The default path of a dataset's key: beside its folder, not in it."""
    folder = Path(os.path.abspath(folder))  # noqa: PTH100 - without following links
    return folder.with_name(f"{folder.name or 'dataset'}{ENDING}")


def read_key(path: Path, *, secret: Secret) -> tuple[Entry, ...]:
    """The entries of a key, after its seal was verified; none if there is no key.

    Raises:
        BadRequest: it cannot be read, or its seal is not of this secret and content.
    """
    advice = "Allow reading it, or name another with --key."
    try:
        with refuse_os_errors("the key cannot be read", path, advice=advice):
            if not path.exists():
                return ()
            head = json.loads(path.read_bytes())
        seal, entries = head.pop("seal"), head.pop("logs")
        whole = hmac.compare_digest(seal, _compute_seal(head, map(encode, entries), secret))
    except (ValueError, AttributeError, KeyError, TypeError):
        whole = False
    if not whole:
        raise BadRequest(
            "the seal does not fit this key. Somebody changed the key, or it was made with another "
            "secret or seed",
            where=str(path),
            advice="Put both back as they were, or name another folder with -o.",
        )
    return tuple(entries)


def write_key(path: Path, entries: Iterable[str], *, dataset: str, secret: Secret) -> None:
    """Write a key atomically, for its owner only.

    Args:
        path: path of the key.
        entries: the entry of each log, encoded.
        dataset: name of the dataset.
        secret: secret with which the key is sealed.

    Raises:
        BadRequest: it cannot be written.
    """
    head = {
        "dataset": dataset,
        "made_with": f"sysid-course {version('sysid-course')}",
        "sealed_with": "secret" if secret.hidden else "seed",
    }
    entries = list(entries)
    opening = json.dumps(head, ensure_ascii=False, indent=1).removesuffix("\n}")
    logs = ",\n  ".join(entries)
    seal = _compute_seal(head, entries, secret)
    text = f'{opening},\n "logs": [\n  {logs}\n ],\n "seal": "{seal}"\n}}\n'
    advice = (
        "Make room there, or name another place with --key; then run the same command again: what "
        "is finished is kept."
    )
    with refuse_os_errors("the key cannot be written", path, advice=advice):
        write_atomically(path, text, private=True)


def _compute_seal(head: Mapping[str, str], entries: Iterable[str], secret: Secret) -> str:
    """The seal of a key's content."""
    return secret.seal("\n".join((encode(head), *entries)).encode())
