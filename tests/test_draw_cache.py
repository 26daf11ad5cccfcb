"""What was drawn for somebody who studies alone is kept for their next answer, and nothing else."""

import os
import pickle
import runpy
from types import SimpleNamespace

import pytest

from grader.student_data import draw_cache as room
from grader.student_data.draw_cache import enable_draw_cache
from grader.student_data.student_files import write_student_files
from grader.student_data.variant import use_class_secret
from sim.support.work import cache

DRAWN = """
from grader.student_data.draw_cache import cache_generated_data

COUNT = []

@cache_generated_data
def draw(student):
    COUNT.append(student)
    return {"student": student, "number": NUMBER}
"""


@pytest.fixture
def shelf(tmp_path, monkeypatch):
    """The folder of what is kept, empty."""
    monkeypatch.setenv(cache.CACHE, str(tmp_path / "cache"))
    room._fingerprint_code.cache_clear()
    return tmp_path / "cache" / "drawn"


def loaded(folder, number=5):
    """The module of an exercise that draws, as another process would load it."""
    folder.mkdir(exist_ok=True)
    path = folder / "drawn.py"
    path.write_text(DRAWN.replace("NUMBER", str(number)), encoding="utf-8")
    room._fingerprint_code.cache_clear()
    return SimpleNamespace(**runpy.run_path(str(path)))


def test_cached_numbers_are_not_drawn_again(shelf, tmp_path):
    first, second = loaded(tmp_path / "exercise7"), loaded(tmp_path / "exercise7")
    with enable_draw_cache():
        drawn = first.draw("ann")
        assert second.draw(" ANN ") == drawn == {"student": "ann", "number": 5}

    assert (first.COUNT, second.COUNT) == (["ann"], [])
    assert [path.suffix for path in shelf.iterdir()] == [".drawn"]


def test_numbers_of_a_class_are_neither_cached_nor_read_from_the_cache(shelf, tmp_path):
    module = loaded(tmp_path / "exercise7")
    with enable_draw_cache(), use_class_secret(b"of the class"):
        module.draw("ann")
        module.draw("ann")
    assert not shelf.exists()

    with enable_draw_cache():
        module.draw("ann")
        with use_class_secret(b"of the class"):
            module.draw("ann")
    assert module.COUNT == ["ann"] * 4


def test_nothing_is_cached_by_default(shelf, tmp_path):
    loaded(tmp_path / "exercise7").draw("ann")

    assert not shelf.exists()


def test_changed_code_draws_new_numbers(shelf, tmp_path):
    with enable_draw_cache():
        assert loaded(tmp_path / "exercise7", 5).draw("ann")["number"] == 5
        assert loaded(tmp_path / "exercise7", 6).draw("ann")["number"] == 6

    assert len(list(shelf.iterdir())) == 2


@pytest.mark.parametrize(
    "content",
    [b"", b"no pickle", pickle.dumps({"student": "ann", "number": 5})[:-4], b"cgone\nGone\n."],
    ids=["empty", "no pickle", "cut short", "a class that is gone"],
)
def test_a_damaged_file_is_drawn_again(shelf, tmp_path, content):
    module = loaded(tmp_path / "exercise7")
    with enable_draw_cache():
        module.draw("ann")
        (file,) = shelf.iterdir()
        file.write_bytes(content)
        assert module.draw("ann") == {"student": "ann", "number": 5}

    assert module.COUNT == ["ann", "ann"]
    assert pickle.loads(file.read_bytes())["number"] == 5  # noqa: S301 - written above


def test_oldest_cache_entries_are_deleted(shelf, tmp_path, monkeypatch):
    monkeypatch.setattr(room, "MOST", 3)
    module = loaded(tmp_path / "exercise7")
    with enable_draw_cache():
        for age, student in enumerate(["ann", "bob", "cid", "dan", "eve"]):
            module.draw(student)
            for file in shelf.iterdir():  # all that is there is older than what comes
                was = file.stat().st_mtime_ns
                os.utime(file, ns=(was - 10**9, was - 10**9 + age))
        module.COUNT.clear()
        module.draw("eve")
        module.draw("ann")

    assert len(list(shelf.iterdir())) == 3
    assert module.COUNT == ["ann"]


@pytest.mark.usefixtures("shelf")
def test_unchanged_files_are_not_written_again(tmp_path):
    made, exercise = [], tmp_path / "exercises" / "exercise7"
    files = {"log.csv": lambda path: (made.append(path), path.write_bytes(b"rows"))}
    told = {"exercise": exercise, "student": "ann", "say": lambda _: None}
    with enable_draw_cache():
        write_student_files(files, **told)
        write_student_files(files, **told)
        assert len(made) == 1
        (written,) = exercise.glob("data/*/log.csv")
        for change in (lambda: written.write_bytes(b"mine"), written.unlink):
            change()
            write_student_files(files, **told)
            assert written.read_bytes() == b"rows"

    assert len(made) == 3


def test_each_student_and_exercise_has_a_cache_entry_of_its_own(shelf, tmp_path):
    one, other = loaded(tmp_path / "exercise7"), loaded(tmp_path / "exercise8")
    with enable_draw_cache():
        assert one.draw("ann")["student"] == "ann"
        assert one.draw("bob")["student"] == "bob"
        assert other.draw("ann")["student"] == "ann"

    assert (one.COUNT, other.COUNT) == (["ann", "bob"], ["ann"])
    assert len(list(shelf.iterdir())) == 3


def test_data_is_drawn_where_no_cache_can_be_written(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("no folder", encoding="utf-8")
    monkeypatch.setenv(cache.CACHE, str(tmp_path / "file"))

    with enable_draw_cache():
        assert loaded(tmp_path / "exercise7").draw("ann")["number"] == 5
