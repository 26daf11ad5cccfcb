"""The secret of a class: it identifies students' numbers and seals their packages."""

import hashlib
import hmac


def identify_secret(secret: bytes) -> str:
    """Eight characters that tell one secret from another and give nothing of it away."""
    return hmac.digest(secret, b"identity of this secret", hashlib.sha256).hex()[:8]


def describe_numbers(secret: bytes | None) -> str:
    """One sentence about the numbers on which a class is graded."""
    if secret is None:
        return "Graded without a secret, on the numbers of self-study."
    return f"Graded with the secret {identify_secret(secret)}, on each student's numbers from it."


def seal_identity(secret: bytes, *, student: str, name: str) -> str:
    """The seal (HMAC) of the student that a package was issued to.

    Only the holder of the secret can compute it.

    Args:
        secret: of the class.
        student: to whom.
        name: of the class.
    """
    of_class = hashlib.sha256(b"identity\0" + name.encode()).digest()
    message = b"seal\0" + student.casefold().encode() + b"\0" + of_class
    return hmac.digest(secret, message, hashlib.sha256).hex()
