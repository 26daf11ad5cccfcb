"""The same class graded by a Dask cluster of real worker processes."""

import importlib.util

import pytest
from small_course import HALF, RIGHT, lay_out

from grader.cli import run_command

pytestmark = pytest.mark.skipif(
    importlib.util.find_spec("distributed") is None,
    reason="Dask is not installed (extra `cluster`)",
)


@pytest.fixture(scope="module")
def address():
    """The scheduler of a cluster with two workers, each a process of its own."""
    distributed = importlib.import_module("distributed")
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address="127.0.0.1:0"
    ) as found:
        yield found.scheduler_address


def contents(folder):
    return {
        path.relative_to(folder).as_posix(): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }


def test_a_cluster_gives_the_results_that_one_process_gives(tmp_path, monkeypatch, address):
    lay_out(tmp_path / "course")
    monkeypatch.chdir(tmp_path / "course")
    for number in range(12):
        place = tmp_path / "in" / f"student{number:02d}" / "exercise1"
        place.mkdir(parents=True)
        text = (RIGHT, HALF, 'size = "boom"\n')[number % 3]
        (place / "answers.toml").write_text(text, encoding="utf-8")
    asked = ["class", str(tmp_path / "in"), "--export", "gradescope"]

    assert run_command([*asked, "-o", str(tmp_path / "here")]) == 1
    assert run_command([*asked, "-o", str(tmp_path / "there"), "--cluster", address]) == 1
    assert contents(tmp_path / "there") == contents(tmp_path / "here")


def test_a_cluster_that_is_not_there_is_one_line(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr("sim.support.work.cluster.PATIENCE", 0.2)
    lay_out(tmp_path / "course")
    monkeypatch.chdir(tmp_path / "course")
    (tmp_path / "in" / "ann").mkdir(parents=True)

    command = ["class", str(tmp_path / "in"), "--cluster", "tcp://127.0.0.1:1"]
    assert run_command(command) == 2
    assert "no Dask scheduler answers" in capsys.readouterr().err
