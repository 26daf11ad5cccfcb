"""One executor for datasets and classes: child processes here, or those of a Dask cluster."""

import builtins
import importlib.util
import multiprocessing
import os
import signal
import sys
from collections import Counter

import pytest
from dataset_made import PLAIN, key, make_dataset, process, spec
from many_jobs import DIES, HANGS, square, square_in_child
from places import read_all
from small_course import HALF, RIGHT, lay_out

from grader.cli import run_command
from sim.bench.dataset.making import make_log
from sim.bench.dataset.plan import plan_jobs
from sim.bench.dataset.spec import read_spec
from sim.core.errors import BadRequest
from sim.support.work import cluster
from sim.support.work.child import NAME
from sim.support.work.executor import WorkerLost, collect_results, run_jobs

pytestmark = pytest.mark.slow

needs_dask = pytest.mark.skipif(
    importlib.util.find_spec("distributed") is None,
    reason="Dask is not installed (extra `cluster`)",
)
TINY = """
name = "many"
seed = 1
[routine]
timeout = 0.3
step = 3.0
[[logs]]
mechanisms = "drivetrain"
drawn = false
count = 100
"""


@pytest.fixture(scope="module")
def address():
    """The scheduler of a cluster with two workers, each a process of its own."""
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address="127.0.0.1:0"
    ) as found:
        yield found.scheduler_address


@pytest.fixture(params=["here", pytest.param("there", marks=needs_dask)])
def executor(request):
    """The address of a cluster, or None for processes of this machine."""
    return request.getfixturevalue("address") if request.param == "there" else None


def children():
    """The child processes that do jobs."""
    return [one for one in multiprocessing.active_children() if one.name == NAME]


def test_failing_jobs_do_not_affect_the_other_jobs(executor):
    jobs = range(500 if executor else 2_000)  # Dask takes some milliseconds for each
    results = collect_results(square_in_child, jobs, processes=2, cluster=executor)

    expected = Counter(n * n for n in jobs if n not in {DIES, HANGS})
    assert Counter(results) == expected + Counter(["ChildEnded", "TimeoutError"])
    assert children() == []


def test_a_child_that_dies_ends_a_run_whose_work_must_be_whole(executor):
    with pytest.raises(WorkerLost, match="perhaps because the memory was full. Run the same"):
        list(run_jobs(square, range(DIES + 1), processes=2, worth=1, cluster=executor))


def test_exception_of_a_job_returns_with_its_traceback(executor):
    with pytest.raises(TypeError) as raised:
        list(run_jobs(square, [3, "x"], processes=2, worth=1, cluster=executor))

    assert "return number * number" in raised.value.__notes__[0]


def test_a_stopped_run_ends_children_that_hang():
    def stop():
        if children():
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        list(collect_results(square_in_child, [HANGS] * 3, processes=2, stop_if_asked=stop))

    assert children() == []
    assert list(collect_results(square_in_child, [3], processes=2)) == [9]  # and again


@pytest.mark.skipif(sys.platform == "win32", reason="a test cannot press Ctrl+C on Windows")
def test_ctrl_c_does_not_reach_the_children():
    results = collect_results(square_in_child, [1, HANGS, 2], processes=2)
    assert next(results) in {1, 4}
    for child in children():
        os.kill(child.pid, signal.SIGINT)

    assert list(results) in ([1, "TimeoutError"], [4, "TimeoutError"])


def test_jobs_of_one_thread_share_one_child():
    jobs, seen = range(100, 2_000), set()

    for _ in collect_results(square_in_child, jobs, processes=1):
        seen |= {child.pid for child in children()}

    assert len(seen) == 1


def test_dataset_and_key_are_the_same_from_processes_and_from_a_cluster(tmp_path, executor):
    path = spec(tmp_path, TINY)  # 100 logs: worth two processes
    one = make_dataset(path, "one", "--processes", 1)

    asked = ("--cluster", executor) if executor else ("--processes", 2)
    with process("dataset", "spec.toml", "-o", "two", *asked, folder=tmp_path) as running:
        said = running.communicate(timeout=100)

    assert (running.returncode, said[1]) == (0, ""), said
    assert len(read_all(one)) == 100
    assert read_all(tmp_path / "two") == read_all(one)
    assert key(tmp_path / "two") == key(one)


@needs_dask
def test_cluster_worker_with_many_threads_makes_the_same_dataset(tmp_path):
    distributed = pytest.importorskip("distributed")
    path = spec(tmp_path, TINY.replace("100", "10"))
    with distributed.LocalCluster(
        n_workers=1, threads_per_worker=4, processes=True, dashboard_address="127.0.0.1:0"
    ) as found:
        there = make_dataset(path, "there", "--cluster", found.scheduler_address)

    assert read_all(there) == read_all(make_dataset(path, "here"))


def test_class_is_graded_the_same_by_processes_and_by_a_cluster(tmp_path, monkeypatch, executor):
    lay_out(tmp_path / "course")
    monkeypatch.chdir(tmp_path / "course")
    for number in range(12):
        place = tmp_path / "in" / f"student{number:02d}" / "exercise1"
        place.mkdir(parents=True)
        text = (RIGHT, HALF, 'size = "boom"\n')[number % 3]
        (place / "answers.toml").write_text(text, encoding="utf-8")
    asked = ["class", str(tmp_path / "in"), "--export", "gradescope"]

    assert run_command([*asked, "-o", str(tmp_path / "one"), "--processes", "1"]) == 1
    other = ["--cluster", executor] if executor else ["--processes", "2"]
    assert run_command([*asked, "-o", str(tmp_path / "two"), *other]) == 1
    assert read_all(tmp_path / "two") == read_all(tmp_path / "one")


def test_refusal_of_a_job_is_raised_as_a_refusal(tmp_path, executor):
    late = '[[logs.faults]]\nname = "loop-overrun"\nat = 0.99\ntest = "dynamic-forward"\n'
    asked = read_spec(spec(tmp_path, PLAIN + late))  # a test of 1 s drives for 0.96 s
    jobs = plan_jobs(asked, asked.find_secret(make=False))

    with pytest.raises(BadRequest, match=r"number 1 \(log-0.\).*0.99 s is not within dynamic-fo"):
        list(run_jobs(make_log, jobs, processes=2, worth=1, cluster=executor))


@needs_dask
def test_a_lost_cluster_gets_one_line(monkeypatch):
    monkeypatch.setattr(cluster, "PATIENCE", 1.0)  # [s] to take leave of who is gone
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(
        n_workers=1, processes=False, protocol="tcp", dashboard_address="127.0.0.1:0"
    ) as found:
        jobs = range(100, 10_000)
        making = run_jobs(square, jobs, processes=1, worth=1, cluster=found.scheduler_address)
        next(making)
        found.close()
        with pytest.raises(BadRequest, match="was lost .* again to go on"):
            list(making)


@needs_dask
@pytest.mark.parametrize(
    ("given", "said"),
    [
        ("nonsense", "'nonsense' is not the address of a Dask scheduler. Start one with: dask sch"),
        ("http://host:1", "is not the address of a Dask scheduler"),
        ("tcp://127.0.0.1:9", "no Dask scheduler answers at tcp://127.0.0.1:9 (OSError). Start"),
    ],
)
def test_a_missing_scheduler_gets_one_line(monkeypatch, given, said):
    monkeypatch.setattr(cluster, "PATIENCE", 0.2)  # [s]

    with pytest.raises(BadRequest) as refused:
        list(run_jobs(square, [1], processes=1, worth=1, cluster=given))

    assert said in str(refused.value)


def test_message_without_dask_names_the_extra_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)  # as if it were not installed

    with pytest.raises(BadRequest, match='Install it: python -m pip install "distributed'):
        list(run_jobs(square, [1], processes=1, worth=1, cluster="tcp://127.0.0.1:8786"))


def test_nothing_but_a_cluster_imports_dask(tmp_path, monkeypatch):
    real = builtins.__import__

    def watched(name, *arguments, **named):
        assert not name.startswith(("distributed", "dask"))
        return real(name, *arguments, **named)

    monkeypatch.setattr(builtins, "__import__", watched)
    monkeypatch.setattr(cluster, "import_module", pytest.fail)

    make_dataset(spec(tmp_path))


class Workers:
    """A connection to workers that have something else installed."""

    def __init__(self, *has):
        self.has = has

    def run(self, *_arguments, **_named):
        """What each worker answers."""
        return {f"tcp://worker:{number}": one for number, one in enumerate(self.has)}


@pytest.mark.parametrize(
    ("has", "said"),
    [
        ((), "has no workers. Start some with: dask worker tcp://host:1"),
        (("0.0.1",), "the worker at tcp://worker:0 has sysid-course 0.0.1. Install sysid-course"),
        ((ModuleNotFoundError("sim"),), "the worker at tcp://worker:0 has no sysid-course."),
    ],
)
def test_workers_with_another_version_are_refused(has, said):
    with pytest.raises(BadRequest, match=said):
        cluster._count_threads(Workers(*has), "tcp://host:1")
