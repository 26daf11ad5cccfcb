"""The same dataset from a Dask cluster of real worker processes."""

import builtins
import importlib.util
import sys

import pytest
from dataset_made import DAMAGED, PLAIN, files, key, make_dataset, process, spec, sysid

from sim.bench.dataset.making import make_log
from sim.bench.dataset.plan import plan_jobs
from sim.bench.dataset.secret import find_secret
from sim.bench.dataset.spec import read_spec
from sim.support.work import cluster

needs_dask = pytest.mark.skipif(
    importlib.util.find_spec("distributed") is None,
    reason="Dask is not installed (extra `cluster`)",
)


@pytest.fixture(autouse=True)
def _no_secret_around(monkeypatch):
    monkeypatch.delenv("SYSID_SECRET", raising=False)


@pytest.fixture(scope="module")
def address():
    """The scheduler of a cluster with two workers, each a process of its own."""
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address="127.0.0.1:0"
    ) as found:
        yield found.scheduler_address


@needs_dask
def test_a_cluster_makes_the_files_that_one_process_makes(tmp_path, address):
    path = spec(tmp_path, DAMAGED.replace("count = 2", "count = 20"))  # 22 logs of each student
    here = make_dataset(path, "here", "--processes", 1)

    asked = ("dataset", "spec.toml", "-o", "there", "--cluster", address)
    with process(*asked, folder=tmp_path) as running:
        said = running.communicate(timeout=100)

    assert running.returncode == 0, said
    assert said[1] == ""
    assert len(files(here)) == 88
    assert files(tmp_path / "there") == files(here)
    assert key(tmp_path / "there") == key(here)


@needs_dask
def test_a_worker_of_many_threads_makes_the_same(tmp_path):
    distributed = pytest.importorskip("distributed")
    path = spec(tmp_path, PLAIN.replace("count = 2", "count = 10"))
    with distributed.LocalCluster(
        n_workers=1, threads_per_worker=4, processes=True, dashboard_address="127.0.0.1:0"
    ) as found:
        there = make_dataset(path, "there", "--cluster", found.scheduler_address)

    assert files(there) == files(make_dataset(path, "here"))


@needs_dask
def test_a_refusal_on_a_worker_comes_back_as_one(tmp_path, address):
    late = '[[logs.faults]]\nname = "loop-overrun"\nat = 0.99\ntest = "dynamic-forward"\n'
    asked = read_spec(spec(tmp_path, PLAIN + late))  # a test of 1 s drives for 0.96 s
    jobs = plan_jobs(asked, find_secret(asked, make=False))

    found = list(cluster.run_jobs_on_cluster(make_log, jobs, address=address))

    assert {one.job for one in found} == set(jobs)
    assert all("0.99 s is not within dynamic-forward" in one.what for one in found)


@needs_dask
def test_a_cluster_that_is_lost_is_one_line(tmp_path, monkeypatch):
    monkeypatch.setattr(cluster, "PATIENCE", 1.0)  # [s] to take leave of who is gone
    asked = read_spec(spec(tmp_path, PLAIN.replace("count = 2", "count = 200")))
    jobs = plan_jobs(asked, find_secret(asked, make=False))
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(
        n_workers=1, processes=False, protocol="tcp", dashboard_address="127.0.0.1:0"
    ) as found:
        making = cluster.run_jobs_on_cluster(make_log, jobs, address=found.scheduler_address)
        next(making)
        found.close()
        with pytest.raises(cluster.BadRequest, match="was lost .* again to go on"):
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
def test_a_scheduler_that_is_not_there_is_one_line(tmp_path, monkeypatch, capsys, given, said):
    monkeypatch.setattr(cluster, "PATIENCE", 0.2)  # [s]

    assert sysid("dataset", spec(tmp_path), "-o", tmp_path / "data", "--cluster", given) == 2

    shown = capsys.readouterr().err
    assert said in shown
    assert shown.count("\n") == 1
    assert sorted(one.name for one in tmp_path.iterdir()) == ["spec.toml"]


def test_without_dask_the_extra_is_named(tmp_path, monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "distributed", None)  # as if it were not installed

    asked = ("--cluster", "tcp://127.0.0.1:8786")
    assert sysid("dataset", spec(tmp_path), "-o", tmp_path / "data", *asked) == 2

    shown = capsys.readouterr().err
    assert 'Install the extra "cluster": pip install "sysid-course[cluster]"' in shown
    assert shown.count("\n") == 1
    assert not (tmp_path / "data").exists()


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
def test_workers_that_would_make_something_else_are_refused(has, said):
    with pytest.raises(cluster.BadRequest, match=said):
        cluster._count_workers(Workers(*has), "tcp://host:1")
