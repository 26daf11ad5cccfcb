"""What a class's secret identifies and seals: whose numbers, whose file, whose package."""

import hashlib
import hmac


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
