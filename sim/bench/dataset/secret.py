"""The secret or seed from which a dataset is drawn and with which its key is sealed.

    seed = HMAC-SHA256(secret, [dataset, student, which log])

A secret prevents others from making the same data. A seed in the spec does not: with the spec,
anyone can compute the ground truth and seal another key.
"""

import hashlib
import hmac
import json
import os
import re
import secrets
from dataclasses import dataclass
from pathlib import Path

from sim.bench.dataset.spec import ENDING, Spec
from sim.core.errors import BadRequest
from sim.support.os_errors import refuse_os_errors

VARIABLE = "SYSID_SECRET"  # environment variable with the secret itself
FEWEST = 16  # [characters] a shorter secret could be guessed
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
        return int.from_bytes(self._code("seed", json.dumps(which).encode()), "big")

    def seal(self, content: bytes) -> str:
        """The seal (HMAC) of a content, which can only be computed with the secret."""
        return self._code("seal", content).hex()

    def _code(self, purpose: str, content: bytes) -> bytes:
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


def find_secret(spec: Spec, *, make: bool) -> Secret:
    """The secret of a spec, or its seed.

    Args:
        spec: the spec.
        make: whether to make a new secret if its file does not exist.

    Raises:
        BadRequest: there is none, it is too short, or file and environment differ.
    """
    if spec.seed is not None:
        return Secret(f"sysid dataset of seed {spec.seed}".encode(), hidden=False)
    set_ = os.environ.get(VARIABLE, "").strip().encode()
    kept = read_secret(spec.secret) if spec.secret else b""
    if set_ and kept and set_ != kept:
        raise BadRequest(
            f"this file and the environment variable {VARIABLE} hold different secrets",
            where=str(spec.secret),
            advice=f"Unset {VARIABLE}, or remove the file.",
        )
    value = kept or set_
    if value:
        if len(value) < FEWEST:
            raise BadRequest(
                f"the secret has fewer than {FEWEST} characters",
                where=str(spec.secret) if kept else VARIABLE,
                advice="Use a longer one: a short secret can be guessed.",
            )
        return Secret(value, hidden=True)
    if spec.secret is None:
        raise BadRequest(
            "it says neither secret nor seed",
            where=spec.where,
            advice=f'Add secret = "class{ENDING}" to the spec, and run this command again: it '
            "makes the file. Or add seed = 1, if everybody is allowed to make the same data again.",
        )
    if not make:
        raise BadRequest(
            "the file with the secret is missing",
            where=str(spec.secret),
            advice=f"Put back the file this dataset was made with, or set {VARIABLE}.",
        )
    return Secret(secrets.token_hex(SIZE).encode(), hidden=True, new=spec.secret)


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
            advice="Name the file with the secret, or, to get a new one, a file that is not there.",
        )
    return kept
