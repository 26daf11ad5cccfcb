"""Facts in the names of motors and mechanisms: the side, the kind of motion, and the groups."""

import re

DRIVES = ("drive", "chassis", "swerve", "tank")
LINEAR = (*DRIVES, "elevator", "lift", "climb", "telescop", "slide")
SHOOTERS = ("shooter", "flywheel")  # top and bottom turn on their own; left and right are one shaft
ANGULAR = (
    *(*SHOOTERS, "roller", "intake", "outtake"),
    *("arm", "shoulder", "turret", "wrist", "pivot", "hood"),
)
SIDES = (("left", "right"), ("front", "back"), ("front", "rear"), ("top", "bottom"))


def split_words(name: str) -> list[str]:
    """``m_leftMotor`` -> ``["m", "left", "motor"]``."""
    return [word.lower() for word in re.findall(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])", name)]


def find_side(name: str, pair: tuple[str, str]) -> str:
    """``left`` or ``right`` (or another pair), if a name contains one of them; else empty."""
    found = [side for side in pair if side in split_words(name)]
    return found[0] if len(found) == 1 else ""


def find_other_side(name: str, motor: str) -> str:
    """The side in a name, if the motor's own name contains the opposite side; else empty."""
    for pair in SIDES:
        named, asked = find_side(name, pair), find_side(motor, pair)
        if named and asked and named != asked:
            return named
    return ""


def turn_independently(name: str, pair: tuple[str, str]) -> bool:
    """Whether the motors of a class of this name turn on their own, and not one shaft together."""
    own = (*DRIVES, *SHOOTERS) if pair == ("top", "bottom") else DRIVES
    return _begins_any(name, own) or not _begins_any(name, (*LINEAR, *ANGULAR))


def find_motion_family(name: str) -> str:
    """The motion of a mechanism of this name, ``linear`` or ``angular``; empty if unknown."""
    linear, angular = _begins_any(name, LINEAR), _begins_any(name, ANGULAR)
    return "" if linear == angular else "linear" if linear else "angular"


def _begins_any(name: str, beginnings: tuple[str, ...]) -> bool:
    return any(word.startswith(beginnings) for word in split_words(name))
