"""README and guide show what the commands print and name what exists; the README stays short."""

import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

README = Path(__file__).parents[1] / "README.md"
GUIDE = Path(__file__).parents[1] / "sim" / "docs" / "guide.md"
SCREENS = 800  # [words] that the README has at most, what pictures say in words included
BLOCK = re.compile(r"```console\n\$ (?P<command>.*)\n(?P<shown>(?:.*\n)*?)```")
NUMBER = re.compile(r"−?\d+(?:\.\d+)?(?:e[+-]?\d+)?")
ENTRY = {"sysid": "sim.cli", "grade": "grader.cli"}


def printed(command, *, folder):
    """What a command of the tour prints, errors included."""
    name, *arguments = shlex.split(command)
    run = subprocess.run(
        [sys.executable, "-c", f"from {ENTRY[name]} import main; main()", *arguments],
        cwd=folder,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        encoding="utf-8",
        check=False,
        env={key: value for key, value in os.environ.items() if key != "COLUMNS"},
    )
    return "\n".join(line.rstrip() for line in run.stdout.rstrip().splitlines())


def words(text):
    """A text without its numbers, the length of its bars and where its lines break."""
    return re.sub(r"#+", "#", NUMBER.sub("0", " ".join(text.split())))


def numbers(text):
    return [float(one.replace("−", "-")) for one in NUMBER.findall(text)]


def last_digits(text):
    """What one more in its last digit is worth, of each number."""
    exponents = [one.partition("e") for one in NUMBER.findall(text)]
    return [10.0 ** (int(e or 0) - len(one.partition(".")[2])) for one, _, e in exponents]


def differences(now, shown):
    """Numbers that differ by more than 3 % and by more than one in the last digit shown."""
    return [
        (one, other)
        for one, other, last in zip(numbers(now), numbers(shown), last_digits(shown), strict=True)
        if abs(one - other) > max(0.03 * abs(other), 1.001 * last)
    ]


def test_the_tour_prints_what_the_guide_shows(root, tmp_path):
    for part in ("exercises", "lessons"):
        shutil.copytree(root / part, tmp_path / part, ignore=shutil.ignore_patterns("data"))
    blocks = list(BLOCK.finditer(GUIDE.read_text(encoding="utf-8")))
    assert len(blocks) >= 4

    for block in blocks:
        now, shown = printed(block["command"], folder=tmp_path), block["shown"].rstrip()
        other = f"guide.md shows something else for: {block['command']}"
        assert words(now) == words(shown), other
        # another processor rounds otherwise, and the last digit shown may be another
        assert differences(now, shown) == [], other


def test_the_set_up_is_two_commands_of_one_line():
    section = README.read_text(encoding="utf-8").partition("\n## Set up\n")[2].partition("\n## ")[0]

    commands = re.findall(r"```shell\n(.*?)\n```", section, flags=re.DOTALL)

    assert commands == ["python -m grader start", "python -m grader test"]


@pytest.mark.parametrize("folder", ["lessons", "exercises"])
def test_guide_lists_the_lessons_and_exercises_that_there_are(root, folder):
    row = next(
        line for line in GUIDE.read_text(encoding="utf-8").splitlines()
        if line.startswith(f"| {folder} |")
    )  # fmt: skip
    there = {int(re.search(r"\d+", path.name)[0]) for path in (root / folder).glob("*[0-9]*")}

    listed = {int(number) for number in re.findall(r"(?:\| |· )(\d+) ", row)}
    assert listed == there, f"{GUIDE.name} lists other {folder} than there are"


def test_readme_is_short_and_its_pictures_have_alt_text():
    text = README.read_text(encoding="utf-8")
    pictures = re.findall(r'<img width="760" alt="([^"]+)" src="([^"]+)">', text)
    pictures += re.findall(r"^!\[(.+)\]\((.+)\)$", text, re.MULTILINE)

    assert len(pictures) == 3
    for words_of_it, file in pictures:
        assert len(words_of_it) > 100
        assert (README.parent / file).is_file()
    assert len(text.split()) <= SCREENS


def test_commands_of_the_readme_work(tmp_path):
    minute = README.read_text(encoding="utf-8").partition("\n## One minute\n")[2]
    simulated, fitted, opened = minute.partition("```shell\n")[2].partition("\n```")[0].splitlines()

    assert "Next: sysid fit arm.wpilog" in printed(simulated, folder=tmp_path)
    assert re.search(r"kV +1\.46", printed(fitted, folder=tmp_path))
    assert opened == "sysid open arm.wpilog"
