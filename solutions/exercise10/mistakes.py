"""Wrong answers to exercise 10, and what a learner must be told about each."""

import re
from collections.abc import Callable

from grader.exercise.mistake import Mistake, replace_text

JAVA, PYTHON = "ExampleMechanism.java", "example_mechanism.py"
CLASS = r"(SimpleMotor|Elevator|Arm)Feedforward"
CONVERTED = " * CONVERSION"


def changed(pattern: str, new: str | Callable[[re.Match[str]], str]) -> Callable[[str], str]:
    """Make a wrong text by changing whatever a pattern finds."""

    def edit_text(text: str) -> str:
        wrong = re.sub(pattern, new, text, flags=re.MULTILINE)
        if wrong == text:
            raise ValueError(f"the solution no longer contains {pattern!r}")
        return wrong

    return edit_text


def change_gain(gain: str, change: Callable[[str], str]) -> Callable[[str], str]:
    """Make a wrong text by writing another value beside a gain's name."""
    return changed(rf"(\b{gain} = )([^;#\n]*[^;#\s])", lambda one: one[1] + change(one[2]))


def use_other_class(text: str) -> str:
    """Take a class that is made for another mechanism."""
    made = "Elevator" if "new Arm" in text else "Arm"
    right = re.search(rf"new {CLASS}", text)
    if right is None:
        raise ValueError("the solution makes no feedforward")
    return re.sub(rf"(private final |new ){CLASS}", rf"\g<1>{made}Feedforward", text)


def sort_gains_by_name(text: str) -> str:
    """Hand the gains over by the alphabet."""
    return re.sub(
        r"(Feedforward\w*)\((.*)\)", lambda one: f"{one[1]}({_sort_arguments(one[2])})", text
    )


def _sort_arguments(arguments: str) -> str:
    return ", ".join(sorted(arguments.split(", ")))


def use_other_output(text: str) -> str:
    """Take volts for a duty cycle, or the other way round."""
    if "CONVERSION / 12" in text:
        return text.replace("CONVERSION / 12", "CONVERSION")
    return re.sub(r"(kP = \S+ \* CONVERSION)", r"\1 / 12", text)


def write_slot0(scale: str, *, sign: str = "UseVelocitySign") -> Callable[[str], str]:
    """Put the gains into Phoenix 6's Slot0Configs, kV and kA times a scale, in Java or Python.

    Args:
        scale: of the analyzer's number; TURN and GEARS are those of the solution's note.
        sign: of kS, as Java has it.
    """

    def edit_text(text: str) -> str:
        java = "new SimpleMotor" in text or "new Elevator" in text or "new Arm" in text
        arm = "ArmFeedforward(" in text
        note = re.search(r"times ([\d.]+) in place of CONVERSION. Gears ([\d.]+):1", text)
        if note is None:
            raise ValueError("the solution no longer says what Slot0Configs would take")
        times = scale.replace("TURN", note[1]).replace("GEARS", note[2])
        settings = [
            f"{_write_gain_setter(gain, java=java)}({HELD}{gain}{_scale_gain(gain, times)})"
            for gain in re.findall(rf"{re.escape(HELD)}(k\w)", text)
        ]
        gravity = "Arm_Cosine" if arm else "Elevator_Static"
        for name, value in (("GravityType", gravity), ("StaticFeedforwardSign", sign)):
            settings.append(
                f"with{name}({name}Value.{value})"
                if java
                else f"with_{_to_snake_case(name)}({name}Value.{_to_snake_case(value).upper()})"
            )
        made = f"{'new ' * java}Slot0Configs()." + ".".join(settings)
        return add_imports(
            _replace_feedforward(text, made), "ctre.phoenix6.configs", "ctre.phoenix6.signals"
        )

    return edit_text


def repeat_in_slot0(text: str) -> str:
    """Put the gains into Phoenix 6's Slot0Configs, and keep WPILib's feedforward."""
    inside = write_slot0("TURN")(text)
    chain = re.search(r"(?:new )?Slot0Configs\(\)\S*(?: \S+)*?(?=;|$)", inside, re.MULTILINE)
    if chain is None:
        raise ValueError("no Slot0Configs was made")
    java = "new Slot0Configs" in inside
    line = (
        f"  private final Slot0Configs m_gains = {chain[0]};\n"
        if java
        else f"self.gains = {chain[0]}"
    )
    text = add_imports(text, "ctre.phoenix6.configs", "ctre.phoenix6.signals")
    if java:
        return re.sub(
            r"^(?=  private final \w+Feedforward)", lambda _: line, text, flags=re.MULTILINE
        )
    before = r"^(?= +self\.feedforward = )"
    return re.sub(before, lambda _: f"        {line}\n", text, flags=re.MULTILINE)


def write_spark_config(order: dict[str, str]) -> Callable[[str], str]:
    """Put the gains into REVLib's FeedForwardConfig.

    Args:
        order: setting -> the gain that it gets.
    """

    def edit_text(text: str) -> str:
        chain = ".".join(f"{name}({HELD}{gain})" for name, gain in order.items())
        made = f"{'new ' * ('new ' in text)}FeedForwardConfig().{chain}"
        return add_imports(_replace_feedforward(text, made), "revrobotics.spark.config")

    return edit_text


def add_imports(text: str, *packages: str) -> str:
    """Add the imports of a vendor's packages, as Java names them without ``com``."""
    if "package " in text:
        lines = "".join(f"import com.{one}.*;\n" for one in packages)
        return re.sub(r"^(?=import )", lines, text, count=1, flags=re.MULTILINE)
    modules = [
        one.removeprefix("ctre.").replace("revrobotics.spark.config", "rev") for one in packages
    ]
    lines = "".join(f"from {one} import *\n" for one in modules)
    return re.sub(r"^(?=from )", lines, text, count=1, flags=re.MULTILINE)


HELD = "CharacterizationConstants."


def _write_gain_setter(gain: str, *, java: bool) -> str:
    return f"withK{gain[1]}" if java else f"with_k_{gain[1].lower()}"


def _scale_gain(gain: str, scale: str) -> str:
    return f" / {HELD}CONVERSION * {scale}" if gain in {"kV", "kA"} else ""


def _to_snake_case(name: str) -> str:
    return re.sub(r"(?<=[a-z])(?=[A-Z])", "_", name).lower()


def _replace_feedforward(text: str, made: str) -> str:
    """The text with something else in place of WPILib's feedforward."""
    found = re.search(rf"(new )?{CLASS}\w*\((?=Char)[^)]*\)", text)
    if found is None:
        raise ValueError("the solution makes no feedforward")
    return text[: found.start()] + made + text[found.end() :]


SWAPPED = replace_text((".kV, CharacterizationConstants.kA", ".kA, CharacterizationConstants.kV"))

MISTAKES = (
    Mistake("gains as the analyzer shows them", JAVA,
        change_gain("kV", lambda value: value.removesuffix(CONVERTED)), "conversion",
        "as the analyzer shows it", "M-UNITS"),
    Mistake("a unit in the comment that is not the number's", JAVA,
        change_gain("kA", lambda value: value.removesuffix(CONVERTED)), "units",
        "This is the right kind of unit", "M-UNITS"),
    Mistake("convert in the wrong direction? A larger", PYTHON,
        change_gain("kV", lambda value: value.replace("*", "/")), "kv",
        "convert in the wrong direction? A larger", "M-UNITS"),
    Mistake("the seconds' square on the unit of length", JAVA,
        change_gain("kA", lambda value: value + CONVERTED), "ka", "convert twice", "M-UNITS"),
    Mistake("converted in the constant and once more where it is used", PYTHON,
        changed(r"Constants\.kV", "Constants.kV * CharacterizationConstants.CONVERSION"),
        "conversion", "convert twice, in the constant", "M-UNITS"),
    Mistake("kS converted as well", PYTHON, change_gain("kS", lambda value: value + CONVERTED),
        "volts", "volts stay volts", "M-UNITS"),
    Mistake("kV as a share of the battery", JAVA, change_gain("kV",
        lambda value: value + " / 12"), "kv", "did you use a duty cycle? A", "M-DUTY"),
    Mistake("kV and kA exchanged", JAVA, SWAPPED, "order", "kA is where", "M-ARGORDER"),
    Mistake("kV and kA exchanged, Python", PYTHON, SWAPPED, "order", "expects kV", "M-ARGORDER"),
    Mistake("gains by the alphabet", JAVA, sort_gains_by_name, "order", "kA is where",
        "M-ARGORDER"),
    Mistake("kP as the time step", JAVA,
        changed(r"(Feedforward\(Char[^)]*)", rf"\1, {HELD}kP"), "order", "kP does not belong here",
        "M-ARGORDER"),
    Mistake("a time step in milliseconds", PYTHON,
        changed(r"(Feedforward\w*\(Char[^)]*)", r"\1, 20"), "order", "loop to loop in seconds",
        "M-ARGORDER"),
    Mistake("no kA", PYTHON, changed(r", CharacterizationConstants\.kA\)", ")"), "order",
        "A missing argument counts as 0"),
    Mistake("another mechanism's class", JAVA, use_other_class, "feedforward",
        "Which analysis type did the analyzer use?"),
    Mistake("no feedforward", PYTHON, changed(r"^.*self\.feedforward = .*\n", "        pass\n"),
        "feedforward", "no feedforward is made"),
    Mistake("Slot0Configs with gains per rotation of the rotor", JAVA, write_slot0("TURN / GEARS"),
        "conversion", "per rotation of the motor's rotor", "M-GEARING"),
    Mistake("Slot0Configs with gains per radian", PYTHON, write_slot0("TURN / (2 * 3.14159265)"),
        "conversion", "Slot0Configs counts rotations of the mechanism", "M-UNITS"),
    Mistake("kS by the sign of the error", JAVA, write_slot0("TURN", sign="UseClosedLoopSign"),
        "feedforward", "Then kS follows the sign of the error"),
    Mistake("gains in the code and in the motor controller", JAVA, repeat_in_slot0, "feedforward",
        "This is a double feedforward"),
    Mistake("gains in the code and in the motor controller, Python", PYTHON, repeat_in_slot0,
        "feedforward", "This is a double feedforward"),
    Mistake("kV and kA exchanged in a Spark", PYTHON,
        write_spark_config({"kS": "kS", "kV": "kA", "kA": "kV"}), "order",
        "kA is where FeedForwardConfig expects kV", "M-ARGORDER"),
    Mistake("kV in volts", JAVA, changed(r"(?<=// V)·s/.*$", ""), "units",
        "This unit does not belong to this kV", "M-UNITS"),
    Mistake("no units", JAVA, changed(r" // V.*$", ""), "units", "no unit of kS"),
    Mistake("no units, Python", PYTHON, changed(r"  # V·s/.*$", ""), "units", "no unit of kV"),
    Mistake("kP as it was suggested", JAVA, change_gain("kP", lambda value: value.split(" ")[0]),
        "kp", "as the analyzer shows it", "M-UNITS"),
    Mistake("kP for another output", PYTHON, use_other_output, "kp", "the output not", "M-DUTY"),
    Mistake("kP without 'start here, then tune'", JAVA,
        replace_text(("the analyzer's suggestion: start here, then tune", "proportional gain")),
        "kp", "The number is right. Write in a comment"),
    Mistake("a kP that only running the code can tell", PYTHON,
        change_gain("kP", lambda _: "max(77.0, 99.0)"), "kp", "not the suggested kP"),
    Mistake("a kP out of a function that is not there", PYTHON,
        change_gain("kP", lambda _: "load_gain()"), "named",
        "the program stops when the robot's program starts"),
    Mistake("no kA anywhere", PYTHON, changed(r"^    kA = .*\n", ""), "named", "no kA"),
    Mistake("half by dividing whole numbers", JAVA, change_gain("kS", lambda _: "1 / 4"), "volts",
        "did you divide whole numbers"),
    Mistake("a class of another name", PYTHON, replace_text(("CharacterizationConstants", "Gains")),
        "named", "is not in CharacterizationConstants"),
)  # fmt: skip
