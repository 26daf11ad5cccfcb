"""sysid dataset: one spec and secret, always the same files, and a key that tells the truth."""

import json
from dataclasses import replace

import numpy as np
import pytest
from dataset_made import DAMAGED, PLAIN, SECRET, key, make_dataset, spec, sysid
from places import read_all

import sim
from sim.bench.dataset import making
from sim.bench.dataset.plan import DAMAGE, FAULT, MECHANISM, RECORD, plan_jobs
from sim.bench.dataset.spec import read_spec
from sim.bench.simulate import simulate
from sim.inspect.contaminate import contaminate


def jobs_of(path):
    asked = read_spec(path)
    return plan_jobs(asked, asked.find_secret(make=False))


def test_dataset_has_a_folder_of_logs_and_a_key_next_to_it(tmp_path, capsys):
    folder = make_dataset(spec(tmp_path))

    assert list(read_all(folder)) == [f"log-0{number}.wpilog" for number in (1, 2, 3, 4)]
    assert sorted(log["mechanism"] for log in key(folder)["logs"]) == [
        "drivetrain", "drivetrain", "shooter", "shooter",
    ]  # fmt: skip
    assert capsys.readouterr().out == (
        f"{folder}: 4 logs. The truth about them: {tmp_path / 'data.key.json'}\n"
    )


def test_students_have_folders_of_their_own_and_each_format_is_written(tmp_path):
    made = read_all(make_dataset(spec(tmp_path, DAMAGED)))

    assert list(made) == [
        f"{student}/log-0{number}.{ending}"
        for student in ("ann", "bo")
        for number in (1, 2, 3, 4)
        for ending in ("csv", "wpilog")
    ]


def test_the_same_spec_and_secret_give_the_same_bytes(tmp_path):
    path = spec(tmp_path, DAMAGED)

    assert read_all(make_dataset(path, "one")) == read_all(make_dataset(path, "two"))
    assert key(tmp_path / "one") == key(tmp_path / "two")


@pytest.mark.parametrize(
    "other",
    [
        pytest.param({"text": DAMAGED, "secret": SECRET + "!"}, id="another secret"),
        pytest.param({"text": DAMAGED.replace("week3", "week4")}, id="another name"),
    ],
)
def test_another_seed_or_secret_changes_the_bytes_of_every_file(tmp_path, other):
    (tmp_path / "other").mkdir()
    ours = read_all(make_dataset(spec(tmp_path, DAMAGED)))

    theirs = read_all(make_dataset(spec(tmp_path / "other", **other)))

    assert list(ours) == list(theirs)
    assert not [file for file in ours if ours[file] == theirs[file]]


def test_more_students_leave_the_logs_of_the_others_as_they_are(tmp_path, capsys):
    before = read_all(make_dataset(spec(tmp_path, DAMAGED)))

    after = read_all(make_dataset(spec(tmp_path, DAMAGED.replace('["ann"', '["zoe", "ann"'))))

    assert before.items() <= after.items()
    assert len(after) == len(before) + 8
    assert "12 logs, 8 of them made earlier" in capsys.readouterr().out


def test_a_fault_is_all_that_differs_from_the_clean_log(tmp_path):
    fault = '[[logs.faults]]\nname = "loop-overrun"\ntest = "dynamic-forward"\n'
    clean = {job.seed: job for job in jobs_of(spec(tmp_path))}
    spoilt = {job.seed: job for job in jobs_of(spec(tmp_path, PLAIN + fault))}

    assert clean.keys() == spoilt.keys()
    for seed, job in clean.items():
        here, there = making.make_log(job), making.make_log(spoilt[seed])
        assert here.truth["gains"] == there.truth["gains"]
        assert here.contents != there.contents


def test_fault_time_after_the_end_of_a_test_is_drawn_again(tmp_path):
    late = '[[logs.faults]]\nname = "loop-overrun"\ntest = "dynamic-forward"\nat = [0.1, 1.0]\n'
    text = PLAIN.replace("count = 2", "count = 20") + late  # a test of 1 s drives for 0.94 s

    made = [making.make_log(job) for job in jobs_of(spec(tmp_path, text))]

    assert len(made) == 40  # each draws a moment after the end 1 time in 15
    assert all(isinstance(one, making.MadeLog) for one in made)


def test_each_purpose_has_a_random_generator_of_its_own(tmp_path):
    jobs = jobs_of(spec(tmp_path, DAMAGED))
    purposes = [(MECHANISM,), (RECORD,), (DAMAGE, 0, 0), (DAMAGE, 1, 0), (DAMAGE, 0, 1), (FAULT, 0)]

    drawn = {job.make_random_stream(*which).random() for job in jobs for which in purposes}

    assert len(drawn) == len(jobs) * len(purposes)


def test_another_processor_gives_the_same_bytes(tmp_path, monkeypatch):
    def off_by_a_bit(log):
        return replace(log, runs=tuple(replace(run, **last_bits(run)) for run in log.runs))

    def spoilt_there(spoilt):
        return replace(spoilt, log=off_by_a_bit(spoilt.log))

    def last_bits(run):
        names = ("time", "voltage", "position", "velocity")
        return {name: np.nextafter(getattr(run, name), np.inf) for name in names}

    path = spec(tmp_path, DAMAGED)
    here = read_all(make_dataset(path, "here"))
    monkeypatch.setattr(making, "simulate", lambda *a, **k: off_by_a_bit(simulate(*a, **k)))
    monkeypatch.setattr(making, "contaminate", lambda *a, **k: spoilt_there(contaminate(*a, **k)))

    assert read_all(make_dataset(path, "there")) == here


def test_a_log_holds_the_tests_that_are_asked_for(tmp_path):
    tests = '["coast-reverse", "quasistatic-forward", "quasistatic-reverse"]'
    text = PLAIN.replace("step = 3.0", f"step = 3.0\ntests = {tests}\nelectrical = true")

    log = sim.read(make_dataset(spec(tmp_path, text)) / "log-01.wpilog")

    assert [run.test for run in log.runs] == [
        "quasistatic-forward", "quasistatic-reverse", "coast-reverse",
    ]  # fmt: skip
    assert all(run.current is not None and run.bus_voltage is not None for run in log.runs)


def test_number_of_a_log_does_not_reveal_its_faults(tmp_path):
    text = PLAIN.replace("seed = 1", 'secret = "class.secret"\nstudents = {names}')
    names = json.dumps([f"student {number}" for number in range(40)])
    fault = '[[logs]]\nmechanisms = "shooter"\n[[logs.faults]]\nname = "sign-flip"\n'
    jobs = jobs_of(spec(tmp_path, text.replace("{names}", names) + fault))

    numbers = [job.name[-2:] for job in jobs if job.draw_faults()]

    assert len(numbers) == 40
    assert set(numbers) == {
        "01",
        "02",
        "03",
        "04",
        "05",
    }  # 40 draws miss one of five 1 time in 1500


def test_a_full_temporary_folder_is_refused_in_one_line(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(making.tempfile, "tempdir", str(tmp_path / "none"))

    assert sysid("dataset", spec(tmp_path), "-o", tmp_path / "data") == 2

    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert "a temporary file cannot be written (No such file or directory). Make room" in said


def test_the_example_can_be_made_as_it_is(tmp_path, capsys):
    path = tmp_path / "week3.toml"

    assert sysid("dataset", path, "--example") == 0
    folder = make_dataset(path)

    assert f"sysid dataset {path} -o week3" in capsys.readouterr().out
    assert len(read_all(folder)) == 2 * (4 + 4 + 4)  # students x (clean + damaged + swerve)
    assert sysid("dataset", path, "--example") == 2  # what is there is not overwritten


def test_commanded_voltages_of_the_example_do_not_reveal_damaged_logs(tmp_path):
    path = tmp_path / "week3.toml"
    sysid("dataset", path, "--example")
    commanded = {}

    for entry in key(make_dataset(path))["logs"]:
        (file,) = entry["files"]
        log = sim.read(tmp_path / "data" / file, units=entry["units"])
        voltages = tuple(  # of the steps, to half a volt: a ramp ends where its room ends
            (run.test, round(2.0 * float(abs(run.voltage).max())) / 2.0)
            for run in log.runs
            if run.kind == "dynamic"
        )
        commanded.setdefault(entry["mechanism"], set()).add(voltages)
    kinds = {True: set(), False: set()}
    for job in jobs_of(path):
        kinds[bool(job.table.faults)].add(job.mechanism)
        if job.table.faults and job.table.faults[0].chance < 1.0:
            kinds[False].add(job.mechanism)

    assert {mechanism: len(found) for mechanism, found in commanded.items()} == dict.fromkeys(
        commanded, 1
    )
    assert kinds[True] == kinds[False] == set(commanded)
