"""Fixed names: tests, mechanism types, fitting methods."""

KINDS = ("quasistatic", "dynamic", "coast", "triangle", "multistep", "chirp")
DIRECTIONS = ("forward", "reverse")
TESTS = tuple(f"{kind}-{direction}" for kind in KINDS for direction in DIRECTIONS)
FOUR_TESTS = tuple(f"{kind}-{way}" for kind in KINDS[:2] for way in DIRECTIONS)
TYPES = ("simple", "elevator", "arm")
METHODS = ("output-error", "sysid")
