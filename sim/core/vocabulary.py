"""Fixed names: tests, mechanism types, fitting methods."""

KINDS = ("quasistatic", "dynamic", "coast", "triangle", "multistep", "chirp")
DIRECTIONS = ("forward", "reverse")
TESTS = tuple(f"{kind}-{direction}" for kind in KINDS for direction in DIRECTIONS)
FOUR_TESTS = tuple(f"{kind}-{way}" for kind in KINDS[:2] for way in DIRECTIONS)
TYPES = ("simple", "elevator", "arm")
METHODS = ("output-error", "sysid")


def find_test_sign(test: str) -> int:
    """The sign of the voltage and motion that a test's name states: 1 forward, -1 reverse."""
    return 1 if test.endswith("forward") else -1
