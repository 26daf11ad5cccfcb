"""What INSTRUCTORS.md says can be typed, and what it lists is what there is."""

import re
import shlex

import click
import pytest

from grader.checks.misconception import MISCONCEPTIONS
from grader.cli import grade
from grader.course.progress import find_course
from grader.exercise.exercise import list_exercises
from sim.cli import sysid

COMMANDS = {"grade": grade, "sysid": sysid}


@pytest.fixture(scope="module")
def text(root):
    return (root / "INSTRUCTORS.md").read_text(encoding="utf-8")


def typed(text):
    """Every command of ours with an argument, from blocks and from running text."""
    block = re.compile(r"```shell\n.*?```", re.DOTALL)
    lines = re.findall(r"^(?:grade|sysid) .+", "\n".join(block.findall(text)), re.MULTILINE)
    plain = re.sub(r"\s*\n\s*", " ", block.sub("", text))
    spans = re.findall(r"`((?:grade|sysid) [^`]+)`", plain)
    return [*lines, *spans]


def test_every_command_parses(text):
    found = typed(text)
    for line in found:
        name, *words = shlex.split(line.replace("…", "X"))
        context = click.Context(COMMANDS[name], info_name=name)
        if name == "grade" and words[0] not in grade.list_commands(context):
            words = ["exercise", *words]
        command = COMMANDS[name].get_command(context, words[0])
        assert command, line
        if words[1:]:  # else it is only named
            command.make_context(words[0], words[1:], parent=context)

    assert len(found) >= 10
    assert {line.split()[1] for line in found} >= {
        "release",
        "class",
        "edition",
        "dataset",
    }


def test_check_of_commands_finds_a_wrong_option():
    context = click.Context(grade, info_name="grade")
    with pytest.raises(click.NoSuchOption):
        grade.get_command(context, "class").make_context("class", ["x", "--exports", "y"])


def test_guide_lists_the_misconceptions_that_the_examiner_names(text):
    rows = re.findall(r"^\| (M-[A-Z0-9-]+) \|[^|]*\| (\d+) \| (.*) \|$", text, re.MULTILINE)

    assert rows == [
        (code, str(int(one.lesson[:2])), one.says) for code, one in MISCONCEPTIONS.items()
    ]


def test_every_exercise_has_a_place_in_the_plans(text, root):
    told = text.partition("Each exercise belongs to a lesson:")[2].partition("\n\n")[0]
    named = {int(number) for number in re.findall(r"\d+", told)}

    assert "practice" in told
    for one in list_exercises(find_course(root)):
        told = f"INSTRUCTORS.md does not say to which lesson {one.name} belongs"
        assert one.name == "practice" or int(one.name.removeprefix("exercise")) in named, told
