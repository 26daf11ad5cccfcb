"""Advice as data: what to do, which each surface words in its own way."""

from dataclasses import dataclass, replace

ANGLES = "radians, rotations or degrees"
NAMES = "--state ENTRY --voltage ENTRY --position ENTRY --velocity ENTRY"

# name -> the sentence on the command line, and on the page of `sysid open`
WORDS = {
    "angle": (
        f"Add --units {ANGLES}, or --type elevator.",
        f"Choose {ANGLES} above, or the type elevator.",
    ),
    "angle-units": (
        f"Add --units {ANGLES}, whichever is right.",
        f"Choose {ANGLES} above, whichever is right.",
    ),
    "gravity-type": (
        "Fit it with --type {} if gravity acts on it.",
        "Choose the type {} above if gravity acts on it.",
    ),
    "other-type": (
        "If gravity does not act on it like that, add --type.",
        "If gravity does not act on it like that, choose another type above.",
    ),
    "rubs-or-type": (
        "Look for a part that rubs, or choose another --type.",
        "Look for a part that rubs, or choose another type above.",
    ),
    "state-type": (
        "Say what it is with --type simple, elevator or arm.",
        "Choose its type above.",
    ),
    "same-type": (
        "Add --type, so that all are fitted as the same type.",
        "Choose a type above, so that all are fitted as the same type.",
    ),
    "units": (
        "If the log has other units, add --units.",
        "If the log has other units, choose them above.",
    ),
    "which-units": (
        "Say what they are with --units, one of: {}.",
        "Write its units into the file, one of: {}.",
    ),
    "own-units": (
        "--units does not convert. If the file is right, the gains are wrong: leave out --units.",
        "That does not convert. If the file is right, the gains are wrong: choose its units.",
    ),
    "velocity-scale": (
        "If the position is right, add --velocity-scale {} or --ignore-velocity.",
        "If the position is right, correct the log with `sysid fit --velocity-scale {}`.",
    ),
    "option": (
        "Choose one {}.",
        "This page cannot choose between them. Use `sysid fit` in a terminal, {}.",
    ),
    "entry-type": ("Name an entry of type {} with {}.", "Choose an entry of type {}."),
    "columns": (
        f"Name the columns {{}} in the first line, or say what they are called: {NAMES}.",
        "Choose which column holds which signal.",
    ),
    "arm-position": (
        "Log the position of the arm, or name its entry with --position.",
        "Log the position of the arm, or choose its entry.",
    ),
    "name-part": (
        "Write a test and two times in seconds, dynamic-forward:5.5-6, or a test alone.",
        "Mark the part again.",
    ),
    "no-such-part": (
        "Take test and times from the output of `sysid inspect`.",
        "Take it in again.",
    ),
    "drive-type": (
        "Fit the log of the drive motors with --type simple.",
        "Open the log of the drive motors, of the type simple.",
    ),
    "radius": (
        "Add --radius: the radius of the wheel or drum, in meters.",
        "Type the radius of the wheel or drum, in meters, above.",
    ),
    "look-for-cause": (
        "`sysid reconcile` looks for the cause.",
        "Search for what the model lacks, to find the cause.",
    ),
    "inspect-and-reconcile": (
        "Run `sysid inspect`, then `sysid reconcile` to find the missing effect.",
        "Look at the faults, then search for what the model lacks.",
    ),
    "chosen-entries": (
        f"If that is wrong, name them with {NAMES}.",
        "If that is wrong, choose other signals.",
    ),
    "name-entries": (
        f"Or name another logger's entries with {NAMES}.",
        "Or choose another logger's entries by hand.",
    ),
}


@dataclass(frozen=True)
class Action:
    """What the user can do about a warning or a refusal.

    Args:
        name: one of ``WORDS``.
        argument: what its sentence names; several, of which a surface may leave out the last ones.
        before: sentences of advice that stand before it, and need no option.
    """

    name: str
    argument: str | tuple[str, ...] = ""
    before: str = ""

    def __str__(self) -> str:
        """The advice on the command line."""
        return self._write_words(0)

    @property
    def on_page(self) -> str:
        """The advice on the page of ``sysid open``."""
        return self._write_words(1)

    def add_before(self, text: str) -> "Action":
        """The same action with another sentence before what it asks for."""
        return replace(self, before=f"{self.before} {text}".strip())

    def _write_words(self, surface: int) -> str:
        named = (self.argument,) if isinstance(self.argument, str) else self.argument
        return f"{self.before} {WORDS[self.name][surface].format(*named)}".strip()
