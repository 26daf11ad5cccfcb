"""Robot code in, facts out: refusals, syntax errors, and code that leads nowhere."""

from pathlib import Path

import pytest

from grader.robotcode import read
from grader.robotcode.facts import Certainty
from sim.core.errors import UnreadableFile

CORPUS = Path(__file__).with_name("robotcode")

REFUSED = {
    "missing": ("Gone.java", None, "there is no such file", "Check the path"),
    "empty": ("Arm.java", b"", "the file is empty", "Save your code"),
    "only spaces": ("arm.py", b" \n\t\n", "the file is empty", "Save your code"),
    "binary": ("Arm.java", b"\xca\xfe\xba\xbe\0\0\0\x41", "binary file", "source itself"),
    "latin-1": ("arm.py", "# caf\u00e9\n".encode("latin-1"), "0xe9 is not UTF-8", "encoding UTF-8"),
    "utf-16": ("Arm.java", "class A {}".encode("utf-16"), "UTF-16", "Save with encoding"),
    "too large": ("Arm.java", b"// long\n" * 1_300_000, "larger than 1 MB", "one source file"),
    "kotlin": ("Arm.kt", b"class Arm", "a .kt file", ".java or .py"),
    "c++": ("Arm.cpp", b"class Arm;", "a .cpp file", ".java or .py"),
    "text": ("arm.txt", b"arm", "a .txt file", ".java or .py"),
    "no suffix": ("Makefile", b"all:", "a file without a suffix", ".java or .py"),
    "bottomless": (
        "Arm.java",
        b"class A { int x = " + b"(" * 9999,
        "nested deeper",
        "subsystem",
    ),
    "endless": (
        "Arm.java",
        b"class A { int x = " + b"/a=" * 999,
        "more than 2000 words",
        "subsystem",
    ),
    "generics": ("Arm.java", b"class A { " + b"a<" * 9999, "nested deeper", "subsystem"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_is_no_robot_code_is_refused_with_advice(case: str, tmp_path: Path) -> None:
    name, content, what, advice = REFUSED[case]
    if content is not None:
        (tmp_path / name).write_bytes(content)

    with pytest.raises(UnreadableFile) as refusal:
        read(tmp_path / name)

    assert what in refusal.value.what
    assert advice in refusal.value.advice
    assert name in refusal.value.where
    assert "\n" not in str(refusal.value)


def test_a_folder_is_refused(tmp_path: Path) -> None:
    (tmp_path / "Arm.java").mkdir()

    with pytest.raises(UnreadableFile, match="not a file"):
        read(tmp_path / "Arm.java")


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"], ids=["unix", "windows", "old mac"])
@pytest.mark.parametrize("mark", ["", "\ufeff"], ids=["plain", "byte order mark"])
@pytest.mark.parametrize("name", ["DriveSubsystem.java", "pwm_drive.py"])
def test_line_ends_and_a_byte_order_mark_change_nothing(
    name: str, mark: str, end: str, tmp_path: Path
) -> None:
    text = (CORPUS / name).read_text(encoding="utf-8")
    (tmp_path / name).write_bytes((mark + text.replace("\n", end)).encode())

    assert read(tmp_path / name) == read(CORPUS / name)


BROKEN = {
    "a bracket too many": ("A.java", "class A { int x = (1)); }", 1, "')' closes nothing"),
    "crossed": ("A.java", "class A {\n int x = f(a[1);\n}", 2, "a ']' is missing before this ')'"),
    "never closed": ("A.java", "class A {\n void f() {\n }\n", 1, "the '{' here is never closed"),
    "no semicolon": ("A.java", "class A {\n int x = 1\n int y = 2;\n}", 2, "a ';' is missing"),
    "brackets in text": ("A.java", 'class A {\n String s = "((("\n}', 2, "a ';' is missing"),
    "not Java": ("A.java", "def f():\n    pass\n", 1, "this is Python, and a .java file must"),
    "no semicolon before a call": (
        "A.java",
        "class A {\n  void f() {\n    g(1)\n\n    // h\n    h.g(2);\n  }\n}\n",
        3,
        "a ';' is missing at the end of this line",
    ),
    "no comma": (
        "A.java",
        "class A {\n  B b =\n    f(\n      g(1)\n      g(2));\n}\n",
        4,
        "not Java",
    ),
    "no semicolon before a comment": (
        "A.java",
        "class A {\n  int x = 1\n\n  /** Says y. */\n  int y() { return 2; }\n}\n",
        2,
        "a ';' is missing",
    ),
    "garbage": ("A.java", "class A { int x = " + "-*" * 900, 1, "the '{' here is never closed"),
    "more garbage": ("A.java", "!;" * 20_000, 1, "most of this is not Java"),
    "Java as Python": ("a.py", "public class A {\n}\n", 1, "this is Java, and a .py file must"),
    "no colon": ("a.py", "class A\n    pass\n", 1, "this is not Python: expected ':'"),
    "bottomless": ("a.py", "x = " + "-" * 50_000 + "1", 1, "nested deeper than Python itself"),
}


@pytest.mark.parametrize("case", BROKEN)
def test_a_syntax_error_is_named_with_its_line(case: str, tmp_path: Path) -> None:
    name, text, line, said = BROKEN[case]
    (tmp_path / name).write_text(text, encoding="utf-8")

    problem = read(tmp_path / name).problems[0]

    assert problem.line == line
    assert said in problem.message


ENDLESS = {
    "itself": "void drive(double v) { drive(v); m.setVoltage(v); }",
    "each other": "void drive(double v) { m.setVoltage(v); f(v); } void f(double v) { drive(v); }",
    "made by itself": "Object x = x.y(); void drive(double v) { x.go(); m.setVoltage(v); }",
    "a constant by itself": "double k = k; void drive(double v) { m.setVoltage(v * k); }",
}


@pytest.mark.parametrize("case", ENDLESS)
def test_code_that_leads_back_to_itself_is_followed_once(case: str, tmp_path: Path) -> None:
    (tmp_path / "A.java").write_text(
        "class A extends A { TalonFX m = new TalonFX(1); SysIdRoutine r = new SysIdRoutine("
        "new SysIdRoutine.Config(), new SysIdRoutine.Mechanism(v -> drive(v), null, this)); "
        f"{ENDLESS[case]} }}",
        encoding="utf-8",
    )

    assert [call.motor for call in read(tmp_path / "A.java").drive] == ["m"]


@pytest.mark.parametrize(
    "phrase",
    ["x" + "-" * 1500, "a[" * 90 + "0" + "] += 1" * 90, "f(" * 90 + "x" + ").y += 1" * 90],
    ids=["less and less", "elements", "members"],
)
def test_what_changes_what_it_changes_is_read_once(phrase: str, tmp_path: Path) -> None:
    text = f"class A {{ void f() {{ {phrase}; }} double k = 1; }}"
    (tmp_path / "A.java").write_text(text, encoding="utf-8")

    assert read(tmp_path / "A.java").routine_line == 0


def test_an_import_whose_name_no_file_can_have_is_not_found(tmp_path: Path) -> None:
    name = "comman" + "9" * 400
    (tmp_path / "arm.py").write_text(
        f"from {name} import SysIdRoutine\n\nclass Arm:\n    routine = SysIdRoutine()\n",
        encoding="utf-8",
    )

    assert read(tmp_path / "arm.py").problems == ()


def test_what_is_too_deep_to_follow_is_said(tmp_path: Path) -> None:
    methods = " ".join(f"void f{n}(double v) {{ f{n + 1}(v); }}" for n in range(9))
    (tmp_path / "A.java").write_text(
        "class A { SysIdRoutine r = new SysIdRoutine(new SysIdRoutine.Config(),\n"
        f"new SysIdRoutine.Mechanism(v -> f0(v), null, this));\n{methods} }}",
        encoding="utf-8",
    )

    facts = read(tmp_path / "A.java")

    assert facts.drive == ()
    assert [problem.message for problem in facts.unread] == [
        "the code is nested too deeply here for the grader"
    ]


def test_what_is_made_elsewhere_is_unknown_and_said_to_be(tmp_path: Path) -> None:
    (tmp_path / "A.java").write_text(
        "class A { SysIdRoutine r =\n new SysIdRoutine(Team.config(), Team.mechanism(this)); }",
        encoding="utf-8",
    )

    facts = read(tmp_path / "A.java")

    assert (facts.config_argument, facts.mechanism_argument) == (0, 1)
    assert (facts.ramp.known, facts.ramp.text) == (Certainty.UNKNOWN, "Team.config()")
    assert facts.unread[0].line == 2
    assert "`Team.mechanism(this)` is made in code" in facts.unread[0].message


def test_a_misspelled_keyword_does_not_pass_for_a_default(tmp_path: Path) -> None:
    (tmp_path / "a.py").write_text(
        "r = SysIdRoutine(SysIdRoutine.Config(rampRate=0.5, stepvoltage=3.5), m)", encoding="utf-8"
    )

    facts = read(tmp_path / "a.py")

    assert (facts.ramp.value, facts.step.known) == (0.5, Certainty.UNKNOWN)
