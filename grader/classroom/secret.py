"""The secret of a class: its numbers are drawn from it, and its data are sealed with it."""

import hashlib
import hmac
import os
import secrets
from pathlib import Path

from sim.bench.dataset.secret import FEWEST, SIZE, VARIABLE, Secret, read_secret
from sim.core.errors import BadRequest


def find_secret(path: Path | None, *, make: bool) -> Secret | None:
    """The secret of a class.

    Args:
        path: of its file; None takes the environment's.
        make: whether to make a new one where the file is not there yet; it is not written here.

    Returns:
        The secret; None where neither says one: everybody's numbers are then those of self-study.

    Raises:
        BadRequest: the file is not there, cannot be read, or holds too short a secret.
    """
    value = read_secret(path) if path else os.environ.get(VARIABLE, "").strip().encode()
    if value and len(value) < FEWEST:
        raise BadRequest(
            f"the secret has fewer than {FEWEST} characters",
            where=str(path or VARIABLE),
            advice="Use a longer one: a short secret can be guessed.",
        )
    if value:
        return Secret(value, hidden=True)
    if path is None:
        return None
    if not make:
        raise BadRequest(
            "there is no such file with a secret",
            where=str(path),
            advice="Name the file that grade release made.",
        )
    return Secret(secrets.token_hex(SIZE).encode(), hidden=True, new=path)


def identify_secret(secret: bytes) -> str:
    """Eight characters that tell one secret from another and give nothing of it away."""
    return hmac.digest(secret, b"identity of this secret", hashlib.sha256).hex()[:8]


def describe_numbers(secret: bytes | None) -> str:
    """Whose numbers a class is graded on, in one sentence."""
    if secret is None:
        return "Graded without a secret, on the numbers of self-study."
    return f"Graded with the secret {identify_secret(secret)}, on each student's numbers from it."


def seal_file(secret: bytes, *, student: str, content: bytes) -> str:
    """The seal (HMAC) of one student's file, which only the holder of the secret can compute."""
    message = student.casefold().encode() + b"\0" + hashlib.sha256(content).digest()
    return hmac.digest(secret, b"seal\0" + message, hashlib.sha256).hex()


def seal_identity(secret: bytes, *, student: str, name: str) -> str:
    """The seal (HMAC) of the student that a package was issued to.

    Args:
        secret: of the class.
        student: to whom.
        name: of the class.
    """
    return seal_file(secret, student=student, content=b"identity\0" + name.encode())
