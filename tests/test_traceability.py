"""Every item of the source lesson is taught somewhere, practiced somewhere and checked somewhere.

What is where stands in ``traceability.toml``; here it is held, by name, so that nothing is renamed
or dropped unnoticed.
"""

import re
import sys
import tomllib
from functools import cache

import pytest
from places import ROOT

from grader.checks.misconception import MISCONCEPTIONS
from grader.exercise.course_check import list_mistakes
from grader.exercise.exercise import list_exercises
from sim.inspect.faults import FAULTS
from sim.physics.effects import EFFECTS

TABLE = tomllib.loads((ROOT / "tests" / "traceability.toml").read_text(encoding="utf-8"))
EXERCISES = {one.name: one for one in list_exercises(ROOT)}
LESSONS = {path.stem[:2]: path for path in sorted((ROOT / "lessons").glob("*.py"))}
HEADING = re.compile(r"^(?P<level>#{2,3}) (?:(?P<number>\d+) )?(?P<title>.+)$", re.MULTILINE)

PINNED = re.compile(
    r"https://github\.com/[\w.-]+/[\w.-]+/blob/(?:v\d[\w.]*|[0-9a-f]{40})/\S+"
    r"|https://pypi\.org/project/[\w-]+/\d[\w.]*/"
    r"|[A-Z][\w, ]+, \*[^*]+\*.* ?\(\d{4}\), (?:section|chapter) [\d.]+"  # a book
)

ITEMS = [*TABLE["item"], *TABLE["added"]]
each_item = pytest.mark.parametrize("item", ITEMS, ids=lambda item: item["says"])
each_claim = pytest.mark.parametrize("claim", TABLE["claim"], ids=lambda claim: claim["row"])
each_fact = pytest.mark.parametrize("fact", TABLE["fact"], ids=lambda fact: fact["says"])
each_lesson = pytest.mark.parametrize("lesson", LESSONS)


def unquoted(text):
    """Text without the marks of a quote, and every run of spaces and line ends as one space."""
    return " ".join(re.sub(r"^> ?", "", text, flags=re.MULTILINE).split())


@cache
def prose(lesson):
    """What a lesson says, without the marks of its cells."""
    text = LESSONS[lesson].read_text(encoding="utf-8")
    _, *cells = re.split(r"^# %% \[markdown\]\n", text, flags=re.MULTILINE)
    words = "".join(cell.partition("\n# %%")[0] + "\n" for cell in cells)
    return re.sub(r"^# ?", "", words, flags=re.MULTILINE)


@cache
def sections(lesson):
    """Heading -> its number, and everything up to the next heading of its level or above."""
    text = prose(lesson)
    found = list(HEADING.finditer(text))
    sizes = [len(one["level"]) for one in found]
    there = {}
    for at, one in enumerate(found):
        after = (n for n in range(at + 1, len(found)) if sizes[n] <= sizes[at])
        until = next((found[n].start() for n in after), len(text))
        there[one["title"]] = (one["number"], unquoted(text[one.end() : until]))
    return there


@cache
def boxes(lesson):
    """Of every box: what the source lesson says, and what stands against it."""
    quotes = [unquoted(one) for one in re.findall(r"(?:^>.*\n)+", prose(lesson), re.MULTILINE)]
    return [one.partition("**Source says:**")[::2] for one in quotes if "**Lesson says:**" in one]


def one_line(path):
    """A file's text without Python's string breaks, and every run of spaces as one space."""
    text = (ROOT / path).read_text(encoding="utf-8")
    return " ".join(re.sub(r'"\n\s*f?"', "", text).split())


def assert_taught(lesson, heading, words):
    assert heading in sections(lesson), f"lesson {lesson} has no section {heading!r}"
    assert words in sections(lesson)[heading][1], f"lesson {lesson}, {heading!r}: {words!r} is gone"


def plants():
    """What exercise 7 can put into a log, undamaged ones included."""
    drawn = sys.modules[f"{EXERCISES['exercise7'].module.__name__}.drawn"]
    return {"clean" if min(drawn.SOUND) >= 2 else "", *drawn.LESSON, *drawn.ALWAYS, *drawn.OTHERS}


def hides():
    """What exercise 12 can hide."""
    drawn = sys.modules[f"{EXERCISES['exercise12'].module.__name__}.drawn"]
    return {name for _, effects in drawn.HIDDEN for name, _ in effects}


@each_item
def test_an_item_is_taught_where_the_table_says(item):
    assert item["taught"]
    for place in item["taught"]:
        assert_taught(*place)


@each_item
def test_the_checks_of_an_item_reject_its_wrong_answers(item):
    checks = {tuple(one.split(".")) for one in item["checks"]}
    for name, check in checks:
        assert check in [one.id for one in EXERCISES[name].checks], f"{name} has no check {check}"
    for wrong in item["caught"]:
        name, _, mistake = wrong.partition(": ")
        found = {(name, one.check) for one in list_mistakes(EXERCISES[name]) if one.name == mistake}
        assert found, f"solutions/{name}/mistakes.py has no {mistake!r}"
        assert found <= checks, f"{mistake!r} falls to another check: {found}"
    assert item["caught"]


@each_item
def test_the_damage_and_the_effects_of_an_item_are_drawn_for_learners(item):
    damage, effects = item.get("damage", []), item.get("effects", [])
    assert {*damage} <= plants() & {"clean", *FAULTS}, "exercise 7 plants other damage"
    assert {*effects} <= hides() & {*EFFECTS}, "exercise 12 hides other effects"


@each_claim
def test_claim_of_the_source_lesson_is_shown_next_to_the_fact(claim):
    for lesson, said, fact in claim.get("boxes", []):
        against = [facts for claimed, facts in boxes(lesson) if said in claimed]
        assert against, f"lesson {lesson} no longer quotes {said!r}"
        assert any(fact in facts for facts in against), f"lesson {lesson}: {fact!r} is gone"
    for place in claim.get("prose", []):
        assert_taught(*place)
    assert claim.get("boxes") or claim.get("prose")


@each_fact
def test_a_fact_is_taught_where_the_table_says(fact):
    assert fact.get("taught") or fact.get("texts")
    for place in fact.get("taught", []):
        assert_taught(*place)
    for path, words in fact.get("texts", []):
        assert words in one_line(path), f"{path}: {words!r} is gone"


@each_fact
def test_a_fact_has_a_test_that_shows_it(fact):
    assert fact["tests"]
    for one in fact["tests"]:
        name, _, function = one.partition("::")
        text = (ROOT / "tests" / name).read_text(encoding="utf-8")
        assert f"\ndef {function}(" in text, f"tests/{name} has no {function}"


@each_fact
def test_fact_has_its_source_pinned_to_one_version(fact):
    beside = [sections(lesson)[title][1] for lesson, title, _ in fact.get("taught", [])]
    beside += [one_line(path) for path, _ in fact.get("texts", [])]
    assert fact["sources"]
    for source in fact["sources"]:
        assert PINNED.fullmatch(source), f"not of one version: {source}"
        assert any(source in text for text in beside), f"not beside what it says: {source}"


def test_links_to_source_code_are_pinned():
    moving = re.compile(
        r"github\.com/\S+?/(?:blob|tree)/(?:main|master)/|github\.wpilib\.org/\S+/(?:release|development)/"
    )
    for folder in ("lessons", "exercises", "sim"):
        for path in (ROOT / folder).rglob("*"):
            if path.suffix in {".py", ".md", ".toml"}:
                assert not moving.search(path.read_text("utf-8")), path


@each_lesson
def test_a_box_says_what_the_lesson_says_then_the_source_with_a_link_then_what_to_try(lesson):
    assert boxes(lesson), f"lesson {lesson} has no box: > **Lesson says:** and > **Source says:**"
    for claimed, facts in boxes(lesson):
        source, _, tried = facts.partition("**Try it")
        assert claimed.startswith("**Lesson says:**"), claimed
        assert "](https://" in source, f"no source: {claimed}"
        assert len(tried) > len(":** do"), f"nothing to try: {claimed}"


@each_lesson
def test_the_practice_of_a_lesson_names_its_exercises_and_how_to_grade_them(lesson):
    _, text = sections(lesson)["Practice"]
    named = {f"exercise{number}" for number in re.findall(r"\*\*Exercise (\d+)", text)}
    named |= {"practice"} if "**Practice" in text else set()
    told = f"Practice, or [practice] of traceability.toml, names other exercises of lesson {lesson}"
    assert named == {*TABLE["practice"].get(lesson, ())}, told
    for name in named:
        assert f"grade {name}" in text


def test_every_exercise_is_practice_of_a_lesson():
    named = {name for names in TABLE["practice"].values() for name in names}
    assert named == {*EXERCISES}, "traceability.toml, [practice]: lesson -> its exercises"


@pytest.mark.parametrize("name", EXERCISES)
def test_pointer_hint_names_existing_sections(name):
    _, pointer, _ = EXERCISES[name].hints
    sent = set()
    for part in re.split(r"(?=[Ll]esson \d)", pointer)[1:]:
        lesson = re.match(r"[Ll]esson (\d+)", part)[1].zfill(2)
        lists = re.findall(r"[Ss]ections? (\d+(?:(?:, | and |, and )\d+)*)", part)
        sent |= {(lesson, number) for one in lists for number in re.findall(r"\d+", one)}
    meant = set()
    assert name in TABLE["pointers"], f"traceability.toml, [pointers]: where {name}'s hint sends to"
    for lesson, heading in TABLE["pointers"][name]:
        assert heading in sections(lesson), f"lesson {lesson} has no section {heading!r}"
        meant.add((lesson, sections(lesson)[heading][0]))
    assert sent == meant, "left: lesson and section in the hint; right: in [pointers]"


@pytest.mark.parametrize("code", MISCONCEPTIONS)
def test_misconception_points_to_an_existing_section(code):
    known = MISCONCEPTIONS[code]
    assert LESSONS[known.lesson[:2]].stem == known.lesson
    assert known.section in sections(known.lesson[:2])


def rows(text, heading):
    """The rows of the first table below a heading, each as its cells."""
    _, _, below = text.partition(heading)
    table = re.search(r"^\|[-:| ]+\|\n((?:\|.*\n)+)", below, re.MULTILINE)[1]
    return [[cell.strip() for cell in row.strip(" |").split("|")] for row in table.splitlines()]


@pytest.mark.shared
def test_the_table_has_every_row_of_the_curriculum_in_its_order(shared):
    given = rows((shared / "curriculum.md").read_text(encoding="utf-8"), "### 6 Traceability")
    assert len(given) == len(TABLE["item"])
    for (_, lessons, asked, *_), item in zip(given, TABLE["item"], strict=True):
        names = {
            re.sub(r"^\d", r"exercise\g<0>", one) for one in re.findall(r"\d+|practice", asked)
        }
        missed = {f"0{one}" for one in re.findall(r"N(\d)", lessons)} - {
            at for at, *_ in item["taught"]
        }
        missed |= names - {one.partition(".")[0] for one in item["checks"]}
        assert not missed, f"{item['says']}: the curriculum names {missed} as well"


@pytest.mark.shared
def test_false_statement_of_the_source_lesson_has_a_box(shared):
    facts = rows((shared / "facts.md").read_text(encoding="utf-8"), "against the facts")
    boxed = {claim["row"] for claim in TABLE["claim"] if claim.get("boxes")}
    assert {number for number, *_ in facts} == {claim["row"] for claim in TABLE["claim"]}
    assert {number for number, *_, mark, _ in facts if {"🔴", "🟠"} & {*mark}} <= boxed
