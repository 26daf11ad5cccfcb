"""The secret from which the data of a class or a dataset are drawn, and with which they are sealed.

    seed of a dataset's log = HMAC-SHA256(secret, [dataset, student, which log])

A secret prevents others from making the same data. A seed in a dataset's spec does not: with the
spec, anyone can compute the ground truth and seal another key.
"""

import hashlib
import hmac
import json
import os
import re
import secrets
from dataclasses import dataclass
from pathlib import Path

from sim.core.errors import BadRequest
from sim.support.os_errors import refuse_os_errors

VARIABLE = "SYSID_SECRET"  # environment variable with the secret itself
MIN_LENGTH = 16  # [characters] a shorter secret could be guessed
TABLE = re.compile(rb"[\r\n,;\t]")  # a roster or a log has one of these, a secret does not
SIZE = 32  # [bytes] of a new secret


@dataclass(frozen=True)
class Secret:
    """The secret from which seeds are derived and with which keys are sealed.

    Args:
        value: the secret itself.
        hidden: whether it is secret; False for a seed in the spec.
        new: file in which a new secret is to be saved; None if it is not new.
    """

    value: bytes
    hidden: bool
    new: Path | None = None

    def __repr__(self) -> str:
        """Without the value, because it may appear in a message."""
        return f"Secret(hidden={self.hidden}, new={self.new})"

    def derive_seed(self, *which: str | int) -> int:
        """The seed for the names and numbers ``which``."""
        return int.from_bytes(self._compute_hmac("seed", json.dumps(which).encode()), "big")

    def seal(self, content: bytes) -> str:
        """The seal (HMAC) of a content, which can only be computed with the secret."""
        return self._compute_hmac("seal", content).hex()

    def _compute_hmac(self, purpose: str, content: bytes) -> bytes:
        """The HMAC of a content, with a key of its own for each purpose."""
        key = hmac.digest(self.value, f"sysid dataset {purpose}".encode(), hashlib.sha256)
        return hmac.digest(key, content, hashlib.sha256)

    def save(self) -> None:
        """Write a new secret to its file, for its owner only.

        Raises:
            BadRequest: the file cannot be written.
        """
        if self.new is None:
            return
        advice = f"Name a file in a folder you may write to, or set {VARIABLE}."
        with refuse_os_errors("the new secret cannot be written", self.new, advice=advice):
            file = os.open(self.new, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
            with os.fdopen(file, "wb") as stream:
                stream.write(self.value + b"\n")


def find_secret(path: Path | None, *, make: bool) -> Secret | None:
    """The secret of a class or a dataset, from its file or the environment.

    Args:
        path: path of its file; None if only the environment may hold it.
        make: whether to make a new secret if there is none; it is not written here.

    Returns:
        The secret; None if neither a file is named nor the environment holds one.

    Raises:
        BadRequest: the file is missing or cannot be read, the secret is too short, or file and
            environment differ.
    """
    around = os.environ.get(VARIABLE, "").strip().encode()
    kept = read_secret(path) if path else b""
    if around and kept and around != kept:
        raise BadRequest(
            f"this file and the environment variable {VARIABLE} hold different secrets",
            where=str(path),
            advice=f"Unset {VARIABLE}, or remove the file.",
        )
    value = kept or around
    if value:
        if len(value) < MIN_LENGTH:
            raise BadRequest(
                f"the secret has fewer than {MIN_LENGTH} characters",
                where=str(path) if kept else VARIABLE,
                advice="Use a longer one: a short secret can be guessed.",
            )
        return Secret(value, hidden=True)
    if path is None:
        return None
    if not make:
        raise BadRequest(
            "the file with the secret is missing",
            where=str(path),
            advice=f"Name, or put back, the file that the data were made with, or set {VARIABLE}.",
        )
    return Secret(secrets.token_hex(SIZE).encode(), hidden=True, new=path)


def read_secret(path: Path) -> bytes:
    """The secret in a file; empty if there is no such file.

    Raises:
        BadRequest: the file cannot be read, is empty, or looks like a table or another text.
    """
    advice = f"Allow reading it, or set {VARIABLE}."
    with refuse_os_errors("the secret cannot be read", path, advice=advice):
        try:
            kept = path.read_bytes().strip()
        except FileNotFoundError:
            return b""
    if not kept:
        raise BadRequest(
            "this file should hold a secret, but it is empty",
            where=str(path),
            advice="Remove it, to get a new one.",
        )
    if TABLE.search(kept):
        raise BadRequest(
            "this file holds no secret: a secret is one line without commas",
            where=str(path),
            advice="Name the file with the secret. To get a new secret, name a file that does not "
            "exist.",
        )
    return kept
